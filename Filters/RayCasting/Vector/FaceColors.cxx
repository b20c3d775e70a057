// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FaceColors.h"

#include "Execution/ParallelFor.h"
#include "Scene.h"
#include "Surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{
namespace
{

// Rows of pixels that are sampled before their samples are added, which bounds the memory.
constexpr int BandHeight = 32;
// Step of the samples of ExceedTolerance(): one of 16.
constexpr int EstimateStep = 4;
// Quotient of the RMSE of these samples and the tolerance above which all samples exceed it, too.
constexpr double CertainExcess = 2.0;
// Fewest samples of which no single one decides, at a tolerance of 1/256.
constexpr double FewestSamples = 16384.0;
// Smallest determinant of the normalized covariance of samples that determine a gradient.
constexpr double MinimumDeterminant = 1e-3;
// Fewest samples that determine a gradient.
constexpr int MinimumSamples = 6;
// A gradient whose channels change by at most this much, in [0, 1], is replaced by its mean.
constexpr double FlatRange = 1.5 / 255.0;

struct PointSample
{
  std::size_t Face = std::numeric_limits<std::size_t>::max();
  glm::vec3 Color{ 0.f };
};

}

void FaceColor::Add(glm::dvec2 p, glm::dvec3 color)
{
  this->Origin = this->Count == 0 ? p : this->Origin;
  const glm::dvec2 d = p - this->Origin;
  // The figure has no colors outside [0, 1].
  const glm::dvec3 c = glm::clamp(color, 0.0, 1.0);
  ++this->Count;
  this->Sum += d;
  this->SumXX += d.x * d.x;
  this->SumXY += d.x * d.y;
  this->SumYY += d.y * d.y;
  this->Colors += c;
  this->ColorsX += d.x * c;
  this->ColorsY += d.y * c;
  this->Squares += c * c;
}

bool FaceColor::Fit(glm::dvec3& byX, glm::dvec3& byY) const
{
  byX = glm::dvec3(0.0);
  byY = glm::dvec3(0.0);
  const double n = this->Count;
  const double xx = this->SumXX - this->Sum.x * this->Sum.x / n;
  const double xy = this->SumXY - this->Sum.x * this->Sum.y / n;
  const double yy = this->SumYY - this->Sum.y * this->Sum.y / n;
  const double determinant = xx * yy - xy * xy;
  if (this->Count < MinimumSamples || !(determinant > MinimumDeterminant * xx * yy))
  {
    return false;
  }
  const glm::dvec3 cx = this->ColorsX - this->Sum.x / n * this->Colors;
  const glm::dvec3 cy = this->ColorsY - this->Sum.y / n * this->Colors;
  byX = (yy * cx - xy * cy) / determinant;
  byY = (xx * cy - xy * cx) / determinant;
  return true;
}

double FaceColor::GetVariance() const
{
  const glm::dvec3 mean = this->Colors / static_cast<double>(this->Count);
  return glm::dot(glm::max(this->Squares - this->Colors * mean, 0.0), glm::dvec3(1.0));
}

double FaceColor::GetResidual() const
{
  glm::dvec3 byX;
  glm::dvec3 byY;
  if (this->Count < MinimumSamples || !this->Fit(byX, byY))
  {
    return 0.0;
  }
  const glm::dvec2 mean = this->Sum / static_cast<double>(this->Count);
  const glm::dvec3 cx = this->ColorsX - mean.x * this->Colors;
  const glm::dvec3 cy = this->ColorsY - mean.y * this->Colors;
  return std::max(this->GetVariance() - glm::dot(byX, cx) - glm::dot(byY, cy), 0.0);
}

double FaceColor::Paint(FigurePath& path) const
{
  const double n = this->Count;
  const glm::dvec3 mean = this->Colors / n;
  const glm::dvec2 center = this->Origin + this->Sum / n;
  const double variance = this->GetVariance();
  path.Color = glm::vec4(mean, 1.f);
  path.HasGradient = false;
  glm::dvec3 byX;
  glm::dvec3 byY;
  this->Fit(byX, byY);
  // Direction of the largest change: the first eigenvector of J^T J with J = (byX, byY).
  const double a = glm::dot(byX, byX);
  const double b = glm::dot(byX, byY);
  const double d = glm::dot(byY, byY);
  const double angle = 0.5 * std::atan2(2.0 * b, a - d);
  const glm::dvec2 direction(std::cos(angle), std::sin(angle));
  const glm::dvec3 slope = direction.x * byX + direction.y * byY;
  double low = 0.0;
  double high = 0.0;
  for (const glm::dvec2 point : path.Points)
  {
    const double s = glm::dot(direction, point - center);
    low = std::min(low, s);
    high = std::max(high, s);
  }
  const glm::dvec3 range = glm::abs((high - low) * slope);
  if (std::max({ range.x, range.y, range.z }) <= FlatRange)
  {
    return variance;
  }
  path.HasGradient = true;
  path.From = center + low * direction;
  path.To = center + high * direction;
  path.Color = glm::vec4(glm::clamp(mean + low * slope, 0.0, 1.0), 1.f);
  path.EndColor = glm::vec4(glm::clamp(mean + high * slope, 0.0, 1.0), 1.f);
  // Part of the variance that the change along the direction explains.
  const double xx = this->SumXX - this->Sum.x * this->Sum.x / n;
  const double xy = this->SumXY - this->Sum.x * this->Sum.y / n;
  const double yy = this->SumYY - this->Sum.y * this->Sum.y / n;
  const double ss = direction.x * direction.x * xx + 2.0 * direction.x * direction.y * xy +
    direction.y * direction.y * yy;
  const glm::dvec3 cs = direction.x * (this->ColorsX - this->Sum.x / n * this->Colors) +
    direction.y * (this->ColorsY - this->Sum.y / n * this->Colors);
  return std::max(variance - 2.0 * glm::dot(slope, cs) + ss * glm::dot(slope, slope), 0.0);
}

std::vector<FaceColor> SampleFaceColors(const CameraRayTracer& tracer, int step)
{
  const Scene& scene = tracer.GetScene();
  std::vector<std::size_t> first(1, 0);
  for (const Surface& surface : scene.Surfaces)
  {
    first.push_back(first.back() + surface.Triangles.size());
  }
  std::vector<FaceColor> colors(first.back());
  const int side = FaceSamplesPerPixelSide;
  const int width = (scene.ViewCamera.Width * side + step - 1) / step;
  const int height = (scene.ViewCamera.Height * side + step - 1) / step;
  const auto at = [step](int x, int y) {
    return glm::dvec2(x * step + 0.5, y * step + 0.5) /
      static_cast<double>(FaceSamplesPerPixelSide);
  };
  std::vector<PointSample> band(static_cast<std::size_t>(width) * BandHeight);
  for (int begin = 0; begin < height; begin += BandHeight)
  {
    const int end = std::min(begin + BandHeight, height);
    ParallelFor(begin, end, 1, [&](int y) {
      PointSample* row = band.data() + static_cast<std::size_t>(y - begin) * width;
      RayCounts counts;
      glm::dvec2 points[CameraRayTracer::PacketSize];
      Sample samples[CameraRayTracer::PacketSize];
      for (int x = 0; x < width; x += CameraRayTracer::PacketSize)
      {
        const int count = std::min(CameraRayTracer::PacketSize, width - x);
        for (int i = 0; i < CameraRayTracer::PacketSize; ++i)
        {
          points[i] = at(x + std::min(i, count - 1), y);
          samples[i] = Sample();
        }
        tracer.TracePacket(points, (1u << count) - 1u, samples, counts);
        for (int i = 0; i < count; ++i)
        {
          const Hit& hit = samples[i].FirstHit;
          row[x + i] = PointSample();
          if (hit.IsHit())
          {
            row[x + i] = { first[hit.Surface] + hit.Primitive, glm::vec3(samples[i].Color) };
          }
        }
      }
    });
    for (int y = begin; y < end; ++y)
    {
      const PointSample* row = band.data() + static_cast<std::size_t>(y - begin) * width;
      for (int x = 0; x < width; ++x)
      {
        if (row[x].Face < colors.size())
        {
          colors[row[x].Face].Add(at(x, y), row[x].Color);
        }
      }
    }
  }
  return colors;
}

bool ExceedTolerance(const CameraRayTracer& tracer, double tolerance)
{
  const Camera& camera = tracer.GetCamera();
  const double samplesPerSide = static_cast<double>(FaceSamplesPerPixelSide) / EstimateStep;
  const double samples = samplesPerSide * samplesPerSide * camera.Width * camera.Height;
  if (samples < FewestSamples)
  {
    return false;
  }
  double squaredError = 0.0;
  for (const FaceColor& color : SampleFaceColors(tracer, EstimateStep))
  {
    squaredError += color.GetResidual();
  }
  return std::sqrt(squaredError / (3.0 * samples)) > CertainExcess * tolerance;
}

}
