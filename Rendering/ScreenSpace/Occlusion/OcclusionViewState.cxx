// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionViewState.h"

#include "Frame/ScreenSpaceConstants.h"
#include "vtkPenumbraOcclusionEstimator.h"

#include "vtkCamera.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <chrono>

namespace penumbra
{

namespace
{

/// The sample sequence restarts after this many samples, before its index loses precision as a
/// float.
constexpr int SequenceLength = 1 << 20;

/// Returns the turn of a frame. The first turn of each period is random, so that a surface that moves
/// by a block of pixels per frame does not always miss its turn.
int ChooseTurn(int frame, int turns)
{
  const unsigned int random = static_cast<unsigned int>(frame / turns) * 2654435761u; // [Knuth]
  return static_cast<int>((frame % turns + (random >> 16)) % turns);
}

}

bool OcclusionViewState::MeetsTolerance() const
{
  return this->TileConvergence.IsDone() ||
    this->TileConvergence.GetSamplesAtCheck() >=
    StillSampleLimit * this->Settings.Constants.MaximumWeight;
}

bool OcclusionViewState::Render(const vtkRenderState* state, vtkRenderPass* delegate,
  vtkPenumbraOcclusionEstimator* estimator, const OcclusionSettings& settings)
{
  this->Renderer = state->GetRenderer();
  this->Window = static_cast<vtkOpenGLRenderWindow*>(this->Renderer->GetRenderWindow());
  this->Estimator = estimator;
  const OcclusionSettings last = this->Settings;
  this->Settings = settings;
  this->CompareSettings(last);
  this->NewSamples = 0;
  this->HasActorMotion = false;
  if (!this->Image.SetUpView(state, settings.Margin, settings.Bounds))
  {
    return false;
  }
  ScreenTransform view = this->Image.GetView();
  view.Unit = settings.Radius;
  // An image in the target can be multiplied by a factor, but not by one that depends on its
  // brightness.
  // A delegate that renders the whole image may synchronize with other ranks: it is rendered once.
  const bool direct = !settings.DelegateDrawsBackground && settings.Darkness.LightAwareness == 0.0;
  if (direct && this->CanReuseConvergedFrame(view) &&
    this->StoredFrame.Draw(state, delegate, this->Image, this->GetCompositeInputs()))
  {
    this->Props = this->StoredFrame.GetNumberOfRenderedProps();
    this->Changed = false;
    this->UpdateActorMotion();
    return true;
  }
  this->StoredFrame.Invalidate();
  this->Props = this->Image.Draw(state, delegate, settings.Margin, false, settings.Bounds);
  if (this->Props < 0)
  {
    return false;
  }
  this->UpdateActorMotion();
  const int* at = this->Image.GetViewport();
  this->InnerRegion = { { settings.Margin[0], settings.Margin[1], at[2], at[3] } };
  Allocate(this->Estimates, this->Window, view.Width, view.Height, 1);
  if (this->Settings.Restart)
  {
    this->Depth.Invalidate();
  }
  EyeDepth::Comparison comparison = this->Depth.ChooseComparison(
    settings.UseActorMotion && settings.SceneChanged && this->Changed && !settings.InOneRender);
  if (settings.HiddenChanged && comparison == EyeDepth::Comparison::Wait)
  {
    comparison = EyeDepth::Comparison::Skip;
  }
  EyeDepth::Change change = this->Depth.Update(this->Window, this->Image, view, comparison);
  if (change == EyeDepth::Change::Failed)
  {
    return false;
  }
  this->TurnsFast = false;
  if (change == EyeDepth::Change::Moved && settings.Constants.DepthTolerance < 1.0)
  {
    const auto isCut = [&](double minimumCosine) {
      return view.IsCutFrom(this->Depth.GetPreviousView(),
        this->Renderer->GetActiveCamera()->GetDistance(), minimumCosine);
    };
    const bool isOtherView = isCut(MinimumUncutCosineOfRays);
    // A kernel finds other occluders from the new viewpoint, so a short new history is more accurate.
    this->TurnsFast = !isOtherView && !settings.InOneRender && estimator->NeedsMargin() &&
      isCut(MinimumUncutCosine);
    change = isOtherView || this->TurnsFast ? EyeDepth::Change::Reset : change;
  }
  this->Changed = change != EyeDepth::Change::None;
  if (this->Changed)
  {
    // Discard the history when converging within one Render(): stale samples would delay
    // convergence.
    change = settings.InOneRender ? EyeDepth::Change::Reset : change;
    this->Converged = false;
    this->TileConvergence.Restart(change == EyeDepth::Change::Reset && !this->TurnsFast
        ? 0.0
        : settings.Constants.InvalidationWeight);
  }
  if (change == EyeDepth::Change::Reset)
  {
    this->SamplesSinceReset = 0;
    this->FramesWithTurns = 0;
    // Makes the image independent of earlier frames, and estimators measure again what they keep.
    this->TotalSamples = 0;
  }
  if (change == EyeDepth::Change::Moved && this->Settings.PropsChanged)
  {
    // Many pixels have lost their history: the next frames use FirstSamples.
    this->SamplesSinceReset = 0;
  }
  this->HasActorMotion = change == EyeDepth::Change::Moved &&
    this->Motion.Draw(this->Renderer, this->Image, this->Depth);
  const bool done = this->Converged ? this->Filtered || this->Filter() : this->Converge(change);
  if (!done)
  {
    return false;
  }
  // Later frames are rendered directly into the target. Do the same for this one, so that all are
  // identical.
  if (direct && this->Converged &&
    this->StoredFrame.Draw(state, delegate, this->Image, this->GetCompositeInputs()))
  {
    return true;
  }
  return this->Compositor.Draw(this->Window, this->Image, this->Depth, this->Image.GetColor(),
    this->Estimates, settings.Darkness, settings.DelegateDrawsBackground);
}

void OcclusionViewState::UpdateActorMotion()
{
  if (this->Settings.UseActorMotion && this->Settings.SceneChanged)
  {
    this->Motion.UpdateMotion(this->Renderer);
  }
  else
  {
    this->Motion.ClearMotion();
  }
}

void OcclusionViewState::CompareSettings(const OcclusionSettings& last)
{
  OcclusionSettings& now = this->Settings;
  const OcclusionConstants& constants = now.Constants;
  const bool isDefault = constants.InvalidationWeight == OcclusionConstants().InvalidationWeight;
  this->MovedNeighborWeight = isDefault && this->Estimator->CanAddToHistory()
    ? KeptOfOwnSamples
    : constants.InvalidationWeight;
  // If InvalidationWeight is at least MaximumWeight, sample validation has no effect.
  now.PropsChanged = now.PropsChanged && constants.InvalidationWeight < constants.MaximumWeight;
  // An image that converges in one Render() does not depend on earlier ones.
  now.Restart = now.Restart ||
    (now.InOneRender &&
      (!last.InOneRender || now.Tolerance != last.Tolerance || now.EstimatorChanged));
  if (!now.Restart && now.EstimatorChanged)
  {
    this->Converged = false;
    this->TileConvergence.Restart(constants.InvalidationWeight);
    this->LimitSamplesSinceReset();
  }
  if (!now.Restart && now.Tolerance < last.Tolerance)
  {
    this->Converged = false;
    this->TileConvergence.ReactivateTiles();
  }
  const bool sameFilter = constants.Filter == last.Constants.Filter &&
    constants.SpatialConvergence == last.Constants.SpatialConvergence &&
    constants.MaximumWeight == last.Constants.MaximumWeight;
  this->Filtered = sameFilter;
  this->StoredFrameValid = sameFilter && now.Darkness.Strength == last.Darkness.Strength &&
    now.Darkness.LightAwareness == last.Darkness.LightAwareness;
}

bool OcclusionViewState::CanReuseConvergedFrame(const ScreenTransform& view) const
{
  return this->Converged && this->StoredFrame.IsValid() && !this->Settings.Restart &&
    this->StoredFrameValid && !this->Settings.HiddenChanged &&
    this->Depth.GetView().HasSameView(view);
}

ConvergedFrame::CompositeInputs OcclusionViewState::GetCompositeInputs() const
{
  return { this->Estimates, this->Settings.Darkness.Strength, this->History.GetScratchTexture() };
}

bool OcclusionViewState::Converge(EyeDepth::Change change)
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const bool isStatic = this->Settings.InOneRender || change == EyeDepth::Change::None;
  const bool refines = isStatic && this->Estimator->CanRefine();
  int steps = 0;
  const auto mayContinue = [&]() {
    if (this->Settings.InOneRender)
    {
      return !this->Window->CheckAbortStatus();
    }
    if (this->Settings.Constants.StepsPerFrame > 0)
    {
      return ++steps < this->Settings.Constants.StepsPerFrame;
    }
    this->Window->WaitForCompletion();
    return std::chrono::duration<double>(Clock::now() - start).count() < this->Settings.Seconds;
  };
  this->Refined = this->Refined && refines && change == EyeDepth::Change::None;
  const int samplesBetween = this->TileConvergence.GetSamples() - this->SamplesOfFrame;
  if (isStatic && !refines && this->RefinedBetweenFrames && samplesBetween > 0)
  {
    this->NewSamples = this->DisocclusionSamples = samplesBetween;
    return this->FinishFrame();
  }
  bool done = refines ? this->Refine() : this->Estimate(change);
  while (done && isStatic && !this->MeetsTolerance() &&
    (mayContinue() || (this->Settings.InOneRender && refines && !this->Refined)))
  {
    done = refines ? this->Refine() : this->Estimate(EyeDepth::Change::None);
  }
  return done && this->FinishFrame();
}

bool OcclusionViewState::FinishFrame()
{
  this->RefinedBetweenFrames = false;
  this->SamplesOfFrame = this->TileConvergence.GetSamples();
  this->Converged = this->MeetsTolerance();
  return this->Filter();
}

bool OcclusionViewState::RefineBetweenFrames(double seconds)
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const bool canContinue = this->Estimator && !this->Estimator->CanRefine() && !this->Changed &&
    !this->Converged && !this->Settings.InOneRender && this->TileConvergence.GetSamples() > 0;
  if (!canContinue)
  {
    return true;
  }
  this->RefinedBetweenFrames = true;
  bool done = true;
  do
  {
    done = this->Estimate(EyeDepth::Change::None);
    this->Window->WaitForCompletion();
  }
  while (done && !this->MeetsTolerance() &&
    std::chrono::duration<double>(Clock::now() - start).count() < seconds);
  return !done || this->MeetsTolerance() ||
    this->TileConvergence.GetSamples() >= SamplesPerFrameGrowth * this->SamplesOfFrame;
}

void OcclusionViewState::LimitSamplesSinceReset()
{
  this->SamplesSinceReset = std::min(
    this->SamplesSinceReset, static_cast<int>(this->Settings.Constants.InvalidationWeight));
}

vtkPenumbraOcclusionEstimator::Request OcclusionViewState::MakeRequest(bool isStatic) const
{
  vtkPenumbraOcclusionEstimator::Request request;
  request.Window = this->Window;
  request.Renderer = this->Renderer;
  request.Image = &this->Image;
  request.Depth = &this->Depth;
  request.Radius = this->Settings.Radius;
  request.FirstSample = this->TotalSamples;
  request.Tolerance = this->Settings.Tolerance;
  request.Seconds = this->Settings.Constants.StepsPerFrame > 0 ? 0.0
    : isStatic                                                 ? this->Settings.Seconds
                                                               : this->Settings.SecondsInMotion;
  return request;
}

bool OcclusionViewState::Refine()
{
  const vtkPenumbraOcclusionEstimator::Refinement result =
    this->Estimator->Refine(this->MakeRequest(true), this->Estimates);
  if (result.HasFailed)
  {
    return false;
  }
  if (result.Samples > 0)
  {
    this->Refined = this->History.Add(this->Window, this->Image, this->Depth,
      EyeDepth::Change::Reset, this->Estimates, result.Samples, {}, this->InnerRegion);
    this->NewSamples = this->DisocclusionSamples = result.Samples;
    this->SamplesSinceReset = result.Samples;
    this->TileConvergence.SetError(result.Samples, result.Error, result.IsFinal);
    return this->Refined;
  }
  return true;
}

bool OcclusionViewState::Estimate(EyeDepth::Change change)
{
  const OcclusionSettings& settings = this->Settings;
  const OcclusionConstants& constants = settings.Constants;
  const bool refine = change == EyeDepth::Change::None && this->TileConvergence.GetSamples() > 0;
  if (change == EyeDepth::Change::None && !refine)
  {
    // The camera has just stopped: AccumulateSamples() caps the weight of the history.
    this->LimitSamplesSinceReset();
  }
  const double convergence = this->SamplesSinceReset / constants.MaximumWeight;
  vtkPenumbraOcclusionEstimator::Request request =
    this->MakeRequest(change == EyeDepth::Change::None);
  // In motion, a kernel takes FirstSamples only where history is short. Frames of a static view have
  // more samples, because the rest of a frame costs as much with few.
  const bool byPixel = change == EyeDepth::Change::Moved && this->HasShader();
  const bool many =
    !byPixel && (change != EyeDepth::Change::Moved || convergence < constants.AdaptiveConvergence);
  request.Samples = many ? constants.FirstSamples : constants.Samples;
  if (refine && !settings.InOneRender && constants.StepsPerFrame == 0 &&
    this->TileConvergence.GetSamples() >= LargeStaticStep * request.Samples)
  {
    request.Samples *= LargeStaticStep;
  }
  request.ShortHistorySamples =
    byPixel ? std::max(constants.FirstSamples, request.Samples) : request.Samples;
  request.Parts = refine && this->TileConvergence.HasTileErrors()
    ? &this->TileConvergence.GetActiveTiles()
    : &this->InnerRegion;
  request.Moving = (change == EyeDepth::Change::Moved && this->TotalSamples > 0) || this->TurnsFast;
  // While the view moves, there are always disoccluded pixels with few samples.
  request.RotatePerPixel = request.Moving || convergence < constants.RotationConvergence;
  if (byPixel && !settings.SceneChanged)
  {
    request.Turns = constants.SettledPeriod;
    request.Turn = ChooseTurn(this->FramesWithTurns, request.Turns);
    request.SettledFirstSample = this->FramesWithTurns / request.Turns * request.Samples;
    this->FramesWithTurns = (this->FramesWithTurns + 1) % SequenceLength;
  }
  const auto added = this->AccumulateSamples(request, change, refine);
  if (added.Samples < 1)
  {
    return false;
  }
  this->TotalSamples = (this->TotalSamples + added.Samples) % SequenceLength;
  this->SamplesSinceReset += byPixel && convergence < constants.AdaptiveConvergence
    ? added.ShortHistorySamples
    : added.Samples;
  this->NewSamples += added.Samples;
  this->DisocclusionSamples =
    change == EyeDepth::Change::Moved ? added.ShortHistorySamples : this->NewSamples;
  if (change != EyeDepth::Change::Moved && !this->TurnsFast)
  {
    this->TileConvergence.Add(added.Samples, this->Image.GetView().Width, this->InnerRegion.front(),
      settings.Tolerance, [this]() { return this->ReadMeans(); });
  }
  return true;
}

vtkPenumbraOcclusionEstimator::Addition OcclusionViewState::AccumulateSamples(
  const vtkPenumbraOcclusionEstimator::Request& request, EyeDepth::Change change, bool refine)
{
  const OcclusionConstants& constants = this->Settings.Constants;
  TemporalSettings temporal;
  temporal.MaximumWeight = constants.MaximumWeight;
  temporal.GrowingHistory = constants.AdaptiveConvergence * constants.MaximumWeight;
  temporal.SettledHistory =
    std::max(constants.AdaptiveConvergence, constants.SpatialConvergence) * constants.MaximumWeight;
  temporal.DepthTolerance = constants.DepthTolerance;
  temporal.ImageOnly = this->Estimator->NeedsMargin();
  temporal.NeighborValidation = this->Settings.SceneChanged;
  temporal.InvalidationWeight = this->MovedNeighborWeight;
  temporal.PropsChanged = this->Settings.PropsChanged;
  temporal.Motion = this->HasActorMotion ? &this->Motion : nullptr;
  if (this->Settings.EstimatorChanged)
  {
    temporal.WeightCap = constants.InvalidationWeight;
  }
  if (change == EyeDepth::Change::Moved)
  {
    return this->History.ReprojectAndEstimate(request, this->Estimator, temporal, this->Estimates);
  }
  const int samples = this->Estimator->Estimate(request, this->Estimates);
  if (samples < 1)
  {
    return {};
  }
  if (change == EyeDepth::Change::None)
  {
    // The reprojected history is slightly blurred, so its weight is limited.
    temporal.WeightCap = constants.InvalidationWeight;
  }
  const bool added = refine
    ? this->History.Accumulate(this->Window, this->Image, this->Estimates, samples, *request.Parts)
    : this->History.Add(this->Window, this->Image, this->Depth, change, this->Estimates, samples,
        temporal, this->InnerRegion);
  return { added ? samples : 0, samples };
}

bool OcclusionViewState::Filter()
{
  const OcclusionConstants& constants = this->Settings.Constants;
  BilateralSettings settings;
  settings.ConvergedWeight = constants.SpatialConvergence * constants.MaximumWeight;
  if (!constants.Filter || this->Refined ||
    this->TileConvergence.GetSamples() >= settings.ConvergedWeight)
  {
    // No pixel needs the filter.
    return this->Bilateral.Copy(
      this->Window, this->Image, this->History.GetTexture(), this->Estimates, this->InnerRegion);
  }
  if (this->SamplesSinceReset > settings.ConvergedWeight)
  {
    return this->Bilateral.ApplySinglePass(this->Window, this->Image, this->Depth.GetView(),
      this->Depth.GetCurrent(), this->History.GetTexture(), this->Estimates, settings,
      this->InnerRegion);
  }
  return this->Bilateral.Apply(this->Window, this->Image, this->Depth.GetView(),
    this->Depth.GetCurrent(), this->History.GetTexture(), this->History.GetScratchTexture(),
    this->Estimates, settings, this->InnerRegion);
}

void OcclusionViewState::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Image.ReleaseGraphicsResources(window);
  this->Depth.ReleaseGraphicsResources(window);
  this->Motion.ReleaseGraphicsResources(window);
  this->History.ReleaseGraphicsResources(window);
  this->Bilateral.ReleaseGraphicsResources(window);
  this->Compositor.ReleaseGraphicsResources(window);
  this->StoredFrame.ReleaseGraphicsResources(window);
  this->Counter.ReleaseGraphicsResources(window);
  Release(window, this->Estimates);
  this->Converged = false;
  this->TileConvergence.Restart();
}

}
