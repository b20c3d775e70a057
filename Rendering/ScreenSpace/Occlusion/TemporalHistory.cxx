// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TemporalHistory.h"

#include "Frame/OpenGLFunctions.h"
#include "Frame/Uniforms.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPenumbraAccumulateFS.h"
#include "vtkPenumbraActorMotionLib.h"
#include "vtkPenumbraCameraMotionLib.h"
#include "vtkPenumbraFiniteValuesLib.h"
#include "vtkPenumbraHistoryLengthLib.h"
#include "vtkPenumbraMotionQualityLib.h"
#include "vtkPenumbraNoSampleValidationLib.h"
#include "vtkPenumbraPrecomputedEstimateLib.h"
#include "vtkPenumbraReprojectFS.h"
#include "vtkPenumbraSampleValidationLib.h"
#include "vtkPenumbraSumFS.h"
#include "vtkPenumbraSurfaceLib.h"
#include "vtkPenumbraViewLib.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

namespace penumbra
{

namespace
{

/// Assembles a program without the parts that are off: on some drivers, code that a branch skips
/// costs as much as code that is executed.
std::string AssembleReprojection(const TemporalSettings& settings, const std::string& estimate)
{
  return Assemble(vtkPenumbraReprojectFS,
    { { "ViewLib", vtkPenumbraViewLib }, { "SurfaceLib", vtkPenumbraSurfaceLib },
      { "EstimateLib", estimate }, { "QualityLib", vtkPenumbraMotionQualityLib },
      { "HistoryLengthLib", vtkPenumbraHistoryLengthLib },
      { "FiniteValuesLib", vtkPenumbraFiniteValuesLib },
      { "ActorMotionLib",
        settings.Motion ? vtkPenumbraActorMotionLib : vtkPenumbraCameraMotionLib },
      { "SampleValidationLib",
        settings.NeighborValidation ? vtkPenumbraSampleValidationLib
                                    : vtkPenumbraNoSampleValidationLib } });
}

/// Sets the uniforms of all stages.
void SetWeights(vtkShaderProgram* program, int samples, const TemporalSettings& settings)
{
  program->SetUniformf("newSamples", static_cast<float>(samples));
  program->SetUniformf("maximumWeight", static_cast<float>(settings.MaximumWeight));
  program->SetUniformf("weightCap", static_cast<float>(settings.WeightCap));
}

/// Sets the uniforms and textures of the reprojecting stages.
void SetMotion(
  Stage& stage, vtkShaderProgram* program, const EyeDepth& depth, const TemporalSettings& settings)
{
  const ScreenTransform& before = depth.GetPreviousView();
  const Matrix matrix = depth.GetView().EyeTransformTo(before);
  SetMatrix(program, "toPreviousEye", matrix);
  before.SetPixelUniforms(program, "previousPixelToEye", "previousPixelSkew", "previousPixelSize");
  program->SetUniformf("growingHistoryWeight", static_cast<float>(settings.GrowingHistory));
  program->SetUniformf("settledHistoryWeight", static_cast<float>(settings.SettledHistory));
  program->SetUniformf("depthTolerance", static_cast<float>(settings.DepthTolerance));
  program->SetUniformf("imageOnly", settings.ImageOnly ? 1.f : 0.f);
  if (settings.NeighborValidation)
  {
    program->SetUniformf("propsChanged", settings.PropsChanged ? 1.f : 0.f);
    program->SetUniformf("invalidationWeight",
      settings.PropsChanged ? 0.f : static_cast<float>(settings.InvalidationWeight));
  }
  stage.BindTexture("eyeDepths", depth.GetCurrent());
  stage.BindTexture("previousEyeDepths", depth.GetPrevious());
  if (settings.Motion)
  {
    stage.BindTexture("movedActors", settings.Motion->GetTarget());
    stage.BindTexture("actorMotions", settings.Motion->GetMatrices());
  }
}

}

bool TemporalHistory::SwapTextures(vtkOpenGLRenderWindow* window, const ScreenTransform& view)
{
  const vtkSmartPointer<vtkTextureObject>& last = this->Textures[this->Current];
  const bool isNew = !last || last->GetContext() != window;
  if (isNew)
  {
    Allocate(this->Textures[this->Current], window, view.Width, view.Height, 2);
  }
  this->Current = 1 - this->Current;
  Allocate(this->Textures[this->Current], window, view.Width, view.Height, 2);
  return isNew;
}

void TemporalHistory::ResizeScratchTexture(
  vtkOpenGLRenderWindow* window, const ScreenTransform& view)
{
  Allocate(this->Textures[1 - this->Current], window, view.Width, view.Height, 2);
}

bool TemporalHistory::Add(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  const EyeDepth& depth, EyeDepth::Change change, vtkTextureObject* estimates, int samples,
  const TemporalSettings& settings, const std::vector<Rectangle>& parts)
{
  const bool isNew = this->SwapTextures(window, depth.GetView());
  const bool moved = change == EyeDepth::Change::Moved && !isNew;
  Stage& stage = !moved           ? this->Accumulation
    : settings.NeighborValidation ? this->Validate
                                  : this->Reproject;
  vtkShaderProgram* program = stage.Ready(window,
    moved
      ? AssembleReprojection(settings, vtkPenumbraPrecomputedEstimateLib)
      : Assemble(vtkPenumbraAccumulateFS, { { "FiniteValuesLib", vtkPenumbraFiniteValuesLib } }));
  const ScopedRenderTarget target(
    window, image.GetFramebuffer(), { this->GetTexture() }, image.GetDepth());
  if (!program || !target.IsComplete())
  {
    return false;
  }
  depth.GetView().SetUniforms(program);
  TemporalSettings weights = settings;
  weights.WeightCap = change == EyeDepth::Change::Reset || isNew ? 0.0 : settings.WeightCap;
  SetWeights(program, samples, weights);
  stage.BindTexture("estimates", estimates);
  stage.BindTexture("history", this->GetScratchTexture());
  if (moved)
  {
    SetMotion(stage, program, depth, settings);
  }
  stage.Draw(parts);
  this->ResizeScratchTexture(window, depth.GetView());
  return true;
}

int TemporalHistory::ReprojectAndEstimate(const vtkPenumbraOcclusionEstimator::Request& request,
  vtkPenumbraOcclusionEstimator* estimator, const TemporalSettings& settings)
{
  this->SwapTextures(request.Window, request.Depth->GetView());
  vtkShaderProgram* program =
    this->Estimate.Ready(request.Window, AssembleReprojection(settings, estimator->GetShader()));
  const ScopedRenderTarget target(request.Window, request.Image->GetFramebuffer(),
    { this->GetTexture() }, request.Image->GetDepth());
  if (!program || !target.IsComplete())
  {
    return 0;
  }
  request.Depth->GetView().SetUniforms(program);
  const int samples = estimator->SetUniforms(request, program);
  SetWeights(program, samples, settings);
  SetMotion(this->Estimate, program, *request.Depth, settings);
  this->Estimate.BindTexture("history", this->GetScratchTexture());
  this->Estimate.Draw(*request.Parts);
  this->ResizeScratchTexture(request.Window, request.Depth->GetView());
  return samples;
}

bool TemporalHistory::Accumulate(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  vtkTextureObject* estimates, int samples, const std::vector<Rectangle>& parts)
{
  vtkShaderProgram* program = this->Sum.Ready(
    window, Assemble(vtkPenumbraSumFS, { { "FiniteValuesLib", vtkPenumbraFiniteValuesLib } }));
  const ScopedRenderTarget target(
    window, image.GetFramebuffer(), { this->GetTexture() }, image.GetDepth());
  if (!program || !target.IsComplete())
  {
    return false;
  }
  SetPixelSize(program, "pixelSize", image.GetView().Width, image.GetView().Height);
  program->SetUniformf("newSamples", static_cast<float>(samples));
  this->Sum.BindTexture("estimates", estimates);
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
  Release(window, this->Textures[0], this->Textures[1]);
  this->Reproject.ReleaseGraphicsResources(window);
  this->Validate.ReleaseGraphicsResources(window);
  this->Estimate.ReleaseGraphicsResources(window);
  this->Accumulation.ReleaseGraphicsResources(window);
  this->Sum.ReleaseGraphicsResources(window);
}

}
