// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Cost of light shafts relative to a plain frame: 400 spheres, 1024x768, medians over rounds of
// alternating frames, each compared with the plain frame of its round, see FrameClock.h.
#include "Benchmark.h"
#include "FrameTimes.h"
#include "Occlusion/FrameClock.h"
#include "Processes/MallocSettings.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkAppendPolyData.h"
#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPenumbraLightShaftPass.h"
#include "vtkPenumbraShaftConstants.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkUnsignedCharArray.h"

#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

namespace penumbra
{

namespace
{

constexpr int WarmingRounds = 2;
constexpr int Rounds = 21;

/// A window with the scene S400.
struct SphereScene
{
  SphereScene()
  {
    vtkNew<vtkAppendPolyData> all;
    for (int k = 0; k < 400; ++k)
    {
      const int i = k % 20;
      const int j = k / 20;
      vtkNew<vtkSphereSource> sphere;
      sphere->SetCenter(i, j, 0.3 * ((7 * i + 3 * j) % 5));
      sphere->SetRadius(0.6);
      sphere->SetThetaResolution(32);
      sphere->SetPhiResolution(32);
      all->AddInputConnection(sphere->GetOutputPort());
    }
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(-5.0, -5.0, -0.5);
    plane->SetPoint1(25.0, -5.0, -0.5);
    plane->SetPoint2(-5.0, 25.0, -0.5);
    this->Add(all);
    this->Add(plane);
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(1024, 768);
    this->Window->AddRenderer(this->Renderer);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(10.0, -20.0, 32.0);
    camera->SetFocalPoint(10.0, 10.0, 0.5);
    camera->SetViewUp(0.0, 0.0, 1.0);
    camera->SetViewAngle(30.0);
    this->Renderer->ResetCameraClippingRange();
    // In view: toward the far end of the plane.
    this->AddLight(14.0, 24.0, 4.0);
  }

  void Add(vtkAlgorithm* source)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(source->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    this->Renderer->AddActor(actor);
  }

  void AddLight(double x, double y, double z)
  {
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPosition(x - 10.0, y + 20.0, z - 32.0);
    light->SetFocalPoint(0.0, 0.0, 0.0);
    this->Renderer->AddLight(light);
  }

  double Frame(double azimuth)
  {
    if (this->PropsChange)
    {
      this->Renderer->GetActors()->GetLastActor()->Modified();
    }
    this->Renderer->GetActiveCamera()->Azimuth(azimuth);
    const double start = FrameSeconds();
    this->Window->Render();
    this->Window->WaitForCompletion();
    return FrameSeconds() - start;
  }

  bool PropsChange = false; ///< modify an actor before each frame
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
};

/// Page faults of the process so far, in thousands.
double PageFaults()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return 1e-3 * static_cast<double>(usage.ru_minflt);
}

/// `memory`: configuration of the C library, for the table.
void MeasureFrames(ShaftBenchmark& benchmark, const std::string& memory)
{
  const std::string scene = "S400, " + memory;
  SphereScene plain;
  SphereScene plainOfTwo;
  SphereScene one;
  SphereScene two;
  SphereScene full;
  SphereScene more;
  plainOfTwo.AddLight(6.0, 24.0, 4.0);
  two.AddLight(6.0, 24.0, 4.0);
  vtkPenumbraLightShaftPass::AddTo(one.Renderer)->SetTolerance(1.0 / 64.0);
  vtkPenumbraLightShaftPass::AddTo(two.Renderer)->SetTolerance(1.0 / 64.0);
  vtkPenumbraLightShaftPass::AddTo(full.Renderer)->SetTolerance(1.0 / 256.0);
  auto* pass = vtkPenumbraLightShaftPass::AddTo(more.Renderer);
  pass->SetTolerance(1.0 / 64.0);
  pass->GetConstants().Steps = 64;
  SphereScene mapped[4]; // shadow maps at three tolerances; the middle one with changing props
  const double tolerances[4] = { 1.0 / 64.0, 1.0 / 256.0, 1.0 / 1024.0, 1.0 / 256.0 };
  for (int i = 0; i < 4; ++i)
  {
    auto* estimator = vtkPenumbraLightShaftPass::AddTo(mapped[i].Renderer);
    estimator->SetTolerance(tolerances[i]);
    estimator->SetEstimatorToShadowMap();
  }
  mapped[3].PropsChange = true;
  constexpr int Scenes = 10;
  SphereScene* const scenes[Scenes] = { &plain, &plainOfTwo, &one, &two, &full, &more, &mapped[0],
    &mapped[1], &mapped[2], &mapped[3] };
  std::vector<double> moving[Scenes];
  std::vector<double> stopped[Scenes]; // the first static image
  std::vector<double> still[Scenes];
  double faults[Scenes] = {};
  for (int round = -WarmingRounds; round < Rounds; ++round)
  {
    for (int i = 0; i < Scenes; ++i)
    {
      const double before = PageFaults();
      const double times[3] = { scenes[i]->Frame(0.1), scenes[i]->Frame(0.0),
        scenes[i]->Frame(0.0) };
      if (round >= 0)
      {
        moving[i].push_back(times[0]);
        stopped[i].push_back(times[1]);
        still[i].push_back(times[2]);
        faults[i] += (PageFaults() - before) / (3.0 * Rounds);
      }
    }
  }
  for (int i = 0; i < Scenes; ++i)
  {
    std::printf("  scene %d: moving %.3f s, stopped %.3f s, still %.3f s\n", i, Median(moving[i]),
      Median(stopped[i]), Median(still[i]));
  }
  const double base = Median(moving[0]);
  const double first = MedianOverhead(moving[2], moving[0]);
  const double second = MedianOverhead(moving[3], moving[1]);
  char pages[80];
  std::snprintf(pages, sizeof pages, "thousands of page faults per frame: %.1f, plain %.1f",
    faults[2], faults[0]);
  ResultTable& table = benchmark.Results;
  table.Add(scene, "seconds of a plain frame", base, TargetKind::None);
  table.Add(scene, "overhead at tolerance 1/64, plain frames", first / base, TargetKind::AtMost,
    0.35, pages);
  table.Add(scene, "overhead of two lights over that of one", second / first, TargetKind::AtMost,
    1.6,
    std::string(pages) +
      "; little work is common to both: nearly all of the cost of a light is for its lit "
      "fractions");
  table.Add(scene, "overhead at tolerance 1/256, plain frames",
    MedianOverhead(moving[4], moving[0]) / base, TargetKind::None);
  table.Add(scene, "overhead at tolerance 1/64 with 64 steps, plain frames",
    MedianOverhead(moving[5], moving[0]) / base, TargetKind::None);
  const double mapTargets[3] = { 0.35, 0.6, 1.5 };
  for (int i = 0; i < 3; ++i)
  {
    const int inverse = static_cast<int>(1.0 / tolerances[i]);
    table.Add(scene, "shadow map at tolerance 1/" + std::to_string(inverse) + ", plain frames",
      MedianOverhead(moving[6 + i], moving[0]) / base, TargetKind::AtMost, mapTargets[i]);
  }
  table.Add(scene, "shadow map at tolerance 1/256 while props change, plain frames",
    MedianOverhead(moving[9], moving[0]) / base, TargetKind::None);
  table.Add(scene, "the first image that stays, plain frames",
    MedianQuotient(stopped[2], stopped[0]), TargetKind::None);
  table.Add(scene, "still, plain frames", MedianQuotient(still[2], still[0]), TargetKind::AtMost,
    1.05, pages);

  vtkNew<vtkUnsignedCharArray> before;
  vtkNew<vtkUnsignedCharArray> after;
  one.Window->GetRGBACharPixelData(0, 0, 1023, 767, 0, before);
  one.Window->Render();
  one.Window->GetRGBACharPixelData(0, 0, 1023, 767, 0, after);
  const unsigned char* a = before->GetPointer(0);
  const bool same = std::equal(a, a + before->GetNumberOfValues(), after->GetPointer(0));
  table.Add(scene, "still: identical frames", same ? 1.0 : 0.0, TargetKind::AtLeast, 1.0);
}

}

void MeasureCost(ShaftBenchmark& benchmark)
{
  MeasureFrames(benchmark, "memory as by default");
  RetainFreedMemory();
  MeasureFrames(benchmark, "memory kept");
}

}
