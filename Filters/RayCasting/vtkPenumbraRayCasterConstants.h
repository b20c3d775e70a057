// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Constants of vtkPenumbraRayCaster. Benchmarks, tests and the program change them through
// vtkPenumbraRayCaster::GetConstants(); their values are not checked.
#ifndef vtkPenumbraRayCasterConstants_h
#define vtkPenumbraRayCasterConstants_h

#include <string>

namespace penumbra
{

/// Methods to compute the fraction of a pixel that a surface covers.
enum class CoverageMethods
{
  Silhouettes, ///< exact areas between the projected edges of the surfaces
  Subdivision, ///< [AA]: recursive subdivision by five rays per pixel, down to MaximumLevel
  Uniform      ///< UniformSamples x UniformSamples rays per pixel, for comparison; no tolerance
};

struct RayCasterConstants
{
  CoverageMethods CoverageMethod = CoverageMethods::Silhouettes;

  /// Number of samples along each side of a pixel with Uniform. Range: [1, 64].
  int UniformSamples = 8;

  /// Maximum level of subdivision; subpixels of level L have the side 2^-L [AA eq. 3]. Range: [0, 6].
  int MaximumLevel = 3;

  /// If true, objects that lie between the corner rays (case 4 of [AA]) are found by their edges.
  bool FindSmallObjects = true;

  /// Number of shadow rays per light along a camera ray in a medium, in addition to those that locate
  /// the boundaries of shafts. 0: the number that LightTolerance requires. Range: [0, 4096].
  int LightShaftSteps = 0;

  /// If false, camera lights of vtkLight, such as those of vtkLightKit, light no medium.
  bool CameraLightShafts = true;

  /// If false, GeometryArrays does not compute ambient occlusion: the array `AmbientOcclusion` then
  /// holds NaN at pixels that show a surface.
  bool OcclusionArray = true;

  /// If true, corner rays are traced in packets of 16.
  bool UsePackets = true;

  /// The property of a caller that sets LightTolerance to its value, and Tolerance to a value of its own, for the
  /// warning of a missed tolerance. Empty: that warning has the names and values of the ray caster.
  std::string ToleranceProperty;
  double ToleranceValue = 0.0;
};

}
#endif
