// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What scenes made to be dear may cost: bounds that follow from the tolerance, not from the scene.
#include "vtkPenumbraRayCaster.h"

#include "Scenes/Adversaries.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <gtest/gtest.h>

#include <cmath>
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

/// A picture of side * side pixels, each 1/64 wide; or of those cut into finer * finer each.
void Draw(
  const std::string& name, int primitives, int side, vtkPenumbraRayCaster* caster, int finer = 1)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(FindAdversary(name)->Make(primitives));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToFlat();
  actor->GetProperty()->SetLineWidth(2.f);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->SetBackground(0.2, 0.3, 0.4);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(side / 128.0);
  camera->SetPosition(0.3, 0.4, 5.0);
  caster->SetRenderer(renderer);
  caster->SetResolution(finer * side, finer * side);
  caster->Update();
}

double StatisticOf(vtkPenumbraRayCaster* caster, const char* name)
{
  return caster->GetStatistics()->GetArray(name)->GetTuple1(0);
}

double RaysPerPixel(const Row& row, int primitives)
{
  vtkNew<vtkPenumbraRayCaster> caster;
  Draw(row.Name, primitives, 128, caster);
  return StatisticOf(caster, "Rays/PerPixel");
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

TEST(SampledPixels, ErrByNoMoreThanTheyTell)
{
  constexpr int Side = 4; // all of them
  constexpr int Finer = 4;
  for (const int primitives : { 80, 150, 300 })
  {
    vtkNew<vtkPenumbraRayCaster> caster;
    Draw("Slivers", primitives, Side, caster);
    EXPECT_GT(StatisticOf(caster, "Pixels/Uniform"), 0.0) << primitives;
    vtkNew<vtkPenumbraRayCaster> truth;
    truth->SetCoverageMethod(vtkPenumbraRayCaster::UNIFORM);
    truth->SetUniformSamples(64);
    Draw("Slivers", primitives, Side, truth, Finer);
    vtkPointData* found = caster->GetOutput()->GetPointData();
    vtkPointData* expected = truth->GetOutput()->GetPointData();
    double squares = 0.0;
    double believed = 0.0;
    for (vtkIdType i = 0; i < Side * Side; ++i)
    {
      for (int c = 0; c < 3; ++c)
      {
        double d = found->GetArray("Color")->GetComponent(i, c);
        for (int k = 0; k < Finer * Finer; ++k)
        {
          const vtkIdType row = i / Side * Finer + k / Finer;
          d -= expected->GetArray("Color")->GetComponent(
                 row * Side * Finer + i % Side * Finer + k % Finer, c) /
            (Finer * Finer);
        }
        squares += d * d / 3.0;
      }
      const double error = found->GetArray("EstimatedError")->GetTuple1(i);
      believed += error * error;
      EXPECT_LE(error, 2.0 / 256.0) << primitives;
    }
    EXPECT_LE(std::sqrt(squares), std::sqrt(believed)) << primitives;
    EXPECT_GE(4.0 * std::sqrt(squares), std::sqrt(believed)) << primitives;
  }
}

INSTANTIATE_TEST_SUITE_P(RayCaster, Ceilings,
  ::testing::Values(Row{ "Slivers", 400, 10.0 }, Row{ "Clusters", 4000, 64.0 },
    Row{ "Hair", 4000, 150.0 }, Row{ "Streamlines", 4000, 150.0 }, Row{ "Soup", 8000, 150.0 },
    Row{ "Fan", 4000, 64.0 }, Row{ "UnsharedFan", 4000, 64.0 }, Row{ "Pole", 20000, 100.0 },
    Row{ "SuperEllipsoid", 20000, 100.0 }, Row{ "Comb", 2000, 100.0 }, Row{ "Copies", 4000, 20.0 }),
  NameOf);
