// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Ambient occlusion: VTK's pass, kernels and traced rays over several frames, the cache, and rays
// at every pixel. The error is over surface pixels; the reference is [TSSAO eq. 1] with a thousand
// rays per pixel. Meshes and acceleration structures are built and shaders are compiled before the
// clock starts.
#include "ChartFamilies.h"
#include "Scene.h"
#include "Surface.h"

#include "Embree/RayScene.h"
#include "Import/SceneExtraction.h"
#include "OcclusionReference.h"
#include "OcclusionWindow.h"
#include "Scenes.h"
#include "Scenes/TestScene.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPenumbraIrradianceCache.h"
#include "vtkPenumbraTracedEstimator.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace penumbra
{

namespace
{

using Pass = vtkPenumbraTemporalSSAOPass;
using Cache = vtkPenumbraIrradianceCache;

/// A scene with its reference and its acceleration structure.
struct Subject
{
  OcclusionTestScene Scene;
  int Size[2];
  OcclusionTruth Truth;
  std::unique_ptr<penumbra::Scene> Extracted;
  std::unique_ptr<RayScene> Rays;
};

using Subjects = std::function<Subject&()>;

Subjects Prepare(const std::function<OcclusionTestScene()>& make, bool quick)
{
  return Lazily<Subject>([=] {
    auto subject = std::make_shared<Subject>();
    subject->Scene = make();
    subject->Size[0] = quick ? 96 : 640;
    subject->Size[1] = quick ? 72 : 480;
    subject->Truth = TraceOcclusion(subject->Scene.Renderer, subject->Size, subject->Scene.Radius,
      quick ? 3 : 4, quick ? 12 : 32);
    ExtractionOptions options;
    options.Resolution[0] = subject->Size[0];
    options.Resolution[1] = subject->Size[1];
    subject->Extracted =
      std::make_unique<penumbra::Scene>(ExtractScene(subject->Scene.Renderer, options));
    subject->Rays = std::make_unique<RayScene>(*subject->Extracted, 1);
    return subject;
  });
}

OcclusionTestScene SceneOf(const ChartMesh& mesh)
{
  OcclusionTestScene scene{ mesh.Name, vtkSmartPointer<vtkRenderer>::New(), 0.0 };
  Show(scene.Renderer, mesh.Mesh);
  scene.Radius = .1 * mesh.Mesh->GetLength();
  LookAlong(scene.Renderer, { -.6, 1.0, -.4 }, { 0.0, 0.0, 1.0 }, 640, 480);
  return scene;
}

/// Removes the mesh of the given name from `meshes`; returns null if it is not among them.
vtkSmartPointer<vtkPolyData> Take(std::vector<ChartMesh>& meshes, const std::string& name)
{
  const auto found = std::find_if(
    meshes.begin(), meshes.end(), [&](const ChartMesh& mesh) { return mesh.Name == name; });
  if (found == meshes.end())
  {
    return nullptr;
  }
  const vtkSmartPointer<vtkPolyData> mesh = found->Mesh;
  meshes.erase(found);
  return mesh;
}

Measurement MeasureVtk(const Subject& subject, int samples)
{
  OcclusionWindow screen(subject.Scene.Renderer, subject.Size[0], subject.Size[1]);
  screen.UseVTKSSAOPass(subject.Scene.Radius, static_cast<unsigned int>(samples));
  screen.Draw();
  const double seconds = std::min(screen.Draw(), screen.Draw());
  return { Rmse(subject.Truth, Falloff::Constant, screen.OcclusionFromBrightness()), seconds,
    double(samples) };
}

double SamplesOf(Pass* pass)
{
  return pass->GetStatistics()->GetArray("Samples/Static")->GetComponent(0, 0);
}

Pass* Warm(OcclusionWindow& screen, const Subject& subject, const char* kernel)
{
  Pass* pass = screen.UsePenumbraPass(subject.Scene.Radius);
  pass->SetKernelName(kernel);
  pass->SetConvergeInOneRender(Pass::NEVER);
  screen.Draw();
  screen.Draw();
  return pass;
}

/// Renders the given number of frames of a static view, starting without history.
Measurement MeasureFrames(const Subject& subject, const char* kernel, Falloff falloff, int frames)
{
  OcclusionWindow screen(subject.Scene.Renderer, subject.Size[0], subject.Size[1]);
  Pass* pass = Warm(screen, subject, kernel);
  pass->SetTolerance(
    1e-4); // the changed setting discards the history; the low tolerance prevents an early stop
  Measurement result;
  for (int frame = 0; frame < frames; ++frame)
  {
    result.Seconds += screen.Draw();
  }
  result.Error = Rmse(subject.Truth, falloff, screen.Array("AmbientOcclusion"));
  // One ray replaces the samples that cost as much.
  result.Count = std::string(kernel) == "traced" ? frames : SamplesOf(pass);
  return result;
}

/// Renders as `penumbra render --engine raster` does.
Measurement MeasureAutomatic(const Subject& subject, double tolerance)
{
  OcclusionWindow screen(subject.Scene.Renderer, subject.Size[0], subject.Size[1]);
  Pass* pass = Warm(screen, subject, "automatic");
  pass->SetConvergeInOneRender(Pass::ALWAYS);
  pass->SetTolerance(tolerance);
  Measurement result;
  result.Seconds = screen.Draw();
  result.Error = Rmse(subject.Truth, Falloff::Constant, screen.Array("AmbientOcclusion"));
  result.Count = SamplesOf(pass);
  return result;
}

/// Queries a provider at points; the seconds are scaled from these to all pixels.
Measurement Ask(const Subject& subject, vtkPenumbraIrradianceProvider* source, double tolerance,
  bool onlyWhereTruthIs)
{
  const int stride = onlyWhereTruthIs ? (subject.Size[0] < 200 ? 3 : 4) : 1;
  const std::vector<SeenPoint> points = PointsInImage(*subject.Rays, stride);
  const auto pixels = static_cast<std::size_t>(subject.Size[0]) * subject.Size[1];
  std::vector<float> image(pixels);
  const double start = CpuSeconds();
  source->Begin(*subject.Rays, subject.Scene.Radius, tolerance);
  double rays = 0.0;
  for (const SeenPoint& point : points)
  {
    const auto estimate = source->Occlusion(point.Position, point.Normal);
    image[point.Pixel] = static_cast<float>(estimate.Value);
    rays += static_cast<double>(estimate.Rays);
  }
  const double scale = stride * stride;
  Measurement result;
  result.Seconds = scale * (CpuSeconds() - start);
  result.Error = Rmse(subject.Truth, Falloff::Constant, image);
  vtkNew<vtkFieldData> statistics;
  source->Report(statistics);
  if (vtkDataArray* gathered = statistics->GetArray("Rays/Gather"))
  {
    rays += gathered->GetComponent(0, 0);
  }
  result.Count = std::max(rays / static_cast<double>(points.size()), 1e-3);
  return result;
}

void AddSteps(ChartFamily& family, const std::string& scene, const Subjects& subject, bool quick)
{
  const auto add = [&](const std::string& method, const std::string& setting, double tolerance,
                     const std::function<Measurement()>& measure) {
    family.Steps.push_back({ scene, method, setting, tolerance, measure });
  };
  for (const int samples :
    quick ? std::vector<int>{ 8, 32 } : std::vector<int>{ 8, 16, 32, 64, 128, 256 })
  {
    add("vtkSSAOPass", std::to_string(samples) + " samples", 0.0,
      [=] { return MeasureVtk(subject(), samples); });
  }
  for (const char* kernel : { "volumetric", "horizon", "march", "traced" })
  {
    const Falloff falloff =
      std::string(kernel) == "volumetric" ? Falloff::Linear : Falloff::Constant;
    const std::string method = std::string(kernel) +
      (falloff == Falloff::Linear ? " (D = 1 - t/R)"
          : kernel[0] == 't'      ? " (true rays)"
                                  : "");
    for (const int frames :
      quick ? std::vector<int>{ 1, 4 } : std::vector<int>{ 1, 2, 4, 8, 16, 32, 64 })
    {
      add(method, std::to_string(frames) + (frames > 1 ? " frames" : " frame"), 0.0,
        [=] { return MeasureFrames(subject(), kernel, falloff, frames); });
    }
  }
  for (const int rays : quick ? std::vector<int>{ 8, 32 } : std::vector<int>{ 8, 32, 128, 512 })
  {
    add("rays only", std::to_string(rays) + " rays", 0.0, [=] {
      vtkNew<vtkPenumbraBruteForceIrradiance> source;
      source->SetMinimumRays(rays);
      source->SetMaximumRays(std::max(rays, 32));
      return Ask(subject(), source, 1.0, true);
    });
  }
  for (const double tolerance :
    quick ? std::vector<double>{ .04 } : std::vector<double>{ .08, .04, .02, .01, .005 })
  {
    std::ostringstream setting;
    setting << "tolerance " << tolerance;
    const auto addCache = [&](const char* method, int space) {
      add(method, setting.str(), tolerance, [=] {
        vtkNew<Cache> source;
        source->SetSpace(space);
        return Ask(subject(), source, tolerance, false);
      });
    };
    addCache("Penumbra rays: automatic (cache)", Cache::WORLD);
    addCache("cache in screen space", Cache::SCREEN);
    add("Penumbra OpenGL: automatic", setting.str(), tolerance,
      [=] { return MeasureAutomatic(subject(), tolerance); });
  }
}

}

ChartFamily OcclusionFamily(const ChartRequest& request)
{
  vtkPenumbraTracedEstimator::Register();
  ChartFamily family{ "ao",
    std::string("Ambient occlusion, ") + (request.Quick ? "96x72" : "640x480"),
    "RMSE over surface pixels", "rays or samples per pixel",
    "eq. 1 of [TSSAO], D = 1 within the radius, by " + std::string(request.Quick ? "144" : "1024") +
      " rays at a fraction of the pixels",
    {} };
  std::vector<ChartMesh> others = request.Meshes;
  const auto dragon = Take(others, "ChineseDragon-10kv");
  const auto armadillo = Take(others, "armadillo");
  const auto elephant = Take(others, "refined_elephant");
  const bool hasScans = dragon && armadillo && elephant;
  if (hasScans)
  {
    // The meshes of the benchmark scene form one scene.
    AddSteps(family, "Scans",
      Prepare([=] { return Scans(dragon, armadillo, elephant); }, request.Quick), request.Quick);
  }
  for (const ChartMesh& mesh : hasScans ? others : request.Meshes)
  {
    AddSteps(
      family, mesh.Name, Prepare([mesh] { return SceneOf(mesh); }, request.Quick), request.Quick);
  }
  if (request.Meshes.empty())
  {
    AddSteps(family, "sticks plates boxes", Prepare(Sticks, request.Quick), request.Quick);
    if (!request.Quick)
    {
      AddSteps(family, "400 spheres", Prepare(Spheres400, false), false);
    }
  }
  return family;
}

}
