// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TemporalHistory.h"

#include "OpenGLFunctions.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPenumbraAccumulateFS.h"
#include "vtkPenumbraHistoryFS.h"
#include "vtkPenumbraNeighbourLib.h"
#include "vtkPenumbraSumFS.h"
#include "vtkPenumbraSurfaceLib.h"
#include "vtkPenumbraViewLib.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

namespace penumbra
{

namespace
{

/// What only the reprojecting stage needs.
void SetMotion(vtkShaderProgram* program, const EyeDepth& depth, const TemporalSettings& settings)
{
  const ScreenView& before = depth.GetPreviousView();
  const Matrix matrix = depth.GetView().ToEyeOf(before);
  float columns[16];
  for (int i = 0; i < 16; ++i)
  {
    columns[i] = static_cast<float>(matrix[4 * (i % 4) + i / 4]);
  }
  program->SetUniformMatrix4x4("toPreviousEye", columns);
  const double unit = before.Parallel ? before.Unit : 1.0;
  const float pixelToEye[4] = { static_cast<float>(before.Scale[0] / unit),
    static_cast<float>(before.Scale[1] / unit), static_cast<float>(before.Offset[0] / unit),
    static_cast<float>(before.Offset[1] / unit) };
  program->SetUniform4f("previousPixelToEye", pixelToEye);
  program->SetUniformf("depthTolerance", static_cast<float>(settings.DepthTolerance));
  if (settings.NeighbourValidation)
  {
    program->SetUniformf("invalidationWeight", static_cast<float>(settings.InvalidationWeight));
  }
}

}

bool TemporalHistory::Add(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  const EyeDepth& depth, EyeDepth::Change change, vtkTextureObject* estimates, int samples,
  const TemporalSettings& settings, const std::vector<Rectangle>& parts)
{
  // Two programs: on some drivers what is skipped costs as much as what is done.
  const auto assemble = [](const char* neighbours) {
    return Assemble(vtkPenumbraHistoryFS,
      { { "ViewLib", vtkPenumbraViewLib }, { "SurfaceLib", vtkPenumbraSurfaceLib },
        { "NeighbourLib", neighbours } });
  };
  static const std::string reproject =
    assemble("float neighbourTrust(SurfacePoint point, vec3 before) { return maximumWeight; }");
  static const std::string validate = assemble(vtkPenumbraNeighbourLib);

  const ScreenView& view = depth.GetView();
  bool isNew = false;
  for (vtkSmartPointer<vtkTextureObject>& texture : this->Textures)
  {
    isNew = Allocate(texture, window, view.Width, view.Height, 2) || isNew;
  }
  const bool moved = change == EyeDepth::Change::Some && !isNew;
  const bool fresh = change == EyeDepth::Change::All || isNew;
  Stage& stage = !moved            ? this->Accumulate
    : settings.NeighbourValidation ? this->Validate
                                   : this->Reproject;
  vtkTextureObject* last = this->GetTexture();
  this->Current = 1 - this->Current;

  vtkShaderProgram* program = stage.Ready(window,
    !moved                           ? vtkPenumbraAccumulateFS
      : settings.NeighbourValidation ? validate
                                     : reproject);
  const DrawInto target(window, image.GetFramebuffer(), { this->GetTexture() }, image.GetDepth());
  if (!program || !target.IsComplete())
  {
    return false;
  }
  view.SetUniforms(program);
  program->SetUniformf("newSamples", static_cast<float>(samples));
  program->SetUniformf("maximumWeight", static_cast<float>(settings.MaximumWeight));
  program->SetUniformf("weightCap", fresh ? 0.f : static_cast<float>(settings.WeightCap));
  stage.Read("estimates", estimates);
  stage.Read("history", last);
  if (moved)
  {
    SetMotion(program, depth, settings);
    stage.Read("eyeDepths", depth.GetCurrent());
    stage.Read("previousEyeDepths", depth.GetPrevious());
  }
  stage.Draw(parts);
  return true;
}

bool TemporalHistory::AddTo(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  vtkTextureObject* estimates, int samples, const std::vector<Rectangle>& parts)
{
  vtkShaderProgram* program = this->Sum.Ready(window, vtkPenumbraSumFS);
  const DrawInto target(window, image.GetFramebuffer(), { this->GetTexture() }, image.GetDepth());
  if (!program || !target.IsComplete())
  {
    return false;
  }
  const ScreenView& view = image.GetView();
  const float pixelSize[2] = { 1.f / static_cast<float>(view.Width),
    1.f / static_cast<float>(view.Height) };
  program->SetUniform2f("pixelSize", pixelSize);
  program->SetUniformf("newSamples", static_cast<float>(samples));
  this->Sum.Read("estimates", estimates);
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  const vtkOpenGLState::ScopedglBlendFuncSeparate function(state);
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE);
  this->Sum.Draw(parts);
  return true;
}

void TemporalHistory::ReleaseGraphicsResources(vtkWindow* window)
{
  for (vtkSmartPointer<vtkTextureObject>& texture : this->Textures)
  {
    if (texture)
    {
      texture->ReleaseGraphicsResources(window);
      texture = nullptr;
    }
  }
  this->Reproject.ReleaseGraphicsResources(window);
  this->Validate.ReleaseGraphicsResources(window);
  this->Accumulate.ReleaseGraphicsResources(window);
  this->Sum.ReleaseGraphicsResources(window);
}

}
