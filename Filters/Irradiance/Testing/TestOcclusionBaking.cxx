// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Tests that the filter bakes with the constants of IrradianceConstants.h, and that each constant that the
// benchmark fit-baking varies has an effect.
#include "Baking/OcclusionBaking.h"
#include "Surface.h"

#include "Embree/RayScene.h"
#include "SphereOnFloor.h"

#include "vtkFieldData.h"
#include "vtkPenumbraIrradianceFilter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace penumbra;
using namespace penumbra_testing;

namespace
{

constexpr double Tolerance = .01;

BakedValues BakeWith(vtkPolyData* mesh, const OcclusionBakingConstants& constants)
{
  const BakeInput input = PrepareBakeInput(mesh, BakeInputOptions());
  const RayScene rays(input.OccluderScene, 1);
  const OcclusionGatherer gatherer(rays, DistanceFalloff());
  RecordOctree tree;
  tree.Initialize(glm::vec3(0.f), .5f);
  BakedValues baked;
  EXPECT_TRUE(BakeOcclusion(
    input, rays, gatherer, { Tolerance, { VTK_DOUBLE_MAX }, true }, constants, tree, {}, baked));
  return baked;
}

double CountRays(const BakedValues& baked)
{
  return static_cast<double>(baked.GatherRays + baked.BruteForceRays);
}

/// Returns a wavy surface, most points of which are denoised.
vtkSmartPointer<vtkPolyData> MakeMesh()
{
  const auto floor = MakeFloor(48);
  vtkPolyData* mesh = floor->GetOutput();
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double x[3];
    mesh->GetPoint(i, x);
    mesh->GetPoints()->SetPoint(i, x[0], x[1], 0.5 * std::sin(x[0]) * std::sin(x[1]));
  }
  mesh->GetPointData()->SetNormals(nullptr);
  return mesh;
}

}

TEST(OcclusionBakingConstants, HaveTheDefaultsOfTheHeader)
{
  const OcclusionBakingConstants constants;
  EXPECT_EQ(constants.BruteForceErrorFactor, BruteForceErrorFactor);
  EXPECT_EQ(constants.LowSampleNoiseFactor, LowSampleNoiseFactor);
  EXPECT_EQ(constants.DenoisedErrorFactor, DenoisedErrorFactor);
  EXPECT_EQ(constants.RegressionRadius, RegressionRadius);
}

TEST(BakeOcclusion, GivesTheBitsOfTheFilterByDefault)
{
  const auto mesh = MakeMesh();
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(mesh);
  filter->SetTolerance(Tolerance);
  filter->SetRadius(VTK_DOUBLE_MAX);
  filter->Update();
  vtkDataArray* values = GetPolyData(filter)->GetPointData()->GetArray("AmbientOcclusion");
  const BakedValues baked = BakeWith(mesh, OcclusionBakingConstants());
  ASSERT_EQ(static_cast<std::size_t>(values->GetNumberOfTuples()), baked.Values.size());
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    ASSERT_EQ(static_cast<float>(values->GetComponent(i, 0)), baked.Values[i].Mean.x);
  }
  EXPECT_EQ(GetStatistic(filter, "Rays/Total"), CountRays(baked));
}

TEST(BakeOcclusion, DependsOnEachConstant)
{
  const auto mesh = MakeMesh();
  const double rays = CountRays(BakeWith(mesh, OcclusionBakingConstants()));
  for (double OcclusionBakingConstants::*constant :
    { &OcclusionBakingConstants::BruteForceErrorFactor,
      &OcclusionBakingConstants::LowSampleNoiseFactor,
      &OcclusionBakingConstants::DenoisedErrorFactor, &OcclusionBakingConstants::RegressionRadius })
  {
    OcclusionBakingConstants changed;
    changed.*constant *= .5;
    EXPECT_NE(CountRays(BakeWith(mesh, changed)), rays);
  }
}
