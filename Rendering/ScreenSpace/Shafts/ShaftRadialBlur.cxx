// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ShaftRadialBlur.h"

#include "Frame/OpenGLFunctions.h"
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

/// A geometric way to a light that is seen ends at this share of its distance.
constexpr double NearestToLight = 1.0 / 64.0;

auto AsTuple(const RadialBlurSettings& s)
{
  return std::tie(s.Steps, s.Passes, s.Geometric, s.Weight, s.Decay, s.Density, s.SurfaceEmission,
    s.SkyIsPicture, s.Block);
}

void SetNumber(vtkShaderProgram* program, const char* name, double value)
{
  program->SetUniformf(name, static_cast<float>(value));
}

void SetSize(vtkShaderProgram* program, const char* name, int width, int height)
{
  const float size[2] = { 1.f / static_cast<float>(width), 1.f / static_cast<float>(height) };
  program->SetUniform2f(name, size);
}

void SampleBetween(vtkTextureObject* texture)
{
  texture->SetMinificationFilter(vtkTextureObject::Linear);
  texture->SetMagnificationFilter(vtkTextureObject::Linear);
}

/// Geometric spacing of `count` steps: logarithm of the factor by which the distance to the light
/// shrinks with each, and the step where that is nothing. The way from the middle of the picture is
/// no longer than its diagonal, wherever the light: the guard band.
void SetGrowth(vtkShaderProgram* program, const ShaftLight& light, const ScreenTransform& view,
  double density, double count)
{
  const double turn = view.Parallel ? light.Position[3] : light.Position[2];
  double square = 0.0;
  const int sides[2] = { view.Width, view.Height };
  for (int axis = 0; axis < 2; ++axis)
  {
    const double unit = view.Parallel ? view.Unit : 1.0;
    const double middle = (0.5 * sides[axis] * view.Scale[axis] + view.Offset[axis]) / unit;
    const double way = (light.Position[axis] - middle * turn) / (view.Scale[axis] / unit);
    square += way * way;
  }
  const double guard = std::hypot(view.Width, view.Height) / std::max(std::sqrt(square), 1e-9);
  const double whole =
    turn > 0.0 ? (1.0 - NearestToLight) / turn : std::numeric_limits<double>::infinity();
  const double end = std::min(guard, whole) / density;
  const float growth[2] = { static_cast<float>(std::log1p(-turn * end) / count),
    static_cast<float>(end / count) };
  program->SetUniform2f("growth", growth);
}

}

bool RadialBlurSettings::operator==(const RadialBlurSettings& other) const
{
  return AsTuple(*this) == AsTuple(other);
}

bool ShaftRadialBlur::CopyBehind(vtkOpenGLRenderWindow* window, const DelegateImage& image)
{
  const int* viewport = image.GetViewport();
  if (!this->Behind || this->Behind->GetContext() != window ||
    static_cast<int>(this->Behind->GetWidth()) != viewport[2] ||
    static_cast<int>(this->Behind->GetHeight()) != viewport[3])
  {
    this->Behind = vtkSmartPointer<vtkTextureObject>::New();
    this->Behind->SetContext(window);
    this->Behind->SetWrapS(vtkTextureObject::ClampToEdge);
    this->Behind->SetWrapT(vtkTextureObject::ClampToEdge);
    this->Behind->Allocate2D(viewport[2], viewport[3], 4, VTK_UNSIGNED_CHAR);
    this->Copy = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
    this->Copy->SetContext(window);
  }
  // A blit also makes one sample a pixel of many.
  vtkOpenGLState* gl = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable scissorTest(gl, GL_SCISSOR_TEST);
  gl->vtkglDisable(GL_SCISSOR_TEST);
  gl->PushDrawFramebufferBinding();
  this->Copy->Bind(vtkOpenGLFramebufferObject::GetDrawMode());
  this->Copy->AddColorAttachment(0, this->Behind);
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
    Assemble(vtkPenumbraShaftEmissionFS, { { "Picture", vtkPenumbraShaftSceneColorLib } });
  static const std::string manySamples =
    Assemble(vtkPenumbraShaftEmissionFS, { { "Picture", vtkPenumbraShaftSceneColorMSLib } });
  Allocate(this->Emission, window, coarse.Width, coarse.Height, 4);
  SampleBetween(this->Emission);
  const bool readsBehind = settings.SkyIsPicture && !settings.DelegateDrawsBackground;
  if (readsBehind)
  {
    this->CopyBehind(window, image);
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
  const float toBehind[4] = { 1.f / static_cast<float>(size[0]), 1.f / static_cast<float>(size[1]),
    -static_cast<float>(margin[0]) / static_cast<float>(size[0]),
    -static_cast<float>(margin[1]) / static_cast<float>(size[1]) };
  SetSize(program, "pixelSize", image.GetView().Width, image.GetView().Height);
  SetSize(program, "texelSize", coarse.Width, coarse.Height);
  SetNumber(program, "glowing", emitters ? 1.0 : 0.0);
  program->SetUniform4f("toBehind", toBehind);
  SetNumber(program, "block", settings.Block);
  SetNumber(program, "background", settings.DelegateDrawsBackground ? 1.0 : 0.0);
  SetNumber(program, "surfaceEmission", settings.SurfaceEmission);
  const bool white = !settings.SkyIsPicture && !emitters;
  const float sky[2] = { white ? 1.f : 0.f, settings.SkyIsPicture ? 1.f : 0.f };
  program->SetUniform2f("sky", sky);
  this->EmissionStage.BindTexture("depthBuffer", image.GetDepth());
  this->EmissionStage.BindTexture("colors", image.GetColor());
  this->EmissionStage.BindTexture("behind", readsBehind ? this->Behind.Get() : image.GetDepth());
  this->EmissionStage.BindTexture("emitters", emitters ? emitters : image.GetDepth());
  if (many)
  {
    program->SetUniformi("sampleCount", image.GetSamples());
    this->EmissionStage.BindTexture("depthSamples", image.GetSampleDepth());
  }
  this->EmissionStage.Draw();
  return true;
}

bool ShaftRadialBlur::Find(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  const ScreenTransform& coarse, vtkTextureObject* eyeDepths, const ShaftLight& light,
  const RadialBlurSettings& settings, vtkTextureObject* target)
{
  static const std::string source =
    Assemble(vtkPenumbraShaftRadialFS, { { "ViewLib", vtkPenumbraViewLib } });
  const bool geometric = settings.Geometric || settings.Passes > 1;
  const double count = std::pow(settings.Steps, settings.Passes);
  vtkTextureObject* glows = this->Emission;
  double leap = 1.0;
  for (int pass = 0; pass < settings.Passes; ++pass)
  {
    const bool last = pass + 1 == settings.Passes;
    vtkSmartPointer<vtkTextureObject>& between = this->Between[pass % 2];
    if (!last)
    {
      Allocate(between, window, coarse.Width, coarse.Height, 4);
      SampleBetween(between);
    }
    vtkShaderProgram* program = this->Mean.Ready(window, source);
    const ScopedRenderTarget into(
      window, image.GetFramebuffer(), { last ? target : between.Get() });
    if (!program || !into.IsComplete())
    {
      return false;
    }
    coarse.SetUniforms(program);
    program->SetUniform4f("light", light.Position);
    program->SetUniformi("steps", settings.Steps);
    SetNumber(program, "density", settings.Density);
    SetNumber(program, "evenly", geometric ? 0.0 : 1.0);
    SetGrowth(program, light, coarse, settings.Density, count);
    SetNumber(program, "first", pass == 0 ? 0.5 : 0.0);
    SetNumber(program, "leap", leap);
    SetNumber(program, "decay", std::pow(settings.Decay, 64.0 * leap / count));
    SetNumber(program, "weight", settings.Weight);
    SetNumber(program, "last", last ? 1.0 : 0.0);
    this->Mean.BindTexture("glows", glows);
    this->Mean.BindTexture("eyeDepths", eyeDepths);
    this->Mean.Draw();
    glows = between;
    leap *= settings.Steps;
  }
  return true;
}

void ShaftRadialBlur::ReleaseGraphicsResources(vtkWindow* window)
{
  this->EmissionStage.ReleaseGraphicsResources(window);
  this->Mean.ReleaseGraphicsResources(window);
  for (vtkSmartPointer<vtkTextureObject>* texture :
    { &this->Behind, &this->Emission, &this->Between[0], &this->Between[1] })
  {
    if (*texture)
    {
      (*texture)->ReleaseGraphicsResources(window);
      *texture = nullptr;
    }
  }
  if (this->Copy)
  {
    this->Copy->ReleaseGraphicsResources(window);
    this->Copy = nullptr;
  }
}

}
