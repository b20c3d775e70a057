// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ShaftRadial.h"

#include "Frame/OpenGLFunctions.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPenumbraShaftGlowFS.h"
#include "vtkPenumbraShaftPictureLib.h"
#include "vtkPenumbraShaftRadialFS.h"
#include "vtkPenumbraShaftSamplesLib.h"
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

auto AsTuple(const RadialSettings& s)
{
  return std::tie(s.Steps, s.Passes, s.Geometric, s.Weight, s.Decay, s.Density, s.SurfaceGlow,
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
void SetGrowth(vtkShaderProgram* program, const ShaftLight& light, const ScreenView& view,
  double density, double count)
{
  const double turn = view.Parallel ? light.Place[3] : light.Place[2];
  double square = 0.0;
  const int sides[2] = { view.Width, view.Height };
  for (int axis = 0; axis < 2; ++axis)
  {
    const double unit = view.Parallel ? view.Unit : 1.0;
    const double middle = (0.5 * sides[axis] * view.Scale[axis] + view.Offset[axis]) / unit;
    const double way = (light.Place[axis] - middle * turn) / (view.Scale[axis] / unit);
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

bool RadialSettings::operator==(const RadialSettings& other) const
{
  return AsTuple(*this) == AsTuple(other);
}

bool ShaftRadial::CopyBehind(vtkOpenGLRenderWindow* window, const DelegateImage& image)
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

bool ShaftRadial::FillGlow(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  const ScreenView& coarse, vtkTextureObject* emitters, const RadialSettings& settings)
{
  static const std::string oneSample =
    Assemble(vtkPenumbraShaftGlowFS, { { "Picture", vtkPenumbraShaftPictureLib } });
  static const std::string manySamples =
    Assemble(vtkPenumbraShaftGlowFS, { { "Picture", vtkPenumbraShaftSamplesLib } });
  Allocate(this->Glows, window, coarse.Width, coarse.Height, 4);
  SampleBetween(this->Glows);
  const bool readsBehind = settings.SkyIsPicture && !settings.DelegateDrawsBackground;
  if (readsBehind)
  {
    this->CopyBehind(window, image);
  }
  const bool many = image.GetSamples() > 1;
  vtkShaderProgram* program = this->Glow.Ready(window, many ? manySamples : oneSample);
  const DrawInto target(window, image.GetFramebuffer(), { this->Glows });
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
  SetNumber(program, "surfaceGlow", settings.SurfaceGlow);
  const bool white = !settings.SkyIsPicture && !emitters;
  const float sky[2] = { white ? 1.f : 0.f, settings.SkyIsPicture ? 1.f : 0.f };
  program->SetUniform2f("sky", sky);
  this->Glow.Read("depthBuffer", image.GetDepth());
  this->Glow.Read("colors", image.GetColor());
  this->Glow.Read("behind", readsBehind ? this->Behind.Get() : image.GetDepth());
  this->Glow.Read("emitters", emitters ? emitters : image.GetDepth());
  if (many)
  {
    program->SetUniformi("sampleCount", image.GetSamples());
    this->Glow.Read("depthSamples", image.GetSampleDepth());
  }
  this->Glow.Draw();
  return true;
}

bool ShaftRadial::Find(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  const ScreenView& coarse, vtkTextureObject* eyeDepths, const ShaftLight& light,
  const RadialSettings& settings, vtkTextureObject* target)
{
  static const std::string source =
    Assemble(vtkPenumbraShaftRadialFS, { { "ViewLib", vtkPenumbraViewLib } });
  const bool geometric = settings.Geometric || settings.Passes > 1;
  const double count = std::pow(settings.Steps, settings.Passes);
  vtkTextureObject* glows = this->Glows;
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
    const DrawInto into(window, image.GetFramebuffer(), { last ? target : between.Get() });
    if (!program || !into.IsComplete())
    {
      return false;
    }
    coarse.SetUniforms(program);
    program->SetUniform4f("light", light.Place);
    program->SetUniformi("steps", settings.Steps);
    SetNumber(program, "density", settings.Density);
    SetNumber(program, "evenly", geometric ? 0.0 : 1.0);
    SetGrowth(program, light, coarse, settings.Density, count);
    SetNumber(program, "first", pass == 0 ? 0.5 : 0.0);
    SetNumber(program, "leap", leap);
    SetNumber(program, "decay", std::pow(settings.Decay, 64.0 * leap / count));
    SetNumber(program, "weight", settings.Weight);
    SetNumber(program, "last", last ? 1.0 : 0.0);
    this->Mean.Read("glows", glows);
    this->Mean.Read("eyeDepths", eyeDepths);
    this->Mean.Draw();
    glows = between;
    leap *= settings.Steps;
  }
  return true;
}

void ShaftRadial::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Glow.ReleaseGraphicsResources(window);
  this->Mean.ReleaseGraphicsResources(window);
  for (vtkSmartPointer<vtkTextureObject>* texture :
    { &this->Behind, &this->Glows, &this->Between[0], &this->Between[1] })
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
