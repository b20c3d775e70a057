// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"
#include "BruteForce/PathTracer.h"
#include "Embree/RayScene.h"
#include "Room.h"
#include "Scenes/Solids.h"
#include "Surface.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace penumbra
{
namespace
{

constexpr int Size = 512;
constexpr int TileSize = 16;
constexpr int ReferenceStep = 4; ///< pixels between reference points in both directions
constexpr int Paths = 1024;
constexpr double Albedo = .5;
constexpr int Bounces = 5;

const glm::dvec3 Eye(.51, -1.3, .47);
const glm::dvec3 Target(.5, 0.0, .5);
constexpr double ViewAngle = 41.0;

/// Reference colors of pixels that a single surface fills.
struct BoxReference
{
  std::vector<glm::ivec2> Pixels;
  std::vector<glm::dvec3> Colors;
};

BoxReference FindBoxReference(const std::vector<Panel>& panels)
{
  Scene scene;
  AddSurfaces(scene, panels);
  LookAt(scene, Eye, Target, ViewAngle, Size, Size);
  const RayScene rays(scene, 1);
  const PathTracer truth{ panels, Albedo, Bounces, glm::dvec3(0.0) };
  BoxReference reference;
  std::uint64_t seed = 0;
  for (const ImagePoint& point : FindImagePoints(rays, ReferenceStep))
  {
    if (!ShowsOneSurface(rays, point.Pixel))
    {
      continue;
    }
    const glm::dvec3 reflectance(scene.Surfaces[point.Surface].Front.DiffuseColor);
    reference.Pixels.push_back(point.Pixel);
    reference.Colors.push_back(Albedo / glm::pi<double>() * reflectance *
      truth.Irradiance(point.Position, point.Normal, Paths, ++seed));
  }
  return reference;
}

struct BoxErrors
{
  double Rmse = 0.0;       ///< of all pixels, of the channel with the largest
  double TileMean = 0.0;   ///< largest absolute mean difference of a tile
  double TileRmse = 0.0;   ///< largest RMSE of a tile
  double Neighbors = 0.0;  ///< largest difference between the mean differences of adjacent tiles
  glm::ivec2 Tile{ 0, 0 }; ///< that of TileMean
};

double LargestChannel(glm::dvec3 color)
{
  return std::max({ color.x, color.y, color.z });
}

BoxErrors FindErrors(const BoxReference& reference, vtkDataArray* colors)
{
  struct Sums
  {
    glm::dvec3 Differences{ 0.0 };
    glm::dvec3 Squares{ 0.0 };
    double Count = 0.0;
  };
  constexpr int Tiles = Size / TileSize;
  std::vector<Sums> tiles(Tiles * Tiles);
  Sums all;
  for (std::size_t i = 0; i < reference.Pixels.size(); ++i)
  {
    const glm::ivec2 at = reference.Pixels[i];
    const vtkIdType pixel = at.y * Size + at.x;
    const glm::dvec3 color(colors->GetComponent(pixel, 0), colors->GetComponent(pixel, 1),
      colors->GetComponent(pixel, 2));
    const glm::dvec3 difference = color - reference.Colors[i];
    for (Sums* sums : { &all, &tiles[at.y / TileSize * Tiles + at.x / TileSize] })
    {
      sums->Differences += difference;
      sums->Squares += difference * difference;
      sums->Count += 1.0;
    }
  }
  constexpr double MinimumCount = 8.0;
  BoxErrors errors;
  errors.Rmse = std::sqrt(LargestChannel(all.Squares / all.Count));
  for (int t = 0; t < Tiles * Tiles; ++t)
  {
    if (tiles[t].Count < MinimumCount)
    {
      continue;
    }
    const glm::dvec3 mean = tiles[t].Differences / tiles[t].Count;
    const double off = LargestChannel(glm::abs(mean));
    if (off > errors.TileMean)
    {
      errors.TileMean = off;
      errors.Tile = TileSize * glm::ivec2(t % Tiles, t / Tiles);
    }
    errors.TileRmse =
      std::max(errors.TileRmse, std::sqrt(LargestChannel(tiles[t].Squares / tiles[t].Count)));
    for (const int other : { t % Tiles ? t - 1 : t, t >= Tiles ? t - Tiles : t })
    {
      if (tiles[other].Count >= MinimumCount)
      {
        errors.Neighbors = std::max(errors.Neighbors,
          LargestChannel(glm::abs(tiles[other].Differences / tiles[other].Count - mean)));
      }
    }
  }
  return errors;
}

}

void MeasureBox(LightBenchmark& benchmark)
{
  const std::vector<Panel> panels = CornellLikeBox();
  const BoxReference reference = FindBoxReference(panels);
  const vtkSmartPointer<vtkRenderer> renderer = MakeRenderer(panels, Eye, Target, ViewAngle);
  for (const double tolerance : { .01, 1.0 / 256.0 })
  {
    vtkNew<vtkPenumbraRayCaster> caster;
    caster->SetRenderer(renderer);
    caster->SetResolution(Size, Size);
    caster->SetTolerance(tolerance);
    caster->SetLightTolerance(tolerance);
    caster->SetIndirectLight(true);
    caster->SetAlbedo(Albedo);
    caster->SetBounces(Bounces);
    caster->SetIrradianceProvider(MakeProvider(benchmark.Provider, true));
    caster->SetNumberOfThreads(1);
    const double start = Seconds();
    caster->Update();
    const double seconds = Seconds() - start;
    const auto count = [&](const char* name) {
      vtkDataArray* counted = caster->GetStatistics()->GetArray(name);
      return counted ? counted->GetComponent(0, 0) : 0.0;
    };
    const BoxErrors errors =
      FindErrors(reference, caster->GetOutput()->GetPointData()->GetArray("Color"));
    const bool coarse = tolerance == .01;
    const std::string row =
      "box, 512 x 512, tolerance " + (coarse ? std::string(".01") : std::string("1/256"));
    ResultTable& table = benchmark.Results;
    table.Add(row, "largest mean error of a tile over the tolerance", errors.TileMean / tolerance,
      TargetKind::AtMost, 2.0,
      "tile at " + std::to_string(errors.Tile.x) + ", " + std::to_string(errors.Tile.y));
    table.Add(row, "largest RMSE of a tile over the tolerance", errors.TileRmse / tolerance,
      TargetKind::None);
    table.Add(row, "largest step of the mean error between tiles over the tolerance",
      errors.Neighbors / tolerance, TargetKind::None);
    table.Add(row, "RMSE over the tolerance", errors.Rmse / tolerance, TargetKind::AtMost, 1.0);
    table.Add(row, "seconds", seconds, coarse ? TargetKind::AtMost : TargetKind::None, 1.5,
      Brief(count("Cache/Records")) + " records, " + Brief(count("Rays/Total") * 1e-6) +
        " M rays, " + Brief(count("Rays/Gather") * 1e-6) + " M of them for records");
  }
}

}
