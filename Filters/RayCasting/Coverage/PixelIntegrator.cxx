// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PixelIntegrator.h"

#include "PixelErrors.h"
#include "Scene.h"
#include "Surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

PixelCounts& PixelCounts::operator+=(const PixelCounts& other)
{
  this->Empty += other.Empty;
  this->Interior += other.Interior;
  this->Edge += other.Edge;
  this->SmallObject += other.SmallObject;
  this->Refined += other.Refined;
  this->Uniform += other.Uniform;
  return *this;
}

PixelIntegrator::PixelIntegrator(const CameraRayTracer& tracer, const CornerGrid& corners,
  const std::vector<ProjectedEdge>& edges, const std::vector<char>& dense,
  const std::vector<char>& unsteady, const IntegrationSettings& settings)
  : Tracer(tracer),
    Grid(corners),
    Edges(edges),
    Dense(dense),
    Unsteady(unsteady),
    Settings(settings),
    Noise(settings.Noise)
{
}

// Traces a sample that represents the fraction `area` of the pixel.
Sample PixelIntegrator::Trace(glm::dvec2 local, double area)
{
  ++this->Rays.Refinement;
  const glm::dvec2 p = glm::dvec2(this->X, this->Y) + local;
  const std::uint32_t penumbrae = this->Grid.GetPenumbrae(p);
  return this->Tracer.TraceSample(
    p, this->Rays, ComputeToleranceScale(area), penumbrae, this->GetNeighbors(penumbrae));
}

std::vector<PenumbraNeighbors>* PixelIntegrator::GetNeighbors(std::uint32_t penumbrae)
{
  if (penumbrae == 0)
  {
    return nullptr;
  }
  this->Neighbors.resize(this->Tracer.GetScene().Lights.size());
  return &this->Neighbors;
}

void PixelIntegrator::LoadCorners(int x, int y)
{
  this->X = x;
  this->Y = y;
  this->MediumError = 0.f;
  this->Neighbors.clear();
  float penumbraNoise = 0.f;
  for (int i = 0; i < 4; ++i)
  {
    this->Corners[i] = this->Grid.At(x + (i & 1), y + (i >> 1));
    this->MediumError = std::max(this->MediumError, this->Corners[i].Error);
    penumbraNoise = std::max(penumbraNoise, this->Corners[i].Noise);
  }
  this->Noise = penumbraNoise > 0.f
    ? std::hypot(this->Settings.Noise, static_cast<double>(penumbraNoise))
    : this->Settings.Noise;
  this->TrustedCorners = 15u;
  this->Segments.clear();
  this->VisibleTriangles.clear();
  this->PairsTested = 0;
  this->HasIntersections = false;
  this->IsTubeIntersected = false;
  this->HitsUnsteadyTriangle = false;
}

bool PixelIntegrator::CornersAgree() const
{
  for (int i = 1; i < 4; ++i)
  {
    if (this->Corners[i].FirstHit.Surface != this->Corners[0].FirstHit.Surface)
    {
      return false;
    }
  }
  return true;
}

PixelResult PixelIntegrator::Integrate(
  int x, int y, const std::uint32_t* edgeIndices, std::size_t count, bool crowded)
{
  if (this->Settings.Method == IntegrationSettings::Methods::Uniform)
  {
    this->X = x;
    this->Y = y;
    ++this->Pixels.Uniform;
    return this->IntegrateUniform(this->Settings.UniformSamples);
  }
  this->LoadCorners(x, y);
  if (this->Settings.Method == IntegrationSettings::Methods::Subdivision)
  {
    if (this->Settings.FindSmallObjects)
    {
      this->LoadSegments(edgeIndices, count, true);
    }
    return this->IntegrateSubdivided(true);
  }
  this->ListedEdges = edgeIndices;
  this->NumberOfListedEdges = count;
  // The pole of a sphere or the center of a fan: too many edges to arrange.
  if (count > MaximumEdges || this->MayRasterize(count))
  {
    return this->IntegrateSampled();
  }
  if (std::any_of(this->Corners, this->Corners + 4,
        [this](const Sample& corner) { return this->IsUnsteady(corner); }))
  {
    return this->IntegrateUnsteady();
  }
  this->LoadSegments(edgeIndices, count, true);
  const bool isTextureDiscontinuous = this->IsTextureDiscontinuous();
  if (isTextureDiscontinuous && this->Rasterizer &&
    !this->Rasterizer->SelectPixel({ this->X, this->Y }) && this->SelectLayers())
  {
    PixelResult result;
    return this->IntegrateTexels(result) ? result : this->IntegrateSampled();
  }
  const bool unknown = (this->Settings.Shadows && !this->Segments.empty()) ||
    this->IsNearShadowBoundary() || isTextureDiscontinuous;
  if (unknown || this->HitsDenseSurface())
  {
    return this->IntegrateDense(unknown);
  }
  if (crowded && this->Segments.size() > MaximumEdgesInCrowdedTile)
  {
    return this->IntegrateSampled();
  }
  if (this->Segments.empty() || (!this->Settings.FindSmallObjects && this->CornersAgree()))
  {
    return this->IntegrateInterior();
  }
  return this->IntegrateExact(edgeIndices, count);
}

// The error of the mean of four corners is (f_xx + f_yy) / 12. Second differences with the
// neighboring corners approximate the derivatives. Discontinuities also cause second differences.
float PixelIntegrator::EstimateCurvatureError() const
{
  const float contrast = ComputeContrast(this->Corners);
  if (contrast == 0.f)
  {
    return 0.f;
  }
  const std::uint32_t surface = this->Corners[0].FirstHit.Surface;
  float sum = 0.f;
  for (int axis = 0; axis < 2; ++axis)
  {
    const glm::ivec2 step(axis == 0, axis == 1);
    const glm::ivec2 side(axis == 1, axis == 0);
    float worst = 0.f;
    for (int line = 0; line < 2; ++line)
    {
      const glm::ivec2 p = glm::ivec2(this->X, this->Y) + line * side;
      const glm::vec4& first = this->Grid.At(p.x, p.y).Color;
      const glm::vec4& second = this->Grid.At(p.x + step.x, p.y + step.y).Color;
      float minimum = contrast;
      for (int end = 0; end < 2; ++end)
      {
        const glm::ivec2 q = end == 0 ? p - step : p + 2 * step;
        if (q.x < this->Grid.GetLow().x || q.y < this->Grid.GetLow().y ||
          q.x > this->Grid.GetHigh().x || q.y > this->Grid.GetHigh().y ||
          this->Grid.At(q.x, q.y).FirstHit.Surface != surface)
        {
          continue;
        }
        const glm::vec4& outer = this->Grid.At(q.x, q.y).Color;
        const glm::vec4 d = end == 0 ? outer - 2.f * first + second : first - 2.f * second + outer;
        minimum = std::min(minimum, ComputeMaximumDifference(d, glm::vec4(0.f)));
      }
      worst = std::max(worst, minimum);
    }
    sum += worst;
  }
  // The expected second difference of noise is about 2.4 of its standard errors.
  const float noise = 2.f * 2.4f * static_cast<float>(this->Noise);
  return std::max(sum - noise, 0.f) / 12.f;
}

// If an edge runs along a side of the pixel, the rays of its corners may hit either side of the
// edge. These corners are traced again at a position slightly inside the pixel.
void PixelIntegrator::RetraceCornersOnEdges()
{
  for (int i = 0; i < 4; ++i)
  {
    if (!(this->TrustedCorners >> i & 1u))
    {
      const glm::dvec2 inward = glm::dvec2(0.5) - GetCornerOffset(i);
      this->Corners[i] = this->Trace(GetCornerOffset(i) + CornerInset * inward);
    }
  }
}

// A ray exactly through a vertex or an edge can miss both triangles. If no edge is near, a single
// corner that differs from the other three is traced again slightly inside the pixel.
bool PixelIntegrator::RetraceIsolatedMiss()
{
  for (int i = 0; i < 4; ++i)
  {
    const Hit& isolated = this->Corners[i].FirstHit;
    const Hit& a = this->Corners[(i + 1) & 3].FirstHit;
    const Hit& b = this->Corners[(i + 2) & 3].FirstHit;
    const Hit& c = this->Corners[(i + 3) & 3].FirstHit;
    if (a.Surface != b.Surface || a.Surface != c.Surface || isolated.Surface == a.Surface)
    {
      continue;
    }
    const glm::dvec2 inward = glm::dvec2(0.5) - GetCornerOffset(i);
    const Sample retraced = this->Trace(GetCornerOffset(i) + CornerInset * inward);
    if (retraced.FirstHit.Surface == a.Surface)
    {
      this->Corners[i] = retraced;
      return true;
    }
    return false;
  }
  return false;
}

// Returns true if `test` is true for a corner of this pixel or of its neighbors.
bool PixelIntegrator::AnyNeighborCorner(const std::function<bool(const Sample&)>& test) const
{
  const glm::ivec2 low = glm::max(glm::ivec2(this->X, this->Y) - 1, this->Grid.GetLow());
  const glm::ivec2 high = glm::min(glm::ivec2(this->X, this->Y) + 2, this->Grid.GetHigh());
  for (int y = low.y; y <= high.y; ++y)
  {
    for (int x = low.x; x <= high.x; ++x)
    {
      if (test(this->Grid.At(x, y)))
      {
        return true;
      }
    }
  }
  return false;
}

float PixelIntegrator::ComputeVariation(unsigned int corners, const Sample& sample) const
{
  float variation = 0.f;
  for (int i = 0; i < 4; ++i)
  {
    if (corners >> i & 1u)
    {
      const Sample& corner = this->Corners[i];
      const bool disconnected = corner.FirstHit.Surface != sample.FirstHit.Surface;
      variation = std::max(variation,
        std::max(disconnected ? 1.f : 0.f, ComputeMaximumDifference(corner.Color, sample.Color)));
    }
  }
  return variation;
}

// A shadow boundary may cross a pixel without a difference between its corners. The corners of a
// neighboring pixel then show one. Penumbrae do not count: their colors are noisy everywhere.
bool PixelIntegrator::IsNearShadowBoundary() const
{
  if (!this->Settings.Shadows)
  {
    return false;
  }
  return this->AnyNeighborCorner([this](const Sample& neighbor) {
    return std::any_of(this->Corners, this->Corners + 4, [&](const Sample& corner) {
      return neighbor.Noise == 0.f && corner.Noise == 0.f &&
        neighbor.FirstHit.Surface == corner.FirstHit.Surface &&
        ComputeMaximumDifference(neighbor.Color, corner.Color) > ShadowContrast;
    });
  });
}

// A sphere or tube whose outline is hidden may emerge from the surface in front of it.
void PixelIntegrator::AddHiddenShape(const ProjectedEdge& edge, double depth, double limit)
{
  if (!edge.IsRound())
  {
    return;
  }
  const RoundShape shape =
    this->Tracer.GetScene().Surfaces[edge.RoundSurface].GetRoundShape(edge.RoundPrimitive);
  if (depth - 2.0 * std::max(shape.RadiusA, shape.RadiusB) <= limit)
  {
    this->AddPrimitive({ edge.RoundSurface, edge.RoundPrimitive });
  }
}

void PixelIntegrator::AddTriangle(const Sample& sample)
{
  if (sample.FirstHit.IsHit())
  {
    this->AddPrimitive({ sample.FirstHit.Surface, sample.FirstHit.Primitive });
  }
}

void PixelIntegrator::AddPrimitive(PrimitiveId id)
{
  if (this->VisibleTriangles.size() < MaximumTriangles &&
    std::find(this->VisibleTriangles.begin(), this->VisibleTriangles.end(), id) ==
      this->VisibleTriangles.end())
  {
    this->VisibleTriangles.push_back(id);
  }
}

PixelResult PixelIntegrator::IntegrateInterior()
{
  this->RetraceCornersOnEdges();
  const bool agree = this->CornersAgree() || this->RetraceIsolatedMiss();
  const bool hasHiddenShapes = !this->VisibleTriangles.empty();
  if (hasHiddenShapes)
  {
    this->FindNearbyIntersections();
  }
  PixelResult result;
  if (agree && (!hasHiddenShapes || (this->Segments.empty() && !this->IsTubeIntersected)))
  {
    const float error = this->EstimateCurvatureError();
    const bool empty = !this->Corners[0].FirstHit.IsHit() && !this->Tracer.HasShafts();
    if (empty || (error <= 0.25f * this->Settings.Tolerance && !this->IsNearShadowBoundary()))
    {
      ++(empty ? this->Pixels.Empty : this->Pixels.Interior);
      result.Color = empty && this->Tracer.HasBackgroundImage()
        ? this->Tracer.GetBackground(glm::dvec2(this->X, this->Y) + 0.5)
        : ComputeMean(this->Corners);
      if (empty)
      {
        result.Error = EmptyErrorFloor;
      }
      else
      {
        this->SetErrors(CurvatureSafetyFactor * error, ErrorFloor, result);
      }
      return result;
    }
  }
  if (!hasHiddenShapes)
  {
    this->FindNearbyIntersections();
  }
  if (!this->Segments.empty() || this->IsTubeIntersected)
  {
    return this->IntegrateExact(nullptr, 0);
  }
  return this->IntegrateSubdivided(false);
}

}
