// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Antialiasing: OpenGL's methods, samples on a grid, the subdivision of [AA], and exact edges to a
// tolerance. The error is over edge pixels; the reference is exact areas or thousands of samples
// per pixel.
#include "ChartFamilies.h"

#include "BruteForce/ImageErrors.h"
#include "PovRay.h"
#include "Scenes/TestScene.h"
#include "TemporaryFolder.h"
#include "TriangleScene.h"

#include "vtkCameraPass.h"
#include "vtkNew.h"
#include "vtkPenumbraRayCasterConstants.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSSAAPass.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <limits>
#include <sstream>

namespace penumbra
{

namespace
{

constexpr int Repetitions = 3;

/// Measurements that take longer are not repeated, in seconds.
constexpr double LongSeconds = .5;

/// vtkSSAAPass renders sqrt(5) times as wide and as high.
constexpr double SsaaSamples = 5.0;

/// A renderer with its reference.
struct Subject
{
  vtkSmartPointer<vtkRenderer> Renderer;
  int Size = 0;
  std::vector<glm::dvec3> Truth;
  std::vector<bool> IsEdge;
};

using Subjects = std::function<Subject&()>;

Subjects FlatRods(int size)
{
  return Lazily<Subject>([size] {
    const std::vector<Shape> rods = Rods(size, size, size / 16);
    const std::vector<double> shares = SharesOf(rods, size, size);
    return std::make_shared<Subject>(Subject{
      RendererOf(rods, size, size), size, WhiteOnBlack(shares), PartlyCoveredPixels(shares) });
  });
}

Subjects LitMesh(const vtkSmartPointer<vtkPolyData>& mesh, int size, int samples)
{
  return Lazily<Subject>([=] {
    const vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
    AddMesh(renderer, mesh, true)->GetProperty()->SetInterpolationToFlat();
    LookAlong(renderer, { -.6, 1.0, -.4 }, { 0.0, 0.0, 1.0 }, size, size);
    const BruteForceImage truth =
      DrawByBruteForce(BruteForceOf(renderer, size, size), size, size, samples);
    return std::make_shared<Subject>(
      Subject{ renderer, size, truth.Colors, SilhouettePixels(truth) });
  });
}

double EdgeError(const Subject& subject, const std::vector<glm::dvec3>& colors)
{
  return Compare(colors, subject.Truth, subject.IsEdge).Edge;
}

enum class Smoothing
{
  None,
  Fxaa,
  Ssaa
};

Measurement MeasureOpenGL(const Subject& subject, int samples, Smoothing smoothing)
{
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(samples);
  window->SetSize(subject.Size, subject.Size);
  window->AddRenderer(subject.Renderer);
  subject.Renderer->SetUseFXAA(smoothing == Smoothing::Fxaa);
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkSSAAPass> fine;
  fine->SetDelegatePass(steps);
  subject.Renderer->SetPass(smoothing == Smoothing::Ssaa ? fine.Get() : nullptr);
  Measurement result;
  result.Seconds = std::numeric_limits<double>::infinity();
  for (int frame = -1; frame < Repetitions; ++frame)
  {
    const double start = CpuSeconds();
    window->Render();
    window->WaitForCompletion();
    result.Seconds = frame < 0 ? result.Seconds : std::min(result.Seconds, CpuSeconds() - start);
  }
  vtkNew<vtkUnsignedCharArray> bytes;
  window->GetPixelData(0, 0, subject.Size - 1, subject.Size - 1, 0, bytes);
  std::vector<glm::dvec3> colors;
  for (vtkIdType i = 0; i < bytes->GetNumberOfTuples(); ++i)
  {
    colors.emplace_back(bytes->GetTypedComponent(i, 0) / 255.0,
      bytes->GetTypedComponent(i, 1) / 255.0, bytes->GetTypedComponent(i, 2) / 255.0);
  }
  // The number of samples in use cannot be queried from a window, which may have fewer than
  // requested.
  result.Count =
    smoothing == Smoothing::Ssaa ? SsaaSamples : std::max(1, window->GetMultiSamples());
  result.Error = EdgeError(subject, colors);
  fine->ReleaseGraphicsResources(window);
  subject.Renderer->SetPass(nullptr);
  subject.Renderer->UseFXAAOff();
  window->RemoveRenderer(subject.Renderer);
  return result;
}

Measurement MeasureRays(
  const Subject& subject, const std::function<void(vtkPenumbraRayCaster*)>& choose)
{
  Measurement result;
  result.Seconds = std::numeric_limits<double>::infinity();
  for (int time = 0; time < Repetitions && !(time > 0 && result.Seconds > LongSeconds); ++time)
  {
    const Answer answer = Cast(subject.Renderer, subject.Size, subject.Size, choose);
    result.Seconds = std::min(result.Seconds, answer.Seconds);
    result.Error = EdgeError(subject, answer.Colors);
    result.Count = answer.RaysPerPixel;
  }
  return result;
}

/// CPU seconds of tracing only, as POV-Ray reports them.
Measurement MeasurePovRay(
  const Subject& subject, const std::string& program, const PovRayStep& step)
{
  const TemporaryFolder folder;
  const std::string file = folder.Path / "scene.pov";
  const int size = subject.Size;
  WritePovRayScene(file, subject.Renderer, BruteForceOf(subject.Renderer, size, size), size, size);
  const PovRayAnswer answer = RunPovRay(program, file, size, size, step);
  return { EdgeError(subject, answer.Colors), answer.TraceSeconds, answer.RaysPerPixel };
}

Measurement MeasureFaces(const Subject& subject, const Peer& peer, const std::string& setting)
{
  const TemporaryFolder folder;
  const std::string file = folder.Path / "scene.json";
  const int size = subject.Size;
  WriteFaces(file, subject.Renderer, BruteForceOf(subject.Renderer, size, size), size, size);
  const PeerImage answer = RunImageScript(peer, file, setting, size, size);
  return { EdgeError(subject, answer.Colors), answer.Seconds, answer.SamplesPerPixel };
}

void AddPeer(
  ChartFamily& family, const std::string& scene, const Subjects& subject, const Peer& peer)
{
  if (peer.Path.empty() || peer.Joins != family.Name)
  {
    return;
  }
  for (const std::string& setting : peer.Settings)
  {
    family.Steps.push_back(
      { scene, peer.Name, setting, 0.0, [=] { return MeasureFaces(subject(), peer, setting); } });
  }
  for (const PovRayStep& step : peer.Script.empty() ? PovRayLadder() : std::vector<PovRayStep>())
  {
    std::ostringstream setting;
    setting << "+A" << step.Threshold << " +R" << step.Depth;
    family.Steps.push_back({ scene, "POV-Ray +AM2", setting.str(), 0.0,
      [=] { return MeasurePovRay(subject(), peer.Path, step); } });
  }
}

void AddSteps(ChartFamily& family, const std::string& scene, const Subjects& subject, bool quick)
{
  const auto add = [&](const std::string& method, const std::string& setting, double tolerance,
                     const std::function<Measurement()>& measure) {
    family.Steps.push_back({ scene, method, setting, tolerance, measure });
  };
  for (const int samples : quick ? std::vector<int>{ 0, 4 } : std::vector<int>{ 0, 4, 8 })
  {
    add("OpenGL multisampled", std::to_string(std::max(samples, 1)) + " samples", 0.0,
      [=] { return MeasureOpenGL(subject(), samples, Smoothing::None); });
  }
  add("OpenGL FXAA", "FXAA", 0.0, [=] { return MeasureOpenGL(subject(), 0, Smoothing::Fxaa); });
  add("vtkSSAAPass", "SSAA", 0.0, [=] { return MeasureOpenGL(subject(), 0, Smoothing::Ssaa); });
  for (const int n :
    quick ? std::vector<int>{ 1, 4 } : std::vector<int>{ 1, 2, 3, 4, 6, 8, 12, 16 })
  {
    add("rays on a grid", std::to_string(n) + " x " + std::to_string(n), 0.0, [=] {
      return MeasureRays(subject(), [n](vtkPenumbraRayCaster* caster) {
        caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Uniform;
        caster->GetConstants().UniformSamples = n;
      });
    });
  }
  for (const int level : quick ? std::vector<int>{ 0, 3 } : std::vector<int>{ 0, 1, 2, 3, 4, 5 })
  {
    add("subdivision as in [AA]", "level " + std::to_string(level), 0.0, [=] {
      return MeasureRays(subject(), [level](vtkPenumbraRayCaster* caster) {
        caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Subdivision;
        caster->GetConstants().MaximumLevel = level;
        caster->GetConstants().FindSmallObjects = false;
      });
    });
  }
  for (const int inverse :
    quick ? std::vector<int>{ 16, 256 } : std::vector<int>{ 8, 32, 128, 256, 512, 1024, 4096 })
  {
    add("Penumbra automatic", "--tolerance 1/" + std::to_string(inverse), 1.0 / inverse, [=] {
      return MeasureRays(subject(),
        [inverse](vtkPenumbraRayCaster* caster) { caster->SetTolerance(1.0 / inverse); });
    });
  }
}

}

ChartFamily AntialiasingFamily(const ChartRequest& request)
{
  const int size = request.Quick ? 64 : 512;
  ChartFamily family{ "aa", "Antialiasing, " + std::to_string(size) + "x" + std::to_string(size),
    "RMSE over edge pixels", "rays or samples per pixel",
    "exact areas (rods); 32 x 32 samples per pixel, 16 times as many on edges (meshes)", {},
    { { "OpenGL multisampled", "OpenGL" }, { "F3D", "F3D" },
      { "rays on a grid", "1 to 256 rays per pixel" }, { "POV-Ray +AM2", "POV-Ray" },
      { "Blender", "Blender" }, { "Mitsuba", "Mitsuba" }, { "Penumbra automatic", "Penumbra" } } };
  if (request.Meshes.empty())
  {
    AddSteps(family, "thin rods", FlatRods(size), request.Quick);
  }
  std::vector<ChartMesh> meshes = request.Meshes;
  if (meshes.empty() && !request.Quick)
  {
    meshes.push_back({ "burr of 12000 triangles", Burr(96) });
  }
  for (const ChartMesh& mesh : meshes)
  {
    const Subjects subject = LitMesh(mesh.Mesh, size, request.Quick ? 8 : 32);
    AddSteps(family, mesh.Name, subject, request.Quick);
    for (const Peer& peer : request.Peers)
    {
      AddPeer(family, mesh.Name, subject, peer);
    }
  }
  return family;
}

}
