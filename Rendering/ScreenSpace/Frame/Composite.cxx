// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Composite.h"

#include "OpenGLFunctions.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPenumbraApplyOcclusionLib.h"
#include "vtkPenumbraCompositeFS.h"
#include "vtkPenumbraSceneSampleLib.h"
#include "vtkPenumbraSceneSamplesLib.h"
#include "vtkPenumbraViewLib.h"
#include "vtkShaderProgram.h"

namespace penumbra
{

bool Composite::Draw(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  const EyeDepth& depth, vtkTextureObject* colors, vtkTextureObject* occlusions,
  const Darkening& darkening, bool background)
{
  const auto assemble = [](const char* sample) {
    return Assemble(vtkPenumbraCompositeFS,
      { { "ViewLib", vtkPenumbraViewLib }, { "SceneSample", sample },
        { "ApplyOcclusionLib", vtkPenumbraApplyOcclusionLib } });
  };
  static const std::string oneSample = assemble(vtkPenumbraSceneSampleLib);
  static const std::string manySamples = assemble(vtkPenumbraSceneSamplesLib);
  const bool many = image.GetSamples() > 1;
  vtkShaderProgram* program = this->DrawStage.Ready(window, many ? manySamples : oneSample);
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
  this->DrawStage.BindTexture("colors", colors);
  this->DrawStage.BindTexture(many ? "depthSamples" : "depthBuffer", image.GetSampleDepth());
  if (many)
  {
    this->DrawStage.BindTexture("eyeDepths", depth.GetCurrent());
  }
  this->DrawStage.BindTexture("occlusions", occlusions ? occlusions : depth.GetCurrent());
  many ? this->DrawStage.DrawSamples(program) : this->DrawStage.Draw();
  return true;
}

void Composite::ReleaseGraphicsResources(vtkWindow* window)
{
  this->DrawStage.ReleaseGraphicsResources(window);
}

}
