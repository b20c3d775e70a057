// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"
#include "Peers.h"
#include "Scenes/AccuracyScenes.h"
#include "Scenes/TestScene.h"

#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPolyData.h"
#include "vtkPolyDataWriter.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cstdio>

namespace penumbra
{
namespace
{

constexpr int Side = 1024;
constexpr double Eye[3] = { 1.6, -4.2, 1.3 };
constexpr double ViewAngle = 30.0;

struct Gyroid
{
  double Parameter; ///< of MakeGyroid()
  double Target;    ///< largest time over that of F3D
};

/// Returns the CPU seconds of F3D, the last line that its script prints.
double TimeF3D(const Peer& peer, const std::string& script, const std::string& mesh)
{
  char view[80];
  std::snprintf(view, sizeof view, " %d %g,%g,%g %g", Side, Eye[0], Eye[1], Eye[2], ViewAngle);
  const std::string command = "LP_NUM_THREADS=0 '" + peer.Path + "' '" + script + "' '" + mesh +
    "'" + view + " 2>/dev/null | tail -n 1";
  double seconds = 0.0;
  if (FILE* pipe = popen(command.c_str(), "r"))
  {
    seconds = std::fscanf(pipe, "%lf", &seconds) == 1 ? seconds : 0.0;
    pclose(pipe);
  }
  return seconds;
}

void CompareGyroid(
  LightBenchmark& benchmark, const Peer& peer, const std::string& script, const Gyroid& gyroid)
{
  const vtkSmartPointer<vtkPolyData> mesh = MakeGyroid(gyroid.Parameter, true);
  const std::string file = benchmark.Output + "/gyroid.vtk";
  vtkNew<vtkPolyDataWriter> writer;
  writer->SetInputData(mesh);
  writer->SetFileName(file.c_str());
  writer->SetFileTypeToBinary();
  writer->Write();
  const double theirs = TimeF3D(peer, script, file);
  std::remove(file.c_str());
  const vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, mesh, true);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(Eye);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetViewAngle(ViewAngle);
  renderer->ResetCameraClippingRange();
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(Side, Side);
  caster->SetNumberOfThreads(1);
  caster->AmbientOcclusionOn();
  const double start = Seconds();
  caster->Update();
  const double ours = Seconds() - start;
  const auto count = [&](const char* name) {
    return 1e-6 * caster->GetStatistics()->GetArray(name)->GetComponent(0, 0);
  };
  const std::string row = "gyroid of " + std::to_string(mesh->GetNumberOfPolys()) + " triangles";
  const std::string remark = Brief(ours) + " s, " + Brief(count("Rays/Occlusion")) + " of " +
    Brief(count("Rays/Total")) + " M rays for occlusion; " + peer.Name + " " + peer.Version + " " +
    Brief(theirs) + " s";
  if (theirs > 0.0)
  {
    benchmark.Results.Add(row, "occlusion: time over that of F3D, supersampled", ours / theirs,
      TargetKind::AtMost, gyroid.Target, remark);
  }
}

}

void CompareWithF3D(LightBenchmark& benchmark)
{
  const std::vector<Peer> peers = FindPeers();
  const auto found =
    std::find_if(peers.begin(), peers.end(), [](const Peer& peer) { return peer.Name == "F3D"; });
  if (found->Path.empty())
  {
    std::printf("  %s\n", Describe(*found).c_str());
    return;
  }
  const std::string script =
    found->Script.substr(0, found->Script.rfind('/')) + "/f3d_occlusion.py";
  for (const Gyroid& gyroid : { Gyroid{ 34500.0, .15 }, Gyroid{ 2.9e6, .3 } })
  {
    CompareGyroid(benchmark, *found, script, gyroid);
  }
}

}
