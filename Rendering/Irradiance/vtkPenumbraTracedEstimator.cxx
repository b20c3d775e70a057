// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraTracedEstimator.h"

#include "Frame/DelegateImage.h"
#include "Frame/EyeDepth.h"
#include "Frame/RendererMap.h"
#include "Frame/Textures.h"
#include "Import/SceneModificationTime.h"
#include "SceneCoordinates.h"
#include "Traced/JoinedOcclusion.h"
#include "Traced/OccluderGeometry.h"
#include "Traced/RaysInMotion.h"
#include "Traced/TracedOcclusion.h"

#include "vtkObjectFactory.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <map>

vtkStandardNewMacro(vtkPenumbraTracedEstimator);

namespace
{

/// Number of independent rays per pixel whose standard error is `error` if half of them are blocked.
int ComputeEquivalentRays(double error)
{
  constexpr int Maximum = 1 << 20;
  return static_cast<int>(std::clamp(.25 / (error * error), 1.0, static_cast<double>(Maximum)));
}

/// Indices of the first samples of frames in motion, beyond the indices that a static view normally
/// reaches.
constexpr int SparseSequenceStart = 1 << 18;
constexpr int ShortHistorySequenceStart = 1 << 19;

/// Number of samples after which the sequence of pixels with a short history repeats.
constexpr int ShortHistorySequenceLength = 1 << 20;

/// Largest number of rays per pixel of a frame without history, a power of two.
constexpr int MaximumRaysInMotion = 32;

/// Weight of the last frame in the average number of rays per second.
constexpr double SpeedUpdate = 0.25;

class Stopwatch
{
public:
  double GetSeconds() const
  {
    return std::chrono::duration<double>(Clock::now() - this->Start).count();
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point Start = Clock::now();
};

std::vector<penumbra::Rectangle> WholeImage(int width, int height)
{
  return { { 0, 0, width, height } };
}

/// Surface points of a view, and its occlusion while it is refined.
struct ViewState
{
  long long Version = 0; ///< of the depths
  std::vector<penumbra::SurfacePoint> Points;
  int FramePhase = 0;         ///< phase of the next frame in motion
  int ShortHistorySample = 0; ///< index of the next sample of pixels with a short history

  std::unique_ptr<penumbra::JoinedOcclusion> Joined;
  double Radius = 0.0;      ///< of the request for Joined
  double Tolerance = 0.0;   ///< of the request for Joined
  bool HasNewImage = false; ///< Joined has an image that was not returned

  void UpdatePoints(
    const vtkPenumbraOcclusionEstimator::Request& request, const penumbra::RayScene& rays)
  {
    if (this->Version != request.Depth->GetVersion())
    {
      this->ReconstructPoints(request, rays, penumbra::ReadBack(request.Depth->GetCurrent()));
      this->Version = request.Depth->GetVersion();
    }
  }

  /// `needed`: flags of the pixels whose points are needed, or null for all.
  void ReconstructPoints(const vtkPenumbraOcclusionEstimator::Request& request,
    const penumbra::RayScene& rays, const std::vector<float>& depths,
    const std::vector<char>* needed = nullptr)
  {
    this->Joined.reset();
    this->Version = 0;
    penumbra::ReconstructSurface(depths, request.Image->GetSamples() == 1, request.Depth->GetView(),
      rays, needed, this->Points);
  }

  void UpdateJoined(
    const vtkPenumbraOcclusionEstimator::Request& request, const penumbra::RayScene& rays)
  {
    if (!this->Joined || this->Radius != request.Radius || this->Tolerance != request.Tolerance)
    {
      this->Radius = request.Radius;
      this->Tolerance = request.Tolerance;
      this->Joined = std::make_unique<penumbra::JoinedOcclusion>(this->Points,
        request.Depth->GetView().Width, rays,
        static_cast<float>(request.Radius * rays.GetCoordinates().Scale), request.Tolerance);
      this->HasNewImage = this->Joined->IsComplete();
    }
  }

  /// Adds the occlusion of new rays to the sums of the pixels. Returns the number of rays.
  long long Trace(const vtkPenumbraOcclusionEstimator::Request& request,
    const penumbra::RayScene& rays, int first, const penumbra::PixelRays& counts,
    std::vector<float>& sums, int stride = 1) const
  {
    penumbra::TracedSamples samples;
    samples.First = first;
    samples.Radius = static_cast<float>(request.Radius * rays.GetCoordinates().Scale);
    return penumbra::TraceOcclusion(
      this->Points, request.Depth->GetView().Width, rays, samples, counts, sums, stride);
  }

  /// Continues the occlusion until there is an image that was not returned. Returns the number of rays.
  long long Refine(double seconds)
  {
    const Stopwatch watch;
    penumbra::WorkLimit limit([&](double) { return watch.GetSeconds() >= seconds; });
    const long long before = this->Joined->GetNumberOfRays();
    this->HasNewImage = this->HasNewImage || this->Joined->Continue(&limit);
    return this->Joined->GetNumberOfRays() - before;
  }
};

}

/// Cached geometry and views of one renderer, several in stereo.
struct vtkPenumbraTracedEstimator::RendererState
{
  penumbra::OccluderGeometry Geometry;
  double RaysPerSecond = 0.0; ///< average of frames in motion, with their origins; 0: unknown
  std::map<const penumbra::EyeDepth*, ViewState> Views;

  /// Returns true if the BVH was rebuilt.
  bool UpdateGeometry(vtkRenderer* renderer, double radius)
  {
    const bool rebuilt = this->Geometry.Update(renderer, radius);
    for (auto& [depth, view] : this->Views)
    {
      if (rebuilt)
      {
        view.Joined.reset();
        view.Version = 0;
      }
    }
    return rebuilt;
  }

  /// Returns the number of rays per pixel that take about `seconds`: a power of two, or 0 if it is
  /// below 1.
  int CountAffordableRays(double seconds, std::size_t pixels) const
  {
    const double affordable =
      this->RaysPerSecond * seconds / static_cast<double>(std::max<std::size_t>(pixels, 1));
    int count = affordable >= 1.0 ? 1 : 0;
    while (count > 0 && count < MaximumRaysInMotion && 2 * count <= affordable)
    {
      count *= 2;
    }
    return count;
  }

  void AddTime(long long rays, double seconds)
  {
    const double speed = static_cast<double>(rays) / std::max(seconds, 1e-6);
    this->RaysPerSecond +=
      (this->RaysPerSecond > 0.0 ? SpeedUpdate : 1.0) * (speed - this->RaysPerSecond);
  }
};

struct vtkPenumbraTracedEstimator::Internals
{
  penumbra::RendererMap<RendererState> Renderers;
  std::vector<float> Means;    ///< of the pixels of a frame
  penumbra::RaysInMotion Rays; ///< of a frame
  std::string Warned;          ///< last reported prop that rays do not hit
};

vtkPenumbraTracedEstimator::vtkPenumbraTracedEstimator()
  : Implementation(std::make_unique<Internals>())
{
}

vtkPenumbraTracedEstimator::~vtkPenumbraTracedEstimator() = default;

void vtkPenumbraTracedEstimator::Register()
{
  vtkPenumbraOcclusionEstimator::Register(
    "traced", []() -> vtkPenumbraOcclusionEstimator* { return vtkPenumbraTracedEstimator::New(); });
}

int vtkPenumbraTracedEstimator::Estimate(const Request& request, vtkTextureObject* target)
try
{
  RendererState& state = this->UpdateRenderer(request);
  ViewState& viewState = state.Views[request.Depth];
  const penumbra::ScreenTransform& view = request.Depth->GetView();
  viewState.FramePhase = 0;
  viewState.UpdatePoints(request, state.Geometry.GetRays());
  const Stopwatch watch;
  const std::size_t pixels = viewState.Points.size();
  const int perPixel = std::max({ request.Samples / this->SamplesPerRay,
    state.CountAffordableRays(request.Seconds, pixels), 1 });
  penumbra::PixelRays counts(pixels, 0);
  for (const penumbra::Rectangle& part :
    request.Parts ? *request.Parts : WholeImage(view.Width, view.Height))
  {
    for (int y = part.Y; y < part.Y + part.Height; ++y)
    {
      std::fill_n(counts.begin() + static_cast<std::ptrdiff_t>(y) * view.Width + part.X, part.Width,
        static_cast<std::uint16_t>(perPixel));
    }
  }
  std::vector<float>& means = this->Implementation->Means;
  means.assign(pixels, 0.f);
  const long long rays =
    viewState.Trace(request, state.Geometry.GetRays(), request.FirstSample, counts, means);
  std::for_each(
    means.begin(), means.end(), [perPixel](float& mean) { mean /= static_cast<float>(perPixel); });
  this->NumberOfRays += rays;
  state.AddTime(rays, watch.GetSeconds());
  const bool uploaded =
    target->Create2DFromRaw(view.Width, view.Height, 1, VTK_FLOAT, means.data());
  return uploaded ? perPixel : 0;
}
catch (const std::exception& error)
{
  vtkErrorMacro("Ambient occlusion cannot be ray traced: " << error.what());
  return 0;
}

vtkPenumbraOcclusionEstimator::Addition vtkPenumbraTracedEstimator::AddToHistory(
  const Request& request, vtkTextureObject* history)
try
{
  RendererState& state = this->UpdateRenderer(request);
  ViewState& viewState = state.Views[request.Depth];
  const penumbra::ScreenTransform& view = request.Depth->GetView();
  const penumbra::RayScene& scene = state.Geometry.GetRays();
  const std::vector<float> depths = penumbra::ReadBack(request.Depth->GetCurrent());
  std::vector<float> values = penumbra::ReadBack(history);
  const Stopwatch watch;
  penumbra::MotionRayLimits limits;
  limits.Affordable = state.RaysPerSecond * request.Seconds;
  limits.PerPixel = request.Samples / this->SamplesPerRay;
  limits.Sparse = request.Moving && this->SparseInMotion;
  limits.Phase = viewState.FramePhase;
  viewState.FramePhase = (viewState.FramePhase + 1) % penumbra::MotionPhases;
  penumbra::RaysInMotion& counts = this->Implementation->Rays;
  penumbra::DistributeRays(depths, values, view.Width,
    request.Parts ? *request.Parts : WholeImage(view.Width, view.Height), limits, counts);
  viewState.ReconstructPoints(request, scene, depths, &counts.Traced);
  const int first = counts.IsSparse
    ? SparseSequenceStart + request.FirstSample / penumbra::MotionPhases
    : request.FirstSample;
  long long rays = viewState.Trace(request, scene, first, counts.LongHistory, values, 2);
  rays += viewState.Trace(request, scene, ShortHistorySequenceStart + viewState.ShortHistorySample,
    counts.ShortHistory, values, 2);
  viewState.ShortHistorySample =
    (viewState.ShortHistorySample + counts.WithoutHistory) % ShortHistorySequenceLength;
  this->NumberOfRays += rays;
  state.AddTime(rays, watch.GetSeconds());
  const bool uploaded =
    history->Create2DFromRaw(view.Width, view.Height, 2, VTK_FLOAT, values.data());
  return uploaded ? Addition{ counts.PerPixel, counts.WithoutHistory } : Addition();
}
catch (const std::exception& error)
{
  vtkErrorMacro("Ambient occlusion cannot be ray traced: " << error.what());
  return {};
}

vtkPenumbraOcclusionEstimator::Refinement vtkPenumbraTracedEstimator::Refine(
  const Request& request, vtkTextureObject* target)
try
{
  RendererState& state = this->UpdateRenderer(request);
  ViewState& viewState = state.Views[request.Depth];
  viewState.UpdatePoints(request, state.Geometry.GetRays());
  viewState.UpdateJoined(request, state.Geometry.GetRays());
  this->NumberOfRays += viewState.Refine(request.Seconds);
  Refinement result;
  if (viewState.HasNewImage)
  {
    penumbra::JoinedOcclusion& joined = *viewState.Joined;
    const penumbra::ScreenTransform& view = request.Depth->GetView();
    joined.CopyTo(this->Implementation->Means);
    result.HasFailed = !target->Create2DFromRaw(
      view.Width, view.Height, 1, VTK_FLOAT, this->Implementation->Means.data());
    result.Samples = ComputeEquivalentRays(joined.GetMeanError());
    result.Error = joined.GetLargestError();
    result.IsFinal = joined.IsComplete();
    viewState.HasNewImage = false;
  }
  if (result.IsFinal)
  {
    viewState.Joined.reset();
  }
  return result;
}
catch (const std::exception& error)
{
  vtkErrorMacro("Ambient occlusion cannot be ray traced: " << error.what());
  Refinement result;
  result.HasFailed = true;
  return result;
}

bool vtkPenumbraTracedEstimator::RefineBetweenFrames(vtkRenderer* renderer, double seconds)
{
  bool hasNewImage = false;
  std::vector<ViewState*> unfinished;
  for (auto& [depth, view] : this->Implementation->Renderers.Get(renderer).Views)
  {
    if (view.Joined)
    {
      unfinished.push_back(&view);
    }
  }
  for (ViewState* view : unfinished)
  {
    this->NumberOfRays += view->Refine(seconds / static_cast<double>(unfinished.size()));
    hasNewImage = hasNewImage || view->HasNewImage;
  }
  return hasNewImage || unfinished.empty();
}

vtkPenumbraTracedEstimator::RendererState& vtkPenumbraTracedEstimator::UpdateRenderer(
  const Request& request)
{
  RendererState& state = this->Implementation->Renderers.Get(request.Renderer);
  this->NumberOfTrees += state.UpdateGeometry(request.Renderer, request.Radius);
  const std::string& missing = state.Geometry.GetMissing();
  if (!missing.empty() && missing != this->Implementation->Warned)
  {
    this->Implementation->Warned = missing;
    vtkWarningMacro("Rays do not hit "
      << missing << ". It casts no ambient occlusion; use a kernel that reads the depth buffer.");
  }
  return state;
}

bool vtkPenumbraTracedEstimator::CanEstimate(vtkRenderer* renderer)
try
{
  RendererState& state = this->Implementation->Renderers.Get(renderer);
  this->NumberOfTrees += state.UpdateGeometry(renderer, VTK_DOUBLE_MAX);
  return state.Geometry.HasAllOccluders();
}
catch (const std::exception&)
{
  return false;
}

vtkMTimeType vtkPenumbraTracedEstimator::GetSceneMTime(vtkRenderer* renderer)
{
  return penumbra::GetGeometryMTime(renderer);
}

void vtkPenumbraTracedEstimator::ReleaseGraphicsResources(vtkWindow*)
{
  this->Implementation->Renderers.Clear();
}

void vtkPenumbraTracedEstimator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SamplesPerRay: " << this->SamplesPerRay << "\n";
  os << indent << "SparseInMotion: " << this->SparseInMotion << "\n";
  os << indent << "NumberOfRays: " << this->NumberOfRays << "\n";
  os << indent << "NumberOfTrees: " << this->NumberOfTrees << "\n";
}
