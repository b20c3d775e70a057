// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Occlusion within a radius R with the falloff 1 - (t / R)^power, by one-dimensional integrals.
// Shares no code with the irradiance providers.
#ifndef penumbra_FalloffOcclusion_h
#define penumbra_FalloffOcclusion_h

namespace penumbra
{

struct FadingOcclusion
{
  double Radius;
  double Power; ///< 0: no falloff within the radius

  /// Occlusion of a floor at `distance` from an infinite wall that stands on it.
  double BeforeWall(double distance) const;

  /// Occlusion below an infinite ceiling at `height`.
  double UnderCeiling(double height) const;

  double At(double distance) const;
};

/// Exponents of vtkPenumbraIrradianceProvider::Falloffs, in the order of the enumeration.
constexpr double PowersOfFalloffs[] = { 0.0, 1.0, 2.0, .5 };

}
#endif
