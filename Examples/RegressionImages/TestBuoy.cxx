// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares images with baselines, in one line per test. A baseline is an image that was reviewed
// and committed. Images of the ray caster must be equal to it, images of OpenGL similar.
//
// After an intended change, run `PENUMBRA_ACCEPT=replace ./TestBuoy` and review the changes with
// git.
#include "PenumbraGoogleTest.h"
#include "vtkPenumbraRayCaster.h"

#include <vtkActor.h>
#include <vtkConeSource.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <gtest/gtest.h>

namespace
{

void Add(vtkRenderer* renderer, vtkPolyDataAlgorithm* shape, double red, double green, double blue)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(shape->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(red, green, blue);
  renderer->AddActor(actor);
}

// The code under test.
void AddBuoy(vtkRenderer* renderer)
{
  vtkNew<vtkSphereSource> body;
  body->SetThetaResolution(32);
  body->SetPhiResolution(24);
  Add(renderer, body, 0.9, 0.4, 0.1);
  vtkNew<vtkConeSource> mast;
  mast->SetDirection(0.0, 1.0, 0.0);
  mast->SetCenter(0.0, 0.8, 0.0);
  mast->SetRadius(0.15);
  mast->SetResolution(24);
  Add(renderer, mast, 0.9, 0.9, 0.9);
  renderer->SetBackground(0.15, 0.3, 0.4);
  renderer->ResetCamera();
}

TEST(Buoy, MatchesItsBaselineWithTheRayCaster)
{
  vtkNew<vtkRenderer> renderer;
  AddBuoy(renderer);
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(200, 200);
  EXPECT_IMAGE_NEAR(caster, "buoy.png", 0.0);
}

TEST(Buoy, MatchesItsBaselineInAWindow)
{
  vtkNew<vtkRenderer> renderer;
  AddBuoy(renderer);
  vtkNew<vtkRenderWindow> window;
  window->SetSize(200, 200);
  window->AddRenderer(renderer);
  EXPECT_IMAGE_NEAR(window, "buoy-window.png", 1.0 / 16.0);
}

TEST(Buoy, MatchesItsBaselineOutsideAMask)
{
  vtkNew<vtkRenderer> renderer;
  AddBuoy(renderer);
  vtkNew<vtkTextActor> clock;
  clock->SetInput(__TIME__);
  clock->GetTextProperty()->SetFontSize(24);
  clock->SetPosition(60, 5);
  renderer->AddViewProp(clock);
  vtkNew<vtkRenderWindow> window;
  window->SetSize(200, 200);
  window->AddRenderer(renderer);

  // The comparison ignores the lowest 40 rows of pixels.
  auto mask = vtkSmartPointer<vtkImageData>::New();
  mask->SetDimensions(200, 200, 1);
  mask->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  for (int y = 0; y < 200; ++y)
  {
    for (int x = 0; x < 200; ++x)
    {
      *static_cast<unsigned char*>(mask->GetScalarPointer(x, y, 0)) = y < 40 ? 0 : 255;
    }
  }
  penumbra::ImageTolerance tolerance(1.0 / 16.0);
  tolerance.Mask = mask;
  EXPECT_IMAGE_NEAR(window, "buoy-window.png", tolerance);
}

}
