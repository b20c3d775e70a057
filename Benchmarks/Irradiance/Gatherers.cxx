// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares hemisphere sampling by rays and by cube maps, in one room and in a building of which
// most is hidden from any point.
#include "Benchmark.h"
#include "Surface.h"

#include "BruteForce/ImageErrors.h"
#include "Embree/RayScene.h"
#include "Gathering/HemisphereGrid.h"
#include "Gathering/RayGatherer.h"
#include "Scenes/Building.h"
#include "Shading/HemisphereSampling.h"

#include "vtkNew.h"
#include "vtkPenumbraCubeMapGatherer.h"

#include <cmath>
#include <set>

namespace penumbra
{
namespace
{

constexpr int Points = 48;
constexpr int DirectionsAlong =
  256; ///< square root of the number of rays that determine the hidden triangles

/// Errors at which times are compared: typical of records, and typical of references.
constexpr double Targets[] = { .004, .0008 };

struct Looks
{
  std::vector<double> Means;
  double Seconds = 0.0; ///< per hemisphere
};

std::vector<glm::vec3> PointsOnFloors(int along, int storeys)
{
  std::uint32_t random = 1;
  std::vector<glm::vec3> points;
  for (int i = 0; i < Points; ++i)
  {
    const float x = RoomSize * static_cast<float>(along) * NextFloat(random);
    const float y = RoomSize * static_cast<float>(along) * NextFloat(random);
    const float storey = std::floor(static_cast<float>(storeys) * NextFloat(random));
    points.emplace_back(x, y, RoomHeight * storey);
  }
  return points;
}

Looks LookAround(const Gatherer& gatherer, int side, const std::vector<glm::vec3>& points)
{
  const HemisphereGrid& grid = HemisphereGrid::Get(side);
  const glm::mat3 frame = FrameFromNormal({ 0.f, 0.f, 1.f });
  std::vector<glm::vec3> directions;
  std::vector<HemisphereSample> sights;
  Looks looks;
  gatherer.SampleHemisphere(
    points.front(), frame, grid, 0, directions, sights); // allocates tables and compiles shaders
  const double start = FrameSeconds();
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const auto seed = MixBits(static_cast<std::uint32_t>(i));
    gatherer.SampleHemisphere(points[i], frame, grid, seed, directions, sights);
    double sum = 0.0;
    for (const HemisphereSample& sight : sights)
    {
      sum += sight.Radiance.x;
    }
    looks.Means.push_back(sum / grid.Cells());
  }
  looks.Seconds = (FrameSeconds() - start) / static_cast<double>(points.size());
  return looks;
}

double ErrorOf(const Looks& looks, const Looks& truth)
{
  double square = 0.0;
  for (std::size_t i = 0; i < truth.Means.size(); ++i)
  {
    square += std::pow(looks.Means[i] - truth.Means[i], 2.0);
  }
  return std::sqrt(square / static_cast<double>(truth.Means.size()));
}

/// Mean fraction of the triangles that are not hit by a large number of rays from a point.
double HiddenShare(
  const RayScene& rays, const std::vector<glm::vec3>& points, std::size_t triangles)
{
  double seen = 0.0;
  for (const glm::vec3& point : points)
  {
    std::set<std::pair<std::uint32_t, std::uint32_t>> met;
    for (int k = 0; k < DirectionsAlong * DirectionsAlong; ++k)
    {
      const glm::vec2 at(k % DirectionsAlong, k / DirectionsAlong);
      const glm::vec2 square = (at + .5f) / static_cast<float>(DirectionsAlong);
      const glm::vec3 direction = DiskToHemisphere(SampleUniformDiskConcentric(square.x, square.y));
      const Hit hit = rays.Intersect({ point + glm::vec3(0.f, 0.f, 1e-3f), direction });
      if (hit.IsHit())
      {
        met.insert({ hit.Surface, hit.Primitive });
      }
    }
    seen += static_cast<double>(met.size());
  }
  return 1.0 - seen / static_cast<double>(points.size() * triangles);
}

/// Adds a setting to the table, and its error and seconds to `ladder`.
void AddStep(ResultTable& table, const std::string& scene, const std::string& what,
  const Looks& looks, const Looks& truth, std::vector<glm::dvec2>& ladder)
{
  const double error = ErrorOf(looks, truth);
  ladder.emplace_back(error, looks.Seconds);
  table.Add(scene, "RMSE by " + what, error, TargetKind::None, 0.0,
    std::to_string(1e3 * looks.Seconds).substr(0, 5) + " ms per hemisphere");
}

void Compare(ResultTable& table, const std::string& name, int along, int storeys)
{
  Scene scene;
  AddBuilding(scene, along, storeys);
  std::size_t triangles = 0;
  for (const Surface& surface : scene.Surfaces)
  {
    triangles += surface.Triangles.size();
  }
  const RayScene rays(scene, 1);
  // Every ray hits a surface eventually, so the radius is limited.
  const OcclusionGatherer byRays(rays, .5f * RoomSize);
  const std::vector<glm::vec3> points = PointsOnFloors(along, storeys);
  const Looks truth = LookAround(byRays, HemisphereGrid::MaximumSide, points);
  table.Add(name, "share of the triangles that a point does not see",
    HiddenShare(rays, points, triangles), TargetKind::None, 0.0,
    std::to_string(triangles) + " triangles");
  std::vector<glm::dvec2> rayLadder;
  for (const int side : { 8, 16, 32, 64, 128 })
  {
    AddStep(table, name, std::to_string(side * side) + " rays", LookAround(byRays, side, points),
      truth, rayLadder);
  }
  const OcclusionGatherer everywhere(rays, std::numeric_limits<float>::infinity());
  const double allRays = LookAround(everywhere, 32, points).Seconds;
  std::vector<glm::dvec2> mapLadder;
  double allMaps = 0.0;
  for (const int side : { 16, 32, 64, 128, 256 })
  {
    vtkNew<vtkPenumbraCubeMapGatherer> maker;
    maker->SetResolution(side);
    AddStep(table, name, "a cube map of " + std::to_string(side),
      LookAround(*maker->Make(byRays), 32, points), truth, mapLadder);
    if (side == 64)
    {
      allMaps = LookAround(*maker->Make(everywhere), 32, points).Seconds;
    }
  }
  for (const double target : Targets)
  {
    table.Add(name,
      "time at an RMSE of " + std::to_string(target).substr(1, 5) + ", cube maps over rays",
      CostAtError(mapLadder, target) / CostAtError(rayLadder, target), TargetKind::None, 0.0,
      std::string("radius of half a room") +
        (IsExtrapolated(mapLadder, target) || IsExtrapolated(rayLadder, target) ? ", extrapolated"
                                                                                : ""));
  }
  table.Add(name, "time of a look, a cube map of 64 over 1024 rays", allMaps / allRays,
    TargetKind::None, 0.0,
    "unlimited radius: " + std::to_string(1e3 * allMaps).substr(0, 5) + " ms over " +
      std::to_string(1e3 * allRays).substr(0, 5));
}

}

void MeasureGatherers(IrradianceBenchmark& benchmark)
{
  Compare(benchmark.Results, "one room", 1, 1);
  Compare(benchmark.Results, "building of 100 rooms", 5, 4);
}

}
