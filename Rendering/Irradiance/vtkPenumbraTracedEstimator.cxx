// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraTracedEstimator.h"

#include "Frame/DelegateImage.h"
#include "Frame/EyeDepth.h"
#include "Frame/RendererMap.h"
#include "Import/SceneModificationTime.h"
#include "Scene.h"
#include "Traced/JoinedOcclusion.h"
#include "Traced/OccluderGeometry.h"
#include "Traced/TracedOcclusion.h"

#include "vtkObjectFactory.h"
#include "vtkPixelBufferObject.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <map>

vtkStandardNewMacro(vtkPenumbraTracedEstimator);

namespace
{

std::vector<float> ReadTexture(vtkTextureObject* texture)
{
  unsigned int size[2] = { texture->GetWidth(), texture->GetHeight() };
  std::vector<float> values(static_cast<std::size_t>(size[0]) * size[1]);
  vtkIdType increments[2] = { 0, 0 };
  auto buffer = vtkSmartPointer<vtkPixelBufferObject>::Take(texture->Download());
  buffer->Download2D(VTK_FLOAT, values.data(), size, 1, increments);
  return values;
}

/// Expands the means of the traced pixels to a whole image. Pixels that were not traced get -1 - m,
/// where m is the mean of the traced pixel of their block: a negative value marks a neighbor's mean.
std::vector<float> ExpandToImage(const std::vector<float>& means,
  const penumbra::InterleavedPixels& lattice, int width, int height)
{
  const int columns = lattice.CountIn(width, lattice.Column);
  const int rows = lattice.CountIn(height, lattice.Row);
  std::vector<float> image(static_cast<std::size_t>(width) * height);
  for (int j = 0; j < height; ++j)
  {
    const float* row = means.data() + std::min(j / lattice.Step, rows - 1) * columns;
    float* target = image.data() + static_cast<std::size_t>(j) * width;
    for (int i = 0; i < width; ++i)
    {
      target[i] = -1.f - row[std::min(i / lattice.Step, columns - 1)];
    }
    if (j % lattice.Step == lattice.Row)
    {
      for (int i = lattice.Column; i < width; i += lattice.Step)
      {
        target[i] = row[i / lattice.Step];
      }
    }
  }
  return image;
}

/// Converts rectangles of image pixels to rectangles of lattice points.
std::vector<penumbra::Rectangle> ConvertToLattice(
  std::vector<penumbra::Rectangle> parts, const penumbra::InterleavedPixels& lattice)
{
  for (penumbra::Rectangle& part : parts)
  {
    const int right = part.X + part.Width;
    const int top = part.Y + part.Height;
    part.X /= lattice.Step;
    part.Y /= lattice.Step;
    part.Width = (right + lattice.Step - 1) / lattice.Step - part.X;
    part.Height = (top + lattice.Step - 1) / lattice.Step - part.Y;
  }
  return parts;
}

/// Number of independent rays per pixel whose standard error is `error` if half of them are blocked.
int ComputeEquivalentRays(double error)
{
  constexpr int Maximum = 1 << 20;
  return static_cast<int>(std::clamp(.25 / (error * error), 1.0, static_cast<double>(Maximum)));
}

/// Side of the blocks of pixels of which one is traced per frame while the view moves. The phases
/// go around the block diagonally first.
constexpr int InterleaveStep = 2;
constexpr int NumberOfPhases = InterleaveStep * InterleaveStep;
constexpr int PhaseColumn[NumberOfPhases] = { 0, 1, 1, 0 };
constexpr int PhaseRow[NumberOfPhases] = { 0, 1, 0, 1 };

/// Index of the first sample of frames in motion, beyond the indices that a static view normally
/// reaches.
constexpr int MotionSequenceStart = 1 << 18;

penumbra::InterleavedPixels PhaseLattice(int phase)
{
  return { InterleaveStep, PhaseColumn[phase], PhaseRow[phase] };
}

/// Largest number of rays per pixel of a frame in motion, a power of two.
constexpr int MaximumRaysInMotion = 32;

/// Weight of the last frame in the average number of rays per second.
constexpr double SpeedUpdate = 0.25;

/// Surface points of a view, and its occlusion while it is refined.
struct ViewState
{
  long long Version = 0;               ///< of the depths
  int FramePhase = 0;                  ///< phase of the next frame in motion
  penumbra::InterleavedPixels Lattice; ///< lattice of Points
  std::vector<penumbra::SurfacePoint> Points;

  std::unique_ptr<penumbra::JoinedOcclusion> Joined;
  double Radius = 0.0;      ///< of the request for Joined
  double Tolerance = 0.0;   ///< of the request for Joined
  bool HasNewImage = false; ///< Joined has an image that was not returned

  void UpdatePoints(const vtkPenumbraOcclusionEstimator::Request& request,
    const penumbra::RayScene& rays, const penumbra::InterleavedPixels& lattice)
  {
    if (this->Version != request.Depth->GetVersion() || !(this->Lattice == lattice))
    {
      this->Joined.reset();
      this->Points = penumbra::ReconstructSurface(ReadTexture(request.Depth->GetCurrent()),
        request.Image->GetSamples() == 1, request.Depth->GetView(), rays, lattice);
      this->Lattice = lattice;
      this->Version = request.Depth->GetVersion();
    }
  }

  void UpdateJoined(
    const vtkPenumbraOcclusionEstimator::Request& request, const penumbra::RayScene& rays)
  {
    if (!this->Joined || this->Radius != request.Radius || this->Tolerance != request.Tolerance)
    {
      this->Radius = request.Radius;
      this->Tolerance = request.Tolerance;
      this->Joined =
        std::make_unique<penumbra::JoinedOcclusion>(this->Points, request.Depth->GetView().Width,
          rays, static_cast<float>(request.Radius * rays.GetScene().Scale), request.Tolerance);
      this->HasNewImage = this->Joined->IsComplete();
    }
  }

  /// Continues the occlusion until there is an image that was not returned. Returns the number of rays.
  long long Refine(double seconds)
  {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    penumbra::WorkLimit limit([&](double) {
      return std::chrono::duration<double>(Clock::now() - start).count() >= seconds;
    });
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
  double RaysPerSecond = 0.0; ///< average of frames in motion; 0: unknown
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
  std::vector<float> Means;
  std::string Warned; ///< last reported prop that rays do not hit
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
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const int affordable =
    state.CountAffordableRays(request.Seconds, static_cast<std::size_t>(view.Width) * view.Height);
  const bool sparse = request.Moving && this->SparseInMotion && affordable == 0 &&
    view.Width >= InterleaveStep && view.Height >= InterleaveStep;
  const penumbra::InterleavedPixels lattice =
    sparse ? PhaseLattice(viewState.FramePhase) : penumbra::InterleavedPixels();
  viewState.FramePhase = sparse ? (viewState.FramePhase + 1) % NumberOfPhases : 0;
  viewState.UpdatePoints(request, state.Geometry.GetRays(), lattice);
  std::vector<float>& means = this->Implementation->Means;
  means.assign(viewState.Points.size(), 0.f);
  penumbra::TracedSamples samples;
  samples.First =
    sparse ? MotionSequenceStart + request.FirstSample / NumberOfPhases : request.FirstSample;
  samples.Count = std::max({ request.Samples / this->SamplesPerRay, affordable, 1 });
  samples.Radius = static_cast<float>(request.Radius * state.Geometry.GetScene().Scale);
  samples.Lattice = lattice;
  const std::vector<penumbra::Rectangle> wholeImage = { { 0, 0, view.Width, view.Height } };
  const long long rays = penumbra::TraceOcclusion(viewState.Points,
    lattice.CountIn(view.Width, lattice.Column), state.Geometry.GetRays(), samples,
    ConvertToLattice(request.Parts ? *request.Parts : wholeImage, lattice), means);
  this->NumberOfRays += rays;
  state.AddTime(rays, std::chrono::duration<double>(Clock::now() - start).count());
  if (sparse)
  {
    means = ExpandToImage(means, lattice, view.Width, view.Height);
  }
  const bool uploaded =
    target->Create2DFromRaw(view.Width, view.Height, 1, VTK_FLOAT, means.data());
  return uploaded ? samples.Count : 0;
}
catch (const std::exception& error)
{
  vtkErrorMacro("Ambient occlusion cannot be ray traced: " << error.what());
  return 0;
}

vtkPenumbraOcclusionEstimator::Refinement vtkPenumbraTracedEstimator::Refine(
  const Request& request, vtkTextureObject* target)
try
{
  RendererState& state = this->UpdateRenderer(request);
  ViewState& viewState = state.Views[request.Depth];
  viewState.UpdatePoints(request, state.Geometry.GetRays(), {});
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
