// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The occlusion next to a unit sphere with its center at the height h above a plane is h (h^2 +
// rho^2)^(-3/2) on the plane and (1 - n_z) / 2 on the sphere.
#include "Benchmark.h"
#include "Surface.h"

#include "BruteForce/ImageErrors.h"
#include "Embree/RayScene.h"
#include "PeerTimings.h"
#include "Scenes/Solids.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPenumbraIrradianceCache.h"

#include <cmath>

namespace penumbra
{
namespace
{

constexpr int Size = 1024;
constexpr double Infinity = std::numeric_limits<double>::infinity();

struct Point
{
  glm::dvec3 Position; ///< world
  glm::dvec3 Normal;
  double Truth;
  bool OnSphere;
};

struct SphereScene
{
  explicit SphereScene(double height)
    : Height(height)
  {
    AddFloor(this->Drawn, 1000.f);
    AddSphere(this->Drawn, { 0.0, 0.0, height }, 1.0, 1000);
    LookAt(this->Drawn, { 0.0, -7.0, 4.0 }, { 0.0, 0.0, .6 }, 45.0, Size, Size);
  }

  /// Surface points at the centers of every `step`-th pixel, without the silhouette of the sphere.
  std::vector<Point> Look(const RayScene& rays, int step) const
  {
    const Camera& eye = this->Drawn.ViewCamera;
    const glm::dvec3 center = glm::dvec3(0.0, 0.0, this->Height) - this->Drawn.Origin;
    const double outline = std::asin(1.0 / glm::length(center));
    std::vector<Point> points;
    for (int y = step / 2; y < Size; y += step)
    {
      for (int x = step / 2; x < Size; x += step)
      {
        Ray ray;
        ray.Direction = eye.RayDirection({ x + .5, y + .5 });
        const Hit hit = rays.Intersect(ray);
        const double angle =
          std::acos(glm::dot(glm::normalize(glm::dvec3(ray.Direction)), glm::normalize(center)));
        if (!hit.IsHit() || std::abs(angle - outline) < 2.0 * eye.PixelSize)
        {
          continue;
        }
        Point point;
        point.Position = double(hit.Distance) * glm::dvec3(ray.Direction) + this->Drawn.Origin;
        point.OnSphere = hit.Surface == 1;
        const double square =
          point.Position.x * point.Position.x + point.Position.y * point.Position.y;
        point.Normal = point.OnSphere
          ? glm::normalize(point.Position - glm::dvec3(0.0, 0.0, this->Height))
          : glm::dvec3(0.0, 0.0, 1.0);
        point.Truth = point.OnSphere
          ? .5 * (1.0 - point.Normal.z)
          : this->Height * std::pow(this->Height * this->Height + square, -1.5);
        points.push_back(point);
      }
    }
    return points;
  }

  double Height;
  Scene Drawn;
};

struct Outcome
{
  double Plane = 0.0;
  double Sphere = 0.0;
  double All = 0.0;
  double Seconds = 0.0; ///< of the queries
};

Outcome Ask(const vtkPenumbraIrradianceProvider* source, const std::vector<Point>& points)
{
  std::vector<double> answers;
  const double start = FrameSeconds();
  for (const Point& point : points)
  {
    answers.push_back(source->Occlusion(&point.Position.x, &point.Normal.x).Value);
  }
  Outcome outcome;
  outcome.Seconds = FrameSeconds() - start;
  double squares[2] = { 0.0, 0.0 };
  double counts[2] = { 0.0, 0.0 };
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    squares[points[i].OnSphere] += std::pow(answers[i] - points[i].Truth, 2.0);
    counts[points[i].OnSphere] += 1.0;
  }
  outcome.Plane = std::sqrt(squares[0] / counts[0]);
  outcome.Sphere = std::sqrt(squares[1] / counts[1]);
  outcome.All = std::sqrt((squares[0] + squares[1]) / (counts[0] + counts[1]));
  return outcome;
}

double CountOf(const vtkPenumbraIrradianceCache* cache, const char* name)
{
  vtkNew<vtkFieldData> statistics;
  cache->Report(statistics);
  return statistics->GetArray(name)->GetComponent(0, 0);
}

/// CPU seconds that brute force requires for all pixels at the error `target`.
double BruteForceSeconds(const RayScene& rays, const std::vector<Point>& some, double target,
  double pixels, bool& extrapolated)
{
  std::vector<glm::dvec2> ladder;
  for (const double tolerance : { .02, .01, .005, .0025 })
  {
    vtkNew<vtkPenumbraBruteForceIrradiance> source;
    source->Begin(rays, Infinity, tolerance);
    const Outcome outcome = Ask(source, some);
    ladder.emplace_back(outcome.All, outcome.Seconds / static_cast<double>(some.size()) * pixels);
  }
  extrapolated = IsExtrapolated(ladder, target);
  return CostAtError(ladder, target);
}

/// Measures the screen-space cache at the tolerance `tolerance`.
void MeasureOnScreen(ResultTable& table, const std::string& name, const RayScene& rays,
  const std::vector<Point>& points, double tolerance)
{
  vtkNew<vtkPenumbraIrradianceCache> cache;
  cache->SetSpace(vtkPenumbraIrradianceCache::SCREEN);
  const double start = FrameSeconds();
  cache->Begin(rays, Infinity, 2.0 * tolerance);
  const double placing = FrameSeconds() - start;
  const Outcome outcome = Ask(cache, points);
  table.Add(name, "screen space: records", CountOf(cache, "Cache/Records"), TargetKind::None);
  table.Add(
    name, "screen space: rays, millions", CountOf(cache, "Rays/Gather") * 1e-6, TargetKind::None);
  table.Add(name, "screen space: RMSE on the plane", outcome.Plane, TargetKind::AtMost, .003);
  table.Add(name, "screen space: RMSE on the sphere", outcome.Sphere, TargetKind::AtMost, .006);
  table.Add(name, "screen space: seconds: records, then look-ups", placing + outcome.Seconds,
    TargetKind::None, 0.0, std::to_string(placing) + " + " + std::to_string(outcome.Seconds));
}

}

void MeasureSpheres(IrradianceBenchmark& benchmark)
{
  ResultTable& table = benchmark.Results;
  int kept = 0;
  int tried = 0;
  for (const double height : { 1.0, 1.5 })
  {
    const std::string name = height == 1.0 ? "sphere touching a plane" : "sphere hovering";
    const SphereScene scene(height);
    const RayScene rays(scene.Drawn, 1);
    const std::vector<Point> points = scene.Look(rays, 1);
    for (const double tolerance : { .05, .02, .01, .005, .002 })
    {
      vtkNew<vtkPenumbraIrradianceCache> cache;
      const double start = FrameSeconds();
      cache->Begin(rays, Infinity, 2.0 * tolerance); // as a ray caster with this tolerance does
      const double placing = FrameSeconds() - start;
      const Outcome outcome = Ask(cache, points);
      kept += outcome.All <= tolerance ? 1 : 0;
      ++tried;
      if (tolerance != .005)
      {
        continue;
      }
      const double records = CountOf(cache, "Cache/Records");
      const double seconds = placing + outcome.Seconds;
      table.Add(name, "records", records, TargetKind::AtMost, 500.0, "Radiance, tuned: 453");
      table.Add(
        name, "rays, millions", CountOf(cache, "Rays/Gather") * 1e-6, TargetKind::AtMost, .6);
      table.Add(name, "RMSE on the plane", outcome.Plane, TargetKind::AtMost, .003,
        height == 1.0 ? "Radiance, tuned: 0.0031; its defaults 0.105" : "Radiance: 0.077 to 0.094");
      table.Add(name, "RMSE on the sphere", outcome.Sphere, TargetKind::AtMost, .006,
        height == 1.0 ? "Radiance, tuned: 0.0083" : "");
      table.Add(name, "seconds: records, then look-ups", seconds, TargetKind::None, 0.0,
        std::to_string(placing) + " + " + std::to_string(outcome.Seconds));
      CompareTimes(table, name,
        { "Radiance", benchmark.Radiance,
          "radiance.py '" + benchmark.Output + "' sphere " + std::to_string(height) },
        outcome.All, seconds, 1.0 / 3.0);
      const auto pixels = static_cast<double>(points.size());
      table.Add(
        name, "gathers, brute force over cache", pixels / records, TargetKind::AtLeast, 1000.0);
      bool extrapolated = false;
      const double bruteForce =
        BruteForceSeconds(rays, scene.Look(rays, 16), outcome.All, pixels, extrapolated);
      table.Add(name, "time at equal RMSE, brute force over cache", bruteForce / seconds,
        TargetKind::AtLeast, 30.0, extrapolated ? "extrapolated" : "");
      MeasureOnScreen(table, name, rays, points, tolerance);
    }
  }
  table.Add("both, tolerances .05 to .002", "share with RMSE <= tolerance",
    static_cast<double>(kept) / tried, TargetKind::AtLeast, .95);
}

}
