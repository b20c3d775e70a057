// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Renders triangle ids and depths of a scene into a hemicube with OpenGL, in an offscreen window,
// and reads them back.
#ifndef penumbra_HemicubeRenderer_h
#define penumbra_HemicubeRenderer_h

#include "Gathering/Gatherer.h"
#include "Hemicube.h"
#include "OpenGLThread.h"
#include "TriangleClusters.h"

#include <memory>
#include <vector>

namespace penumbra
{

/// Nearest triangle in a texel: its id (see TriangleClusters; 0 for background) and its depth along
/// the axis of the face.
struct HemicubeTexel
{
  float TriangleId;
  float Depth;
};

class HemicubeRenderer
{
public:
  /// Throws std::runtime_error if OpenGL is not available. All arguments must outlive this object.
  HemicubeRenderer(
    const std::vector<Surface>& surfaces, const TriangleClusters& clusters, const Hemicube& cube);
  ~HemicubeRenderer();

  /// Renders the triangles at distances in [near, far] from `eye`, above the plane through `eye` and in the
  /// hemisphere around the third axis of `frame`. Returns the number of rendered triangles. Thread-safe;
  /// concurrent calls are serialized.
  long long Draw(glm::vec3 eye, const TangentFrame& frame, float near, float far,
    std::vector<HemicubeTexel>& texels);

private:
  void Open(const std::vector<Surface>& surfaces);
  void DrawFace(const Hemicube::Face& face, glm::vec3 eye, const glm::mat3& frame, float near,
    float far, long long& triangles);

  struct Graphics;

  const TriangleClusters& Clusters;
  const Hemicube& Cube;
  std::unique_ptr<Graphics> OpenGL; ///< used only by Thread while it runs
  OpenGLThread Thread;
};

}
#endif
