// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PixelContext.h"

#include "PixelErrors.h"
#include "Scene.h"
#include "Surface.h"

#include <iterator>

namespace penumbra
{
namespace
{

/// As ShadowContrast, in penumbrae, in addition to their noise. A missed end of a shadow has an error of about half of
/// the difference, which is 0.008 in a tile.
constexpr float NarrowPenumbraContrast = 0.25f;

}

PixelContext::PixelContext(
  const CameraRayTracer& tracer, const CornerGrid& corners, const IntegrationSettings& settings)
  : Tracer(tracer),
    Grid(corners),
    Settings(settings),
    Noise(settings.Noise)
{
}

Sample PixelContext::Trace(glm::dvec2 local, double area)
{
  ++this->Rays.Refinement;
  const glm::dvec2 p = this->GetOrigin() + local;
  const std::uint32_t penumbrae = this->Grid.GetPenumbrae(p);
  return this->Tracer.TraceSample(
    p, this->Rays, ComputeToleranceScale(area), penumbrae, this->GetNeighbors(penumbrae));
}

std::vector<PenumbraNeighbors>* PixelContext::GetNeighbors(std::uint32_t penumbrae)
{
  if (penumbrae == 0)
  {
    return nullptr;
  }
  this->Neighbors.resize(this->Tracer.GetScene().Lights.size());
  return &this->Neighbors;
}

void PixelContext::Load(glm::ivec2 pixel)
{
  this->Position = pixel;
  this->MediumError = 0.f;
  this->Neighbors.clear();
  float penumbraNoise = 0.f;
  for (int i = 0; i < 4; ++i)
  {
    this->Grid.Load(pixel.x + (i & 1), pixel.y + (i >> 1), this->Corners[i]);
    this->MediumError = std::max(this->MediumError, this->Corners[i].Error);
    penumbraNoise = std::max(penumbraNoise, this->Corners[i].Noise);
  }
  this->Noise = penumbraNoise > 0.f
    ? std::hypot(this->Settings.Noise, static_cast<double>(penumbraNoise))
    : this->Settings.Noise;
  this->TrustedCorners = 15u;
  this->LeastSteady = Steadiness::Steady;
}

double PixelContext::ComputePixelSize(double distance) const
{
  const Camera& camera = this->Tracer.GetCamera();
  return camera.PixelSize * (camera.Parallel ? 1.0 : distance + camera.DepthOfRayOrigins());
}

bool PixelContext::CornersAgree() const
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

bool PixelContext::IsConstantBehindMedium(const Hit& hit) const
{
  return !hit.IsHit() ||
    (!this->Tracer.HasTranslucentSurfaces() && !this->Tracer.UsesIrradianceProvider() &&
      this->Tracer.GetShading().IsConstantPerTriangle(hit.Surface));
}

bool PixelContext::IsIsolated() const
{
  const Hit hit = this->Corners[0].FirstHit;
  const bool isOneTriangle =
    std::all_of(std::begin(this->Corners), std::end(this->Corners), [&hit](const Sample& corner) {
      return corner.FirstHit.Surface == hit.Surface && corner.FirstHit.Primitive == hit.Primitive;
    });
  if (!hit.IsHit() || (isOneTriangle && this->IsConstant(hit)))
  {
    return false;
  }
  const bool isRound = this->GetSurfaces()[hit.Surface].IsRound();
  const auto isOnSurface = [&](glm::ivec2 q) {
    if (glm::any(glm::lessThan(q, this->Grid.GetLow())) ||
      glm::any(glm::greaterThan(q, this->Grid.GetHigh())))
    {
      return false;
    }
    const Hit other = this->Grid.At(q.x, q.y).FirstHit;
    return other.Surface == hit.Surface && (!isRound || other.Primitive == hit.Primitive);
  };
  const glm::ivec2 p = this->Position;
  return !((isOnSurface(p + glm::ivec2(-1, 0)) || isOnSurface(p + glm::ivec2(2, 0)) ||
             isOnSurface(p + glm::ivec2(-1, 1)) || isOnSurface(p + glm::ivec2(2, 1))) &&
    (isOnSurface(p + glm::ivec2(0, -1)) || isOnSurface(p + glm::ivec2(0, 2)) ||
      isOnSurface(p + glm::ivec2(1, -1)) || isOnSurface(p + glm::ivec2(1, 2))));
}

// The error of the mean of four corners is (f_xx + f_yy) / 12. Second differences with the
// neighboring corners approximate the derivatives. Discontinuities also cause second differences.
float PixelContext::EstimateCurvatureError() const
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
      const glm::ivec2 p = this->Position + line * side;
      const glm::vec4 first = this->Grid.At(p.x, p.y).Color;
      const glm::vec4 second = this->Grid.At(p.x + step.x, p.y + step.y).Color;
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
        const glm::vec4 outer = this->Grid.At(q.x, q.y).Color;
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

void PixelContext::RetraceCornersOnEdges()
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

bool PixelContext::RetraceIsolatedMiss()
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

float PixelContext::ComputeVariation(unsigned int corners, const Sample& sample) const
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
// neighboring pixel then show one. In penumbrae, whose colors are noisy, only large differences count: those of
// penumbrae that are not much wider than a pixel.
bool PixelContext::IsNearShadowBoundary() const
{
  if (!this->Settings.Shadows)
  {
    return false;
  }
  return this->AnyNeighborCorner([this](const Sample& neighbor) {
    return std::any_of(this->Corners, this->Corners + 4, [&](const Sample& corner) {
      const float noise = neighbor.Noise + corner.Noise;
      const float contrast = noise > 0.f ? NarrowPenumbraContrast + noise : ShadowContrast;
      return neighbor.FirstHit.Surface == corner.FirstHit.Surface &&
        ComputeMaximumDifference(neighbor.Color, corner.Color) > contrast;
    });
  });
}

}
