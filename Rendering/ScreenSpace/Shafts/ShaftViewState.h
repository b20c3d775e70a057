// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// State that vtkPenumbraLightShaftPass keeps per renderer, and the steps of a frame: render the
// delegate, linearize depth, compute lit fractions, add in-scattered light, composite. While the
// view and the depth do not change, only the first and the last step run.
#ifndef penumbra_ShaftViewState_h
#define penumbra_ShaftViewState_h

#include "EmitterImage.h"
#include "Frame/DelegateImage.h"
#include "Frame/EyeDepth.h"

#include "ShadowCasters.h"
#include "ShadowMap.h"
#include "ShaftAutoExposure.h"
#include "ShaftLights.h"
#include "ShaftRadialBlur.h"
#include "ShaftSettings.h"

#include <array>
#include <vector>

class vtkImageData;

namespace penumbra
{

class ShaftViewState
{
public:
  /// Renders one frame into the target of `state`. Returns false, with nothing rendered, if OpenGL
  /// reports an error.
  bool Render(const vtkRenderState* state, vtkRenderPass* delegate,
    const std::vector<ShaftLight>& lights, const ShaftSettings& settings);

  int GetNumberOfRenderedProps() const { return this->Props; }

  /// Number of lit fractions that the last frame computed.
  long long GetNewLitFractions() const { return this->NewLitFractions; }
  int GetNumberOfLights() const { return static_cast<int>(this->Lights.size()); }

  /// Number of shadow maps that the last frame rendered.
  int GetNewShadowMaps() const { return this->NewShadowMaps; }

  /// Factor on the in-scattered light.
  double GetGain() const
  {
    return this->Settings.AutomaticTone ? this->AutoExposure.GetGain() : 1.0;
  }

  /// Adds the float arrays LightShafts (3 components) and Transmittance to `image`, which gets the
  /// size of the frame without its margin.
  void CopyTo(vtkImageData* image);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  bool ReuseShafts(const vtkRenderState* state, vtkRenderPass* delegate);
  bool RememberTarget(const DelegateImage& image);
  bool Compute(const vtkRenderState* state);
  bool DrawEmission(const vtkRenderState* state);
  bool FillCoarseDepths();
  bool UpdateShadowMaps(const vtkRenderState* state);
  bool ComputeLitFractions(std::size_t number);
  bool FillShafts();
  bool Scatter(
    std::size_t number, const std::array<float, 2>& alpha, const std::array<float, 2>& offset);
  bool Composite();
  bool BlendOverTarget();
  std::array<float, 2> GetOffset() const;

  vtkOpenGLRenderWindow* Window = nullptr;
  ShaftSettings Settings;
  std::vector<ShaftLight> Lights;
  std::vector<ShaftLightGroup> Groups;
  DelegateImage Image;
  EyeDepth Depth;
  DelegateImage Target; ///< the target of the frame, while stored shafts are blended over it
  EyeDepth TargetDepth;
  ScreenTransform Coarse; ///< view with one pixel per block
  Stage Downsample;
  ShaftRadialBlur RadialBlur;
  EmitterImage Emitters;
  ShadowCasters Casters;
  std::vector<ShadowMap> ShadowMaps; ///< per group
  ShaftAutoExposure AutoExposure;
  Stage Visibility[2];    ///< of directional lights, of a positional light
  Stage MapVisibility[2]; ///< the same with shadow maps
  Stage InScatter[2];
  Stage Composition;
  Stage MediumBlend;
  Stage Reuse;
  vtkSmartPointer<vtkTextureObject> CoarseDepths;
  std::vector<vtkSmartPointer<vtkTextureObject>>
    LitFractions;                           ///< per group; rgb: lit fractions, a: eye depth
  vtkSmartPointer<vtkTextureObject> Shafts; ///< rgb: in-scattered light, a: transmittance
  long long NewLitFractions = 0;
  bool ComputedBefore = false; ///< NewLitFractions of the frame before was not 0
  int NewShadowMaps = 0;
  int Props = 0;
  bool HasLitFractions = false; ///< LitFractions are valid for Settings and Lights
  bool HasShafts = false;       ///< Shafts is valid, too
  bool IsModified = false;      ///< props were modified since the frame before the last one
  bool Changed = false;         ///< the depths of the last frame differed from those before
  bool HasTargetDepth = false;  ///< TargetDepth holds the depths of an unchanged target
};

}
#endif
