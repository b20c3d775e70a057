// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Upper bounds of the number of rays for adversarial scenes. They follow from the tolerance, not
// from the number of primitives.
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraRayCasterConstants.h"

#include "Scenes/Adversaries.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
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
  int Primitives; ///< of the largest scene
  double Bound;   ///< rays per pixel of an image of 128 x 128 pixels
};

std::ostream& operator<<(std::ostream& os, const Row& row)
{
  return os << row.Name << row.Primitives;
}

std::string MakeName(const ::testing::TestParamInfo<Row>& row)
{
  return row.param.Name;
}

/// Renders side * side pixels, each 1/64 wide, each divided into `subdivisions` * `subdivisions`
/// pixels.
void Render(const std::string& name, int primitives, int side, vtkPenumbraRayCaster* caster,
  int subdivisions = 1)
{
  caster->SetRenderer(NewAdversaryRenderer(FindAdversary(name)->Make(primitives), side / 128.0));
  caster->SetResolution(subdivisions * side, subdivisions * side);
  caster->Update();
}

double GetStatistic(vtkPenumbraRayCaster* caster, const char* name)
{
  return caster->GetStatistics()->GetArray(name)->GetTuple1(0);
}

double ComputeRaysPerPixel(const Row& row, int primitives)
{
  vtkNew<vtkPenumbraRayCaster> caster;
  Render(row.Name, primitives, 128, caster);
  return GetStatistic(caster, "Rays/PerPixel");
}

class AdversarialScenes : public ::testing::TestWithParam<Row>
{
protected:
  void Check(int divisor)
  {
    const int primitives = this->GetParam().Primitives / divisor;
    const double rays = ComputeRaysPerPixel(this->GetParam(), primitives);
    RecordProperty("RaysPerPixel" + std::to_string(primitives), std::to_string(rays));
    EXPECT_LE(rays, this->GetParam().Bound) << primitives;
  }
};

}

TEST_P(AdversarialScenes, RespectTheRayBoundWithFewPrimitives)
{
  this->Check(4);
}

TEST_P(AdversarialScenes, RespectTheRayBoundWithManyPrimitives)
{
  this->Check(2);
  this->Check(1);
}

TEST(SampledPixels, HaveConservativeErrorEstimates)
{
  constexpr int Side = 4;
  constexpr int Subdivisions = 4; // of a pixel in the reference
  for (const int primitives : { 80, 150, 300 })
  {
    vtkNew<vtkPenumbraRayCaster> caster;
    Render("Slivers", primitives, Side, caster);
    EXPECT_GT(GetStatistic(caster, "Pixels/Uniform"), 0.0) << primitives;
    vtkNew<vtkPenumbraRayCaster> reference;
    reference->GetConstants().CoverageMethod = penumbra::CoverageMethods::Uniform;
    reference->GetConstants().UniformSamples = 32;
    Render("Slivers", primitives, Side, reference, Subdivisions);
    vtkPointData* actual = caster->GetOutput()->GetPointData();
    vtkPointData* expected = reference->GetOutput()->GetPointData();
    double squares = 0.0;
    double estimated = 0.0;
    for (vtkIdType i = 0; i < Side * Side; ++i)
    {
      for (int c = 0; c < 3; ++c)
      {
        double d = actual->GetArray("Color")->GetComponent(i, c);
        for (int k = 0; k < Subdivisions * Subdivisions; ++k)
        {
          const vtkIdType row = i / Side * Subdivisions + k / Subdivisions;
          d -= expected->GetArray("Color")->GetComponent(
                 row * Side * Subdivisions + i % Side * Subdivisions + k % Subdivisions, c) /
            (Subdivisions * Subdivisions);
        }
        squares += d * d / 3.0;
      }
      const double error = actual->GetArray("EstimatedError")->GetTuple1(i);
      estimated += error * error;
      EXPECT_LE(error, 2.0 / 256.0) << primitives;
    }
    EXPECT_LE(std::sqrt(squares), std::sqrt(estimated)) << primitives;
    EXPECT_GE(4.0 * std::sqrt(squares), std::sqrt(estimated)) << primitives;
  }
}

INSTANTIATE_TEST_SUITE_P(RayCaster, AdversarialScenes,
  ::testing::Values(Row{ "Slivers", 400, 10.0 }, Row{ "Clusters", 4000, 64.0 },
    Row{ "Hair", 4000, 150.0 }, Row{ "Streamlines", 4000, 150.0 }, Row{ "Soup", 8000, 150.0 },
    Row{ "Fan", 4000, 64.0 }, Row{ "UnsharedFan", 4000, 64.0 }, Row{ "Pole", 20000, 100.0 },
    Row{ "SuperEllipsoid", 20000, 100.0 }, Row{ "Comb", 2000, 100.0 }, Row{ "Copies", 4000, 20.0 }),
  MakeName);
