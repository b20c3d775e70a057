// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ShaftRadialBlur.h"

#include "Frame/OpenGLFunctions.h"
#include "Frame/ScreenSpaceConstants.h"
#include "Frame/Uniforms.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPenumbraShaftEmissionFS.h"
#include "vtkPenumbraShaftRadialFS.h"
#include "vtkPenumbraShaftSceneColorLib.h"
#include "vtkPenumbraShaftSceneColorMSLib.h"
#include "vtkPenumbraViewLib.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace penumbra
{

namespace
{

auto AsTuple(const RadialBlurSettings& s)
{
  return std::tie(s.Steps, s.Passes, s.Geometric, s.Weight, s.Decay, s.PathRatio, s.SurfaceEmission,
    s.SkyIsImage, s.Block);
}

void UseLinearFilter(vtkTextureObject* texture)
{
  texture->SetMinificationFilter(vtkTextureObject::Linear);
  texture->SetMagnificationFilter(vtkTextureObject::Linear);
}

/// Sets the uniform spacingGrowth for `count` geometric steps: the logarithm of the factor by which
/// the distance to the light shrinks per step, and the step length while that logarithm is 0. The
/// path from the image center is at most as long as the diagonal (guard band).
void SetSpacingGrowth(vtkShaderProgram* program, const ShaftLight& light,
  const ScreenTransform& view, double density, double count)
{
  const double planeFactor = view.Parallel ? light.Position[3] : light.Position[2];
  double square = 0.0;
  const int sides[2] = { view.Width, view.Height };
  for (int axis = 0; axis < 2; ++axis)
  {
    const double unit = view.Parallel ? view.Unit : 1.0;
    const double center = (0.5 * sides[axis] * view.Scale[axis] + view.Offset[axis]) / unit;
    const double path = (light.Position[axis] - center * planeFactor) / (view.Scale[axis] / unit);
    square += path * path;
  }
  const double guard = std::hypot(view.Width, view.Height) / std::max(std::sqrt(square), 1e-9);
  const double toLight = planeFactor > 0.0 ? (1.0 - MinimumRadialDistance) / planeFactor
                                           : std::numeric_limits<double>::infinity();
  const double end = std::min(guard, toLight) / density;
  const float spacingGrowth[2] = { static_cast<float>(std::log1p(-planeFactor * end) / count),
    static_cast<float>(end / count) };
  program->SetUniform2f("spacingGrowth", spacingGrowth);
}

}

bool RadialBlurSettings::operator==(const RadialBlurSettings& other) const
{
  return AsTuple(*this) == AsTuple(other);
}

bool ShaftRadialBlur::CopyBackground(vtkOpenGLRenderWindow* window, const DelegateImage& image)
{
  const int* viewport = image.GetViewport();
  if (!this->Background || this->Background->GetContext() != window ||
    static_cast<int>(this->Background->GetWidth()) != viewport[2] ||
    static_cast<int>(this->Background->GetHeight()) != viewport[3])
  {
    this->Background = vtkSmartPointer<vtkTextureObject>::New();
    this->Background->SetContext(window);
    this->Background->SetWrapS(vtkTextureObject::ClampToEdge);
    this->Background->SetWrapT(vtkTextureObject::ClampToEdge);
    this->Background->Allocate2D(viewport[2], viewport[3], 4, VTK_UNSIGNED_CHAR);
    this->Copy = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
    this->Copy->SetContext(window);
  }
  // The blit also resolves multisampled images.
  vtkOpenGLState* gl = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable scissorTest(gl, GL_SCISSOR_TEST);
  gl->vtkglDisable(GL_SCISSOR_TEST);
  gl->PushDrawFramebufferBinding();
  this->Copy->Bind(vtkOpenGLFramebufferObject::GetDrawMode());
  this->Copy->AddColorAttachment(0, this->Background);
  this->Copy->ActivateDrawBuffer(0);
  gl->vtkglBlitFramebuffer(viewport[0], viewport[1], viewport[0] + viewport[2],
    viewport[1] + viewport[3], 0, 0, viewport[2], viewport[3], GL_COLOR_BUFFER_BIT, GL_NEAREST);
  this->Copy->RemoveColorAttachments(1);
  gl->PopDrawFramebufferBinding();
  return true;
}

bool ShaftRadialBlur::DrawEmission(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  const ScreenTransform& coarse, vtkTextureObject* emitters, const RadialBlurSettings& settings)
{
  static const std::string oneSample =
    Assemble(vtkPenumbraShaftEmissionFS, { { "SceneColor", vtkPenumbraShaftSceneColorLib } });
  static const std::string manySamples =
    Assemble(vtkPenumbraShaftEmissionFS, { { "SceneColor", vtkPenumbraShaftSceneColorMSLib } });
  Allocate(this->Emission, window, coarse.Width, coarse.Height, 4);
  UseLinearFilter(this->Emission);
  const bool readsBackground = settings.SkyIsImage && !settings.DelegateDrawsBackground;
  if (readsBackground)
  {
    this->CopyBackground(window, image);
  }
  const bool many = image.GetSamples() > 1;
  vtkShaderProgram* program = this->EmissionStage.Ready(window, many ? manySamples : oneSample);
  const ScopedRenderTarget target(window, image.GetFramebuffer(), { this->Emission });
  if (!program || !target.IsComplete())
  {
    return false;
  }
  const int* margin = image.GetMargin();
  const int* size = image.GetViewport() + 2;
  const float pixelToBackground[4] = { 1.f / static_cast<float>(size[0]),
    1.f / static_cast<float>(size[1]), -static_cast<float>(margin[0]) / static_cast<float>(size[0]),
    -static_cast<float>(margin[1]) / static_cast<float>(size[1]) };
  SetPixelSize(program, "pixelSize", image.GetView().Width, image.GetView().Height);
  SetPixelSize(program, "texelSize", coarse.Width, coarse.Height);
  SetNumber(program, "hasEmitters", emitters ? 1.0 : 0.0);
  program->SetUniform4f("pixelToBackground", pixelToBackground);
  SetNumber(program, "blockSize", settings.Block);
  SetNumber(program, "background", settings.DelegateDrawsBackground ? 1.0 : 0.0);
  SetNumber(program, "surfaceEmission", settings.SurfaceEmission);
  const bool white = !settings.SkyIsImage && !emitters;
  const float skyEmission[2] = { white ? 1.f : 0.f, settings.SkyIsImage ? 1.f : 0.f };
  program->SetUniform2f("skyEmission", skyEmission);
  this->EmissionStage.BindTexture("depthBuffer", image.GetDepth());
  this->EmissionStage.BindTexture("colors", image.GetColor());
  this->EmissionStage.BindTexture(
    "backgroundImage", readsBackground ? this->Background.Get() : image.GetDepth());
  this->EmissionStage.BindTexture("emitters", emitters ? emitters : image.GetDepth());
  if (many)
  {
    program->SetUniformi("sampleCount", image.GetSamples());
    this->EmissionStage.BindTexture("depthSamples", image.GetSampleDepth());
  }
  this->EmissionStage.Draw();
  return true;
}

bool ShaftRadialBlur::ComputeLitFractions(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  const ScreenTransform& coarse, vtkTextureObject* eyeDepths, const ShaftLight& light,
  const RadialBlurSettings& settings, vtkTextureObject* target)
{
  static const std::string source =
    Assemble(vtkPenumbraShaftRadialFS, { { "ViewLib", vtkPenumbraViewLib } });
  const bool geometric = settings.Geometric || settings.Passes > 1;
  const double count = std::pow(settings.Steps, settings.Passes);
  vtkTextureObject* emission = this->Emission;
  double stepStride = 1.0;
  for (int pass = 0; pass < settings.Passes; ++pass)
  {
    const bool last = pass + 1 == settings.Passes;
    vtkSmartPointer<vtkTextureObject>& intermediate = this->Intermediate[pass % 2];
    if (!last)
    {
      Allocate(intermediate, window, coarse.Width, coarse.Height, 4);
      UseLinearFilter(intermediate);
    }
    vtkShaderProgram* program = this->BlurStage.Ready(window, source);
    const ScopedRenderTarget into(
      window, image.GetFramebuffer(), { last ? target : intermediate.Get() });
    if (!program || !into.IsComplete())
    {
      return false;
    }
    coarse.SetUniforms(program);
    program->SetUniform4f("light", light.Position);
    program->SetUniformi("steps", settings.Steps);
    SetNumber(program, "density", settings.PathRatio);
    SetNumber(program, "evenSpacing", geometric ? 0.0 : 1.0);
    SetSpacingGrowth(program, light, coarse, settings.PathRatio, count);
    SetNumber(program, "firstStep", pass == 0 ? 0.5 : 0.0);
    SetNumber(program, "stepStride", stepStride);
    SetNumber(program, "decay", std::pow(settings.Decay, 64.0 * stepStride / count));
    SetNumber(program, "weight", settings.Weight);
    SetNumber(program, "isLastPass", last ? 1.0 : 0.0);
    this->BlurStage.BindTexture("emission", emission);
    this->BlurStage.BindTexture("eyeDepths", eyeDepths);
    this->BlurStage.Draw();
    emission = intermediate;
    stepStride *= settings.Steps;
  }
  return true;
}

void ShaftRadialBlur::ReleaseGraphicsResources(vtkWindow* window)
{
  this->EmissionStage.ReleaseGraphicsResources(window);
  this->BlurStage.ReleaseGraphicsResources(window);
  Release(window, this->Background, this->Emission, this->Intermediate[0], this->Intermediate[1],
    this->Copy);
}

}
