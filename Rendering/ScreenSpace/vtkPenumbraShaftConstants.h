// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Constants of vtkPenumbraLightShaftPass. Benchmarks and tests change them through
// vtkPenumbraLightShaftPass::GetConstants(); their values are not checked.
#ifndef vtkPenumbraShaftConstants_h
#define vtkPenumbraShaftConstants_h

namespace penumbra
{

/// RADIAL: spacing of the samples.
enum class ShaftSpacings
{
  Even,
  Geometric ///< each step covers the same fraction of the remaining path to the light
};

/// RADIAL: treatment of occluders in the emission image [Shafts 13.5].
enum class ShaftOcclusions
{
  Mask,    ///< occluders are black; depth separates them from sky and emitters
  Prepass, ///< with emitters: the scene is rendered a second time, with black occluders
  Contrast ///< occluders emit their color times SurfaceEmission
};

/// RADIAL: emission of pixels without a surface, multiplied by the color of the light.
enum class ShaftSkies
{
  White, ///< white; black if there are emitters
  Image  ///< the image behind the scene
};

struct ShaftConstants
{
  /// Number of depth fetches per light and lit fraction. 0: 0.375 / Tolerance, at least 16 and at most
  /// one per two blocks of the larger image side; with SHADOW_MAP 1.5 / sqrt(Tolerance), at least 16.
  int Steps = 0;

  /// Margin around the image, in which occluders have an effect, in percent of the larger image side.
  /// Negative: 20 while a light without a shadow map is outside of the image, else 0. Requires
  /// OpaqueOnly.
  double Margin = -1.0;

  /// RADIAL [Shafts eq. 4]: factor on all samples, factor per 1/64 of the path, and ratio of the path to
  /// the light to the sampled path, at least 1.
  double Weight = 1.0;
  double Decay = 1.0;
  double PathRatio = 1.0;

  ShaftSpacings Spacing = ShaftSpacings::Even;

  /// RADIAL: number of chained passes. Each averages Steps samples of the previous one, so that
  /// Steps^Passes samples have an effect [Shafts 13.8]. More than one implies Geometric.
  int Passes = 1;

  ShaftOcclusions Occlusion = ShaftOcclusions::Mask;
  double SurfaceEmission = 0.2; ///< fraction of their color that occluders emit with Contrast
  ShaftSkies Sky = ShaftSkies::White;
};

}
#endif
