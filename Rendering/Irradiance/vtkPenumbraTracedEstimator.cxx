// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraTracedEstimator.h"

#include "DelegateImage.h"
#include "EyeDepth.h"
#include "InterpolatedOcclusion.h"
#include "SceneExtractionTime.h"
#include "TracedGeometry.h"
#include "TracedOcclusion.h"

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

std::vector<float> Read(vtkTextureObject* texture)
{
  unsigned int size[2] = { texture->GetWidth(), texture->GetHeight() };
  std::vector<float> values(static_cast<std::size_t>(size[0]) * size[1]);
  vtkIdType increments[2] = { 0, 0 };
  auto buffer = vtkSmartPointer<vtkPixelBufferObject>::Take(texture->Download());
  buffer->Download2D(VTK_FLOAT, values.data(), size, 1, increments);
  return values;
}

/// So many rays of a pixel have this error where half of them are blocked.
int EquivalentRays(double tolerance)
{
  return std::max(static_cast<int>(.25 / (tolerance * tolerance)), 1);
}

/// What is known of one renderer.
struct Traced
{
  penumbra::TracedGeometry Geometry;
  long long Version = 0;
  std::vector<penumbra::SurfacePoint> Points;
};

}

struct vtkPenumbraTracedEstimator::Internals
{
  std::map<vtkRenderer*, Traced> Renderers;
  std::vector<float> Means;
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
  Traced& state = this->Implementation->Renderers[request.Renderer];
  const bool rebuilt = state.Geometry.Update(request.Renderer, request.Radius);
  this->NumberOfTrees += rebuilt;
  const penumbra::ScreenView& view = request.Depth->GetView();
  if (rebuilt || state.Version != request.Depth->GetVersion())
  {
    state.Points = penumbra::FindSurface(Read(request.Depth->GetCurrent()),
      request.Image->GetSamples() == 1, view, state.Geometry.GetRays());
    state.Version = request.Depth->GetVersion();
  }
  std::vector<float>& means = this->Implementation->Means;
  means.assign(state.Points.size(), 0.f);
  this->Final = request.Tolerance > 0.0;
  if (this->Final)
  {
    state.Geometry.SetEye(penumbra::EyeOf(view, state.Geometry.GetScene()));
    this->NumberOfRays += penumbra::InterpolateOcclusion(
      state.Points, state.Geometry.GetRays(), request.Radius, request.Tolerance, means);
    const bool done = target->Create2DFromRaw(view.Width, view.Height, 1, VTK_FLOAT, means.data());
    return done ? EquivalentRays(request.Tolerance) : 0;
  }
  penumbra::TracedSamples samples;
  samples.First = request.FirstSample;
  samples.Count = std::max(request.Samples / this->SamplesPerRay, 1);
  samples.Reach = static_cast<float>(request.Radius * state.Geometry.GetScene().Scale);
  const std::vector<penumbra::Rectangle> whole = { { 0, 0, view.Width, view.Height } };
  this->NumberOfRays += penumbra::TraceOcclusion(state.Points, view.Width, state.Geometry.GetRays(),
    samples, request.Parts ? *request.Parts : whole, means);
  const bool done = target->Create2DFromRaw(view.Width, view.Height, 1, VTK_FLOAT, means.data());
  return done ? samples.Count : 0;
}
catch (const std::exception& error)
{
  vtkErrorMacro("The scene cannot be traced: " << error.what());
  return 0;
}

bool vtkPenumbraTracedEstimator::CanEstimate(vtkRenderer* renderer)
try
{
  penumbra::TracedGeometry& geometry = this->Implementation->Renderers[renderer].Geometry;
  this->NumberOfTrees += geometry.Update(renderer, VTK_DOUBLE_MAX);
  return geometry.IsWhole();
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
  os << indent << "NumberOfRays: " << this->NumberOfRays << "\n";
  os << indent << "NumberOfTrees: " << this->NumberOfTrees << "\n";
}
