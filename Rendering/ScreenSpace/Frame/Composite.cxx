// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Composite.h"

#include "OpenGLFunctions.h"
#include "SceneShader.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPenumbraApplyOcclusionLib.h"
#include "vtkPenumbraCompositeFS.h"
#include "vtkShaderProgram.h"

namespace penumbra
{

bool Composite::Draw(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  const EyeDepth& depth, vtkTextureObject* colors, vtkTextureObject* occlusions,
  const Darkening& darkening, bool background)
{
  static const SceneShader shader(
    vtkPenumbraCompositeFS, { { "ApplyOcclusionLib", vtkPenumbraApplyOcclusionLib } });
  vtkShaderProgram* program = shader.Ready(this->DrawStage, window, image);
  if (!program)
  {
    return false;
  }
  const int* viewport = image.GetViewport();
  const int* margin = image.GetMargin();
  const ScopedBlending target(window, viewport, true);
  window->GetState()->vtkglDisable(GL_BLEND);
  const float offset[2] = { static_cast<float>(margin[0] - viewport[0]),
    static_cast<float>(margin[1] - viewport[1]) };
  program->SetUniform2f("offset", offset);
  depth.GetView().SetUniforms(program);
  const double* toCamera = depth.GetView().ToCameraDepth;
  const float toTarget[2] = { static_cast<float>(toCamera[0]), static_cast<float>(toCamera[1]) };
  program->SetUniform2f("toTargetDepth", toTarget);
  program->SetUniformf("strength", static_cast<float>(darkening.Strength));
  program->SetUniformf("lightAwareness", static_cast<float>(darkening.LightAwareness));
  program->SetUniformf("background", background ? 1.f : 0.f);
  this->DrawStage.BindTexture("occlusions", occlusions ? occlusions : depth.GetCurrent());
  SceneShader::Draw(this->DrawStage, program, image, depth, colors);
  return true;
}

void Composite::ReleaseGraphicsResources(vtkWindow* window)
{
  this->DrawStage.ReleaseGraphicsResources(window);
}

}
