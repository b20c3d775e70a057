// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// All that vtkPenumbraLightShaftPass keeps of one renderer, and the steps of a frame: draw the
// delegate, turn depths into distances, find what the lights light and add what they scatter, compose.
// Of a still scene only the first and the last of it.
#ifndef penumbra_ShaftViewState_h
#define penumbra_ShaftViewState_h

#include "EmitterImage.h"
#include "Frame/DelegateImage.h"
#include "Frame/EyeDepth.h"
#include "ShaftAutoExposure.h"
#include "ShaftLights.h"
#include "ShaftRadialBlur.h"

#include <array>
#include <vector>

class vtkImageData;

namespace penumbra
{

/// A frame's settings; see vtkPenumbraLightShaftPass for their meaning. Lengths in world units.
struct ShaftSettings
{
  double Scattering = 0.0;
  double Extinction = 0.0;
  int Phase = 0;
  double Asymmetry = 0.0;
  double Exposure = 1.0;
  bool Radial = false;
  RadialBlurSettings Paper; ///< where Radial
  double Thickness = 1.0;
  int Steps = 64;
  int Block = 1; ///< pixels a side of the blocks for which lit shares are found
  bool Bounded = false;
  std::array<double, 6> Bounds{}; ///< where Bounded: xmin, xmax, ymin, ...
  bool AutomaticTone = false;
  std::array<double, 3> Background{};
  double Unit = 1.0;              ///< what shaders call 1
  double Range = 1.0;             ///< no surface is farther from the eye
  bool Prepass = false;           ///< Radial: occluders are drawn black for their own sake
  std::vector<vtkProp*> Emitters; ///< Radial
  bool DelegateDrawsBackground = true;
  int Margin[2] = { 0, 0 };

  bool operator==(const ShaftSettings& other) const;
};

class ShaftViewState
{
public:
  /// Draws one frame into the target of `state`. False when OpenGL refuses: nothing was drawn.
  bool Render(const vtkRenderState* state, vtkRenderPass* delegate,
    const std::vector<ShaftLight>& lights, const ShaftSettings& settings);

  int GetNumberOfRenderedProps() const { return this->Props; }

  /// Of the last frame: lit shares that were found anew.
  long long GetNewShares() const { return this->NewLitFractions; }
  int GetNumberOfLights() const { return static_cast<int>(this->Lights.size()); }

  /// What scattered light is multiplied by.
  double GetGain() const { return this->Settings.AutomaticTone ? this->Tone.GetGain() : 1.0; }

  /// Adds the float arrays LightShafts (3) and Transmittance to an image of the picture without
  /// margin.
  void CopyTo(vtkImageData* image);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  bool DrawAgain(const vtkRenderState* state, vtkRenderPass* delegate);
  bool RememberTarget(const DelegateImage& image);
  bool Compute(const vtkRenderState* state);
  bool DrawEmission(const vtkRenderState* state);
  bool FillCoarseDepths();
  bool ComputeLitFractions(std::size_t number);
  bool FillShafts();
  bool Scatter(
    std::size_t number, const std::array<float, 2>& alpha, const std::array<float, 2>& offset);
  bool Composite();
  bool CompositeStraight();
  std::array<float, 2> GetOffset() const;
  void SetBox(vtkShaderProgram* program) const;
  void SetMedium(vtkShaderProgram* program) const;

  vtkOpenGLRenderWindow* Window = nullptr;
  ShaftSettings Settings;
  std::vector<ShaftLight> Lights;
  std::vector<ShaftLightGroup> Groups;
  DelegateImage Image;
  EyeDepth Depth;
  DelegateImage Target; ///< where what is known is drawn straight and without a margin
  EyeDepth TargetDepth;
  ScreenTransform Coarse; ///< of one pixel in each block
  Stage Downsample;
  ShaftRadialBlur RadialBlur;
  EmitterImage Emitters;
  ShaftAutoExposure Tone;
  Stage Visibility[2]; ///< by a sun, by a lamp
  Stage InScatter[2];
  Stage Composition;
  Stage MediumBlend;
  Stage Reuse;
  vtkSmartPointer<vtkTextureObject> CoarseDepths;
  std::vector<vtkSmartPointer<vtkTextureObject>> LitFractions; ///< of each group: shares, eye depth
  vtkSmartPointer<vtkTextureObject> Shafts; ///< rgb: scattered light, a: transmittance
  long long NewLitFractions = 0;
  int Props = 0;
  bool Known = false;  ///< LitFractions are those of Settings and Lights
  bool Filled = false; ///< and Shafts
  bool Seen = false;   ///< twice in a row; TargetDepth holds the target's depths
};

}
#endif
