// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Reference ambient occlusion of an image: [TSSAO eq. 1] at the centers of some pixels, by rays
// through the ray caster's scene.
#ifndef penumbra_occlusion_OcclusionReference_h
#define penumbra_occlusion_OcclusionReference_h

#include <vector>

class vtkRenderer;

namespace penumbra
{

class RayScene;

/// Surface point at the center of a pixel.
struct SeenPoint
{
  int Pixel;          ///< row * width + column
  double Position[3]; ///< world
  double Normal[3];   ///< unit, geometric, facing the camera
};

/// Every `stride`-th pixel in both directions that shows a surface.
std::vector<SeenPoint> PointsInImage(const RayScene& rays, int stride);

/// Function D of [TSSAO eq. 1] within the radius.
enum class Falloff
{
  Constant, ///< 1
  Linear    ///< 1 - t / R
};

struct OcclusionTruth
{
  int Width = 0;
  std::vector<int> Pixels; ///< surface pixels: row * width + column
  std::vector<float> Constant;
  std::vector<float> Linear;
};

/// Traces rays * rays directions at every `stride`-th pixel in both directions.
OcclusionTruth TraceOcclusion(
  vtkRenderer* renderer, const int size[2], double radius, int stride, int rays);

/// Returns, for each of these pixels, the fraction of rays * rays points for which "not visible
/// from the camera" differs from "occluded from the surface point". The points lie in the
/// hemisphere above the surface: directions are cosine-distributed, distances are uniform up to the
/// radius.
std::vector<float> TraceMisjudged(
  vtkRenderer* renderer, const int size[2], double radius, int stride, int rays);

/// RMS difference between the array of an image and the reference.
double Rmse(const OcclusionTruth& truth, Falloff falloff, const std::vector<float>& image);

/// Factor on the image that minimizes its difference from the reference.
double Gain(const OcclusionTruth& truth, Falloff falloff, const std::vector<float>& image);

}
#endif
