// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Interreflection: a room against independent paths, closed cubes against closed forms.
#include "Benchmark.h"
#include "Surface.h"

#include "BruteForce/PathTracer.h"
#include "Embree/RayScene.h"
#include "PeerTimings.h"
#include "ResultImages.h"
#include "Scenes/Solids.h"
#include "Shading/Illumination.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPenumbraIrradianceCache.h"

#include <glm/gtc/constants.hpp>

#include <cmath>
#include <fstream>

namespace penumbra
{
namespace
{

constexpr double Pi = glm::pi<double>();
constexpr int Size = 256;
constexpr int TruthStep = 8; ///< distance in pixels, in both directions, between reference values
constexpr int Paths = 16384;

/// Accepted error of the image of the room, as irradiance over pi: about 1.7 % of its mean.
constexpr double RoomTolerance = .0034;

/// Radiance displayed as white in the image of the room.
constexpr double WhiteOfImage = .5;

struct Asked
{
  std::size_t Pixel;
  glm::dvec3 Reflectance;
  glm::dvec3 Position;
  glm::dvec3 Normal;
};

/// Surface points at the centers of every `step`-th pixel, without emitting surfaces.
std::vector<Asked> Look(const RayScene& rays, int step)
{
  const Scene& scene = rays.GetScene();
  std::vector<Asked> places;
  for (int y = step / 2; y < Size; y += step)
  {
    for (int x = step / 2; x < Size; x += step)
    {
      Ray ray;
      ray.Direction = scene.ViewCamera.RayDirection({ x + .5, y + .5 });
      const Hit hit = rays.Intersect(ray);
      if (!hit.IsHit() || scene.Surfaces[hit.Surface].Front.AmbientColor.x > 0.f)
      {
        continue;
      }
      const Surface& surface = scene.Surfaces[hit.Surface];
      const glm::dvec3 a(surface.Positions[0]);
      const glm::dvec3 normal = glm::normalize(
        glm::cross(glm::dvec3(surface.Positions[1]) - a, glm::dvec3(surface.Positions[2]) - a));
      const bool away = glm::dot(normal, glm::dvec3(ray.Direction)) > 0.0;
      places.push_back({ static_cast<std::size_t>(y) * Size + x,
        glm::dvec3(surface.Front.DiffuseColor),
        double(hit.Distance) * glm::dvec3(ray.Direction) + scene.Origin, away ? -normal : normal });
    }
  }
  return places;
}

glm::dvec3 Ask(const vtkPenumbraIrradianceProvider* source, const Asked& place, long long& rays)
{
  const auto light = source->Irradiance(&place.Position.x, &place.Normal.x, Pi * RoomTolerance);
  rays += light.Rays;
  return { light.Value[0], light.Value[1], light.Value[2] };
}

double CountOf(const vtkPenumbraIrradianceCache* cache, const char* name)
{
  vtkNew<vtkFieldData> statistics;
  cache->Report(statistics);
  return statistics->GetArray(name)->GetComponent(0, 0);
}

void MeasureRoom(IrradianceBenchmark& benchmark, int space)
{
  ResultTable& table = benchmark.Results;
  const bool onScreen = space == vtkPenumbraIrradianceCache::SCREEN;
  const PathTracer truth{ CornellLikeBox(), .5, 5, glm::dvec3(0.0) };
  Scene scene;
  AddSurfaces(scene, truth.Panels);
  LookAt(scene, { .51, -1.3, .47 }, { .5, 0.0, .5 }, 41.0, Size, Size);
  const RayScene rays(scene, 1);
  IlluminationSettings settings;
  settings.Albedo = static_cast<float>(truth.Albedo);
  settings.Bounces = truth.Bounces;
  const Illumination light(rays, settings);
  vtkNew<vtkPenumbraIrradianceCache> cache;
  cache->SetTolerance(RoomTolerance);
  cache->SetSpace(space);
  const double start = FrameSeconds();
  cache->BeginIrradiance(light, 1.0);
  const double placing = FrameSeconds() - start;
  long long own = 0;
  std::vector<glm::dvec3> image(static_cast<std::size_t>(Size) * Size, glm::dvec3(1.0));
  for (const Asked& place : Look(rays, 1))
  {
    const glm::dvec3 reflected =
      truth.Albedo * place.Reflectance / Pi * Ask(cache, place, own) / WhiteOfImage;
    image[place.Pixel] = glm::pow(reflected, glm::dvec3(1.0 / 2.2));
  }
  const double seconds = FrameSeconds() - start;
  WriteImage(benchmark.Output + (onScreen ? "/box-screen.png" : "/box.png"), Size, image);

  long long ignored = 0;
  double square = 0.0;
  double size = 0.0;
  std::uint64_t seed = 0;
  const std::string known = benchmark.Output + "/box-truth.txt"; // for peer programs
  std::ofstream file(known);
  for (const Asked& place : Look(rays, TruthStep))
  {
    const glm::dvec3 exact = truth.Irradiance(place.Position, place.Normal, Paths, seed++);
    const glm::dvec3 error = Ask(cache, place, ignored) - exact;
    file << place.Pixel % Size << ' ' << place.Pixel / Size << ' ' << exact.x << ' ' << exact.y
         << ' ' << exact.z << '\n';
    square += glm::dot(error, error);
    size += glm::dot(exact, exact);
  }
  file.close();
  const std::string name =
    std::string("box, albedo .5, 5 bounces, 256 x 256") + (onScreen ? ", screen space" : "");
  const TargetKind atMost =
    onScreen ? TargetKind::None : TargetKind::AtMost; // targets apply to the default
  table.Add(name, "RMSE over root mean square", std::sqrt(square / size), atMost, .018);
  table.Add(
    name, "records", CountOf(cache, "Cache/Records"), atMost, 10000.0, "Radiance: 11.9 thousand");
  table.Add(name, "rays, millions",
    (CountOf(cache, "Rays/Gather") + static_cast<double>(own)) * 1e-6, atMost, 12.0,
    "Radiance: 15; " + std::to_string(static_cast<double>(own) * 1e-6).substr(0, 4) +
      " M of them at pixels without a valid record");
  table.Add(name, "seconds: records, then look-ups", seconds, TargetKind::None, 0.0,
    std::to_string(placing) + " + " + std::to_string(seconds - placing));
  if (!onScreen)
  {
    CompareTimes(table, name,
      { "Radiance", benchmark.Radiance,
        "radiance.py '" + benchmark.Output + "' box '" + known + "'" },
      std::sqrt(square / size), seconds, .5);
  }
}

void MeasureFurnace(ResultTable& table, double albedo)
{
  std::vector<Panel> panels;
  AddPanels(panels, { -1.0, -1.0, -1.0 }, { 1.0, 1.0, 1.0 }, glm::dvec3(1.0));
  for (Panel& panel : panels)
  {
    panel.Emission = glm::dvec3(1.0);
  }
  Scene scene;
  AddSurfaces(scene, panels);
  LookAt(scene, { -.6, -.7, .2 }, { 0.0, 0.0, 0.0 }, 60.0, Size, Size);
  const RayScene rays(scene, 1);
  IlluminationSettings settings;
  settings.Albedo = static_cast<float>(albedo);
  settings.Bounces = 8;
  vtkNew<vtkPenumbraIrradianceCache> cache;
  cache->BeginIrradiance(Illumination(rays, settings), .02);
  // Surfaces emit 1 and reflect: Le / (1 - albedo), minus the truncated bounces.
  const double truth = (1.0 - std::pow(albedo, settings.Bounces + 1)) / (1.0 - albedo);
  long long ignored = 0;
  double worst = 0.0;
  for (int i = 0; i < 1000; ++i)
  {
    Asked place;
    const double angle = .1 * i;
    place.Position = { .9 * std::cos(angle), .9 * std::sin(2.3 * angle), -1.0 };
    place.Normal = { 0.0, 0.0, 1.0 };
    const double found = 1.0 + albedo * Ask(cache, place, ignored).x / Pi;
    worst = std::max(worst, std::abs(found / truth - 1.0));
  }
  table.Add("closed cube, albedo " + std::to_string(albedo).substr(0, 3) + ", 8 bounces",
    "greatest relative bias of the radiance", worst, TargetKind::AtMost, 5e-4, "mitsuba: 2e-4");
}

}

void MeasureLight(IrradianceBenchmark& benchmark)
{
  MeasureRoom(benchmark, vtkPenumbraIrradianceCache::WORLD);
  MeasureRoom(benchmark, vtkPenumbraIrradianceCache::SCREEN);
  MeasureFurnace(benchmark.Results, .5);
  MeasureFurnace(benchmark.Results, .8);
}

}
