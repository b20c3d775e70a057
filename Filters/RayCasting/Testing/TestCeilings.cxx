// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What scenes made to be dear may cost: bounds that follow from the tolerance, not from the scene.
#include "vtkPenumbraRayCaster.h"

#include "Adversaries.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <gtest/gtest.h>

#include <ostream>
#include <string>

using namespace penumbra;

namespace
{

struct Row
{
  std::string Name;
  int Primitives; ///< of the largest
  double Bound;   ///< rays per pixel of a picture of 128 x 128
};

std::ostream& operator<<(std::ostream& os, const Row& row)
{
  return os << row.Name << row.Primitives;
}

std::string NameOf(const ::testing::TestParamInfo<Row>& row)
{
  return row.param.Name;
}

double RaysPerPixel(const Row& row, int primitives)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(FindAdversary(row.Name)->Make(primitives));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToFlat();
  actor->GetProperty()->SetLineWidth(2.f);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->SetBackground(0.2, 0.3, 0.4);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(1.0);
  camera->SetPosition(0.3, 0.4, 5.0);
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(128, 128);
  caster->Update();
  return caster->GetStatistics()->GetArray("Rays/PerPixel")->GetTuple1(0);
}

class Ceilings : public ::testing::TestWithParam<Row>
{
};

}

TEST_P(Ceilings, BoundTheRays)
{
  for (const int share : { 4, 2, 1 })
  {
    const double rays = RaysPerPixel(this->GetParam(), this->GetParam().Primitives / share);
    RecordProperty(
      "RaysPerPixel" + std::to_string(this->GetParam().Primitives / share), std::to_string(rays));
    EXPECT_LE(rays, this->GetParam().Bound) << this->GetParam().Primitives / share;
  }
}

INSTANTIATE_TEST_SUITE_P(RayCaster, Ceilings,
  ::testing::Values(Row{ "Slivers", 400, 10.0 }, Row{ "Clusters", 4000, 50.0 },
    Row{ "Hair", 4000, 150.0 }, Row{ "Streamlines", 4000, 150.0 }, Row{ "Soup", 8000, 150.0 },
    Row{ "Fan", 20000, 100.0 }, Row{ "UnsharedFan", 20000, 100.0 }, Row{ "Pole", 20000, 100.0 },
    Row{ "SuperEllipsoid", 20000, 100.0 }, Row{ "Comb", 2000, 100.0 }, Row{ "Copies", 4000, 20.0 }),
  NameOf);
