// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The irradiance cache: its rules for radii, and rays at every pixel, for the occlusion beside a
// sphere on a floor, which is known in closed form, and for the light in a room, of five reflections,
// against independent paths. The tree is ready before the clock starts.
#include "ChartFamilies.h"

#include "Illumination.h"
#include "PathTracer.h"
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
constexpr double Pi = 3.14159265358979323846;

/// vtkPenumbraBruteForceSource begins with so many paths where it would begin with one ray.
constexpr int PathsPerRay = 8;

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

double TruthAt(const Subject& subject, const SeenPoint& point)
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
  const std::vector<SeenPoint> points = PointsInPicture(*subject.Rays, stride);
  const double start = CpuSeconds();
  source->Begin(*subject.Rays, Infinity, tolerance);
  double rays = 0.0;
  double squares = 0.0;
  for (const SeenPoint& point : points)
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
    int Space;
  } rules[] = { { "nearest hit [IC]", Cache::NEAREST_HIT, Cache::WORLD },
    { "harmonic mean [IC]", Cache::HARMONIC_MEAN, Cache::WORLD },
    { "Penumbra automatic (second derivative)", Cache::OCCLUSION_HESSIAN, Cache::WORLD },
    { "Penumbra in screen space", Cache::OCCLUSION_HESSIAN, Cache::SCREEN } };
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
                                cache->SetSpace(rule.Space);
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

/// A room lit by a panel below its ceiling.
struct Room
{
  Scene Drawn;
  std::unique_ptr<RayScene> Rays;
  std::unique_ptr<Illumination> Light;
  std::vector<SeenPoint> Known;  ///< of all pixels those that have a truth
  std::vector<glm::dvec3> Truth; ///< irradiance over pi
};

using Rooms = std::function<Room&()>;

Rooms LitRoom(int size, int stride, int paths)
{
  return Lazily<Room>([=] {
    const PathTracer truth{ CornellLikeBox(), .5, 5, glm::dvec3(0.0) };
    auto room = std::make_shared<Room>();
    AddSurfaces(room->Drawn, truth.Panels);
    LookAt(room->Drawn, { .51, -1.3, .47 }, { .5, 0.0, .5 }, 41.0, size, size);
    room->Rays = std::make_unique<RayScene>(room->Drawn, 1);
    IlluminationSettings settings;
    settings.Albedo = static_cast<float>(truth.Albedo);
    settings.Bounces = truth.Bounces;
    room->Light = std::make_unique<Illumination>(*room->Rays, settings);
    room->Known = PointsInPicture(*room->Rays, stride);
    for (const SeenPoint& point : room->Known)
    {
      const double* p = point.Position;
      const double* n = point.Normal;
      room->Truth.push_back(
        truth.Irradiance({ p[0], p[1], p[2] }, { n[0], n[1], n[2] }, paths, room->Truth.size()) /
        Pi);
    }
    return room;
  });
}

/// `tolerance` of irradiance over pi. The seconds are of all pixels.
Measurement AskForLight(
  const Room& room, vtkPenumbraIrradianceSource* source, double tolerance, bool ofAllPixels)
{
  const std::vector<SeenPoint> all = PointsInPicture(*room.Rays, 1);
  const double start = CpuSeconds();
  source->BeginIrradiance(*room.Light, Pi * tolerance);
  double rays = 0.0;
  const auto ask = [&](const SeenPoint& point) {
    const auto light = source->Irradiance(point.Position, point.Normal, Pi * tolerance);
    rays += static_cast<double>(light.Rays);
    return glm::dvec3(light.Value[0], light.Value[1], light.Value[2]) / Pi;
  };
  std::vector<glm::dvec3> found;
  for (const SeenPoint& point : ofAllPixels ? all : room.Known)
  {
    found.push_back(ask(point));
  }
  const double share = static_cast<double>(all.size()) / static_cast<double>(found.size());
  Measurement result;
  result.Seconds = share * (CpuSeconds() - start);
  vtkNew<vtkFieldData> statistics;
  source->Report(statistics);
  if (vtkDataArray* gathered = statistics->GetArray("Rays/Gather"))
  {
    rays += gathered->GetComponent(0, 0);
  }
  result.Count = rays / static_cast<double>(found.size());
  double squares = 0.0;
  for (std::size_t i = 0; i < room.Known.size(); ++i)
  {
    const glm::dvec3 error = (ofAllPixels ? ask(room.Known[i]) : found[i]) - room.Truth[i];
    squares += glm::dot(error, error) / 3.0;
  }
  result.Error = std::sqrt(squares / static_cast<double>(room.Known.size()));
  return result;
}

void AddRoom(ChartFamily& family, const std::string& scene, const Rooms& room)
{
  for (const double tolerance : { .02, .01, .005, .003, .002 })
  {
    std::ostringstream setting;
    setting << "tolerance " << tolerance;
    family.Steps.push_back(
      { scene, "Penumbra automatic (second derivative)", setting.str(), tolerance, [=] {
         vtkNew<Cache> cache;
         cache->SetTolerance(tolerance);
         return AskForLight(room(), cache, tolerance, true);
       } });
  }
  for (const int paths : { 128, 512, 2048, 8192 })
  {
    family.Steps.push_back({ scene, "paths alone", std::to_string(paths) + " paths", 0.0, [=] {
                              vtkNew<vtkPenumbraBruteForceSource> source;
                              source->SetMinimumRays(paths / PathsPerRay);
                              source->SetMaximumRays(paths);
                              return AskForLight(room(), source, 1.0, false);
                            } });
  }
}

}

ChartFamily IrradianceFamily(const ChartRequest& request)
{
  const int size = request.Quick ? 256 : 512;
  ChartFamily family{ "irradiance",
    "Interpolated occlusion and light, " + std::to_string(size) + "x" + std::to_string(size),
    "RMSE over surface pixels", "rays a pixel",
    "closed form; in the room, of irradiance over pi, 16384 independent paths at a share of the "
    "pixels",
    {} };
  AddSteps(family, "sphere on a floor", SphereOnFloor(1.0, size), request.Quick);
  if (!request.Quick)
  {
    AddSteps(family, "sphere over a floor", SphereOnFloor(1.5, size), false);
    AddRoom(family, "light in a room of 256x256", LitRoom(256, 8, 16384));
  }
  return family;
}

}
