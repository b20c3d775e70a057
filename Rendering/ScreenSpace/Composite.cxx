// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Composite.h"

#include "OpenGLFunctions.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPenumbraCompositeFS.h"
#include "vtkPenumbraCompositeSamplesFS.h"
#include "vtkPenumbraViewLib.h"
#include "vtkShaderProgram.h"

namespace penumbra
{

bool Composite::Draw(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  const EyeDepth& depth, vtkTextureObject* colors, vtkTextureObject* occlusions, double strength,
  bool background)
{
  static const std::string samplesSource =
    Assemble(vtkPenumbraCompositeSamplesFS, { { "ViewLib", vtkPenumbraViewLib } });
  const bool manySamples = image.GetSamples() > 1;
  vtkShaderProgram* program =
    this->Darken.Ready(window, manySamples ? samplesSource : vtkPenumbraCompositeFS);
  if (!program)
  {
    return false;
  }
  vtkOpenGLState* gl = window->GetState();
  const vtkOpenGLState::ScopedglViewport viewport(gl);
  const vtkOpenGLState::ScopedglScissor scissor(gl);
  const vtkOpenGLState::ScopedglEnableDisable blend(gl, GL_BLEND);
  const vtkOpenGLState::ScopedglEnableDisable depthTest(gl, GL_DEPTH_TEST);
  const int* at = image.GetViewport();
  const int* margin = image.GetMargin();
  gl->vtkglViewport(at[0], at[1], at[2], at[3]);
  gl->vtkglScissor(at[0], at[1], at[2], at[3]);
  const vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(gl);
  gl->vtkglDisable(GL_BLEND);
  if (manySamples && !background)
  {
    gl->vtkglEnable(GL_BLEND);
    gl->vtkglBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  }
  gl->vtkglEnable(GL_DEPTH_TEST);
  gl->vtkglDepthMask(GL_TRUE);
  gl->vtkglDepthFunc(GL_ALWAYS);
  gl->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);

  const float offset[2] = { static_cast<float>(margin[0] - at[0]),
    static_cast<float>(margin[1] - at[1]) };
  program->SetUniform2f("offset", offset);
  depth.GetView().SetUniforms(program);
  program->SetUniformf("strength", static_cast<float>(strength));
  program->SetUniformf("background", background ? 1.f : 0.f);
  this->Darken.Read("colors", colors);
  this->Darken.Read(manySamples ? "depthSamples" : "depthBuffer", image.GetSampleDepth());
  if (manySamples)
  {
    program->SetUniformi("sampleCount", image.GetSamples());
    this->Darken.Read("eyeDepths", depth.GetCurrent());
  }
  this->Darken.Read("occlusions", occlusions ? occlusions : depth.GetCurrent());
  this->Darken.Draw();
  gl->vtkglDepthFunc(GL_LEQUAL);
  return true;
}

void Composite::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Darken.ReleaseGraphicsResources(window);
}

}
