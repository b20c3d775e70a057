// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Baking/BakeInput.h"
#include "Benchmark.h"
#include "Room.h"
#include "SkyScenes.h"
#include "Surface.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPenumbraIrradianceFilter.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"

#include <glm/gtc/constants.hpp>

#include <cmath>
#include <map>

namespace penumbra
{
namespace
{

constexpr double Pi = glm::pi<double>();

/// Tolerance of an image, and of irradiance over pi: that of the image over the albedo.
constexpr double ImageTolerance = 1.0 / 256.0;
constexpr double MeanTolerance = ImageTolerance / .5;

constexpr int TileSize = 16;
constexpr int ReferenceStep = 8; ///< pixels between reference points in both directions

/// Points to bake, at which there are references.
constexpr std::size_t BakedReferences = 512;
constexpr double BakedTolerance = .02;

/// Errors of irradiance over pi.
struct SkyErrors
{
  double WithinShare = 0.0; ///< tiles with an RMSE of at most the tolerance in every channel
  glm::dvec3 Rmse{ 0.0 };
};

SkyErrors FindErrors(const std::vector<ImagePoint>& points, const std::vector<glm::dvec3>& found,
  const std::vector<glm::dvec3>& exact, double tolerance)
{
  SkyErrors errors;
  struct Tile
  {
    glm::dvec3 Squares{ 0.0 };
    double Count = 0.0;
  };
  std::map<int, Tile> tiles;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const glm::dvec3 error = found[i] - exact[i];
    const glm::ivec2 at = points[i].Pixel / TileSize;
    Tile& tile = tiles[at.y * SkyImageSize + at.x];
    tile.Squares += error * error;
    tile.Count += 1.0;
    errors.Rmse += error * error / static_cast<double>(points.size());
  }
  errors.Rmse = glm::sqrt(errors.Rmse);
  for (const auto& [at, tile] : tiles)
  {
    const double worst =
      std::sqrt(std::max({ tile.Squares.x, tile.Squares.y, tile.Squares.z }) / tile.Count);
    errors.WithinShare += worst <= tolerance ? 1.0 / static_cast<double>(tiles.size()) : 0.0;
  }
  return errors;
}

std::string Describe(glm::dvec3 rmse, double unit)
{
  return "RMSE over the tolerance " + Brief(rmse.x / unit) + ", " + Brief(rmse.y / unit) + ", " +
    Brief(rmse.z / unit);
}

/// Times are compared with those under a white sky.
void AddCosts(
  ResultTable& table, const std::string& scene, const CacheCost& cost, const CacheCost& white)
{
  table.Add(scene, "time over that under the white sky", cost.Seconds / white.Seconds,
    TargetKind::AtMost, 1.5,
    Brief(cost.Seconds) + " s, " + Brief(cost.Records) + " records, " + Brief(cost.Rays * 1e-6) +
      " M rays");
}

std::vector<MeasuredSky> MakeSkies()
{
  return { { "white sky", glm::dvec3(1.0), nullptr, 1.0 },
    { "blue sky", { 0.0, 0.0, 1.0 }, nullptr, 1.0 }, { "red sky", { 1.0, 0.0, 0.0 }, nullptr, 1.0 },
    { "10 x", glm::dvec3(10.0), nullptr, 10.0 }, { ".01 x", glm::dvec3(.01), nullptr, .01 } };
}

/// Light is linear in the sky: the reference under a white one is that under any sky of one color.
std::vector<glm::dvec3> Multiply(const std::vector<glm::dvec3>& white, glm::dvec3 color)
{
  std::vector<glm::dvec3> values;
  for (const glm::dvec3& value : white)
  {
    values.push_back(color * value);
  }
  return values;
}

/// Casts an image with indirect light and compares the pixels that show a single surface
/// with `exact`, irradiance over pi at `queried`. The sky is scaled to a mean radiance of 1.
void MeasureImage(ResultTable& table, const std::string& provider, const std::string& row,
  vtkRenderer* renderer, const RayScene& rays, const MeasuredSky& sky,
  const std::vector<ImagePoint>& queried, const std::vector<glm::dvec3>& exact,
  double& whiteSeconds)
{
  const IlluminationSettings settings = MakeIlluminationSettings(sky);
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(SkyImageSize, SkyImageSize);
  caster->SetTolerance(ImageTolerance);
  caster->SetLightTolerance(ImageTolerance);
  caster->IndirectLightOn();
  caster->SetEnvironmentColor(sky.Color.x, sky.Color.y, sky.Color.z);
  caster->SetEnvironment(sky.Environment);
  if (sky.Environment)
  {
    sky.Environment->SetIntensity(1.0 / sky.MeanRadiance);
  }
  caster->SetAlbedo(settings.Albedo);
  caster->SetBounces(settings.Bounces);
  caster->SetIrradianceProvider(MakeProvider(provider, true));
  caster->SetNumberOfThreads(1);
  const double start = Seconds();
  caster->Update();
  const double seconds = Seconds() - start;
  whiteSeconds = whiteSeconds > 0.0 ? whiteSeconds : seconds;
  vtkDataArray* colors = caster->GetOutput()->GetPointData()->GetArray("Color");
  std::vector<ImagePoint> points;
  std::vector<glm::dvec3> found;
  std::vector<glm::dvec3> truth;
  for (std::size_t i = 0; i < queried.size(); ++i)
  {
    const ImagePoint& point = queried[i];
    if (ShowsOneSurface(rays, point.Pixel))
    {
      const vtkIdType pixel = point.Pixel.y * SkyImageSize + point.Pixel.x;
      points.push_back(point);
      found.emplace_back(colors->GetComponent(pixel, 0), colors->GetComponent(pixel, 1),
        colors->GetComponent(pixel, 2));
      truth.push_back(double(settings.Albedo) / sky.MeanRadiance *
        glm::dvec3(rays.GetSurfaces()[point.Surface].Front.DiffuseColor) * exact[i]);
    }
  }
  const SkyErrors errors = FindErrors(points, found, truth, ImageTolerance);
  table.Add(row, "image: share of tiles within the tolerance", errors.WithinShare,
    TargetKind::AtLeast, .95, Describe(errors.Rmse, ImageTolerance));
  table.Add(row, "image: time over that under the white sky", seconds / whiteSeconds,
    TargetKind::AtMost, 1.5, Brief(seconds) + " s");
}

void MeasureScene(
  LightBenchmark& benchmark, const std::string& name, const Scene& scene, vtkRenderer* renderer)
{
  ResultTable& table = benchmark.Results;
  const RayScene rays(scene, 1);
  double whiteImageSeconds = 0.0;
  const std::vector<ImagePoint> points = FindImagePoints(rays, 1);
  const std::vector<ImagePoint> queried = FindImagePoints(rays, ReferenceStep);
  std::vector<MeasuredSky> skies = MakeSkies();
  skies.push_back(MakeColoredSky());
  skies.push_back(MakeSunSky());
  std::vector<glm::dvec3> white;
  CacheCost whiteCost;
  for (const MeasuredSky& sky : skies)
  {
    const Illumination light(rays, MakeIlluminationSettings(sky));
    std::vector<glm::dvec3> exact;
    if (sky.Environment || white.empty())
    {
      exact = FindReference(light, queried);
      white = white.empty() ? exact : white;
    }
    else
    {
      exact = Multiply(white, sky.Color);
    }
    CacheCost cost;
    const double tolerance = sky.MeanRadiance * MeanTolerance;
    const std::vector<glm::dvec3> found = AskCache(light, tolerance, points, queried, cost);
    whiteCost = whiteCost.Seconds > 0.0 ? whiteCost : cost;
    const SkyErrors errors = FindErrors(queried, found, exact, tolerance);
    const std::string row = name + ", " + sky.Name;
    table.Add(row, "share of tiles within the tolerance", errors.WithinShare, TargetKind::AtLeast,
      .95, Describe(errors.Rmse, tolerance));
    AddCosts(table, row, cost, whiteCost);
    if (sky.Environment || sky.Name == "white sky")
    {
      MeasureImage(benchmark.Results, benchmark.Provider, row, renderer, rays, sky, queried, exact,
        whiteImageSeconds);
    }
  }
}

/// Baked mesh, with the points at which there are references.
struct BakedScene
{
  vtkSmartPointer<vtkPolyData> Mesh;
  BakeInput Input;
  std::vector<ImagePoint> Points;
  std::vector<vtkIdType> Ids;

  explicit BakedScene(vtkPolyData* mesh)
    : Mesh(mesh),
      Input(PrepareBakeInput(mesh, BakeInputOptions()))
  {
    const std::vector<RecordCandidate>& sites = this->Input.Sites;
    for (std::size_t k = 0; k < BakedReferences; ++k)
    {
      const std::size_t i = k * sites.size() / BakedReferences;
      const glm::dvec3 normal(sites[i].Normal);
      this->Points.push_back(
        { {}, this->Input.OccluderScene.ToWorld(sites[i].Position), normal, normal });
      this->Ids.push_back(this->Input.Ids[i]);
    }
  }
};

std::vector<glm::dvec3> BakeSky(
  const BakedScene& scene, const MeasuredSky& sky, int method, CacheCost& cost)
{
  const IlluminationSettings settings = MakeIlluminationSettings(sky);
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(scene.Mesh);
  filter->SetQuantity(vtkPenumbraIrradianceFilter::IRRADIANCE);
  filter->SetMethod(method);
  filter->SetTolerance(BakedTolerance);
  filter->SetEnvironmentColor(sky.Color.x, sky.Color.y, sky.Color.z);
  filter->SetEnvironment(sky.Environment);
  filter->SetAlbedo(settings.Albedo);
  filter->SetBounces(settings.Bounces);
  filter->SetNumberOfThreads(1);
  const double start = Seconds();
  filter->Update();
  cost.Seconds = Seconds() - start;
  const auto count = [&](const char* name) {
    return filter->GetStatistics()->GetArray(name)->GetComponent(0, 0);
  };
  cost.Records = count("Cache/Records");
  cost.Rays = count("Rays/Total");
  vtkDataArray* values =
    vtkPolyData::SafeDownCast(filter->GetOutput())->GetPointData()->GetArray("Irradiance");
  std::vector<glm::dvec3> means;
  for (const vtkIdType id : scene.Ids)
  {
    means.emplace_back(values->GetComponent(id, 0) / Pi, values->GetComponent(id, 1) / Pi,
      values->GetComponent(id, 2) / Pi);
  }
  return means;
}

}

void MeasureSkies(LightBenchmark& benchmark)
{
  const vtkSmartPointer<vtkPolyData> head = ReadHead(benchmark);
  MeasureScene(benchmark, "boxes", MakeBoxScene(), MakeBoxRenderer());
  MeasureScene(benchmark, "head", MakeHeadScene(head), MakeHeadRenderer(head));
}

void MeasureBakedSkies(LightBenchmark& benchmark)
{
  ResultTable& table = benchmark.Results;
  const BakedScene scene(MakeBakedMesh(ReadHead(benchmark)));
  const RayScene rays(scene.Input.OccluderScene, 1);
  std::vector<MeasuredSky> skies = MakeSkies();
  skies.push_back(MakeColoredSky());
  skies.push_back(MakeSunSky());
  std::vector<glm::dvec3> exact;
  std::map<int, std::vector<glm::dvec3>> white;
  std::map<int, CacheCost> whiteCosts;
  for (const MeasuredSky& sky : skies)
  {
    const bool isFirst = exact.empty();
    const bool needsReference = isFirst || sky.Environment;
    exact = needsReference
      ? FindReference(Illumination(rays, MakeIlluminationSettings(sky)), scene.Points)
      : exact;
    if (isFirst)
    {
      white[-1] = exact;
    }
    const std::vector<glm::dvec3> truth = sky.Environment ? exact : Multiply(white[-1], sky.Color);
    const double tolerance = sky.MeanRadiance * BakedTolerance / Pi;
    for (const int method :
      { vtkPenumbraIrradianceFilter::AUTOMATIC, vtkPenumbraIrradianceFilter::BRUTE_FORCE })
    {
      if (method == vtkPenumbraIrradianceFilter::BRUTE_FORCE && sky.MeanRadiance != 1.0)
      {
        continue;
      }
      CacheCost cost;
      const std::vector<glm::dvec3> found = BakeSky(scene, sky, method, cost);
      const glm::dvec3 rmse = FindErrors(scene.Points, found, truth, tolerance).Rmse / tolerance;
      if (isFirst)
      {
        whiteCosts[method] = cost;
      }
      const std::string row = std::string("baked head, ") +
        (method == vtkPenumbraIrradianceFilter::AUTOMATIC ? "" : "brute force, ") + sky.Name;
      table.Add(row, "largest RMSE of a channel over the tolerance",
        std::max({ rmse.x, rmse.y, rmse.z }), TargetKind::AtMost, 1.0, Describe(rmse, 1.0));
      AddCosts(table, row, cost, whiteCosts[method]);
    }
  }
}

}
