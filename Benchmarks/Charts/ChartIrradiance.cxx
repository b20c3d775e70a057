// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The irradiance cache: its radius rules, and rays at every pixel. Scenes: the occlusion next to a
// sphere on a floor, with a closed form; and the light in a room with five bounces, with
// independent paths as reference. The acceleration structure is built before the clock starts.
#include "ChartPointQueries.h"
#include "Surface.h"

#include "BruteForce/PathTracer.h"
#include "Embree/RayScene.h"
#include "OcclusionReference.h"
#include "Scenes/Solids.h"
#include "Scenes/TestScene.h"
#include "Shading/Illumination.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPenumbraCubeMapGatherer.h"
#include "vtkPenumbraIrradianceCache.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace penumbra
{

namespace
{

using Cache = vtkPenumbraIrradianceCache;

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double Pi = glm::pi<double>();

/// Methods without a cache are evaluated at every n-th pixel in both directions.
constexpr int StrideWithoutCache = 4;

/// A hemicube: four faces are rendered by halves and one is not rendered.
constexpr double FacesOfACubeMap = 3.0;

/// Initial number of paths where vtkPenumbraBruteForceIrradiance would start with one ray.
constexpr int PathsPerRay = 8;

/// The tolerance of path tracing in the room for one path: near the noise of its paths, so that light sampled apart
/// from them has an error as small as theirs.
constexpr double NoiseOfOnePath = .08;

struct Subject
{
  Scene Drawn;
  std::unique_ptr<RayScene> Rays;
  double Height;
};

using Subjects = std::function<Subject&()>;

/// Builds a unit sphere with its center at `height` above a floor.
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

/// Number of rays of the records of a provider; pixels of cube maps count as rays.
double Gathered(vtkPenumbraIrradianceProvider* source)
{
  vtkNew<vtkFieldData> statistics;
  source->Report(statistics);
  const auto count = [&](const char* name) {
    vtkDataArray* values = statistics->GetArray(name);
    return values ? values->GetComponent(0, 0) : 0.0;
  };
  const int resolution = vtkNew<vtkPenumbraCubeMapGatherer>()->GetResolution();
  return count("Rays/Gather") + count("CubeMaps/Total") * FacesOfACubeMap * resolution * resolution;
}

double TruthAt(const Subject& subject, const double* p, const double* normal)
{
  const double h = subject.Height;
  return p[2] < 1e-3 ? h * std::pow(h * h + p[0] * p[0] + p[1] * p[1], -1.5)
                     : .5 * (1.0 - normal[2]);
}

/// Evaluates every `stride`-th pixel; the seconds are scaled to all pixels.
Measurement Ask(
  const Subject& subject, vtkPenumbraIrradianceProvider* source, double tolerance, int stride)
{
  const std::vector<SeenPoint> points = PointsInImage(*subject.Rays, stride);
  const double start = CpuSeconds();
  source->Begin(*subject.Rays, Infinity, tolerance);
  double rays = 0.0;
  double squares = 0.0;
  for (const SeenPoint& point : points)
  {
    const auto estimate = source->Occlusion(point.Position, point.Normal);
    rays += static_cast<double>(estimate.Rays);
    squares += std::pow(estimate.Value - TruthAt(subject, point.Position, point.Normal), 2.0);
  }
  const auto count = static_cast<double>(points.size());
  Measurement result;
  result.Seconds = stride * stride * (CpuSeconds() - start);
  result.Error = std::sqrt(squares / count);
  rays += Gathered(source);
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
    bool Cubes;
  } rules[] = { { "nearest hit [IC]", Cache::NEAREST_HIT, Cache::WORLD, false },
    { "harmonic mean [IC]", Cache::HARMONIC_MEAN, Cache::WORLD, false },
    { "Penumbra automatic (second derivative)", Cache::OCCLUSION_HESSIAN, Cache::WORLD, false },
    { "cache in screen space", Cache::OCCLUSION_HESSIAN, Cache::SCREEN, false },
    { "second derivative by cube maps", Cache::OCCLUSION_HESSIAN, Cache::WORLD, true } };
  for (const auto& rule : rules)
  {
    std::vector<double> tolerances = { .05, .02 };
    if (!quick && !rule.Cubes)
    {
      tolerances.insert(tolerances.end(), { .01, .005, .002, .001 });
    }
    for (const double tolerance : quick&& rule.Cubes ? std::vector<double>() : tolerances)
    {
      std::ostringstream setting;
      setting << "tolerance " << tolerance;
      family.Steps.push_back({ scene, rule.Method, setting.str(), tolerance, [=] {
                                vtkNew<Cache> cache;
                                cache->SetRadiusRule(rule.Rule);
                                cache->SetSpace(rule.Space);
                                cache->SetTolerance(tolerance);
                                if (rule.Cubes)
                                {
                                  cache->SetGatherer(vtkNew<vtkPenumbraCubeMapGatherer>());
                                }
                                return Ask(subject(), cache, tolerance, 1);
                              } });
    }
  }
  for (const int rays :
    quick ? std::vector<int>{ 8, 32 } : std::vector<int>{ 8, 32, 128, 512, 2048 })
  {
    family.Steps.push_back({ scene, "rays only", std::to_string(rays) + " rays", 0.0, [=] {
                              vtkNew<vtkPenumbraBruteForceIrradiance> source;
                              source->SetMinimumRays(rays);
                              source->SetMaximumRays(std::max(rays, 32));
                              return Ask(subject(), source, 1.0, 8);
                            } });
  }
}

std::vector<PointQuery> QuestionsAt(const std::vector<SeenPoint>& points)
{
  std::vector<PointQuery> questions;
  for (const SeenPoint& point : points)
  {
    questions.push_back({ { point.Position[0], point.Position[1], point.Position[2] },
      { point.Normal[0], point.Normal[1], point.Normal[2] } });
  }
  return questions;
}

PointQuerySteps PeersBesideSphere(const std::string& scene, const Subjects& subject)
{
  PointQuerySteps steps;
  steps.Scene = scene;
  steps.Prepare = [=](const Peer& peer) {
    const int stride = peer.HasCache ? 1 : StrideWithoutCache;
    PointQueryScene asked;
    asked.Drawn = &subject().Drawn;
    asked.Questions = QuestionsAt(PointsInImage(*subject().Rays, stride));
    asked.Share = 1.0 / (stride * stride);
    return asked;
  };
  steps.Error = [=](const PointQueryScene& asked, const std::vector<glm::dvec3>& light) {
    double squares = 0.0;
    for (std::size_t i = 0; i < light.size(); ++i)
    {
      const PointQuery& question = asked.Questions[i];
      squares += std::pow(
        1.0 - light[i].x - TruthAt(subject(), &question.Position.x, &question.Normal.x), 2.0);
    }
    return std::sqrt(squares / static_cast<double>(light.size()));
  };
  return steps;
}

/// Builds a room lit by a panel below its ceiling.
struct Room
{
  Scene Drawn;
  std::unique_ptr<RayScene> Rays;
  std::unique_ptr<Illumination> Light;
  std::vector<SeenPoint> Known;  ///< pixels with a reference value
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
    room->Known = PointsInImage(*room->Rays, stride);
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

/// `tolerance` is of irradiance over pi. The seconds are of all pixels.
Measurement AskForLight(
  const Room& room, vtkPenumbraIrradianceProvider* source, double tolerance, bool ofAllPixels)
{
  const std::vector<SeenPoint> all = PointsInImage(*room.Rays, 1);
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
  rays += Gathered(source);
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

PointQuerySteps PeersInRoom(const std::string& scene, const Rooms& room)
{
  PointQuerySteps steps;
  steps.Scene = scene;
  steps.Emitters = true;
  steps.Prepare = [=](const Peer&) {
    PointQueryScene asked;
    asked.Drawn = &room().Drawn;
    asked.Albedo = room().Light->GetSettings().Albedo;
    asked.Bounces = room().Light->GetSettings().Bounces;
    asked.Sky = 0.0;
    asked.Questions = QuestionsAt(PointsInImage(*room().Rays, 1));
    return asked;
  };
  steps.Error = [=](const PointQueryScene&, const std::vector<glm::dvec3>& light) {
    std::map<int, std::size_t> placeOf;
    for (const SeenPoint& point : PointsInImage(*room().Rays, 1))
    {
      placeOf.insert({ point.Pixel, placeOf.size() });
    }
    double squares = 0.0;
    for (std::size_t i = 0; i < room().Known.size(); ++i)
    {
      const glm::dvec3 error = light[placeOf.at(room().Known[i].Pixel)] - room().Truth[i];
      squares += glm::dot(error, error) / 3.0;
    }
    return std::sqrt(squares / static_cast<double>(room().Known.size()));
  };
  return steps;
}

void AddRoom(ChartFamily& family, const std::string& scene, const Rooms& room)
{
  const auto add = [&](const char* method, double tolerance, int space, bool cubes) {
    std::ostringstream setting;
    setting << "tolerance " << tolerance;
    family.Steps.push_back({ scene, method, setting.str(), tolerance, [=] {
                              vtkNew<Cache> cache;
                              cache->SetTolerance(tolerance);
                              cache->SetSpace(space);
                              if (cubes)
                              {
                                cache->SetGatherer(vtkNew<vtkPenumbraCubeMapGatherer>());
                              }
                              return AskForLight(room(), cache, tolerance, true);
                            } });
  };
  for (const double tolerance : { .02, .01, .005, .003, .002 })
  {
    add("Penumbra automatic (second derivative)", tolerance, Cache::WORLD, false);
  }
  for (const double tolerance : { .02, .01, .005 })
  {
    add("cache in screen space", tolerance, Cache::SCREEN, false);
    add("second derivative by cube maps", tolerance, Cache::WORLD, true);
  }
  for (const int paths : { 128, 512, 2048, 8192 })
  {
    family.Steps.push_back({ scene, "path tracing", std::to_string(paths) + " paths", 0.0, [=] {
                              vtkNew<vtkPenumbraBruteForceIrradiance> source;
                              source->SetMinimumRays(paths / PathsPerRay);
                              source->SetMaximumRays(paths);
                              return AskForLight(
                                room(), source, NoiseOfOnePath / std::sqrt(paths), false);
                            } });
  }
}

}

ChartFamily IrradianceFamily(const ChartRequest& request)
{
  const int size = request.Quick ? 256 : 512;
  ChartFamily family{ "irradiance", "Interpolated occlusion and light",
    "RMSE over surface pixels or points", "rays per pixel or point",
    "closed form at 512x512; in the room, of irradiance over pi, 16384 independent paths at a "
    "fraction of the "
    "pixels; on meshes 65536 rays at a fraction of the points",
    {} };
  for (const ChartMesh& mesh : request.Meshes)
  {
    AddBaking(family, mesh, request);
  }
  if (request.Meshes.empty())
  {
    const Subjects touching = SphereOnFloor(1.0, size);
    AddSteps(family, "sphere on a floor", touching, request.Quick);
    AddPeers(family, request.Peers, PeersBesideSphere("sphere on a floor", touching));
  }
  if (request.Meshes.empty() && !request.Quick)
  {
    const Subjects hovering = SphereOnFloor(1.5, size);
    AddSteps(family, "sphere over a floor", hovering, false);
    AddPeers(family, request.Peers, PeersBesideSphere("sphere over a floor", hovering));
    const Rooms room = LitRoom(256, 8, 16384);
    AddRoom(family, "light in a room of 256x256", room);
    AddPeers(family, request.Peers, PeersInRoom("light in a room of 256x256", room));
    AddBaking(family, { "burr of 12000 triangles", Burr(96) }, request);
  }
  return family;
}

}
