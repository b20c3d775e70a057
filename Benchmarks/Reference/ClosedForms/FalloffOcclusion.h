// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Occlusion within a radius R that falls off like 1 - (t / R)^power, by integrals of one variable. It
// shares no code with the irradiance sources.
#ifndef penumbra_FalloffOcclusion_h
#define penumbra_FalloffOcclusion_h

namespace penumbra
{

struct FadingOcclusion
{
  double Radius;
  double Power; ///< 0: everything within the radius counts in full

  /// Blocked at `distance` from an endless wall, on the floor that it stands on.
  double BeforeWall(double distance) const;

  /// Blocked under an endless ceiling at `height`.
  double UnderCeiling(double height) const;

  double At(double distance) const;
};

/// Powers of vtkPenumbraIrradianceProvider::Falloffs, in their order.
constexpr double PowersOfFalloffs[] = { 0.0, 1.0, 2.0, .5 };

}
#endif
