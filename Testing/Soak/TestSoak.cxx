// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A long session in one process: data changes, windows are created and destroyed, passes are added
// and removed, images are ray cast and meshes are baked. No operation may fail and memory must not
// grow. PENUMBRA_SOAK_FRAMES sets the number of frames; use 2,000 for a run overnight.
#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPenumbraIrradianceCache.h"
#include "vtkPenumbraIrradianceFilter.h"
#include "vtkPenumbraLightShaftPass.h"
#include "vtkPenumbraTemporalSSAOPass.h"
#include "vtkPenumbraTracedEstimator.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <gtest/gtest.h>
#include <malloc.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <string>

using namespace penumbra;

namespace
{

constexpr int DefaultFrames = 120;
constexpr double AllowedGrowth = 8.0; // MiB

double ResidentMegabytes()
{
  malloc_trim(0);
  std::ifstream file("/proc/self/statm");
  double pages = 0.0;
  file >> pages >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

/// A window with a lit burr.
struct Session
{
  Session()
  {
    AddMesh(this->Renderer, Burr(16), true);
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPosition(.3, -1.0, .6);
    this->Renderer->AddLight(light);
    this->Open();
  }

  ~Session() { this->Close(); }

  void Open()
  {
    this->Window = vtkSmartPointer<vtkRenderWindow>::New();
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(48, 36);
    this->Window->AddRenderer(this->Renderer);
  }

  void Close()
  {
    this->Take();
    this->Window->RemoveRenderer(this->Renderer);
    this->Window = nullptr;
  }

  void Take()
  {
    vtkPenumbraTemporalSSAOPass::RemoveFrom(this->Renderer);
    vtkPenumbraLightShaftPass::RemoveFrom(this->Renderer);
  }

  vtkPolyDataMapper* Mapper()
  {
    return vtkPolyDataMapper::SafeDownCast(
      this->Renderer->GetActors()->GetLastActor()->GetMapper());
  }

  void Do(int operation, int frame)
  {
    switch (operation)
    {
      case 0:
        this->Mapper()->SetInputData(Burr(12 + 4 * (frame % 5)));
        break;
      case 1:
        this->Window->SetSize(40 + frame % 24, 30 + frame % 18);
        break;
      case 2:
        this->Renderer->GetActors()->GetLastActor()->SetPosition(.01 * (frame % 30), 0.0, 0.0);
        break;
      case 3:
        this->Mapper()->GetInput()->GetPoints()->SetPoint(0, 0.0, 0.0, .5 + .01 * (frame % 7));
        this->Mapper()->GetInput()->GetPoints()->Modified();
        break;
      case 4:
        vtkPenumbraTemporalSSAOPass::AddTo(this->Renderer)->SetTolerance(.05);
        break;
      case 5:
        vtkPenumbraLightShaftPass::AddTo(this->Renderer);
        break;
      case 6:
        this->Take();
        break;
      case 7:
        this->Renderer->GetActiveCamera()->Azimuth(11.0);
        this->Renderer->ResetCameraClippingRange();
        break;
      case 8:
        this->Cast();
        break;
      case 9:
        this->Bake();
        break;
      case 10:
        this->Close();
        this->Open();
        break;
      default:
        this->Renderer->SetViewport(0.0, 0.0, frame % 2 ? .5 : 1.0, 1.0);
        break;
    }
  }

  void Cast()
  {
    vtkNew<vtkPenumbraRayCaster> caster;
    caster->SetRenderer(this->Renderer);
    caster->SetResolution(24, 18);
    caster->SetTolerance(.1);
    caster->AmbientOcclusionOn();
    caster->SetIrradianceProvider(vtkNew<vtkPenumbraIrradianceCache>());
    caster->Update();
    EXPECT_GE(caster->GetEstimatedError(), 0.0);
  }

  void Bake()
  {
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputData(Burr(12));
    filter->SetTolerance(.1);
    filter->Update();
    EXPECT_GE(filter->GetEstimatedError(), 0.0);
  }

  vtkSmartPointer<vtkRenderer> Renderer = NewRenderer();
  vtkSmartPointer<vtkRenderWindow> Window;
};

}

TEST(Soak, KeepsMemoryFlatOverMixedOperations)
{
  vtkPenumbraTracedEstimator::Register();
  const char* requested = std::getenv("PENUMBRA_SOAK_FRAMES");
  const int frames = requested ? std::atoi(requested) : DefaultFrames;
  Session sessions[2];
  double before = 0.0;
  for (int frame = 0; frame < frames; ++frame)
  {
    // 5 and 12 are coprime, so each round of 12 runs all operations, in a permuted order.
    sessions[frame / 12 % 2].Do((frame * 5 + frame / 12) % 12, frame);
    for (Session& session : sessions)
    {
      session.Window->Render();
    }
    before = frame == frames / 2 ? ResidentMegabytes() : before;
  }
#ifndef __SANITIZE_ADDRESS__ // which delays freeing memory, and finds leaks itself
  EXPECT_LT(ResidentMegabytes() - before, AllowedGrowth);
#endif
}
