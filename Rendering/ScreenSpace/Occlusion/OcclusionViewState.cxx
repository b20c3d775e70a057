// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionViewState.h"

#include "vtkPenumbraOcclusionEstimator.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPointData.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <limits>

namespace penumbra
{

namespace
{

/// A still view gives up on the tolerance when it has been looked at after so many times MaximumWeight.
constexpr double StillSampleLimit = 8.0;

/// Of one step: graphics cards give up on a picture that takes them seconds.
constexpr int MostSamples = 128;

/// The sequence starts again here, long before its index loses precision.
constexpr int SequenceLength = 1 << 20;

/// Eye depths beyond this are empty pixels: vtkPenumbraViewLib.glsl.
constexpr float FarAway = 1e17f;

vtkFloatArray* AddArray(vtkImageData* image, const char* name)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  image->GetPointData()->AddArray(array);
  return array;
}

}

bool OcclusionViewState::MeetsTolerance() const
{
  return this->TileConvergence.IsDone() ||
    this->TileConvergence.GetSamplesAtReading() >= StillSampleLimit * this->Settings.MaximumWeight;
}

bool OcclusionViewState::Render(const vtkRenderState* state, vtkRenderPass* delegate,
  vtkPenumbraOcclusionEstimator* estimator, const OcclusionSettings& settings)
{
  this->Renderer = state->GetRenderer();
  this->Window = static_cast<vtkOpenGLRenderWindow*>(this->Renderer->GetRenderWindow());
  this->Estimator = estimator;
  const OcclusionSettings last = this->Settings;
  this->Settings = settings;
  this->Compare(last);
  this->NewSamples = 0;
  this->HasActorMotion = false;
  if (!this->Image.SetUpView(state, settings.Margin, settings.Bounds))
  {
    return false;
  }
  ScreenTransform view = this->Image.GetView();
  view.Unit = settings.Radius;
  // What is drawn already can be multiplied by a number, not by one of its own brightness.
  const bool straight = !settings.DelegateOnce && settings.Darkness.LightAwareness == 0.0;
  if (straight && this->CanReuseConvergedFrame(view) &&
    this->Picture.Draw(
      state, delegate, this->Image, this->GetDarkness(), settings.DelegateDrawsBackground))
  {
    this->Props = this->Picture.GetNumberOfRenderedProps();
    this->LookForMotion();
    return true;
  }
  this->Picture.Forget();
  this->Props = this->Image.Draw(state, delegate, settings.Margin, false, settings.Bounds);
  if (this->Props < 0)
  {
    return false;
  }
  this->LookForMotion();
  const int* at = this->Image.GetViewport();
  this->InnerRegion = { { settings.Margin[0], settings.Margin[1], at[2], at[3] } };
  Allocate(this->Estimates, this->Window, view.Width, view.Height, 1);
  if (this->Settings.Restart)
  {
    this->Depth.Invalidate();
  }
  EyeDepth::Change change =
    this->Depth.Update(this->Window, this->Image, view, settings.HiddenChanged);
  if (change == EyeDepth::Change::Failed)
  {
    return false;
  }
  if (change != EyeDepth::Change::None)
  {
    // What is to converge at once takes nothing over: a mean with old samples is late to be right.
    change = settings.InOneRender ? EyeDepth::Change::Reset : change;
    this->Converged = false;
    this->TileConvergence.Restart(
      change == EyeDepth::Change::Reset ? 0.0 : settings.InvalidationWeight);
  }
  if (change == EyeDepth::Change::Reset)
  {
    this->SamplesSinceReset = 0;
    this->TotalSamples = 0; // The same picture, whatever was drawn before.
  }
  if (change == EyeDepth::Change::Moved && this->Settings.PropsChanged)
  {
    // Many pixels have lost their history: the next frames take FirstSamples.
    this->SamplesSinceReset = 0;
  }
  this->HasActorMotion = change == EyeDepth::Change::Moved &&
    this->Motion.Draw(this->Renderer, this->Image, this->Depth);
  const bool done = this->Converged ? this->Filtered || this->Filter() : this->Converge(change);
  if (!done)
  {
    return false;
  }
  // From now on pictures are drawn straight into their target, this one already, so that all are alike.
  if (straight && this->Converged &&
    this->Picture.Draw(
      state, delegate, this->Image, this->GetDarkness(), settings.DelegateDrawsBackground))
  {
    return true;
  }
  return this->Darken.Draw(this->Window, this->Image, this->Depth, this->Image.GetColor(),
    this->Estimates, settings.Darkness, settings.DelegateDrawsBackground);
}

void OcclusionViewState::LookForMotion()
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

void OcclusionViewState::Compare(const OcclusionSettings& last)
{
  OcclusionSettings& now = this->Settings;
  // As many samples as there can be: validation by neighbors is off.
  now.PropsChanged = now.PropsChanged && now.InvalidationWeight < now.MaximumWeight;
  // An image that converges in one Render() does not depend on earlier ones.
  now.Restart =
    now.Restart || (now.InOneRender && (!last.InOneRender || now.Tolerance != last.Tolerance));
  if (!now.Restart && now.Tolerance < last.Tolerance)
  {
    this->Converged = false;
    this->TileConvergence.Reopen();
  }
  const bool sameFilter = now.Filter == last.Filter &&
    now.SpatialConvergence == last.SpatialConvergence && now.MaximumWeight == last.MaximumWeight;
  this->Filtered = sameFilter;
  this->Darkened = sameFilter && now.Darkness.Strength == last.Darkness.Strength &&
    now.Darkness.LightAwareness == last.Darkness.LightAwareness;
}

bool OcclusionViewState::CanReuseConvergedFrame(const ScreenTransform& view) const
{
  return this->Converged && this->Picture.IsKnown() && !this->Settings.Restart && this->Darkened &&
    !this->Settings.HiddenChanged && this->Depth.GetView().HasSameView(view);
}

ConvergedFrame::CompositeInputs OcclusionViewState::GetDarkness() const
{
  return { this->Estimates, this->Settings.Darkness.Strength, this->History.GetScratchTexture() };
}

bool OcclusionViewState::Converge(EyeDepth::Change change)
{
  bool done = this->Estimate(change);
  while (done && this->Settings.InOneRender && !this->MeetsTolerance())
  {
    done = this->Estimate(EyeDepth::Change::None);
  }
  this->Converged = done && this->MeetsTolerance();
  return done && this->Filter();
}

bool OcclusionViewState::Estimate(EyeDepth::Change change)
{
  const OcclusionSettings& settings = this->Settings;
  const bool refine = change == EyeDepth::Change::None && this->TileConvergence.GetSamples() > 0;
  if (change == EyeDepth::Change::None && !refine)
  {
    // The eye has just stopped: JoinHistory() leaves little of what came along.
    this->SamplesSinceReset =
      std::min(this->SamplesSinceReset, static_cast<int>(settings.InvalidationWeight));
  }
  const double convergence = this->SamplesSinceReset / settings.MaximumWeight;
  vtkPenumbraOcclusionEstimator::Request request;
  request.Window = this->Window;
  request.Renderer = this->Renderer;
  request.Image = &this->Image;
  request.Depth = &this->Depth;
  request.Radius = settings.Radius;
  request.FirstSample = this->TotalSamples;
  const bool many = convergence < settings.AdaptiveConvergence || settings.InOneRender;
  // Nobody looks at the picture before that many: few steps instead of many small ones.
  const int unseen = settings.InOneRender ? this->TileConvergence.GetSamplesUntilCheck() : 0;
  request.Samples =
    std::max(many ? settings.FirstSamples : settings.Samples, std::min(unseen, MostSamples));
  request.Tolerance = settings.InOneRender && settings.Interpolate ? settings.Tolerance : 0.0;
  request.Parts = refine && this->TileConvergence.IsKnown()
    ? &this->TileConvergence.GetActiveTiles()
    : &this->InnerRegion;
  request.Moving = change == EyeDepth::Change::Moved && this->TotalSamples > 0;
  // In motion there are always pixels that have just come into sight.
  request.RotatePerPixel = request.Moving || convergence < settings.RotationConvergence;
  const int samples = this->AccumulateSamples(request, change, refine);
  if (samples < 1)
  {
    return false;
  }
  this->TotalSamples = (this->TotalSamples + samples) % SequenceLength;
  this->SamplesSinceReset += samples;
  this->NewSamples += samples;
  if (this->Estimator->IsFinal())
  {
    this->TileConvergence.MarkConverged(samples, settings.Tolerance);
  }
  else if (change != EyeDepth::Change::Moved)
  {
    this->TileConvergence.Add(samples, this->Image.GetView().Width, settings.Tolerance,
      [this]() { return this->ReadMeans(); });
  }
  return true;
}

int OcclusionViewState::AccumulateSamples(
  const vtkPenumbraOcclusionEstimator::Request& request, EyeDepth::Change change, bool refine)
{
  TemporalSettings temporal;
  temporal.MaximumWeight = this->Settings.MaximumWeight;
  temporal.DepthTolerance = this->Settings.DepthTolerance;
  temporal.NeighbourValidation = this->Settings.SceneChanged;
  temporal.InvalidationWeight = this->Settings.InvalidationWeight;
  temporal.PropsChanged = this->Settings.PropsChanged;
  temporal.Motion = this->HasActorMotion ? &this->Motion : nullptr;
  if (change == EyeDepth::Change::Moved && !this->Estimator->GetShader().empty())
  {
    return this->History.ReprojectAndEstimate(request, this->Estimator, temporal);
  }
  const int samples = this->Estimator->Estimate(request, this->Estimates);
  if (samples < 1)
  {
    return 0;
  }
  if (change == EyeDepth::Change::None)
  {
    // What came along from frames in motion is a little blurred: it shall not weigh for long.
    temporal.WeightCap = this->Settings.InvalidationWeight;
  }
  const bool added = refine
    ? this->History.Accumulate(this->Window, this->Image, this->Estimates, samples, *request.Parts)
    : this->History.Add(this->Window, this->Image, this->Depth, change, this->Estimates, samples,
        temporal, this->InnerRegion);
  return added ? samples : 0;
}

bool OcclusionViewState::Filter()
{
  BilateralSettings settings;
  settings.ConvergedWeight = this->Settings.SpatialConvergence * this->Settings.MaximumWeight;
  if (!this->Settings.Filter || this->Estimator->IsFinal() ||
    this->TileConvergence.GetSamples() >= settings.ConvergedWeight)
  {
    // No pixel needs the filter.
    return this->Smoother.Copy(
      this->Window, this->Image, this->History.GetTexture(), this->Estimates, this->InnerRegion);
  }
  if (this->SamplesSinceReset > settings.ConvergedWeight)
  {
    return this->Smoother.ApplySinglePass(this->Window, this->Image, this->Depth.GetView(),
      this->Depth.GetCurrent(), this->History.GetTexture(), this->Estimates, settings,
      this->InnerRegion);
  }
  return this->Smoother.Apply(this->Window, this->Image, this->Depth.GetView(),
    this->Depth.GetCurrent(), this->History.GetTexture(), this->History.GetScratchTexture(),
    this->Estimates, settings, this->InnerRegion);
}

std::vector<float> OcclusionViewState::ReadMeans() const
{
  const std::vector<float> depths = ReadBack(this->Depth.GetCurrent());
  const std::vector<float> history = ReadBack(this->History.GetTexture());
  std::vector<float> values(depths.size(), -1.f);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    // Nothing has a weight outside of the picture proper.
    if (depths[i] < FarAway && history[2 * i + 1] > 0.f)
    {
      values[i] = history[2 * i] / history[2 * i + 1];
    }
  }
  return values;
}

OcclusionViewState::PixelCounts OcclusionViewState::CountPixels() const
{
  PixelCounts counts;
  if (!this->Estimates)
  {
    return counts;
  }
  const std::vector<float> depths = ReadBack(this->Depth.GetCurrent());
  const std::vector<float> history = ReadBack(this->History.GetTexture());
  const std::vector<unsigned char> actors = this->HasActorMotion
    ? this->Motion.ReadNumbers()
    : std::vector<unsigned char>(depths.size(), 0);
  const int width = this->Image.GetView().Width;
  const auto fresh = static_cast<float>(this->NewSamples);
  const auto pulled = static_cast<float>(this->Settings.InvalidationWeight) + fresh;
  const auto enough =
    static_cast<float>(this->Settings.SpatialConvergence * this->Settings.MaximumWeight);
  for (int j = 0; j < this->Image.GetViewport()[3]; ++j)
  {
    for (int i = 0; i < this->Image.GetViewport()[2]; ++i)
    {
      const std::size_t at = static_cast<std::size_t>(j + this->Image.GetMargin()[1]) * width + i +
        this->Image.GetMargin()[0];
      if (depths[at] >= FarAway)
      {
        continue;
      }
      const float weight = history[2 * at + 1];
      ++counts.Surface;
      counts.Disoccluded += fresh > 0.f && weight <= fresh;
      counts.Invalidated += fresh > 0.f && weight > fresh && weight <= pulled;
      counts.Kept += fresh == 0.f || weight > pulled;
      counts.Followed += actors[at] > 0 && weight > fresh;
      counts.Converged += this->Converged || weight >= enough;
    }
  }
  return counts;
}

void OcclusionViewState::CopyTo(vtkImageData* image) const
{
  const int* size = this->Image.GetViewport() + 2;
  image->SetDimensions(size[0], size[1], 1);
  vtkFloatArray* occlusions = AddArray(image, "AmbientOcclusion");
  vtkFloatArray* depths = AddArray(image, "Depth");
  vtkFloatArray* convergences = AddArray(image, "Convergence");
  if (!this->Estimates)
  {
    return;
  }
  const std::vector<float> eyeDepths = ReadBack(this->Depth.GetCurrent());
  const std::vector<float> history = ReadBack(this->History.GetTexture());
  const std::vector<float> result = ReadBack(this->Estimates);
  const ScreenTransform& view = this->Depth.GetView();
  for (int j = 0; j < size[1]; ++j)
  {
    for (int i = 0; i < size[0]; ++i)
    {
      const std::size_t at = static_cast<std::size_t>(j + this->Image.GetMargin()[1]) * view.Width +
        i + this->Image.GetMargin()[0];
      const vtkIdType to = static_cast<vtkIdType>(j) * size[0] + i;
      const bool empty = eyeDepths[at] >= FarAway;
      const double depth = eyeDepths[at] * view.Unit;
      occlusions->SetValue(to, empty ? 0.f : result[at]);
      depths->SetValue(
        to, empty ? std::numeric_limits<float>::infinity() : static_cast<float>(depth));
      convergences->SetValue(to,
        empty
          ? 1.f
          : std::min(static_cast<float>(history[2 * at + 1] / this->Settings.MaximumWeight), 1.f));
    }
  }
}

void OcclusionViewState::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Image.ReleaseGraphicsResources(window);
  this->Depth.ReleaseGraphicsResources(window);
  this->Motion.ReleaseGraphicsResources(window);
  this->History.ReleaseGraphicsResources(window);
  this->Smoother.ReleaseGraphicsResources(window);
  this->Darken.ReleaseGraphicsResources(window);
  this->Picture.ReleaseGraphicsResources(window);
  if (this->Estimates)
  {
    this->Estimates->ReleaseGraphicsResources(window);
    this->Estimates = nullptr;
  }
  this->Converged = false;
  this->TileConvergence.Restart();
}

}
