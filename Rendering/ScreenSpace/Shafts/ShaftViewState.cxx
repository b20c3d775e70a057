// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ShaftViewState.h"

#include "Frame/OpenGLFunctions.h"
#include "Frame/SceneShader.h"
#include "Frame/Uniforms.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPenumbraPhaseFunctions.h"
#include "vtkPenumbraShaftBlendFS.h"
#include "vtkPenumbraShaftBoundedLib.h"
#include "vtkPenumbraShaftCompositeFS.h"
#include "vtkPenumbraShaftDepthLib.h"
#include "vtkPenumbraShaftDirectionalBoxLib.h"
#include "vtkPenumbraShaftDirectionalLib.h"
#include "vtkPenumbraShaftDownsampleDepthFS.h"
#include "vtkPenumbraShaftFalloffLib.h"
#include "vtkPenumbraShaftLib.h"
#include "vtkPenumbraShaftLitColorLib.h"
#include "vtkPenumbraShaftLitFractionLib.h"
#include "vtkPenumbraShaftMapLib.h"
#include "vtkPenumbraShaftPositionalLib.h"
#include "vtkPenumbraShaftReuseFS.h"
#include "vtkPenumbraShaftScatterFS.h"
#include "vtkPenumbraShaftUnboundedLib.h"
#include "vtkPenumbraShaftUniformLib.h"
#include "vtkPenumbraShaftVisibilityFS.h"
#include "vtkPenumbraViewLib.h"
#include "vtkPointData.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>

namespace penumbra
{

namespace
{

/// Assembles a shader with the libraries for a type of light and of medium.
std::string AssembleFor(bool positional, const ShaftSettings& settings, const char* source,
  std::vector<std::pair<std::string, std::string>> pieces)
{
  const bool bounded = settings.Bounded;
  pieces.insert(pieces.begin(),
    { { "ViewLib", vtkPenumbraViewLib }, { "ShaftLib", vtkPenumbraShaftLib },
      { "PhaseFunctions", vtkPenumbraPhaseFunctions },
      { "Medium", bounded ? vtkPenumbraShaftBoundedLib : vtkPenumbraShaftUnboundedLib },
      { "Density", settings.Falloff ? vtkPenumbraShaftFalloffLib : vtkPenumbraShaftUniformLib },
      { "Light",
        positional                      ? vtkPenumbraShaftPositionalLib
          : bounded || settings.Falloff ? vtkPenumbraShaftDirectionalBoxLib
                                        : vtkPenumbraShaftDirectionalLib } });
  return Assemble(source, pieces);
}

}

bool ShaftViewState::Render(const vtkRenderState* state, vtkRenderPass* delegate,
  const std::vector<ShaftLight>& lights, const ShaftSettings& settings)
{
  this->Window = static_cast<vtkOpenGLRenderWindow*>(state->GetRenderer()->GetRenderWindow());
  this->ComputedBefore = this->NewLitFractions > 0;
  this->NewLitFractions = 0;
  if (!this->Image.SetUpView(state, settings.Margin))
  {
    return false;
  }
  ScreenTransform view = this->Image.GetView();
  view.Unit = settings.Unit;
  // Depth does not reveal changes of emitted colors.
  const bool colored =
    settings.Radial && (settings.RadialBlur.DependsOnColor() || !settings.Emitters.empty());
  this->HasLitFractions = this->HasLitFractions && !colored && settings == this->Settings &&
    lights == this->Lights && this->Depth.GetView().HasSameView(view);
  // Neither does it reveal changes outside of the image.
  const bool wasModified = this->IsModified;
  // After compositing of several ranks it is unknown which props moved.
  this->IsModified = (settings.MapSize > 0 || !settings.DelegateDrawsBackground) &&
    this->Casters.Update(state->GetRenderer());
  this->HasLitFractions = this->HasLitFractions && !(settings.MapSize > 0 && this->IsModified);
  this->NewShadowMaps = 0;
  this->Settings = settings;
  this->Lights = lights;
  this->Groups = GroupLights(lights, settings.Radial || settings.MapSize > 0);
  const bool reuse = this->HasLitFractions && this->HasTargetDepth;
  if (reuse && this->ReuseShafts(state, delegate))
  {
    return true;
  }
  this->HasTargetDepth = false;
  // After a failed reuse, part of the target already contains light: the new frame has to replace
  // it.
  const bool simple = !reuse && !settings.DelegateDrawsBackground && settings.Margin[0] == 0 &&
    settings.Margin[1] == 0 && !settings.Radial && !settings.AutomaticTone && !settings.IsColored();
  this->Props = simple ? this->Image.DrawToTarget(state, delegate) : -1;
  const bool drawnToTarget = this->Props >= 0;
  if (!drawnToTarget)
  {
    this->Props = this->Image.Draw(state, delegate, settings.Margin);
  }
  if (this->Props < 0)
  {
    return false;
  }
  EyeDepth::Comparison comparison =
    this->Depth.ChooseComparison(this->IsModified && wasModified && this->Changed);
  if (!this->HasLitFractions && comparison == EyeDepth::Comparison::Wait)
  {
    comparison = EyeDepth::Comparison::Skip; // They are computed anyway.
  }
  const EyeDepth::Change change = this->Depth.Update(this->Window, this->Image, view, comparison);
  if (change == EyeDepth::Change::Failed)
  {
    return false;
  }
  this->Changed = change != EyeDepth::Change::None;
  this->HasLitFractions = this->HasLitFractions && change == EyeDepth::Change::None;
  const bool isStatic = this->HasLitFractions && !settings.DelegateDrawsBackground &&
    !settings.Bounded && !settings.IsColored();
  if (isStatic && (drawnToTarget || this->Target.DrawToTarget(state, delegate) >= 0))
  {
    // From this frame on, the delegate renders directly into the target.
    this->HasTargetDepth = this->RememberTarget(drawnToTarget ? this->Image : this->Target);
    return this->BlendOverTarget();
  }
  if (!this->HasLitFractions)
  {
    this->HasLitFractions = this->Compute(state);
  }
  return this->HasLitFractions && (drawnToTarget ? this->BlendOverTarget() : this->Composite());
}

bool ShaftViewState::RememberTarget(const DelegateImage& image)
{
  ScreenTransform view = image.GetView();
  view.Unit = this->Settings.Unit;
  this->TargetDepth.Invalidate();
  return this->TargetDepth.Update(this->Window, image, view) != EyeDepth::Change::Failed;
}

bool ShaftViewState::ReuseShafts(const vtkRenderState* state, vtkRenderPass* delegate)
{
  static const std::string source =
    Assemble(vtkPenumbraShaftReuseFS, { { "ViewLib", vtkPenumbraViewLib } });
  const int props = this->Target.DrawToTarget(state, delegate);
  vtkShaderProgram* program = props < 0 ? nullptr : this->Reuse.Ready(this->Window, source);
  if (!program)
  {
    return false;
  }
  this->Props = props;
  const ScopedRenderTarget target(
    this->Window, this->Target.GetFramebuffer(), { this->Target.GetColor() });
  const ScopedBlending over(this->Window, this->Target.GetViewport(), false);
  const ScreenTransform& view = this->TargetDepth.GetView();
  view.SetUniforms(program);
  program->SetUniform2f("offset", this->GetOffset().data());
  SetPixelSize(program, "shaftsPixelSize", this->Shafts->GetWidth(), this->Shafts->GetHeight());
  SetNumber(program, "gain", this->GetGain());
  this->Reuse.BindTexture("depthBuffer", this->Target.GetDepth());
  this->Reuse.BindTexture("eyeDepths", this->TargetDepth.GetCurrent());
  this->Reuse.BindTexture("shafts", this->Shafts);
  return this->Reuse.DrawAndCount() ==
    static_cast<unsigned int>(view.Width) * static_cast<unsigned int>(view.Height);
}

bool ShaftViewState::Compute(const vtkRenderState* state)
{
  const int block = this->Settings.Block;
  this->Coarse = this->Depth.GetView().Downsampled(block);
  this->HasShafts = false;
  if (block > 1 && !this->FillCoarseDepths())
  {
    return false;
  }
  if (this->Settings.Radial && !this->DrawEmission(state))
  {
    return false;
  }
  if (this->Settings.MapSize > 0 && !this->UpdateShadowMaps(state))
  {
    return false;
  }
  this->LitFractions.resize(std::max(this->LitFractions.size(), this->Groups.size()));
  for (std::size_t i = 0; i < this->Groups.size(); ++i)
  {
    if (!this->ComputeLitFractions(i))
    {
      return false;
    }
  }
  if (!this->Settings.AutomaticTone)
  {
    this->AutoExposure.Reset();
    return true;
  }
  return this->FillShafts() &&
    this->AutoExposure.Update(this->Window, this->Image, this->Shafts,
      this->Settings.DelegateDrawsBackground ? nullptr : this->Settings.Background.data(),
      this->ComputedBefore);
}

bool ShaftViewState::DrawEmission(const vtkRenderState* state)
{
  const bool hasEmitters = !this->Settings.Emitters.empty();
  if (hasEmitters &&
    !this->Emitters.Draw(state, this->Image, this->Coarse, this->Settings.Block,
      this->Settings.Emitters, this->Settings.Prepass))
  {
    return false;
  }
  return this->RadialBlur.DrawEmission(this->Window, this->Image, this->Coarse,
    hasEmitters ? this->Emitters.GetColor() : nullptr, this->Settings.RadialBlur);
}

bool ShaftViewState::FillCoarseDepths()
{
  Allocate(this->CoarseDepths, this->Window, this->Coarse.Width, this->Coarse.Height, 1);
  vtkShaderProgram* program =
    this->Downsample.Ready(this->Window, vtkPenumbraShaftDownsampleDepthFS);
  const ScopedRenderTarget target(
    this->Window, this->Image.GetFramebuffer(), { this->CoarseDepths });
  if (!program || !target.IsComplete())
  {
    return false;
  }
  SetPixelSize(program, "pixelSize", this->Depth.GetView().Width, this->Depth.GetView().Height);
  SetNumber(program, "blockSize", this->Settings.Block);
  this->Downsample.BindTexture("eyeDepths", this->Depth.GetCurrent());
  this->Downsample.Draw();
  return true;
}

bool ShaftViewState::UpdateShadowMaps(const vtkRenderState* state)
{
  this->ShadowMaps.resize(std::max(this->ShadowMaps.size(), this->Groups.size()));
  for (std::size_t i = 0; i < this->Groups.size(); ++i)
  {
    const ShaftLight& light = this->Groups[i].GetLights().front();
    ShadowMap& map = this->ShadowMaps[i];
    if (light.HasShadowMap)
    {
      if (!map.Update(state->GetRenderer(), this->Casters, light, this->Image.GetView(),
            this->Settings.MapSize))
      {
        return false;
      }
      this->NewShadowMaps += map.IsNew();
    }
  }
  return true;
}

bool ShaftViewState::ComputeLitFractions(std::size_t number)
{
  const ShaftSettings& settings = this->Settings;
  const ShaftLightGroup& lights = this->Groups[number];
  vtkSmartPointer<vtkTextureObject>& fractions = this->LitFractions[number];
  Allocate(fractions, this->Window, this->Coarse.Width, this->Coarse.Height, 4);
  vtkTextureObject* depths =
    settings.Block > 1 ? this->CoarseDepths.Get() : this->Depth.GetCurrent();
  this->NewLitFractions += static_cast<long long>(this->Coarse.Width) * this->Coarse.Height *
    static_cast<long long>(lights.GetLights().size());
  if (settings.Radial)
  {
    return this->RadialBlur.ComputeLitFractions(this->Window, this->Image, this->Coarse, depths,
      lights.GetLights().front(), settings.RadialBlur, fractions);
  }
  const bool mapped = lights.GetLights().front().HasShadowMap;
  Stage& stage = (mapped ? this->MapVisibility : this->Visibility)[lights.IsPositional()];
  vtkShaderProgram* program = stage.Ready(this->Window,
    AssembleFor(lights.IsPositional(), settings, vtkPenumbraShaftVisibilityFS,
      { { "Estimator", mapped ? vtkPenumbraShaftMapLib : vtkPenumbraShaftDepthLib } }));
  const ScopedRenderTarget target(this->Window, this->Image.GetFramebuffer(), { fractions });
  if (!program || !target.IsComplete())
  {
    return false;
  }
  this->Coarse.SetUniforms(program);
  this->Settings.SetMedium(program, this->Depth.GetView());
  lights.SetUniforms(program);
  program->SetUniformi("steps", mapped ? settings.MapSteps : settings.Steps);
  if (mapped)
  {
    this->ShadowMaps[number].SetUniforms(program, this->Coarse);
    stage.BindTexture("shadowMap", this->ShadowMaps[number].GetDepths());
  }
  else
  {
    SetNumber(program, "thickness", settings.Thickness / settings.Unit);
    SetNumber(program, "range", settings.Range / settings.Unit);
  }
  stage.BindTexture("eyeDepths", depths);
  stage.Draw();
  return true;
}

bool ShaftViewState::FillShafts()
{
  if (this->HasShafts)
  {
    return true;
  }
  const ScreenTransform& view = this->Depth.GetView();
  Allocate(this->Shafts, this->Window, view.Width, view.Height, 4);
  const ScopedRenderTarget target(this->Window, this->Image.GetFramebuffer(), { this->Shafts });
  this->HasShafts = target.IsComplete();
  for (std::size_t i = 0; this->HasShafts && i < this->Groups.size(); ++i)
  {
    vtkOpenGLState* gl = this->Window->GetState();
    gl->vtkglBlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE);
    i == 0 ? gl->vtkglDisable(GL_BLEND) : gl->vtkglEnable(GL_BLEND);
    const float transmittanceFactor = i == 0 ? 1.f : 0.f;
    this->HasShafts = this->Scatter(i, { 0.f, transmittanceFactor }, { 0.f, 0.f });
  }
  return this->HasShafts;
}

bool ShaftViewState::Scatter(
  std::size_t number, const std::array<float, 2>& alpha, const std::array<float, 2>& offset)
{
  const ShaftLightGroup& lights = this->Groups[number];
  vtkTextureObject* fractions = this->LitFractions[number];
  Stage& stage = this->InScatter[lights.IsPositional()];
  const char* library =
    this->Settings.Radial ? vtkPenumbraShaftLitColorLib : vtkPenumbraShaftLitFractionLib;
  vtkShaderProgram* program = stage.Ready(this->Window,
    AssembleFor(lights.IsPositional(), this->Settings, vtkPenumbraShaftScatterFS,
      { { "LitFraction", library },
        { "Channels", this->Settings.IsColored() ? "#define COLORED" : "" } }));
  if (!program)
  {
    return false;
  }
  this->Depth.GetView().SetUniforms(program);
  this->Settings.SetMedium(program, this->Depth.GetView());
  lights.SetUniforms(program);
  lights.SetColors(program, this->Settings.Exposure);
  program->SetUniform2f("alpha", alpha.data());
  program->SetUniform2f("offset", offset.data());
  SetNumber(program, "blockSize", this->Settings.Block);
  const bool exact = this->Settings.Radial && this->Settings.Block == 1;
  SetNumber(program, "interleaved", exact ? 0.0 : 1.0);
  SetPixelSize(program, "texelSize", fractions->GetWidth(), fractions->GetHeight());
  stage.BindTexture("eyeDepths", this->Depth.GetCurrent());
  stage.BindTexture("litFractions", fractions);
  stage.Draw();
  return true;
}

std::array<float, 2> ShaftViewState::GetOffset() const
{
  const int* viewport = this->Image.GetViewport();
  const int* margin = this->Image.GetMargin();
  return { static_cast<float>(margin[0] - viewport[0]),
    static_cast<float>(margin[1] - viewport[1]) };
}

bool ShaftViewState::Composite()
{
  static const SceneShader shader(vtkPenumbraShaftCompositeFS, {});
  vtkShaderProgram* program = nullptr;
  if (this->FillShafts())
  {
    program = shader.Ready(this->Composition, this->Window, this->Image);
  }
  if (!program)
  {
    return false;
  }
  const ScopedBlending target(this->Window, this->Image.GetViewport(), true);
  program->SetUniform2f("offset", this->GetOffset().data());
  this->Depth.GetView().SetUniforms(program);
  SetNumber(program, "gain", this->GetGain());
  SetNumber(program, "background", this->Settings.DelegateDrawsBackground ? 1.0 : 0.0);
  const auto draw = [&](int part) {
    program->SetUniformi("part", part);
    this->Composition.BindTexture("shafts", this->Shafts);
    SceneShader::Draw(this->Composition, program, this->Image, this->Depth, this->Image.GetColor());
  };
  if (!this->Settings.IsColored())
  {
    draw(0);
    return true;
  }
  // Each channel of the target has its own transmittance: it is multiplied first.
  this->Settings.SetExtinctionRatios(program);
  vtkOpenGLState* gl = this->Window->GetState();
  gl->vtkglBlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_SRC_ALPHA);
  draw(1);
  gl->vtkglBlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE);
  draw(2);
  return true;
}

bool ShaftViewState::BlendOverTarget()
{
  // In motion the light is blended directly into the target. With several groups the target would
  // round the intermediate sums.
  if (this->NewLitFractions > 0 && this->Groups.size() == 1 && !this->HasShafts)
  {
    const ScopedBlending target(this->Window, this->Image.GetViewport(), false);
    return this->Scatter(0, { 1.f, -1.f }, this->GetOffset());
  }
  vtkShaderProgram* program = nullptr;
  if (this->FillShafts())
  {
    program = this->MediumBlend.Ready(this->Window, vtkPenumbraShaftBlendFS);
  }
  if (!program)
  {
    return false;
  }
  const ScopedBlending target(this->Window, this->Image.GetViewport(), false);
  program->SetUniform2f("offset", this->GetOffset().data());
  SetPixelSize(program, "pixelSize", this->Depth.GetView().Width, this->Depth.GetView().Height);
  SetNumber(program, "gain", this->GetGain());
  this->MediumBlend.BindTexture("shafts", this->Shafts);
  this->MediumBlend.Draw();
  return true;
}

void ShaftViewState::CopyTo(vtkImageData* image)
{
  const int* size = this->Image.GetViewport() + 2;
  image->SetDimensions(size[0], size[1], 1);
  vtkNew<vtkFloatArray> shafts;
  shafts->SetName("LightShafts");
  shafts->SetNumberOfComponents(3);
  shafts->SetNumberOfTuples(image->GetNumberOfPoints());
  vtkNew<vtkFloatArray> transmittance;
  transmittance->SetName("Transmittance");
  transmittance->SetNumberOfTuples(image->GetNumberOfPoints());
  image->GetPointData()->AddArray(shafts);
  image->GetPointData()->AddArray(transmittance);
  if (!this->HasLitFractions || !this->FillShafts())
  {
    return;
  }
  const std::vector<float> values = ReadBack(this->Shafts);
  const int width = this->Depth.GetView().Width;
  for (int j = 0; j < size[1]; ++j)
  {
    for (int i = 0; i < size[0]; ++i)
    {
      const std::size_t from = 4 *
        (static_cast<std::size_t>(j + this->Image.GetMargin()[1]) * width + i +
          this->Image.GetMargin()[0]);
      const vtkIdType to = static_cast<vtkIdType>(j) * size[0] + i;
      for (int k = 0; k < 3; ++k)
      {
        shafts->SetTypedComponent(to, k, static_cast<float>(this->GetGain()) * values[from + k]);
      }
      transmittance->SetValue(to, values[from + 3]);
    }
  }
}

void ShaftViewState::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Image.ReleaseGraphicsResources(window);
  this->Depth.ReleaseGraphicsResources(window);
  this->Target.ReleaseGraphicsResources(window);
  this->TargetDepth.ReleaseGraphicsResources(window);
  this->RadialBlur.ReleaseGraphicsResources(window);
  this->AutoExposure.ReleaseGraphicsResources(window);
  this->Emitters.ReleaseGraphicsResources(window);
  for (ShadowMap& map : this->ShadowMaps)
  {
    map.ReleaseGraphicsResources(window);
  }
  for (Stage* stage : { &this->Downsample, &this->Visibility[0], &this->Visibility[1],
         &this->MapVisibility[0], &this->MapVisibility[1], &this->InScatter[0], &this->InScatter[1],
         &this->Composition, &this->MediumBlend, &this->Reuse })
  {
    stage->ReleaseGraphicsResources(window);
  }
  for (vtkSmartPointer<vtkTextureObject>& texture : this->LitFractions)
  {
    Release(window, texture);
  }
  this->LitFractions.clear();
  Release(window, this->CoarseDepths, this->Shafts);
  this->HasLitFractions = false;
  this->HasShafts = false;
  this->HasTargetDepth = false;
}

}
