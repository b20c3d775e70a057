// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraTracedEstimator.h"

#include "Frame/DelegateImage.h"
#include "Frame/EyeDepth.h"
#include "Import/SceneModificationTime.h"
#include "Scene.h"
#include "Traced/InterpolatedOcclusion.h"
#include "Traced/OccluderGeometry.h"
#include "Traced/TracedOcclusion.h"

#include "vtkObjectFactory.h"
#include "vtkPixelBufferObject.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h"

#include <algorithm>
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

/// Number of independent rays per pixel whose standard error is `tolerance` if half of them are
/// blocked.
int ComputeEquivalentRays(double tolerance)
{
  return std::max(static_cast<int>(.25 / (tolerance * tolerance)), 1);
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

/// Cached geometry and surface points of one renderer.
struct RendererState
{
  penumbra::OccluderGeometry Geometry;
  long long Version = 0;
  int FramePhase = 0;                  ///< phase of the next frame in motion
  penumbra::InterleavedPixels Lattice; ///< lattice of Points
  std::vector<penumbra::SurfacePoint> Points;
};

}

struct vtkPenumbraTracedEstimator::Internals
{
  std::map<vtkRenderer*, RendererState> Renderers;
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
  RendererState& state = this->Implementation->Renderers[request.Renderer];
  const bool rebuilt = state.Geometry.Update(request.Renderer, request.Radius);
  this->NumberOfTrees += rebuilt;
  const std::string& missing = state.Geometry.GetMissing();
  if (!missing.empty() && missing != this->Implementation->Warned)
  {
    this->Implementation->Warned = missing;
    vtkWarningMacro("Rays do not hit "
      << missing << ". It casts no ambient occlusion; use a kernel that reads the depth buffer.");
  }
  const penumbra::ScreenTransform& view = request.Depth->GetView();
  const bool sparse = request.Moving && this->SparseInMotion && view.Width >= InterleaveStep &&
    view.Height >= InterleaveStep;
  const penumbra::InterleavedPixels lattice =
    sparse ? PhaseLattice(state.FramePhase) : penumbra::InterleavedPixels();
  state.FramePhase = sparse ? (state.FramePhase + 1) % NumberOfPhases : 0;
  if (rebuilt || state.Version != request.Depth->GetVersion() || !(state.Lattice == lattice))
  {
    state.Points = penumbra::ReconstructSurface(ReadTexture(request.Depth->GetCurrent()),
      request.Image->GetSamples() == 1, view, state.Geometry.GetRays(), lattice);
    state.Lattice = lattice;
    state.Version = request.Depth->GetVersion();
  }
  std::vector<float>& means = this->Implementation->Means;
  means.assign(state.Points.size(), 0.f);
  this->Final = request.Tolerance > 0.0;
  if (this->Final)
  {
    state.Geometry.SetCamera(penumbra::CameraFromView(view, state.Geometry.GetScene()));
    this->NumberOfRays += penumbra::InterpolateOcclusion(
      state.Points, state.Geometry.GetRays(), request.Radius, request.Tolerance, means);
    const bool uploaded =
      target->Create2DFromRaw(view.Width, view.Height, 1, VTK_FLOAT, means.data());
    return uploaded ? ComputeEquivalentRays(request.Tolerance) : 0;
  }
  penumbra::TracedSamples samples;
  samples.First =
    sparse ? MotionSequenceStart + request.FirstSample / NumberOfPhases : request.FirstSample;
  samples.Count = std::max(request.Samples / this->SamplesPerRay, 1);
  samples.Radius = static_cast<float>(request.Radius * state.Geometry.GetScene().Scale);
  samples.Lattice = lattice;
  const std::vector<penumbra::Rectangle> wholeImage = { { 0, 0, view.Width, view.Height } };
  this->NumberOfRays += penumbra::TraceOcclusion(state.Points,
    lattice.CountIn(view.Width, lattice.Column), state.Geometry.GetRays(), samples,
    ConvertToLattice(request.Parts ? *request.Parts : wholeImage, lattice), means);
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

bool vtkPenumbraTracedEstimator::CanEstimate(vtkRenderer* renderer)
try
{
  penumbra::OccluderGeometry& geometry = this->Implementation->Renderers[renderer].Geometry;
  this->NumberOfTrees += geometry.Update(renderer, VTK_DOUBLE_MAX);
  return geometry.HasAllOccluders();
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
  this->Implementation->Renderers.clear();
}

void vtkPenumbraTracedEstimator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SamplesPerRay: " << this->SamplesPerRay << "\n";
  os << indent << "SparseInMotion: " << this->SparseInMotion << "\n";
  os << indent << "NumberOfRays: " << this->NumberOfRays << "\n";
  os << indent << "NumberOfTrees: " << this->NumberOfTrees << "\n";
}
