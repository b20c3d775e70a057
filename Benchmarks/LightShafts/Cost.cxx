// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What light shafts cost over a plain frame: 400 spheres, 1024x768, medians of alternating frames.
#include "Benchmark.h"

#include "vtkActor.h"
#include "vtkAppendPolyData.h"
#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPenumbraLightShaftPass.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <chrono>
#include <vector>

namespace penumbra
{

namespace
{

constexpr int Frames = 9;

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
    // In view: towards the far end of the plane.
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
    this->Renderer->GetActiveCamera()->Azimuth(azimuth);
    const auto start = std::chrono::steady_clock::now();
    this->Window->Render();
    this->Window->WaitForCompletion();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
};

double Median(std::vector<double> values)
{
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

}

void MeasureCost(ShaftBenchmark& benchmark)
{
  SphereScene plain;
  plain.AddLight(6.0, 24.0, 4.0);
  SphereScene one;
  SphereScene two;
  two.AddLight(6.0, 24.0, 4.0);
  SphereScene full;
  vtkPenumbraLightShaftPass::AddTo(one.Renderer)->SetTolerance(1.0 / 64.0);
  vtkPenumbraLightShaftPass::AddTo(two.Renderer)->SetTolerance(1.0 / 64.0);
  vtkPenumbraLightShaftPass::AddTo(full.Renderer)->SetTolerance(1.0 / 256.0);
  SphereScene* const scenes[4] = { &plain, &one, &two, &full };
  std::vector<double> moving[4];
  std::vector<double> still[4];
  for (int frame = -2; frame < Frames; ++frame)
  {
    for (int i = 0; i < 4; ++i)
    {
      const double time = scenes[i]->Frame(0.1);
      const double again = scenes[i]->Frame(0.0);
      if (frame >= 0)
      {
        moving[i].push_back(time);
        still[i].push_back(again);
      }
    }
  }
  const double base = Median(moving[0]);
  const double first = Median(moving[1]) - base;
  Table& table = benchmark.Results;
  table.Add("S400, 1024x768", "seconds of a plain frame", base, Bar::None);
  table.Add("S400, tolerance 1/64", "overhead, plain frames", first / base, Bar::AtMost, 0.35);
  table.Add("S400, tolerance 1/64", "overhead of two lights over that of one",
    (Median(moving[2]) - base) / first, Bar::AtMost, 1.6);
  table.Add("S400, tolerance 1/256, 64 steps in every pixel", "overhead, plain frames",
    (Median(moving[3]) - base) / base, Bar::None);
  table.Add("S400, still", "plain frames", Median(still[1]) / Median(still[0]), Bar::AtMost, 1.05);

  vtkNew<vtkUnsignedCharArray> before;
  vtkNew<vtkUnsignedCharArray> after;
  one.Window->GetRGBACharPixelData(0, 0, 1023, 767, 0, before);
  one.Window->Render();
  one.Window->GetRGBACharPixelData(0, 0, 1023, 767, 0, after);
  const unsigned char* a = before->GetPointer(0);
  const bool same = std::equal(a, a + before->GetNumberOfValues(), after->GetPointer(0));
  table.Add("S400, still", "identical frames", same ? 1.0 : 0.0, Bar::AtLeast, 1.0);
}

}
