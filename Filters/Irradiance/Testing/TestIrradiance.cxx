// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares irradiance from the cache and from brute force with closed forms and with path tracing.
#include "BruteForce/PathTracer.h"
#include "Records/PixelCandidates.h"
#include "Scenes/Solids.h"
#include "Shading/EnvironmentMap.h"
#include "Shading/Illumination.h"
#include "Surface.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPenumbraIrradianceCache.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"

#include <glm/gtc/constants.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace penumbra;

namespace
{

constexpr double Pi = glm::pi<double>();
constexpr int Size = 64;

/// Returns the visible points of the first `levels` levels of pixels.
std::vector<RecordCandidate> FindVisiblePoints(const RayScene& rays, int levels)
{
  std::vector<RecordCandidate> all;
  for (int level = 0; level < levels; ++level)
  {
    const std::vector<RecordCandidate> sites = CandidatesInImage(rays, level);
    all.insert(all.end(), sites.begin(), sites.end());
  }
  return all;
}

glm::dvec3 QueryIrradiance(const vtkPenumbraIrradianceProvider* provider, const Scene& scene,
  const RecordCandidate& site, double tolerance = .01)
{
  const glm::dvec3 world = glm::dvec3(site.Position) / scene.Scale + scene.Origin;
  const glm::dvec3 normal(site.Normal);
  const auto light = provider->Irradiance(&world.x, &normal.x, tolerance);
  return { light.Value[0], light.Value[1], light.Value[2] };
}

double GetStatistic(const vtkPenumbraIrradianceCache* cache, const char* name)
{
  vtkNew<vtkFieldData> statistics;
  cache->Report(statistics);
  return statistics->GetArray(name)->GetComponent(0, 0);
}

/// The Cornell-like box of the benchmark.
struct Room
{
  /// `emitterSide`: length of the sides of the emitting panel, whose power is the same for all.
  /// `divisions`: number of squares along each of them.
  explicit Room(int size, double emitterSide = .3, int divisions = 1)
    : Reference{ CornellLikeBox(), .5, 5, glm::dvec3(0.0) }
  {
    for (Panel& panel : this->Reference.Panels)
    {
      if (panel.Emission != glm::dvec3(0.0))
      {
        const double scale = emitterSide / .3;
        panel.Corner += .5 * (1.0 - scale) * (panel.Side + panel.Other);
        panel.Side *= scale;
        panel.Other *= scale;
        panel.Emission /= scale * scale;
      }
    }
    AddSurfaces(this->SceneData, Divide(this->Reference.Panels, divisions));
    LookAt(this->SceneData, { .51, -1.3, .47 }, { .5, 0.0, .5 }, 41.0, size, size);
  }

  /// Divides emitting panels into squares.
  static std::vector<Panel> Divide(const std::vector<Panel>& panels, int divisions)
  {
    std::vector<Panel> all;
    for (const Panel& panel : panels)
    {
      const int n = panel.Emission == glm::dvec3(0.0) ? 1 : divisions;
      for (int k = 0; k < n * n; ++k)
      {
        Panel part = panel;
        part.Side /= n;
        part.Other /= n;
        part.Corner += static_cast<double>(k % n) * part.Side;
        part.Corner += static_cast<double>(k / n) * part.Other;
        all.push_back(part);
      }
    }
    return all;
  }

  IlluminationSettings Light() const
  {
    IlluminationSettings settings;
    settings.Albedo = static_cast<float>(this->Reference.Albedo);
    settings.Bounces = this->Reference.Bounces;
    return settings;
  }

  /// Returns the irradiance of `sites` by path tracing.
  std::vector<glm::dvec3> TracePaths(const std::vector<RecordCandidate>& sites, int paths) const
  {
    std::vector<glm::dvec3> values;
    for (const RecordCandidate& site : sites)
    {
      const glm::dvec3 world = glm::dvec3(site.Position) + this->SceneData.Origin;
      values.push_back(
        this->Reference.Irradiance(world, glm::dvec3(site.Normal), paths, values.size()));
    }
    return values;
  }

  /// Returns the RMSE over the root mean square of the reference.
  double RelativeError(const vtkPenumbraIrradianceProvider* provider,
    const std::vector<RecordCandidate>& sites, const std::vector<glm::dvec3>& references) const
  {
    double square = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < sites.size(); ++i)
    {
      const glm::dvec3 error =
        QueryIrradiance(provider, this->SceneData, sites[i], .02) - references[i];
      square += glm::dot(error, error);
      size += glm::dot(references[i], references[i]);
    }
    return std::sqrt(square / size);
  }

  PathTracer Reference;
  Scene SceneData;
};

}

TEST(Irradiance, IsExactInFurnace)
{
  for (const double albedo : { .5, .8 })
  {
    std::vector<Panel> panels;
    AddPanels(panels, { -1.0, -1.0, -1.0 }, { 1.0, 1.0, 1.0 }, glm::dvec3(1.0));
    for (Panel& panel : panels)
    {
      panel.Emission = { 1.0, 2.0, .5 };
    }
    Scene scene;
    AddSurfaces(scene, panels);
    LookAt(scene, { -.6, -.7, .2 }, { 0.0, 0.0, 0.0 }, 60.0, Size, Size);
    const RayScene rays(scene, 0);
    IlluminationSettings settings;
    settings.Albedo = static_cast<float>(albedo);
    settings.Bounces = 6;
    const Illumination light(rays, settings);
    vtkNew<vtkPenumbraIrradianceCache> cache;
    vtkNew<vtkPenumbraBruteForceIrradiance> brute;
    for (vtkPenumbraIrradianceProvider* provider :
      { static_cast<vtkPenumbraIrradianceProvider*>(cache.Get()),
        static_cast<vtkPenumbraIrradianceProvider*>(brute.Get()) })
    {
      ASSERT_TRUE(provider->BeginIrradiance(light, .1));
      // Incident light after 0 to 5 reflections.
      const double reference = Pi * (1.0 - std::pow(albedo, 6)) / (1.0 - albedo);
      for (const RecordCandidate& site : FindVisiblePoints(rays, 3))
      {
        const glm::dvec3 found = QueryIrradiance(provider, scene, site);
        EXPECT_NEAR(found.x / reference, 1.0, 5e-4);
        EXPECT_NEAR(found.y / reference, 2.0, 1e-3);
        EXPECT_NEAR(found.z / reference, .5, 2.5e-4);
      }
    }
  }
}

TEST(Irradiance, IsComplementOfOcclusionUnderUniformSky)
{
  Scene scene;
  AddFloor(scene, 1000.f);
  AddSphere(scene, { 0.0, 0.0, 1.5 }, 1.0, 200);
  LookAt(scene, { 0.0, -7.0, 4.0 }, { 0.0, 0.0, .6 }, 45.0, 2 * Size, 2 * Size);
  for (Surface& surface : scene.Surfaces)
  {
    surface.Front.DiffuseColor = glm::vec3(0.f);
  }
  const RayScene rays(scene, 0);
  IlluminationSettings settings;
  settings.Environment = glm::vec3(1.f, .5f, 0.f);
  const Illumination light(rays, settings);
  vtkNew<vtkPenumbraIrradianceCache> cache;
  ASSERT_TRUE(cache->BeginIrradiance(light, .006 * Pi));
  double square = 0.0;
  const std::vector<RecordCandidate> sites = FindVisiblePoints(rays, 9);
  for (const RecordCandidate& site : sites)
  {
    const glm::dvec3 world = glm::dvec3(site.Position) + scene.Origin;
    const bool below = site.Normal.z > .999999f && world.z < 1e-3;
    const double blocked = below
      ? 1.5 / std::pow(1.5 * 1.5 + world.x * world.x + world.y * world.y, 1.5)
      : .5 * (1.0 - site.Normal.z);
    const glm::dvec3 found = QueryIrradiance(cache, scene, site);
    square += std::pow(found.x / Pi - (1.0 - blocked), 2.0);
    EXPECT_NEAR(found.y, .5 * found.x, 1e-4);
    EXPECT_EQ(found.z, 0.0);
  }
  EXPECT_LE(std::sqrt(square / static_cast<double>(sites.size())), .01);
}

TEST(Irradiance, FromCacheMatchesPathTracing)
{
  const Room room(2 * Size);
  const RayScene rays(room.SceneData, 0);
  const Illumination light(rays, room.Light());
  vtkNew<vtkPenumbraIrradianceCache> cache;
  cache->SetMinimumRadius(1.0); // the image has few pixels
  ASSERT_TRUE(cache->BeginIrradiance(light, .02 * Pi));
  const std::vector<RecordCandidate> sites = FindVisiblePoints(rays, 7);
  EXPECT_LE(room.RelativeError(cache, sites, room.TracePaths(sites, 500)), .06);
  EXPECT_LE(GetStatistic(cache, "Cache/Records"), 8000);
}

TEST(Irradiance, FromBruteForceMatchesPathTracing)
{
  const Room room(Size);
  const RayScene rays(room.SceneData, 0);
  const Illumination light(rays, room.Light());
  vtkNew<vtkPenumbraBruteForceIrradiance> provider;
  ASSERT_TRUE(provider->BeginIrradiance(light, .02));
  const std::vector<RecordCandidate> sites = FindVisiblePoints(rays, 7);
  EXPECT_LE(room.RelativeError(provider, sites, room.TracePaths(sites, 1500)), .05);
}

TEST(Irradiance, HasTheErrorOfOnePanelWithThousandsOfTriangles)
{
  // The points and their reference are those of the undivided panel.
  const Room undivided(Size);
  const std::vector<RecordCandidate> sites = FindVisiblePoints(RayScene(undivided.SceneData, 0), 7);
  const std::vector<glm::dvec3> references = undivided.TracePaths(sites, 1500);
  for (const bool cached : { false, true })
  {
    double errors[2];
    for (const int divisions : { 1, 32 })
    {
      const Room room(Size, .3, divisions);
      const RayScene rays(room.SceneData, 0);
      const Illumination light(rays, room.Light());
      vtkNew<vtkPenumbraIrradianceCache> cache;
      vtkNew<vtkPenumbraBruteForceIrradiance> brute;
      vtkPenumbraIrradianceProvider* provider = cache;
      if (!cached)
      {
        provider = brute;
      }
      ASSERT_TRUE(provider->BeginIrradiance(light, .02 * Pi));
      errors[divisions == 1 ? 0 : 1] = room.RelativeError(provider, sites, references);
    }
    EXPECT_LE(errors[1] / errors[0], 1.2) << cached;
  }
}

TEST(Irradiance, MatchesPathTracingWithATinyEmitter)
{
  const Room room(Size, .01); // 1e-4 of the area of a wall
  const RayScene rays(room.SceneData, 0);
  const Illumination light(rays, room.Light());
  vtkNew<vtkPenumbraIrradianceCache> cache;
  ASSERT_TRUE(cache->BeginIrradiance(light, .02 * Pi));
  const std::vector<RecordCandidate> sites = FindVisiblePoints(rays, 7);
  const std::vector<glm::dvec3> references = room.TracePaths(sites, 1500);
  EXPECT_LE(room.RelativeError(cache, sites, references), .06);
  vtkNew<vtkPenumbraBruteForceIrradiance> brute;
  ASSERT_TRUE(brute->BeginIrradiance(light, .02));
  EXPECT_LE(room.RelativeError(brute, sites, references), .06);
}

// Next to the walls, the light on the ceiling and on the front of the block decreases by half within a few
// pixels. With the coverage and the clamping of occlusion, the corner of the ceiling is off by 1.2.
TEST(Irradiance, HasNoBlotchesInCornersOfARoom)
{
  constexpr int ImageSize = 512;
  constexpr int TileSize = 16;
  constexpr double ImageTolerance = 1.0 / 256.0;
  const PathTracer reference{ CornellLikeBox(), .5, 5, glm::dvec3(0.0) };
  Scene scene;
  AddSurfaces(scene, reference.Panels);
  LookAt(scene, { .51, -1.3, .47 }, { .5, 0.0, .5 }, 41.0, ImageSize, ImageSize);
  const RayScene rays(scene, 0);
  IlluminationSettings settings;
  settings.Albedo = static_cast<float>(reference.Albedo);
  settings.Bounces = reference.Bounces;
  const double tolerance = 2.0 * Pi * ImageTolerance / reference.Albedo; // as the ray caster asks
  vtkNew<vtkPenumbraIrradianceCache> cache;
  cache->BeginIrradiance(Illumination(rays, settings), tolerance);
  for (const glm::ivec2 tile : { glm::ivec2(432, 432), glm::ivec2(432, 448), glm::ivec2(448, 448),
         glm::ivec2(64, 448), glm::ivec2(288, 32), glm::ivec2(336, 32) })
  {
    glm::dvec3 sum(0.0);
    double count = 0.0;
    for (int k = 0; k < TileSize * TileSize; k += 7)
    {
      RecordCandidate site;
      const glm::dvec2 pixel = glm::dvec2(tile) + glm::dvec2(k % TileSize, k / TileSize) + .5;
      ASSERT_TRUE(FindCandidate(rays, pixel, site));
      constexpr int Paths = 300;
      const glm::dvec3 exact = reference.Irradiance(glm::dvec3(site.Position) + scene.Origin,
        site.Normal, Paths, static_cast<std::uint64_t>(k));
      sum += QueryIrradiance(cache, scene, site, tolerance) - exact;
      count += 1.0;
    }
    const glm::dvec3 error = glm::abs(reference.Albedo / Pi / count * sum) / ImageTolerance;
    EXPECT_LE(std::max({ error.x, error.y, error.z }), 0.6) << tile.x << ", " << tile.y;
  }
}

TEST(Irradiance, IsIndependentOfThreadCount)
{
  const Room room(Size);
  const RayScene rays(room.SceneData, 0);
  const Illumination light(rays, room.Light());
  std::vector<glm::dvec3> values[2];
  for (const int threads : { 1, 5 })
  {
    vtkNew<vtkPenumbraIrradianceCache> cache;
    vtkSMPTools::LocalScope(
      vtkSMPTools::Config(threads), [&]() { cache->BeginIrradiance(light, .3); });
    for (const RecordCandidate& site : FindVisiblePoints(rays, 6))
    {
      values[threads == 1 ? 0 : 1].push_back(QueryIrradiance(cache, room.SceneData, site));
    }
  }
  EXPECT_EQ(values[0], values[1]);
}

TEST(Irradiance, IsFiniteNextToPositionalLight)
{
  // The light is so near to a wall that the wall is much brighter there than elsewhere.
  Room room(Size);
  penumbra::Light positional;
  positional.Kind = penumbra::Light::Kinds::Positional;
  positional.Position = glm::vec3(glm::dvec3(.05, .5, .95) - room.SceneData.Origin);
  room.SceneData.Lights.push_back(positional);
  const RayScene rays(room.SceneData, 0);
  IlluminationSettings settings = room.Light();
  settings.Shadows = true;
  const Illumination light(rays, settings);
  vtkNew<vtkPenumbraIrradianceCache> cache;
  ASSERT_TRUE(cache->BeginIrradiance(light, .3));
  for (const RecordCandidate& site : FindVisiblePoints(rays, 8))
  {
    const glm::dvec3 found = QueryIrradiance(cache, room.SceneData, site);
    ASSERT_TRUE(std::isfinite(found.x + found.y + found.z));
    ASSERT_GE(std::min({ found.x, found.y, found.z }), 0.0);
  }
}

TEST(Irradiance, RecordsRoundTripThroughPolyData)
{
  const Room room(Size);
  const RayScene rays(room.SceneData, 0);
  const Illumination light(rays, room.Light());
  vtkNew<vtkPenumbraIrradianceCache> first;
  ASSERT_TRUE(first->BeginIrradiance(light, .3));
  vtkNew<vtkPolyData> records;
  first->GetIrradianceRecords(records);
  ASSERT_GT(records->GetNumberOfPoints(), 20);
  vtkDataArray* values = records->GetPointData()->GetArray("Irradiance");
  ASSERT_TRUE(values);
  EXPECT_EQ(values->GetNumberOfComponents(), 3);
  vtkNew<vtkPenumbraIrradianceCache> second;
  second->SetInitialRecords(records);
  ASSERT_TRUE(second->BeginIrradiance(light, .3));
  vtkNew<vtkPolyData> again;
  second->GetIrradianceRecords(again);
  // Records of the last level may have reduced the radii of others, which leaves small gaps.
  EXPECT_GE(again->GetNumberOfPoints(), records->GetNumberOfPoints());
  EXPECT_LE(again->GetNumberOfPoints(), 1.03 * records->GetNumberOfPoints());
}

TEST(Irradiance, FromCacheHasSharpShadowsOfEnvironmentSun)
{
  Scene scene;
  AddFloor(scene, 1000.f);
  AddDisc(scene, .8f, 1.f);
  LookAt(scene, { 0.0, -4.0, .9 }, { 0.0, 0.0, 0.0 }, 45.0, 2 * Size, 2 * Size);
  for (Surface& surface : scene.Surfaces)
  {
    surface.Front.DiffuseColor = glm::vec3(0.f);
  }
  const RayScene rays(scene, 0);
  // Bright cap of half a degree about the zenith; radiance 0.3 elsewhere.
  constexpr int Rows = 360;
  std::vector<glm::vec3> sky(2 * static_cast<std::size_t>(Rows), glm::vec3(.3f));
  sky[2 * Rows - 2] = sky[2 * Rows - 1] = glm::vec3(3e4f);
  IlluminationSettings settings;
  settings.Map = std::make_shared<EnvironmentMap>(
    2, Rows, std::move(sky), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0));
  settings.Bounces = 1;
  const double sun = 3e4 * Pi * std::pow(std::sin(Pi / Rows), 2.0); // radiance times cosines
  vtkNew<vtkPenumbraIrradianceCache> cache;
  ASSERT_TRUE(cache->BeginIrradiance(Illumination(rays, settings), .01 * Pi));
  double square = 0.0;
  double count = 0.0;
  for (const RecordCandidate& site : FindVisiblePoints(rays, 9))
  {
    const glm::dvec3 world = glm::dvec3(site.Position) + scene.Origin;
    const double d = std::hypot(world.x, world.y);
    if (world.z > 1e-3 || std::abs(d - .8) < .03) // the disc, and the edge of its shadow
    {
      continue;
    }
    const double u = 1.0 + d * d - .64;
    const double v = 1.0 + d * d + .64;
    const double blocked = .5 * (1.0 - u / std::sqrt(v * v - 4.0 * d * d * .64));
    const double reference = .3 * Pi * (1.0 - blocked) + (d > .8 ? sun : 0.0);
    const glm::dvec3 found = QueryIrradiance(cache, scene, site, .01);
    EXPECT_NEAR(found.x, reference, .05);
    square += std::pow(found.x - reference, 2.0);
    count += 1.0;
  }
  EXPECT_LE(std::sqrt(square / count), .02);
}
