// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// View of an image: transforms between pixels with depth buffer values and eye coordinates, in
// double precision. The eye looks along -z; eye depth is the distance along the view axis.
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

using Matrix = std::array<double, 16>; ///< row-major

struct VTKPENUMBRARENDERINGSCREENSPACE_EXPORT ScreenTransform
{
  int Width = 0; ///< of the image, margin included
  int Height = 0;
  bool Parallel = false;
  Matrix WorldToEye{};
  Matrix Projection{}; ///< eye to clip coordinates, margin included
  double Unit = 1.0;   ///< length of one shader unit, in world units

  /// Scale * pixel + Offset is (x, y) on the plane at eye depth 1; parallel: at any depth.
  double Scale[2] = { 1.0, 1.0 };
  double Offset[2] = { 0.0, 0.0 };
  double Skew = 0.0; ///< times y of a pixel is added to x

  /// Transform from VTK's camera coordinates to eye coordinates: not the identity in stereo, where
  /// VTK shears the projection instead of moving the camera, and if transforms of the application
  /// make camera coordinates oblique, while eye coordinates preserve lengths and angles.
  Matrix CameraToEye{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };

  /// A depth buffer value of this view times [0] plus [1] is the value that the clipping planes of
  /// the camera would give.
  double ToCameraDepth[2] = { 1.0, 0.0 };

  /// Creates the view of the renderer's camera for an image of this size, enlarged on every side by
  /// `margin` pixels.
  static ScreenTransform FromRenderer(
    vtkRenderer* renderer, const int size[2], const int margin[2]);

  /// Moves the clipping planes closer to `bounds` (world coordinates) if those of the camera are so
  /// far away that depths inside would be imprecise. Nothing inside `bounds` is clipped by the
  /// move. Returns whether the planes were moved.
  bool TightenClippingRange(const double bounds[6]);

  /// Returns a view with one pixel per block of `block` pixels per side: the center pixel of the
  /// block or, if `block` is even, the one after the center.
  ScreenTransform Downsampled(int block) const;

  /// Sets the uniforms of vtkPenumbraViewLib.glsl.
  void SetUniforms(vtkShaderProgram* program) const;
  /// Sets those of them that transform pixels to the plane at eye depth 1.
  void SetPixelUniforms(
    vtkShaderProgram* program, const char* toEye, const char* skew, const char* size) const;

  /// Returns the transform from eye coordinates of this view to those of `other`, each in its unit.
  /// `motion`, if given, is applied in world coordinates in between. The product is computed in
  /// double precision, so that camera motion stays exact with coordinates of 1e7.
  Matrix EyeTransformTo(const ScreenTransform& other, const double* motion = nullptr) const;

  /// Returns whether few points at `distance` (eye depth, world units) are seen in `other` from a
  /// similar direction, so that the two views are not consecutive frames of a motion.
  bool IsCutFrom(const ScreenTransform& other, double distance, double minimumCosine) const;

  /// Returns whether size, projection and camera position are equal; clipping planes may differ.
  bool HasSameView(const ScreenTransform& other) const;

private:
  /// Moves the origin of eye coordinates to the center of projection.
  void MoveOriginToEye();

  /// Returns whether camera coordinates preserve lengths and angles, up to rounding, and the
  /// projection keeps the axes of the image.
  bool HasStandardAxes() const;

  /// Replaces eye coordinates by ones that preserve lengths and angles. The projection stays the
  /// same from world to clip coordinates.
  void MakeEyeRigid();

  /// Returns the coefficients of first + second * (1 - depth buffer value), which is the eye depth
  /// or, in perspective, its inverse.
  std::pair<double, double> DepthToEye() const;
};

/// Replaces the line `//VTK::Penumbra::ViewLib` of a shader by vtkPenumbraViewLib.glsl.
VTKPENUMBRARENDERINGSCREENSPACE_EXPORT std::string AssembleView(const std::string& source);

/// Returns the world length of a pixel at the focal point of the camera.
double PixelAtFocus(vtkRenderer* renderer);

}
#endif
