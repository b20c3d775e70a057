// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// How a picture looks at its scene: from pixels and depth buffer to eye coordinates and back, in
// double. The eye looks along -z; eye depth is the distance along the view axis.
#ifndef penumbra_ScreenTransform_h
#define penumbra_ScreenTransform_h

#include "vtkPenumbraRenderingScreenSpaceModule.h" // for export macro

#include <array>
#include <string>
#include <utility>

class vtkRenderer;
class vtkShaderProgram;

namespace penumbra
{

using Matrix = std::array<double, 16>; ///< row after row

struct VTKPENUMBRARENDERINGSCREENSPACE_EXPORT ScreenTransform
{
  int Width = 0; ///< of the picture, margin included
  int Height = 0;
  bool Parallel = false;
  Matrix WorldToEye{};
  Matrix Projection{}; ///< eye to clip coordinates, margin included
  double Unit = 1.0;   ///< what shaders call 1, in world units

  /// (x, y) on the plane at eye depth 1 is Scale * pixel + Offset; parallel: anywhere.
  double Scale[2] = { 1.0, 1.0 };
  double Offset[2] = { 0.0, 0.0 };

  /// A depth buffer of this view times [0] plus [1] is the one that the camera's own clipping planes
  /// would have given.
  double ToCameraDepth[2] = { 1.0, 0.0 };

  /// The view of the renderer's camera into a picture of this size, enlarged on every side by
  /// `margin` pixels.
  static ScreenTransform FromRenderer(
    vtkRenderer* renderer, const int size[2], const int margin[2]);

  /// Moves the clipping planes closer to what lies in `bounds` (world coordinates), where the camera's
  /// are so far from it that its depths would be coarse; nothing in there is cut off by that. Returns
  /// whether it did.
  bool TightenClippingRange(const double bounds[6]);

  /// The view of one pixel in each block of this one's, `block` pixels a side: that in the middle, of
  /// two the latter.
  ScreenTransform Downsampled(int block) const;

  /// Sets the uniforms of vtkPenumbraViewLib.glsl.
  void SetUniforms(vtkShaderProgram* program) const;

  /// From this view's eye coordinates to those of another one, both in their units. The product is
  /// taken in double, so that the eye's motion survives coordinates of 1e7. `motion`, a matrix from
  /// world to world, comes in between.
  Matrix EyeTransformTo(const ScreenTransform& other, const double* motion = nullptr) const;

  /// Do both see the same from the same place? (Clipping planes may differ.)
  bool HasSameView(const ScreenTransform& other) const;

private:
  /// Eye depth, or in perspective its inverse, is first + second * (1 - depth of the depth buffer).
  std::pair<double, double> DepthToEye() const;
};

/// Shader text with vtkPenumbraViewLib.glsl in place of its line `//VTK::Penumbra::ViewLib`.
VTKPENUMBRARENDERINGSCREENSPACE_EXPORT std::string AssembleView(const std::string& source);

/// World length of a pixel at the camera's focal point.
double PixelAtFocus(vtkRenderer* renderer);

}
#endif
