// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Reference images by jittered samples. They share intersection, shading and the rules by which VTK
// blends layers with the ray caster, but neither the edges of meshes, coverage, sequences nor error
// estimates. The error of the reference is estimated from two independent sets of samples.
#ifndef penumbra_StratifiedReference_h
#define penumbra_StratifiedReference_h

#include "Scenes/TestScene.h"

#include <glm/glm.hpp>

#include <vector>

class vtkRenderer;

namespace penumbra
{

struct StratifiedReference
{
  std::vector<glm::dvec3> Colors;    ///< premultiplied by alpha, row by row from the bottom
  std::vector<double> SquaredErrors; ///< unbiased estimates of the squared RMSE per pixel
};

/// Renders two independent sets of `side` x `side` jittered samples per pixel.
StratifiedReference DrawStratified(
  vtkRenderer* renderer, int width, int height, int side, bool shadows);

/// Error and estimate of a tile of 16 x 16 pixels.
struct TileAccuracy
{
  double Error;    ///< RMSE, after subtracting the error of the reference
  double Estimate; ///< RMS of the estimated errors
};

/// Compares all tiles of an image with the reference.
std::vector<TileAccuracy> CompareTiles(
  const Answer& answer, const StratifiedReference& reference, int width);

/// Compares the colors of all tiles of two images, of which the second one is taken as exact.
std::vector<TileAccuracy> CompareTiles(const Answer& answer, const Answer& exact, int width);

}
#endif
