// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The subcommand `chart`: measures and plots speed against accuracy of every method.
#include "Chart.h"
#include "ChartFamilies.h"
#include "ChartPlot.h"
#include "ChartTable.h"
#include "Engines/Engine.h"
#include "Files/AtomicFile.h"
#include "Files/InputFiles.h"
#include "Input/ReadLimit.h"
#include "Input/Surfaces.h"
#include "Parsing/Arguments.h"
#include "Peers.h"
#include "Processes/CommandError.h"
#include "Processes/ProgressLine.h"
#include "Processes/Worker.h"
#include "Program.h"

#include "vtkAppendPolyData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkTriangleFilter.h"
#include "vtkVersion.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>

namespace penumbra
{

namespace
{

struct ChartOptions
{
  std::vector<std::string> Files;
  std::string Output;
  std::string Family = "all";
  bool Quick = false;
  std::string Window = "auto";
  std::string Progress = "auto";
};

/// Reads a file as one triangle mesh, named by the file name without folder, extension and commas.
ChartMesh ReadMesh(const std::string& path)
{
  EnterPhase(path, BadInput);
  vtkNew<vtkAppendPolyData> append;
  for (const vtkSmartPointer<vtkPolyData>& part : ReadSurfaces(path).Meshes)
  {
    append->AddInputData(part);
  }
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(append->GetOutputPort());
  triangles->PassLinesOff();
  triangles->PassVertsOff();
  triangles->Update();
  if (triangles->GetOutput()->GetNumberOfPolys() == 0)
  {
    throw CommandError(BadInput, path + " has no polygons; charts require surface meshes");
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(triangles->GetOutput()->GetPoints());
  mesh->SetPolys(triangles->GetOutput()->GetPolys());
  std::string name = std::filesystem::path(path).stem().string();
  std::replace(name.begin(), name.end(), ',', ' ');
  return { name, mesh };
}

std::string Processor()
{
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
  {
    if (line.compare(0, 10, "model name") == 0)
    {
      return line.substr(line.find(':') + 2);
    }
  }
  return "unknown processor";
}

std::vector<std::string> Metadata(const ChartFamily& family, const std::vector<Peer>& peers)
{
  std::string others;
  for (const Peer& peer : peers)
  {
    if (!peer.Path.empty() && peer.Joins == family.Name)
    {
      others += (others.empty() ? "" : ", ") + peer.Name + " " + peer.Version;
    }
  }
  return { RunLine(), "machine: " + Processor(),
    "penumbra " PENUMBRA_VERSION ", VTK " + std::string(vtkVersion::GetVTKVersion()) +
      ", compiler " __VERSION__,
    "peer programs: " + (others.empty() ? "none" : others), "reference: " + family.Truth,
    "seconds: CPU seconds of one thread" };
}

std::vector<ChartFamily> Families(const ChartOptions& options, const ChartRequest& request)
{
  using Make = ChartFamily (*)(const ChartRequest&);
  const std::pair<const char*, Make> makers[] = { { "aa", AntialiasingFamily },
    { "ao", OcclusionFamily }, { "irradiance", IrradianceFamily }, { "shafts", ShaftFamily } };
  std::vector<ChartFamily> families;
  for (const auto& [name, make] : makers)
  {
    if (options.Family == "all" || options.Family == name)
    {
      families.push_back(make(request));
    }
  }
  return families;
}

/// Writes the distance of Penumbra's automatic settings from the Pareto front to a file and to the
/// terminal.
void WriteDistances(const std::string& path, const std::vector<ChartRow>& rows)
{
  std::ostringstream text;
  text << "scene,method,setting,off,than,times its seconds,times its error,off by counts\n";
  for (const ChartRow& row : rows)
  {
    if (row.Method.find("automatic") != std::string::npos)
    {
      const ParetoDistance time = DistanceToFront(rows, row, &ChartRow::Seconds);
      const double counts = DistanceToFront(rows, row, &ChartRow::Count).Off;
      text << row.Scene << ',' << row.Method << ',' << row.Setting << ',' << time.Off << ','
           << time.Than << ',' << time.TimesCost << ',' << time.TimesError << ',' << counts << "\n";
      std::cout << "  " << row.Scene << ": " << row.Method << ", " << row.Setting << ": "
                << (time.Off > 0.0 ? std::to_string(std::lround(100.0 * time.Off)) +
                         " % off the front, that is " + time.Than
                                   : "on the front")
                << "\n";
    }
  }
  AtomicFile file(path, "--output");
  file.Write(text.str());
  file.Commit();
}

void Measure(const ChartFamily& family, ChartTable& table, ProgressLine& progress)
{
  std::size_t done = 0;
  for (const ChartStep& step : family.Steps)
  {
    progress.Show(family.Name + ": " + step.Scene + "; " + step.Method + "; " + step.Setting,
      static_cast<double>(done++) / static_cast<double>(family.Steps.size()));
    if (!table.Has(step.Scene, step.Method, step.Setting))
    {
      EnterPhase(family.Name + ", " + step.Method + ", " + step.Setting, Unavailable);
      const Measurement measured = step.Measure();
      table.Add({ step.Scene, step.Method, step.Setting, step.Asked, measured.Error,
        measured.Seconds, measured.Count });
    }
  }
}

int Chart(const ChartOptions& options)
{
  for (const std::string& file : options.Files)
  {
    RecordInput(file);
  }
  std::error_code error;
  std::filesystem::create_directories(options.Output, error);
  if (error)
  {
    throw CommandError(BadInput, "--output " + options.Output + ": " + error.message());
  }
  EnterPhase("the chart's window", Unavailable);
  ChooseWindow(options.Window);
  // One thread, so that its CPU seconds are the cost of a method.
  setenv("LP_NUM_THREADS", "0", 1);
  vtkSMPTools::Initialize(1);
  ChartRequest request;
  request.Quick = options.Quick;
  std::string subject = options.Quick ? "quick" : "full";
  for (const std::string& file : options.Files)
  {
    request.Meshes.push_back(ReadMesh(file));
    subject += ", " + request.Meshes.back().Name;
  }
  ProgressLine progress(options.Progress);
  request.Peers = options.Quick ? std::vector<Peer>() : FindPeers();
  for (const Peer& peer : request.Peers)
  {
    std::cout << Describe(peer) << "\n";
  }
  for (const ChartFamily& family : Families(options, request))
  {
    const std::string path = options.Output + "/" + family.Name;
    ChartTable table(path + ".csv", family.Name + ", " + subject, Metadata(family, request.Peers));
    Measure(family, table, progress);
    EnterPhase("drawing " + path, Unavailable);
    const std::vector<ChartPanel> panels = PanelsOf(table.GetRows());
    WriteChartPng(family, panels, path + ".png");
    WriteChartSvg(family, panels, path + ".svg");
    if (!family.Overview.empty() && !panels.empty())
    {
      WriteChartOverview(family, panels.back(), path + "-overview.png");
    }
    progress.Clear();
    WriteDistances(path + "-front.csv", table.GetRows());
    std::cout << path << ".csv .png .svg: " << table.GetRows().size() << " steps\n" << std::flush;
  }
  return Done;
}

}

double CpuSeconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

Action DeclareChart(const CommandLine& program)
{
  const auto options = std::make_shared<ChartOptions>();
  const CommandLine app =
    program.AddSubcommand("chart", "Measure speed against accuracy of every method, and draw it");
  app.AddTexts("FILE", options->Files, "Meshes; default: built-in scenes").TypeName("");
  app
    .AddText("--output", options->Output, "DIR",
      "Folder for one .csv, .png and .svg per family; rows that it already contains are not "
      "measured again")
    .Required();
  AddChoice(app, "--family", options->Family, { "ao", "aa", "irradiance", "shafts", "all" },
    "ao: ambient occlusion; aa: antialiasing; irradiance: the cache; shafts: light shafts");
  app.AddFlag("--quick", options->Quick, "Small images and few settings: seconds per family");
  AddChoice(app, "--window", options->Window, { "auto", "osmesa", "egl", "x" },
    "Kind of OpenGL window; auto: the first that works on this machine");
  AddReadLimitOption(app);
  AddChoice(app, "--progress", options->Progress, { "auto", "bar", "plain", "none" },
    "How progress is shown on stderr; auto: a bar on a terminal");
  return [options]() {
    return RunWorkers(
      1, 1, [&](int) { return Chart(*options); }, [](int) {});
  };
}

}
