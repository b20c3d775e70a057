// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Ambient occlusion of a picture by rays from the ray caster's own scene: [TSSAO eq. 1] at the
// centres of some pixels.
#ifndef penumbra_occlusion_OcclusionReference_h
#define penumbra_occlusion_OcclusionReference_h

#include <vector>

class vtkRenderer;

namespace penumbra
{

class RayScene;

/// What the middle of a pixel shows.
struct SeenPoint
{
  int Pixel;          ///< row * width + column
  double Position[3]; ///< world
  double Normal[3];   ///< unit, geometric, facing the eye
};

/// Every `stride`-th pixel in both directions that shows a surface.
std::vector<SeenPoint> PointsInPicture(const RayScene& rays, int stride);

/// D of [TSSAO eq. 1] within the radius.
enum class Falloff
{
  Constant, ///< 1
  Linear    ///< 1 - t / R
};

struct OcclusionTruth
{
  int Width = 0;
  std::vector<int> Pixels; ///< that show a surface: row * width + column
  std::vector<float> Constant;
  std::vector<float> Linear;
};

/// Every `stride`-th pixel in both directions, rays * rays directions each.
OcclusionTruth TraceOcclusion(
  vtkRenderer* renderer, const int size[2], double radius, int stride, int rays);

/// For every such pixel the share of rays * rays points in the hemisphere over the surface, directions distributed
/// as the cosine, distances evenly up to the radius, of which 'hidden from the eye' does not say the
/// same as 'the way from the surface point is blocked'.
std::vector<float> TraceMisjudged(
  vtkRenderer* renderer, const int size[2], double radius, int stride, int rays);

/// RMS of the difference between a picture's array and the truth.
double Rmse(const OcclusionTruth& truth, Falloff falloff, const std::vector<float>& picture);

/// The factor on the picture that brings it nearest to the truth.
double Gain(const OcclusionTruth& truth, Falloff falloff, const std::vector<float>& picture);

}
#endif
