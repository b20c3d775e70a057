// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// penumbra bake: computes ambient occlusion, irradiance or direct light as an array of a mesh.
#include "Engines/Engine.h"
#include "Files/AtomicFile.h"
#include "Files/FileExtension.h"
#include "Files/InputFiles.h"
#include "Files/Report.h"
#include "Formats/MeshWriter.h"
#include "Input/EnvironmentFile.h"
#include "Input/GridOffset.h"
#include "Input/ReadLimit.h"
#include "Input/Surfaces.h"
#include "Options/SharedOptions.h"
#include "Parsing/Arguments.h"
#include "Processes/Clock.h"
#include "Processes/CommandError.h"
#include "Processes/MessageLog.h"
#include "Processes/OptionNames.h"
#include "Processes/ProgressLine.h"
#include "Processes/Worker.h"
#include "Subcommands.h"

#include "vtkAppendPolyData.h"
#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPenumbraCubeMapGatherer.h"
#include "vtkPenumbraEnvironment.h"
#include "vtkPenumbraIrradianceFilter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <sstream>

namespace penumbra
{

namespace
{

struct BakeOptions
{
  std::string File;
  std::string Output;
  std::string Quantity = "ambient-occlusion";
  double Tolerance = 0.01;
  double Radius = 0.0; ///< world units; 0: a tenth of the bounds' diagonal
  std::string Falloff = "none";
  std::optional<Vector3> EnvironmentColor; ///< unset: white
  std::string EnvironmentFile;             ///< empty: uniform color
  std::optional<Vector3> EnvironmentUp;
  double Albedo = 0.5;
  int Bounces = 3;
  LightPositions Lights;
  double LightRadius = 0.0;
  double LightAngle = 0.0;
  std::string Normals = "file";
  std::string Gatherer = "rays";
  double PointRadius = 0.0;
  double LineRadius = 0.0;
  std::string OpacityArray; ///< empty: opaque
  int Threads = 0;
  std::string Statistics;
  std::string Progress = "auto";
};

void CheckMeshExtension(const std::string& path)
{
  const std::string extension = LowerExtension(path);
  if (extension != ".vtp" && extension != ".vtu" && extension != ".vtk" && extension != ".ply")
  {
    throw CommandError(BadInput,
      "--output: " + path + " is not a supported mesh format; use .vtp .vtu .vtk or .ply");
  }
}

void RequireLights(const BakeOptions& options)
{
  RequireLightPositions(options.Lights);
  if (options.Quantity == "direct-light" && options.Lights.empty())
  {
    throw CommandError(
      BadInput, "--quantity direct-light: there is no light; give --light-position");
  }
}

/// Returns one warning for each option on the command line that has no effect.
std::vector<std::string> FindIgnoredOptions(const CommandLine& app, const BakeOptions& options)
{
  const bool occlusion = options.Quantity == "ambient-occlusion";
  const bool irradiance = options.Quantity == "irradiance";
  const bool direct = options.Quantity == "direct-light";
  const char* withoutOcclusion = "without --quantity ambient-occlusion";
  const char* withoutIrradiance = "without --quantity irradiance";
  const char* withoutDirect = "without --quantity direct-light";
  return DescribeIgnored(app,
    {
      { "--radius", !occlusion, withoutOcclusion },
      { "--falloff", !occlusion, withoutOcclusion },
      { "--falloff", std::isinf(options.Radius), "with --radius inf" },
      { "--environment-color", !irradiance, withoutIrradiance },
      { "--environment-color", !options.EnvironmentFile.empty(), "with --hdri-file" },
      { "--hdri-file", !irradiance, withoutIrradiance },
      { "--hdri-up", !irradiance, withoutIrradiance },
      { "--hdri-up", options.EnvironmentFile.empty(), "without --hdri-file" },
      { "--albedo", !irradiance, withoutIrradiance },
      { "--albedo", options.Bounces == 1, "with --bounces 1" },
      { "--bounces", !irradiance, withoutIrradiance },
      { "--light-position", !direct, withoutDirect },
      { "--light-radius", !direct, withoutDirect },
      { "--light-radius", !HasLight(options.Lights, true),
        "without a positional --light-position" },
      { "--light-angle", !direct, withoutDirect },
      { "--light-angle", !HasLight(options.Lights, false),
        "without a directional --light-position (w = 0)" },
      { "--gatherer", direct, "with --quantity direct-light" },
    });
}

/// Adds the names of arrays that `from` has and `to` has not.
void FindLostArrays(vtkFieldData* from, vtkFieldData* to, std::set<std::string>& lost)
{
  for (int i = 0; i < from->GetNumberOfArrays(); ++i)
  {
    const char* name = from->GetArrayName(i);
    if (name && !to->HasArray(name))
    {
      lost.insert(name);
    }
  }
}

/// Returns all surfaces of the file, appended to one mesh.
vtkSmartPointer<vtkPolyData> ReadMesh(const std::string& path, std::vector<std::string>& warnings)
{
  const Surfaces surfaces = ReadSurfaces(path);
  warnings.insert(warnings.end(), surfaces.Warnings.begin(), surfaces.Warnings.end());
  vtkSmartPointer<vtkPolyData> mesh = surfaces.Meshes.front();
  if (surfaces.Meshes.size() > 1)
  {
    vtkNew<vtkAppendPolyData> append;
    for (const vtkSmartPointer<vtkPolyData>& part : surfaces.Meshes)
    {
      append->AddInputData(part);
    }
    append->Update();
    mesh = append->GetOutput();
    std::set<std::string> lost;
    for (const vtkSmartPointer<vtkPolyData>& part : surfaces.Meshes)
    {
      FindLostArrays(part->GetPointData(), mesh->GetPointData(), lost);
      FindLostArrays(part->GetCellData(), mesh->GetCellData(), lost);
    }
    lost.erase(OriginalCellIds);
    lost.erase(CurvedFaces);
    if (!lost.empty())
    {
      warnings.push_back(path + ": arrays that not all parts have were left out: " +
        Join({ lost.begin(), lost.end() }, ", "));
    }
  }
  mesh->GetCellData()->RemoveArray(OriginalCellIds);
  mesh->GetCellData()->RemoveArray(CurvedFaces);
  return mesh;
}

/// Adds 8-bit vertex colors for PLY files, which have no arrays: 1 - occlusion, the radiosity E / pi of a white
/// surface, or the direct light, clamped to 1.
void AddColors(vtkPolyData* mesh, const std::string& quantity)
{
  const bool isIrradiance = quantity == "irradiance";
  const bool isOcclusion = quantity == "ambient-occlusion";
  vtkDataArray* values = mesh->GetPointData()->GetArray(isIrradiance ? "Irradiance"
      : isOcclusion                                                  ? "AmbientOcclusion"
                                                                     : "DirectLight");
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Baked");
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(mesh->GetNumberOfPoints());
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      const double baked = values->GetComponent(i, isIrradiance ? c : 0);
      const double value = isIrradiance ? baked / vtkMath::Pi() : isOcclusion ? 1.0 - baked : baked;
      colors->SetComponent(i, c, std::round(255.0 * std::min(value, 1.0)));
    }
  }
  mesh->GetPointData()->AddArray(colors);
}

bool WriteAs(const std::string& extension, vtkPolyData* mesh, const std::string& quantity,
  const std::string& path, std::vector<std::string>& warnings)
{
  if (extension == ".ply")
  {
    const double step = FindRoundingStep(mesh->GetBounds());
    if (step > 0.0 && mesh->GetPoints()->GetDataType() == VTK_DOUBLE)
    {
      std::ostringstream text;
      text << "--output: coordinates in .ply files have single precision and are rounded to "
              "multiples of "
           << step << "; use .vtp, .vtu or .vtk";
      warnings.push_back(text.str());
    }
    AddColors(mesh, quantity);
    return WritePly(mesh, "Baked", path, warnings);
  }
  return WriteMesh(extension, mesh, path, warnings);
}

void OnProgress(vtkObject*, unsigned long, void* clientData, void* callData)
{
  static_cast<ProgressLine*>(clientData)->Show("baking", *static_cast<double*>(callData));
}

/// Returns true if hemispheres are sampled by the rasterizer.
bool UsesCubeMap(const BakeOptions& options)
{
  return options.Gatherer == "cube-map" && options.Quantity != "direct-light";
}

int Bake(const BakeOptions& options, std::vector<std::string> warnings, Clock::time_point start)
{
  if (UsesCubeMap(options))
  {
    ChooseWindow("auto", "--gatherer cube-map", "--gatherer rays");
  }
  RecordInput(options.File);
  if (options.Quantity == "irradiance")
  {
    RecordInput(options.EnvironmentFile);
  }
  AtomicFile output(options.Output, "--output");
  std::optional<AtomicFile> statistics;
  if (!options.Statistics.empty())
  {
    statistics.emplace(options.Statistics, "--statistics");
  }
  ProgressLine progress(options.Progress);
  progress.Show("reading", 0.0);
  EnterPhase(options.File, BadInput);
  Clock::time_point lap = Clock::now();
  const vtkSmartPointer<vtkPolyData> mesh = ReadMesh(options.File, warnings);
  const double readSeconds = SecondsSince(lap);
  if (mesh->GetNumberOfPolys() + mesh->GetNumberOfStrips() == 0 && !(options.PointRadius > 0.0))
  {
    throw CommandError(BadInput,
      options.File + ": the mesh has no polygons; give --point-radius to bake onto points");
  }

  EnterPhase("baking " + options.Output, Unavailable);
  lap = Clock::now();
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(mesh);
  filter->SetTolerance(options.Tolerance);
  const bool light = options.Quantity == "irradiance";
  if (light)
  {
    filter->SetQuantity(vtkPenumbraIrradianceFilter::IRRADIANCE);
  }
  if (options.Quantity == "direct-light")
  {
    filter->SetQuantity(vtkPenumbraIrradianceFilter::DIRECT_LIGHT);
    for (const std::array<double, 4>& at : options.Lights)
    {
      filter->AddLight(at[0], at[1], at[2], at[3]);
    }
    filter->SetLightRadius(options.LightRadius);
    filter->SetLightAngle(options.LightAngle);
  }
  const Vector3 environment = options.EnvironmentColor.value_or(Vector3{ 1.0, 1.0, 1.0 });
  filter->SetEnvironmentColor(environment[0], environment[1], environment[2]);
  if (light && !options.EnvironmentFile.empty())
  {
    filter->SetEnvironment(ReadEnvironment(options.EnvironmentFile, options.EnvironmentUp));
  }
  if (UsesCubeMap(options))
  {
    filter->SetGatherer(vtkNew<vtkPenumbraCubeMapGatherer>());
  }
  filter->SetAlbedo(options.Albedo);
  filter->SetBounces(options.Bounces);
  filter->SetRadius(std::min(options.Radius, std::numeric_limits<double>::max()));
  filter->SetFalloff(FindFalloff(options.Falloff));
  filter->SetComputeNormals(options.Normals == "computed");
  filter->SetPointRadius(options.PointRadius);
  filter->SetLineRadius(options.LineRadius);
  filter->SetOpacityArray(options.OpacityArray.empty() ? nullptr : options.OpacityArray.c_str());
  filter->SetNumberOfThreads(options.Threads);
  vtkNew<vtkCallbackCommand> progressObserver;
  progressObserver->SetCallback(OnProgress);
  progressObserver->SetClientData(&progress);
  filter->AddObserver(vtkCommand::ProgressEvent, progressObserver);
  CollectWarnings(filter, warnings);
  TakeErrors();
  filter->Update();
  ThrowErrors(options.File);
  const double bakeSeconds = SecondsSince(lap);

  EnterPhase("writing " + options.Output, Unavailable);
  lap = Clock::now();
  vtkPolyData* baked = vtkPolyData::SafeDownCast(filter->GetOutput());
  if (!WriteAs(
        LowerExtension(options.Output), baked, options.Quantity, output.TemporaryPath(), warnings))
  {
    output.Fail("the file is incomplete; check the free disk space");
  }
  const double writeSeconds = SecondsSince(lap);
  if (statistics)
  {
    const int threads =
      options.Threads > 0 ? options.Threads : vtkSMPTools::GetEstimatedNumberOfThreads();
    const ReportTable seconds = { { "read", readSeconds }, { "bake", bakeSeconds },
      { "write", writeSeconds }, { "total", SecondsSince(start) } };
    const Report report = { { "statistics", ToTable(filter->GetStatistics()) },
      { "estimated_error", filter->GetEstimatedError() }, { "tolerance", options.Tolerance },
      { "threads", threads }, { "seconds", seconds }, { "peak_memory_bytes", PeakMemory() } };
    statistics->Write(FormatJson(report));
    statistics->Commit();
  }
  output.Commit();
  progress.Clear();
  PrintWarnings(warnings);
  return Done;
}

void DeclareBakeOptions(const CommandLine& app, BakeOptions& options)
{
  app.AddText("FILE", options.File, "", "Mesh; `penumbra list` prints the formats").Required();
  app
    .AddText("--output", options.Output, "MESH",
      "Mesh with the array: .vtp .vtu .vtk; .ply: vertex colors, 1 - occlusion, E / pi or direct "
      "light, clamped to 1")
    .Required();
  AddChoice(app, "--quantity", options.Quantity,
    { "ambient-occlusion", "irradiance", "direct-light" },
    "Array AmbientOcclusion (occluded fraction of the hemisphere), Irradiance (direct and "
    "reflected light of the environment) or DirectLight (visible fraction of each light times the "
    "cosine, summed)");
  AddNumber(
    app, "--tolerance", options.Tolerance, "X", "Accepted RMSE over all points", { 1e-4, 1.0 });
  AddOcclusionRadiusOption(app, "--radius", options.Radius, "inf");
  AddFalloffOption(app, "--falloff", options.Falloff);
  AddTriple(app, "--environment-color", options.EnvironmentColor,
    "irradiance: radiance of rays that hit nothing; default: 1,1,1", { 0.0, 1e6 });
  AddEnvironmentOptions(app, options.EnvironmentFile, options.EnvironmentUp);
  AddNumber(app, "--albedo", options.Albedo, "A",
    "irradiance: fraction of light that the surface reflects", { 0.0, 1.0 });
  AddInteger(app, "--bounces", options.Bounces,
    "irradiance: diffuse reflections, including the one toward a viewer; 1: direct light only", 1,
    64);
  AddLightPositionOption(app, options.Lights,
    "direct-light: position of a light, w = 0: direction toward a directional light; repeatable");
  AddLightRadiusOption(app, options.LightRadius, " (direct-light)");
  AddLightAngleOption(app, options.LightAngle, " (direct-light)");
  AddChoice(app, "--normals", options.Normals, { "file", "computed" },
    "Normals of the hemispheres; file: computed if the file has none");
  AddGathererOption(app, options.Gatherer);
  AddNumber(app, "--point-radius", options.PointRadius, "R",
    "Radius of the disks that represent points of a mesh without polygons, and of spheres at the "
    "vertices of other meshes, which occlude",
    { 0.0, 1e30, true })
    .Default("");
  AddNumber(app, "--line-radius", options.LineRadius, "R",
    "Radius of tubes along the lines of the mesh, which occlude", { 0.0, 1e30, true })
    .Default("");
  app.AddText("--opacity-array", options.OpacityArray, "NAME",
    "Point array with the opacity of the mesh, in [0, 1]; default: opaque");
  AddInteger(app, "--threads", options.Threads,
    "Number of threads, 0: all; the values do not depend on it", 0, 1024);
  AddStatisticsOption(app, options.Statistics,
    "Write record and ray counts, estimated error, times and memory to this file");
  AddReadLimitOption(app);
  AddProgressOption(app, options.Progress);
}

}

Action DeclareBake(const CommandLine& program)
{
  const Clock::time_point start = Clock::now();
  const auto options = std::make_shared<BakeOptions>();
  const CommandLine app = program.AddSubcommand(
    "bake", "Compute ambient occlusion, irradiance or direct light on the points of a mesh");
  DeclareBakeOptions(app, *options);
  return [options, app, start]() {
    CheckMeshExtension(options->Output);
    RequireLights(*options);
    if (options->Statistics == options->Output)
    {
      throw CommandError(BadInput,
        "--statistics " + options->Statistics + ": the path equals --output; choose another file");
    }
    const std::vector<std::string> warnings = FindIgnoredOptions(app, *options);
    return RunWorkers(
      1, 1, [&](int) { return Bake(*options, warnings, start); }, [](int) {});
  };
}

}
