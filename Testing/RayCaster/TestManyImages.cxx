// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A thousand images in one process: memory does not grow, and no windowing or OpenGL library is
// loaded.
#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include <unistd.h>

namespace
{

// Resident memory of the process in MB.
double ResidentMemory()
{
  long total = 0;
  long resident = 0;
  std::ifstream("/proc/self/statm") >> total >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

std::string LoadedFiles()
{
  std::ifstream maps("/proc/self/maps");
  return std::string(std::istreambuf_iterator<char>(maps), std::istreambuf_iterator<char>());
}

// AddressSanitizer delays freeing memory, so a few images are enough and growth is not meaningful
// there.
#ifdef __SANITIZE_ADDRESS__
constexpr bool IsMemoryOurs = false;
#else
constexpr bool IsMemoryOurs = true;
#endif
constexpr int Images = IsMemoryOurs ? 1000 : 20;

TEST(ManyImages, DoNotGrowMemoryOrLoadOpenGL)
{
  const std::string before = LoadedFiles();
  double afterTen = 0.0;
  double afterAll = 0.0;
  for (int i = 0; i < Images; ++i)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetThetaResolution(40);
    sphere->SetPhiResolution(20 + i % 5);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(sphere->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    vtkNew<vtkRenderer> renderer;
    renderer->AddActor(actor);
    renderer->GetActiveCamera()->Azimuth(i);
    renderer->ResetCamera();
    vtkNew<vtkPenumbraRayCaster> caster;
    caster->SetRenderer(renderer);
    caster->SetResolution(96, 72);
    caster->Update();
    ASSERT_GT(caster->GetOutput()->GetPointData()->GetArray("Color")->GetRange(0)[1], 0.5);
    afterTen = i == 9 ? ResidentMemory() : afterTen;
    afterAll = ResidentMemory();
  }
  EXPECT_TRUE(!IsMemoryOurs || afterAll <= afterTen + 8.0)
    << afterTen << " MB after ten images, " << afterAll << " MB after all";
  const std::string after = LoadedFiles();
  for (const char* library : { "libGL", "libEGL", "libOSMesa", "libX11.so" })
  {
    const bool ownedByVtk = before.find(library) != std::string::npos;
    EXPECT_TRUE(ownedByVtk || after.find(library) == std::string::npos) << library;
  }
}

}
