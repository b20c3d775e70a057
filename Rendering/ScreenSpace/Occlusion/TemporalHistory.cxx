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
#include "vtkPenumbraNoEstimateLib.h"
#include "vtkPenumbraNoSampleValidationLib.h"
#include "vtkPenumbraReprojectFS.h"
#include "vtkPenumbraSampleValidationLib.h"
#include "vtkPenumbraSumFS.h"
#include "vtkPenumbraSurfaceLib.h"
#include "vtkPenumbraViewLib.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>

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
  vtkShaderProgram* program = this->Accumulation.Ready(window,
    Assemble(vtkPenumbraAccumulateFS, { { "FiniteValuesLib", vtkPenumbraFiniteValuesLib } }));
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
  this->Accumulation.BindTexture("estimates", estimates);
  this->Accumulation.BindTexture("history", this->GetScratchTexture());
  this->Accumulation.Draw(parts);
  this->ResizeScratchTexture(window, depth.GetView());
  return true;
}

bool TemporalHistory::Reproject(const vtkPenumbraOcclusionEstimator::Request& request,
  vtkPenumbraOcclusionEstimator* estimator, const TemporalSettings& settings, int& samples)
{
  const bool isNew = this->SwapTextures(request.Window, request.Depth->GetView());
  Stage& stage = settings.NeighborValidation ? this->Validation : this->Reprojection;
  const std::string shader = estimator->GetShader();
  vtkShaderProgram* program = stage.Ready(request.Window,
    AssembleReprojection(settings, shader.empty() ? vtkPenumbraNoEstimateLib : shader));
  const ScopedRenderTarget target(request.Window, request.Image->GetFramebuffer(),
    { this->GetTexture() }, request.Image->GetDepth());
  if (!program || !target.IsComplete())
  {
    return false;
  }
  request.Depth->GetView().SetUniforms(program);
  samples = shader.empty() ? 0 : estimator->SetUniforms(request, program);
  TemporalSettings weights = settings;
  weights.WeightCap = isNew ? 0.0 : settings.WeightCap;
  SetWeights(program, samples, weights);
  SetMotion(stage, program, *request.Depth, settings);
  stage.BindTexture("history", this->GetScratchTexture());
  stage.Draw(*request.Parts);
  this->ResizeScratchTexture(request.Window, request.Depth->GetView());
  return true;
}

vtkPenumbraOcclusionEstimator::Addition TemporalHistory::ReprojectAndEstimate(
  const vtkPenumbraOcclusionEstimator::Request& request, vtkPenumbraOcclusionEstimator* estimator,
  const TemporalSettings& settings, vtkTextureObject* estimates)
{
  int samples = 0;
  if (!this->Reproject(request, estimator, settings, samples))
  {
    return {};
  }
  if (!estimator->GetShader().empty())
  {
    return { samples, std::max(request.ShortHistorySamples, samples) };
  }
  if (estimator->CanAddToHistory())
  {
    return estimator->AddToHistory(request, this->GetTexture());
  }
  samples = estimator->Estimate(request, estimates);
  const bool added = samples > 0 &&
    this->Accumulate(request.Window, *request.Image, estimates, samples, *request.Parts);
  return { added ? samples : 0, samples };
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
  this->Reprojection.ReleaseGraphicsResources(window);
  this->Validation.ReleaseGraphicsResources(window);
  this->Accumulation.ReleaseGraphicsResources(window);
  this->Sum.ReleaseGraphicsResources(window);
}

}
