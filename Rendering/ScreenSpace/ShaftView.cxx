// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ShaftView.h"

#include "OpenGLFunctions.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPenumbraShaftCoarseDepthFS.h"
#include "vtkPenumbraShaftCompositeFS.h"
#include "vtkPenumbraShaftDepthLib.h"
#include "vtkPenumbraShaftLampLib.h"
#include "vtkPenumbraShaftLib.h"
#include "vtkPenumbraShaftPictureLib.h"
#include "vtkPenumbraShaftRadialLib.h"
#include "vtkPenumbraShaftSamplesLib.h"
#include "vtkPenumbraShaftScatterFS.h"
#include "vtkPenumbraShaftSunLib.h"
#include "vtkPenumbraShaftVisibilityFS.h"
#include "vtkPenumbraViewLib.h"
#include "vtkPointData.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <tuple>

namespace penumbra
{

namespace
{

auto AsTuple(const ShaftSettings& s)
{
  return std::tie(s.Scattering, s.Extinction, s.Phase, s.Asymmetry, s.Exposure, s.Radial, s.Weight,
    s.Decay, s.Density, s.SurfaceGlow, s.Thickness, s.Steps, s.Block, s.Unit, s.Range);
}

void SetSize(vtkShaderProgram* program, const char* name, double width, double height)
{
  const float size[2] = { static_cast<float>(1.0 / width), static_cast<float>(1.0 / height) };
  program->SetUniform2f(name, size);
}

void SetNumber(vtkShaderProgram* program, const char* name, double value)
{
  program->SetUniformf(name, static_cast<float>(value));
}

/// A shader with the pieces for a kind of light.
std::string AssembleFor(
  bool lamp, const char* source, std::vector<std::pair<std::string, std::string>> pieces)
{
  pieces.insert(pieces.begin(),
    { { "ViewLib", vtkPenumbraViewLib }, { "ShaftLib", vtkPenumbraShaftLib },
      { "Light", lamp ? vtkPenumbraShaftLampLib : vtkPenumbraShaftSunLib } });
  return Assemble(source, pieces);
}

}

bool ShaftSettings::operator==(const ShaftSettings& other) const
{
  return AsTuple(*this) == AsTuple(other);
}

bool ShaftView::Render(const vtkRenderState* state, vtkRenderPass* delegate,
  const std::vector<ShaftLight>& lights, const ShaftSettings& settings)
{
  this->Window = static_cast<vtkOpenGLRenderWindow*>(state->GetRenderer()->GetRenderWindow());
  this->NewShares = 0;
  this->Props = this->Image.Draw(state, delegate, settings.Margin);
  if (this->Props < 0)
  {
    return false;
  }
  ScreenView view = this->Image.GetView();
  view.Unit = settings.Unit;
  const EyeDepth::Change change = this->Depth.Update(this->Window, this->Image, view);
  if (change == EyeDepth::Change::Failed)
  {
    return false;
  }
  // A still scene is not computed again.
  this->Known = this->Known && change == EyeDepth::Change::None && settings == this->Settings &&
    lights == this->Lights;
  this->Settings = settings;
  this->Lights = lights;
  if (!this->Known)
  {
    this->Known = this->Compute();
  }
  return this->Known && this->Composite();
}

bool ShaftView::Compute()
{
  const ScreenView& view = this->Depth.GetView();
  const int block = this->Settings.Block;
  Allocate(this->Shafts, this->Window, view.Width, view.Height, 4);
  this->Coarse = view.Coarse(block);
  Allocate(this->LitShares, this->Window, this->Coarse.Width, this->Coarse.Height, 2);
  if (block > 1 && !this->FillCoarseDepths())
  {
    return false;
  }
  for (std::size_t i = 0; i < this->Lights.size(); ++i)
  {
    if (!this->FindLit(this->Lights[i]) || !this->Scatter(this->Lights[i], i == 0))
    {
      return false;
    }
  }
  return true;
}

bool ShaftView::FillCoarseDepths()
{
  Allocate(this->CoarseDepths, this->Window, this->Coarse.Width, this->Coarse.Height, 1);
  vtkShaderProgram* program = this->Thinning.Ready(this->Window, vtkPenumbraShaftCoarseDepthFS);
  const DrawInto target(this->Window, this->Image.GetFramebuffer(), { this->CoarseDepths });
  if (!program || !target.IsComplete())
  {
    return false;
  }
  SetSize(program, "pixelSize", this->Depth.GetView().Width, this->Depth.GetView().Height);
  SetNumber(program, "block", this->Settings.Block);
  this->Thinning.Read("eyeDepths", this->Depth.GetCurrent());
  this->Thinning.Draw();
  return true;
}

void ShaftView::SetMedium(vtkShaderProgram* program) const
{
  const ShaftSettings& settings = this->Settings;
  SetNumber(program, "scattering", settings.Scattering * settings.Unit);
  SetNumber(program, "extinction", settings.Extinction * settings.Unit);
  program->SetUniformi("phase", settings.Phase);
  SetNumber(program, "asymmetry", settings.Asymmetry);
}

bool ShaftView::FindLit(const ShaftLight& light)
{
  const ShaftSettings& settings = this->Settings;
  const bool lamp = light.Place[3] > 0.f;
  Stage& stage = this->Visibility[lamp];
  const char* estimator = settings.Radial ? vtkPenumbraShaftRadialLib : vtkPenumbraShaftDepthLib;
  vtkShaderProgram* program = stage.Ready(
    this->Window, AssembleFor(lamp, vtkPenumbraShaftVisibilityFS, { { "Estimator", estimator } }));
  const DrawInto target(this->Window, this->Image.GetFramebuffer(), { this->LitShares });
  if (!program || !target.IsComplete())
  {
    return false;
  }
  this->Coarse.SetUniforms(program);
  this->SetMedium(program);
  light.SetUniforms(program);
  program->SetUniformi("steps", settings.Steps);
  if (settings.Radial)
  {
    SetNumber(program, "weight", settings.Weight);
    SetNumber(program, "decay", settings.Decay);
    SetNumber(program, "density", settings.Density);
    SetNumber(program, "surfaceGlow", settings.SurfaceGlow);
  }
  else
  {
    SetNumber(program, "thickness", settings.Thickness / settings.Unit);
    SetNumber(program, "range", settings.Range / settings.Unit);
  }
  stage.Read("eyeDepths", settings.Block > 1 ? this->CoarseDepths.Get() : this->Depth.GetCurrent());
  stage.Draw();
  this->NewShares +=
    static_cast<long long>(this->LitShares->GetWidth()) * this->LitShares->GetHeight();
  return true;
}

bool ShaftView::Scatter(const ShaftLight& light, bool first)
{
  const bool lamp = light.Place[3] > 0.f;
  Stage& stage = this->Addition[lamp];
  vtkShaderProgram* program =
    stage.Ready(this->Window, AssembleFor(lamp, vtkPenumbraShaftScatterFS, {}));
  const DrawInto target(this->Window, this->Image.GetFramebuffer(), { this->Shafts });
  if (!program || !target.IsComplete())
  {
    return false;
  }
  vtkOpenGLState* gl = this->Window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable blend(gl, GL_BLEND);
  const vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(gl);
  gl->vtkglBlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE);
  first ? gl->vtkglDisable(GL_BLEND) : gl->vtkglEnable(GL_BLEND);
  this->Depth.GetView().SetUniforms(program);
  this->SetMedium(program);
  light.SetUniforms(program);
  float color[3];
  for (int i = 0; i < 3; ++i)
  {
    color[i] = light.Color[i] * static_cast<float>(this->Settings.Exposure);
  }
  program->SetUniform3f("color", color);
  SetNumber(program, "block", this->Settings.Block);
  SetNumber(program, "transmittance", first ? 1.0 : 0.0);
  SetSize(program, "texelSize", this->LitShares->GetWidth(), this->LitShares->GetHeight());
  stage.Read("eyeDepths", this->Depth.GetCurrent());
  stage.Read("litShares", this->LitShares);
  stage.Draw();
  return true;
}

bool ShaftView::Composite()
{
  static const std::string oneSample =
    Assemble(vtkPenumbraShaftCompositeFS, { { "Picture", vtkPenumbraShaftPictureLib } });
  static const std::string manySamples =
    Assemble(vtkPenumbraShaftCompositeFS, { { "Picture", vtkPenumbraShaftSamplesLib } });
  const bool many = this->Image.GetSamples() > 1;
  vtkShaderProgram* program = this->Composition.Ready(this->Window, many ? manySamples : oneSample);
  if (!program)
  {
    return false;
  }
  vtkOpenGLState* gl = this->Window->GetState();
  const vtkOpenGLState::ScopedglViewport viewport(gl);
  const vtkOpenGLState::ScopedglScissor scissor(gl);
  const vtkOpenGLState::ScopedglEnableDisable blend(gl, GL_BLEND);
  const vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(gl);
  const vtkOpenGLState::ScopedglEnableDisable depthTest(gl, GL_DEPTH_TEST);
  const int* at = this->Image.GetViewport();
  const int* margin = this->Image.GetMargin();
  gl->vtkglViewport(at[0], at[1], at[2], at[3]);
  gl->vtkglScissor(at[0], at[1], at[2], at[3]);
  gl->vtkglEnable(GL_BLEND);
  gl->vtkglBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl->vtkglEnable(GL_DEPTH_TEST);
  gl->vtkglDepthMask(GL_TRUE);
  gl->vtkglDepthFunc(GL_ALWAYS);
  gl->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  const float offset[2] = { static_cast<float>(margin[0] - at[0]),
    static_cast<float>(margin[1] - at[1]) };
  program->SetUniform2f("offset", offset);
  SetSize(program, "pixelSize", this->Depth.GetView().Width, this->Depth.GetView().Height);
  SetNumber(program, "background", this->Settings.DelegateDrawsBackground ? 1.0 : 0.0);
  this->Composition.Read("colors", this->Image.GetColor());
  this->Composition.Read("depthBuffer", this->Image.GetDepth());
  this->Composition.Read("shafts", this->Shafts);
  if (many)
  {
    program->SetUniformi("sampleCount", this->Image.GetSamples());
    this->Composition.Read("depthSamples", this->Image.GetSampleDepth());
  }
  this->Composition.Draw();
  gl->vtkglDepthFunc(GL_LEQUAL);
  return true;
}

void ShaftView::CopyTo(vtkImageData* image) const
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
  if (!this->Shafts)
  {
    return;
  }
  const std::vector<float> values = ReadBack(this->Shafts);
  const int width = this->Depth.GetView().Width;
  for (int j = 0; j < size[1]; ++j)
  {
    for (int i = 0; i < size[0]; ++i)
    {
      const std::size_t at = 4 *
        (static_cast<std::size_t>(j + this->Image.GetMargin()[1]) * width + i +
          this->Image.GetMargin()[0]);
      const vtkIdType to = static_cast<vtkIdType>(j) * size[0] + i;
      shafts->SetTypedTuple(to, &values[at]);
      transmittance->SetValue(to, values[at + 3]);
    }
  }
}

void ShaftView::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Image.ReleaseGraphicsResources(window);
  this->Depth.ReleaseGraphicsResources(window);
  for (Stage* stage : { &this->Thinning, &this->Visibility[0], &this->Visibility[1],
         &this->Addition[0], &this->Addition[1], &this->Composition })
  {
    stage->ReleaseGraphicsResources(window);
  }
  for (vtkSmartPointer<vtkTextureObject>* texture :
    { &this->CoarseDepths, &this->LitShares, &this->Shafts })
  {
    if (*texture)
    {
      (*texture)->ReleaseGraphicsResources(window);
      *texture = nullptr;
    }
  }
  this->Known = false;
}

}
