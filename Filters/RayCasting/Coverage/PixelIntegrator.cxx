// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PixelIntegrator.h"

#include "PixelMethod.h"
#include "Pixels/CoverageConstants.h"
#include "Pixels/PixelErrors.h"
#include "Samples/TexelIntegral.h"
#include "Samples/UniformSampling.h"

namespace penumbra
{

PixelIntegrator::PixelIntegrator(const CameraRayTracer& tracer, const CornerGrid& corners,
  const TileGeometry& tile, const IntegrationSettings& settings)
  : Tile(tile),
    Pixel(tracer, corners, settings),
    Edges(Pixel, tile),
    Exact(Pixel, Edges, tile),
    Subdivided(Pixel, Edges),
    Sampler(Pixel, Edges, tile)
{
}

void PixelIntegrator::SearchAllPixelsForIntersections()
{
  this->Edges.SearchAllPixels();
  this->Sampler.GetPixels().clear();
  this->Pixel.Pixels = PixelCounts();
}

PixelResult PixelIntegrator::Integrate(glm::ivec2 position)
{
  if (this->Pixel.Settings.Method == CoverageMethods::Uniform)
  {
    this->Pixel.MoveTo(position);
  }
  else
  {
    this->Pixel.Load(position);
  }
  this->Edges.Begin();
  std::optional<PixelMethod> gaveUp;
  for (;;)
  {
    const PixelMethod method = ChooseMethod(this->Pixel, this->Edges, this->Tile, gaveUp);
    if (const std::optional<PixelResult> result = this->Apply(method))
    {
      return *result;
    }
    gaveUp = method;
  }
}

std::optional<PixelResult> PixelIntegrator::Apply(PixelMethod method)
{
  switch (method)
  {
    case PixelMethod::Uniform:
      ++this->Pixel.Pixels.Uniform;
      return SampleUniformly(this->Pixel);
    case PixelMethod::Subdivision:
      if (this->Pixel.Settings.FindSmallObjects)
      {
        this->Edges.Load(true);
      }
      return this->Subdivided.Integrate(true);
    case PixelMethod::Corners:
      return this->IntegrateCorners();
    case PixelMethod::Exact:
    case PixelMethod::ExactOnce:
      return this->Exact.Integrate(method == PixelMethod::ExactOnce);
    case PixelMethod::Refinement:
      return this->Subdivided.Integrate(false);
    case PixelMethod::Texels:
      return IntegrateTexels(this->Pixel, *this->Tile.Rasterizer);
    case PixelMethod::Faces:
      return this->Sampler.SampleFaces(false);
    case PixelMethod::SampledFaces:
      return this->Sampler.SampleFaces(true);
    case PixelMethod::Rays:
      return this->Sampler.Sample(SampleSource::Rays);
    case PixelMethod::LitRays:
      return this->Sampler.Sample(SampleSource::LitRays);
    case PixelMethod::Triangles:
      return this->Sampler.Sample(SampleSource::Triangles);
    case PixelMethod::Layers:
      return this->Sampler.Sample(SampleSource::Layers);
  }
  return std::nullopt;
}

// Gives up if the corners or their neighbors show that they are not sufficient.
std::optional<PixelResult> PixelIntegrator::IntegrateCorners()
{
  this->Pixel.RetraceCornersOnEdges();
  const bool agree = this->Pixel.CornersAgree() || this->Pixel.RetraceIsolatedMiss();
  const bool hasHiddenShapes = this->Edges.HasPrimitives();
  if (hasHiddenShapes)
  {
    this->Edges.FindNearbyIntersections();
  }
  PixelResult result;
  if (agree &&
    (!hasHiddenShapes || (this->Edges.Segments.empty() && !this->Edges.IsTubeIntersected)))
  {
    const float error = this->Pixel.EstimateCurvatureError();
    const bool empty = !this->Pixel.Corners[0].FirstHit.IsHit() && !this->Pixel.Tracer.HasShafts();
    if (empty ||
      (error <= 0.25f * this->Pixel.Settings.Tolerance && !this->Pixel.IsNearShadowBoundary() &&
        !this->Pixel.IsIsolated()))
    {
      ++(empty ? this->Pixel.Pixels.Empty : this->Pixel.Pixels.Interior);
      result.Color = empty && this->Pixel.Tracer.HasBackgroundImage()
        ? this->Pixel.Tracer.GetBackground(this->Pixel.GetOrigin() + 0.5)
        : ComputeMean(this->Pixel.Corners);
      if (empty)
      {
        result.Error = EmptyErrorFloor;
      }
      else
      {
        this->Pixel.SetErrors(CurvatureSafetyFactor * error, ErrorFloor, result);
      }
      return result;
    }
  }
  if (!hasHiddenShapes)
  {
    this->Edges.FindNearbyIntersections();
  }
  this->Edges.ForgetEdges();
  return std::nullopt;
}

}
