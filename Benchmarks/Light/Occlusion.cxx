// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Ambient occlusion and indirect light of images at the default settings: accuracy of the tiles of
// 16 x 16 pixels, of their estimated errors, and cost.
#include "Benchmark.h"
#include "OcclusionTruth.h"
#include "Scenes/AccuracyScenes.h"
#include "Scenes/Adversaries.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkMinimalStandardRandomSequence.h"
#include "vtkNew.h"
#include "vtkPLYReader.h"
#include "vtkParametricBoy.h"
#include "vtkParametricFunctionSource.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkPolyDataReader.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSTLReader.h"
#include "vtkSphereSource.h"
#include "vtkTubeFilter.h"
#include "vtkXMLPolyDataReader.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <vector>

namespace penumbra
{
namespace
{

constexpr int TileSide = 16;
constexpr double Tolerance = 1.0 / 256.0;

using MakeMesh = std::function<vtkSmartPointer<vtkPolyData>(const std::string& data)>;

struct OcclusionMesh
{
  std::string Name;
  MakeMesh Make;
  double ElevationAngle = 0.0;
};

template <typename Reader>
MakeMesh Read(const std::string& name)
{
  return [name](const std::string& data) -> vtkSmartPointer<vtkPolyData> {
    vtkNew<Reader> reader;
    reader->SetFileName((data + "/" + name).c_str());
    reader->Update();
    return reader->GetOutput();
  };
}

/// A sphere of triangles without normals, roughened at several scales.
vtkSmartPointer<vtkPolyData> MakeRoughSphere()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(500);
  sphere->SetPhiResolution(300);
  sphere->GenerateNormalsOff();
  sphere->Update();
  vtkSmartPointer<vtkPolyData> mesh = sphere->GetOutput();
  mesh->GetPointData()->SetNormals(nullptr);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double p[3];
    mesh->GetPoint(i, p);
    double height = 1.0;
    for (int k = 2; k < 7; ++k)
    {
      const double f = 3.0 * std::exp2(k);
      height += 0.35 / f *
        (std::sin(f * p[0] + 2.0 * k) * std::cos(f * p[1] - k) +
          std::sin(1.3 * f * p[2] + f * p[1]));
    }
    mesh->GetPoints()->SetPoint(i, height * p[0], height * p[1], height * p[2]);
  }
  return mesh;
}

vtkSmartPointer<vtkPolyData> MakeBoy()
{
  vtkNew<vtkParametricBoy> shape;
  vtkNew<vtkParametricFunctionSource> source;
  source->SetParametricFunction(shape);
  source->SetUResolution(150);
  source->SetVResolution(150);
  source->Update();
  return source->GetOutput();
}

/// Thin rods with six sides in random directions.
vtkSmartPointer<vtkPolyData> MakeRods()
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->Initialize(7);
  const auto next = [&] {
    random->Next();
    return random->GetValue();
  };
  for (int i = 0; i < 500; ++i)
  {
    glm::dvec3 center(next(), next(), next());
    const glm::dvec3 half =
      0.4 * glm::normalize(glm::dvec3(next() - 0.5, next() - 0.5, next() - 0.5));
    const vtkIdType ends[2] = { points->InsertNextPoint(&(center - half)[0]),
      points->InsertNextPoint(&(center += half)[0]) };
    lines->InsertNextCell(2, ends);
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetLines(lines);
  vtkNew<vtkTubeFilter> tubes;
  tubes->SetInputData(mesh);
  tubes->SetRadius(0.006);
  tubes->SetNumberOfSides(6);
  tubes->Update();
  return tubes->GetOutput();
}

MakeMesh MakeAdversaryMesh(const std::string& name, int n)
{
  return [=](const std::string&) { return FindAdversary(name)->Make(n); };
}

std::vector<OcclusionMesh> MakeMeshes()
{
  return { { "head", Read<vtkPLYReader>("head.ply") },
    { "bracket", Read<vtkSTLReader>("bracket.stl"), -50.0 },
    { "brain", Read<vtkXMLPolyDataReader>("brain.vtp") },
    { "terrain", Read<vtkXMLPolyDataReader>("terrain.vtp"), -50.0 },
    { "bell-jar", Read<vtkPolyDataReader>("bell-jar.vtk"), -50.0 },
    { "rough sphere", [](const std::string&) { return MakeRoughSphere(); } },
    { "gyroid", [](const std::string&) { return MakeGyroid(60000.0, true); }, 20.0 },
    { "flat gyroid", [](const std::string&) { return MakeGyroid(60000.0, false); }, 20.0 },
    { "Boy's surface", [](const std::string&) { return MakeBoy(); } },
    { "rods", [](const std::string&) { return MakeRods(); } },
    { "soup", MakeAdversaryMesh("Soup", 3000) } };
}

struct LightImage
{
  double Seconds = 0.0;
  double Rays = 0.0; ///< of the light
  std::vector<float> Values;
  std::vector<float> Errors;
};

enum class Effect
{
  None,
  Occlusion,
  Sun,     ///< and its shadows
  Indirect ///< light of a sun and a white sky
};

LightImage Cast(vtkRenderer* renderer, const int size[2], double tolerance, Effect effect,
  const std::string& provider, bool keep)
{
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(size[0], size[1]);
  caster->SetTolerance(tolerance);
  caster->SetAmbientOcclusion(effect == Effect::Occlusion);
  caster->SetShadows(effect == Effect::Sun || effect == Effect::Indirect);
  caster->SetIndirectLight(effect == Effect::Indirect);
  caster->SetEnvironmentColor(1.0, 1.0, 1.0);
  caster->SetBounces(1);
  caster->SetNumberOfThreads(1);
  caster->SetGlobalWarningDisplay(0);
  caster->SetIrradianceProvider(MakeProvider(provider, effect == Effect::Indirect));
  const double start = Seconds();
  caster->Update();
  LightImage image;
  image.Seconds = Seconds() - start;
  for (const char* name : { "Rays/Occlusion", "Rays/Indirect", "Rays/Gather" })
  {
    vtkDataArray* rays = caster->GetStatistics()->GetArray(name);
    image.Rays += rays ? rays->GetComponent(0, 0) : 0.0;
  }
  vtkPointData* data = caster->GetOutput()->GetPointData();
  for (vtkIdType i = 0; keep && i < caster->GetOutput()->GetNumberOfPoints(); ++i)
  {
    image.Values.push_back(static_cast<float>(data->GetArray("Color")->GetComponent(i, 0)));
    image.Errors.push_back(
      static_cast<float>(data->GetArray("EstimatedError")->GetComponent(i, 0)));
  }
  return image;
}

void WriteFloats(const std::string& file, const std::vector<float>& values)
{
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(values.data()),
    static_cast<std::streamsize>(values.size() * sizeof(float)));
}

/// Fractions of the tiles, in percent.
struct TileFractions
{
  double Above = 0.0;  ///< the error exceeds the tolerance
  double False = 0.0;  ///< only the estimate exceeds the tolerance
  double Missed = 0.0; ///< the error exceeds the tolerance, the estimate does not
  double Rmse = 0.0;   ///< over covered pixels
  double Estimate = 0.0;
};

TileFractions CompareTiles(
  const LightImage& image, const ReferenceLight& truth, const int size[2], double tolerance)
{
  TileFractions result;
  double squares = 0.0;
  double estimates = 0.0;
  double covered = 0.0;
  int tiles = 0;
  for (int low = 0; low < size[1]; low += TileSide)
  {
    for (int left = 0; left < size[0]; left += TileSide)
    {
      double square = 0.0;
      double estimate = 0.0;
      double area = 0.0;
      int count = 0;
      for (int y = low; y < std::min(low + TileSide, size[1]); ++y)
      {
        for (int x = left; x < std::min(left + TileSide, size[0]); ++x, ++count)
        {
          const std::size_t i = static_cast<std::size_t>(y) * size[0] + x;
          square +=
            (image.Values[i] - truth.Means[0][i]) * double(image.Values[i] - truth.Means[1][i]);
          estimate += image.Errors[i] * double(image.Errors[i]);
          area += truth.Coverage[i];
        }
      }
      if (area == 0.0)
      {
        continue;
      }
      ++tiles;
      squares += square;
      estimates += estimate;
      covered += area;
      const bool above = square > count * tolerance * tolerance;
      const bool reported = estimate > count * tolerance * tolerance;
      result.Above += above ? 100.0 : 0.0;
      result.False += reported && !above ? 100.0 : 0.0;
      result.Missed += above && !reported ? 100.0 : 0.0;
    }
  }
  result.Above /= tiles;
  result.False /= tiles;
  result.Missed /= tiles;
  result.Rmse = std::sqrt(std::max(squares, 0.0) / covered);
  result.Estimate = std::sqrt(estimates / covered);
  return result;
}

vtkSmartPointer<vtkRenderer> MakeRenderer(vtkPolyData* mesh, const OcclusionMesh& shown, bool lit)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetLighting(lit);
  if (!mesh->GetPointData()->GetNormals())
  {
    actor->GetProperty()->SetInterpolationToFlat();
  }
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->AddActor(actor);
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Elevation(shown.ElevationAngle);
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Zoom(1.4);
  renderer->ResetCameraClippingRange();
  return renderer;
}

}

namespace
{

void AddSun(vtkRenderer* renderer, const double* direction)
{
  vtkNew<vtkLight> sun;
  sun->SetLightTypeToSceneLight();
  sun->SetPosition(direction[0], direction[1], direction[2]);
  sun->SetFocalPoint(0.0, 0.0, 0.0);
  renderer->AddLight(sun);
}

/// The meshes whose names contain `part`.
std::vector<OcclusionMesh> FindMeshes(const std::string& part)
{
  std::vector<OcclusionMesh> found;
  std::string names;
  for (const OcclusionMesh& mesh : MakeMeshes())
  {
    names += (names.empty() ? "" : ", ") + mesh.Name;
    if (mesh.Name.find(part) != std::string::npos)
    {
      found.push_back(mesh);
    }
  }
  if (found.empty())
  {
    throw std::runtime_error("no mesh " + part + "; meshes: " + names);
  }
  return found;
}

/// Measures occlusion, or indirect light.
void MeasureMeshes(LightBenchmark& benchmark, bool isIndirect)
{
  const std::vector<OcclusionMesh> meshes = FindMeshes(benchmark.Mesh);
  const int width = benchmark.Width.empty() ? 500 : std::atoi(benchmark.Width.c_str());
  const int size[2] = { width, width * 3 / 5 };
  const double divisor =
    benchmark.InverseTolerance.empty() ? 256.0 : std::atof(benchmark.InverseTolerance.c_str());
  const double tolerance = 1.0 / divisor;
  const std::string& provider = benchmark.Provider;
  const double light = benchmark.LightFactor * tolerance;
  const double limit = std::hypot(tolerance, light);
  std::printf("%dx%d, tolerance 1/%g, of light %.4f\n", size[0], size[1], divisor, light);
  std::printf(
    "| mesh | rays per covered pixel | CPU s plain | ratio | RMSE | estimate | tiles above, %% | "
    "falsely reported, %% | above with a low estimate, %% "
    "|\n|---|---|---|---|---|---|---|---|---|\n");
  for (const OcclusionMesh& shown : meshes)
  {
    const vtkSmartPointer<vtkPolyData> mesh = shown.Make(benchmark.Data);
    const vtkSmartPointer<vtkRenderer> lit = MakeRenderer(mesh, shown, true);
    ReferenceSettings settings{ 0.0, { 0.48, 0.6, 0.64 } };
    vtkSmartPointer<vtkRenderer> measured = lit;
    if (isIndirect)
    {
      AddSun(lit, settings.Sun);
    }
    else
    {
      measured = MakeRenderer(mesh, shown, false);
      settings.Radius = FindDefaultRadius(measured);
    }
    const std::string file = benchmark.Output + "/" + shown.Name + (isIndirect ? "-indirect" : "");
    const ReferenceLight truth = FindLightTruth(
      measured, size[0], size[1], settings, file + "-" + std::to_string(width) + ".truth");
    const Effect effect = isIndirect ? Effect::Indirect : Effect::Occlusion;
    const double plain =
      Cast(lit, size, tolerance, isIndirect ? Effect::Sun : Effect::None, provider, false).Seconds;
    const LightImage image = Cast(measured, size, tolerance, effect, provider, true);
    const double occluded =
      isIndirect ? image.Seconds : Cast(lit, size, tolerance, effect, provider, false).Seconds;
    WriteFloats(file + ".values", image.Values);
    WriteFloats(file + ".errors", image.Errors);
    const TileFractions tiles = CompareTiles(image, truth, size, limit);
    double covered = 0.0;
    for (const float value : truth.Coverage)
    {
      covered += value;
    }
    std::printf("| %-14s | %7.1f | %6.3f | %5.2f | %.5f | %.5f | %5.1f | %5.1f | %5.1f |\n",
      shown.Name.c_str(), image.Rays / covered, plain, occluded / plain, tiles.Rmse, tiles.Estimate,
      tiles.Above, tiles.False, tiles.Missed);
    std::fflush(stdout);
    ResultTable& table = benchmark.Results;
    const std::string row = (isIndirect ? "indirect light, " : "occlusion, ") + shown.Name;
    table.Add(row, "tiles above the tolerance, %", tiles.Above, TargetKind::AtMost, 2.0);
    table.Add(row, "tiles falsely reported, %", tiles.False, TargetKind::AtMost, 2.0);
    table.Add(row, "tiles above with a low estimate, %", tiles.Missed, TargetKind::AtMost, 2.0);
    table.Add(row, "rays per covered pixel", image.Rays / covered, TargetKind::None);
    table.Add(row, isIndirect ? "time over that without it" : "time over that without occlusion",
      occluded / plain, TargetKind::AtMost, 3.0);
  }
}

}

void MeasureOcclusion(LightBenchmark& benchmark)
{
  MeasureMeshes(benchmark, false);
}

void MeasureIndirect(LightBenchmark& benchmark)
{
  MeasureMeshes(benchmark, true);
}

}
