// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Settings of a frame with light shafts, and the uniforms of the medium.
#ifndef penumbra_ShaftSettings_h
#define penumbra_ShaftSettings_h

#include "Frame/ScreenTransform.h"
#include "Medium/MediumCoefficients.h"
#include "ShaftRadialBlur.h"

#include <array>
#include <vector>

class vtkProp;
class vtkShaderProgram;

namespace penumbra
{

/// Settings of a frame; vtkPenumbraLightShaftPass describes them. Lengths are in world units.
struct ShaftSettings
{
  std::array<MediumCoefficients, 3> Channels; ///< red, green, blue
  bool Falloff = false;                       ///< the density falls off with height
  double ScaleHeight = 0.0;                   ///< used if Falloff is on, as are the following
  double BaseHeight = 0.0;
  std::array<double, 3> Up{}; ///< unit
  int Phase = 0;
  double Asymmetry = 0.0;
  double Exposure = 1.0;
  bool Radial = false;
  RadialBlurSettings RadialBlur; ///< used if Radial is on
  double Thickness = 1.0;
  int MapSize = 0;   ///< texels per side of shadow maps; 0: none
  int MapSteps = 64; ///< comparisons with a shadow map
  int Steps = 64;
  int Block = 1; ///< pixels per side of a block that shares a lit fraction
  bool Bounded = false;
  std::array<double, 6> Bounds{}; ///< used if Bounded is on: xmin, xmax, ymin, ...
  bool AutomaticTone = false;
  std::array<double, 3> Background{};
  double Unit = 1.0;              ///< length of one shader unit
  double Range = 1.0;             ///< upper bound of the distance of surfaces from the eye
  bool Prepass = false;           ///< Radial: occluders are rendered black before the emitters
  std::vector<vtkProp*> Emitters; ///< Radial: props that emit
  bool DelegateDrawsBackground = true;
  int Margin[2] = { 0, 0 };

  bool operator==(const ShaftSettings& other) const;

  /// Returns true if the channels have different coefficients.
  bool IsColored() const { return !AreEqual(this->Channels); }

  /// Returns the most transparent channel.
  int GetReferenceChannel() const;

  /// Sets the uniforms of the medium for the camera of `view`.
  void SetMedium(vtkShaderProgram* program, const ScreenTransform& view) const;

  /// Sets the extinction of each channel relative to that of the most transparent one.
  void SetExtinctionRatios(vtkShaderProgram* program) const;
};

}
#endif
