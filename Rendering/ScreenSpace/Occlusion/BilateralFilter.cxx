// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BilateralFilter.h"

#include "Frame/Uniforms.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkPenumbraBilateralFS.h"
#include "vtkPenumbraBilateralLib.h"
#include "vtkPenumbraBilateralSinglePassFS.h"
#include "vtkPenumbraMeanFS.h"
#include "vtkPenumbraSurfaceLib.h"
#include "vtkPenumbraViewLib.h"
#include "vtkShaderProgram.h"

namespace penumbra
{

namespace
{

std::string AssembleFilter(const char* source)
{
  return Assemble(source,
    { { "ViewLib", vtkPenumbraViewLib }, { "SurfaceLib", vtkPenumbraSurfaceLib },
      { "BilateralLib", vtkPenumbraBilateralLib } });
}

}

bool BilateralFilter::Apply(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  const ScreenTransform& view, vtkTextureObject* eyeDepths, vtkTextureObject* values,
  vtkTextureObject* intermediate, vtkTextureObject* target, const BilateralSettings& settings,
  const std::vector<Rectangle>& parts)
{
  static const std::string source = AssembleFilter(vtkPenumbraBilateralFS);
  for (int direction = 0; direction < 2; ++direction)
  {
    vtkShaderProgram* program = this->Smooth.Ready(window, source);
    const ScopedRenderTarget renderTarget(
      window, image.GetFramebuffer(), { direction == 0 ? intermediate : target }, image.GetDepth());
    if (!program || !renderTarget.IsComplete())
    {
      return false;
    }
    const float axis[2] = { direction == 0 ? 1.f : 0.f, direction == 0 ? 0.f : 1.f };
    view.SetUniforms(program);
    program->SetUniform2f("direction", axis);
    program->SetUniformf("convergedWeight", static_cast<float>(settings.ConvergedWeight));
    program->SetUniformf("distanceInPixels", static_cast<float>(settings.DistanceInPixels));
    program->SetUniformf("mean", direction == 0 ? 0.f : 1.f);
    this->Smooth.BindTexture("eyeDepths", eyeDepths);
    this->Smooth.BindTexture("values", direction == 0 ? values : intermediate);
    this->Smooth.Draw(parts);
  }
  return true;
}

bool BilateralFilter::ApplySinglePass(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  const ScreenTransform& view, vtkTextureObject* eyeDepths, vtkTextureObject* values,
  vtkTextureObject* target, const BilateralSettings& settings, const std::vector<Rectangle>& parts)
{
  static const std::string source = AssembleFilter(vtkPenumbraBilateralSinglePassFS);
  vtkShaderProgram* program = this->SinglePass.Ready(window, source);
  const ScopedRenderTarget renderTarget(
    window, image.GetFramebuffer(), { target }, image.GetDepth());
  if (!program || !renderTarget.IsComplete())
  {
    return false;
  }
  view.SetUniforms(program);
  program->SetUniformf("convergedWeight", static_cast<float>(settings.ConvergedWeight));
  program->SetUniformf("distanceInPixels", static_cast<float>(settings.DistanceInPixels));
  this->SinglePass.BindTexture("eyeDepths", eyeDepths);
  this->SinglePass.BindTexture("values", values);
  this->SinglePass.Draw(parts);
  return true;
}

bool BilateralFilter::Copy(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  vtkTextureObject* values, vtkTextureObject* target, const std::vector<Rectangle>& parts)
{
  vtkShaderProgram* program = this->Mean.Ready(window, vtkPenumbraMeanFS);
  const ScopedRenderTarget renderTarget(
    window, image.GetFramebuffer(), { target }, image.GetDepth());
  if (!program || !renderTarget.IsComplete())
  {
    return false;
  }
  SetPixelSize(program, "pixelSize", target->GetWidth(), target->GetHeight());
  this->Mean.BindTexture("values", values);
  this->Mean.Draw(parts);
  return true;
}

void BilateralFilter::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Smooth.ReleaseGraphicsResources(window);
  this->SinglePass.ReleaseGraphicsResources(window);
  this->Mean.ReleaseGraphicsResources(window);
}

}
