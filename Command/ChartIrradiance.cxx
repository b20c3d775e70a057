// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The irradiance cache: its rules for radii, and rays at every pixel, for the occlusion beside a
// sphere on a floor, which is known in closed form. The tree is ready before the clock starts.
#include "ChartFamilies.h"

#include "RayScene.h"
#include "Solids.h"
#include "Truth.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPenumbraBruteForceSource.h"
#include "vtkPenumbraIrradianceCache.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace penumbra
{

namespace
{

using Cache = vtkPenumbraIrradianceCache;

constexpr double Infinity = std::numeric_limits<double>::infinity();

struct Subject
{
  Scene Drawn;
  std::unique_ptr<RayScene> Rays;
  double Height;
};

using Subjects = std::function<Subject&()>;

/// A unit sphere whose centre is `height` above a floor.
Subjects SphereOnFloor(double height, int size)
{
  return Lazily<Subject>([=] {
    auto subject = std::make_shared<Subject>();
    subject->Height = height;
    AddFloor(subject->Drawn, 1000.f);
    AddSphere(subject->Drawn, { 0.0, 0.0, height }, 1.0, 400);
    LookAt(subject->Drawn, { 0.0, -7.0, 4.0 }, { 0.0, 0.0, .6 }, 45.0, size, size);
    subject->Rays = std::make_unique<RayScene>(subject->Drawn, 1);
    return subject;
  });
}

double TruthAt(const Subject& subject, const SurfacePoint& point)
{
  const double* p = point.Position;
  const double h = subject.Height;
  return p[2] < 1e-3 ? h * std::pow(h * h + p[0] * p[0] + p[1] * p[1], -1.5)
                     : .5 * (1.0 - point.Normal[2]);
}

/// Asks at every `stride`-th pixel; the seconds are scaled to all of them.
Measurement Ask(
  const Subject& subject, vtkPenumbraIrradianceSource* source, double tolerance, int stride)
{
  const std::vector<SurfacePoint> points = PointsInPicture(*subject.Rays, stride);
  const double start = CpuSeconds();
  source->Begin(*subject.Rays, Infinity, tolerance);
  double rays = 0.0;
  double squares = 0.0;
  for (const SurfacePoint& point : points)
  {
    const auto estimate = source->Occlusion(point.Position, point.Normal);
    rays += static_cast<double>(estimate.Rays);
    squares += std::pow(estimate.Value - TruthAt(subject, point), 2.0);
  }
  const auto count = static_cast<double>(points.size());
  Measurement result;
  result.Seconds = stride * stride * (CpuSeconds() - start);
  result.Error = std::sqrt(squares / count);
  vtkNew<vtkFieldData> statistics;
  source->Report(statistics);
  if (vtkDataArray* gathered = statistics->GetArray("Rays/Gather"))
  {
    rays += gathered->GetComponent(0, 0);
  }
  result.Count = std::max(rays / count, 1e-3);
  return result;
}

void AddSteps(ChartFamily& family, const std::string& scene, const Subjects& subject, bool quick)
{
  const struct
  {
    const char* Method;
    int Rule;
  } rules[] = { { "nearest hit [IC]", Cache::NEAREST_HIT },
    { "harmonic mean [IC]", Cache::HARMONIC_MEAN },
    { "Penumbra automatic (second derivative)", Cache::OCCLUSION_HESSIAN } };
  for (const auto& rule : rules)
  {
    for (const double tolerance : quick ? std::vector<double>{ .05, .02 }
                                        : std::vector<double>{ .05, .02, .01, .005, .002, .001 })
    {
      std::ostringstream setting;
      setting << "tolerance " << tolerance;
      family.Steps.push_back({ scene, rule.Method, setting.str(), tolerance, [=] {
                                vtkNew<Cache> cache;
                                cache->SetRadiusRule(rule.Rule);
                                cache->SetTolerance(tolerance);
                                return Ask(subject(), cache, tolerance, 1);
                              } });
    }
  }
  for (const int rays :
    quick ? std::vector<int>{ 8, 32 } : std::vector<int>{ 8, 32, 128, 512, 2048 })
  {
    family.Steps.push_back({ scene, "rays alone", std::to_string(rays) + " rays", 0.0, [=] {
                              vtkNew<vtkPenumbraBruteForceSource> source;
                              source->SetMinimumRays(rays);
                              source->SetMaximumRays(std::max(rays, 32));
                              return Ask(subject(), source, 1.0, 8);
                            } });
  }
}

}

ChartFamily IrradianceFamily(const ChartRequest& request)
{
  const int size = request.Quick ? 256 : 512;
  ChartFamily family{ "irradiance",
    "Interpolated occlusion, " + std::to_string(size) + "x" + std::to_string(size),
    "RMSE over surface pixels", "rays a pixel", "closed form", {} };
  AddSteps(family, "sphere on a floor", SphereOnFloor(1.0, size), request.Quick);
  if (!request.Quick)
  {
    AddSteps(family, "sphere over a floor", SphereOnFloor(1.5, size), false);
  }
  return family;
}

}
