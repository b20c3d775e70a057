// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Coordinates of a scene: (world - Origin) * Scale in single precision.
//
// Origin is the camera position, or a point in front of the scene if the projection is parallel or
// the scene is far away, or, for scenes that are kept while the camera moves, a point beside the
// bounds (Geometry/FixedOrigin.h). Scenes at a distance of 1e7 from the world's origin and scenes of size 1e-6
// therefore keep their precision. Projections are computed in double precision from the rounded
// positions, so that projected edges match the traced triangles.
#ifndef penumbra_SceneCoordinates_h
#define penumbra_SceneCoordinates_h

#include <glm/glm.hpp>

namespace penumbra
{

struct SceneCoordinates
{
  glm::dvec3 Origin{ 0.0 };
  double Scale = 1.0;

  /// Convert world to scene coordinates and back.
  glm::dvec3 FromWorld(const double x[3]) const
  {
    return (glm::dvec3(x[0], x[1], x[2]) - this->Origin) * this->Scale;
  }
  glm::dvec3 ToWorld(glm::dvec3 x) const { return x / this->Scale + this->Origin; }
};

}
#endif
