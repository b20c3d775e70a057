// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDataArray.h"
#include "vtkDummyController.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPenumbraDistributedIrradianceFilter.h"
#include "vtkPenumbraDistributedRayCaster.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

namespace
{

/// Returns the values of a point array of the filter's output for a sphere.
std::vector<double> ComputeValues(vtkAlgorithm* filter, const char* name)
{
  vtkNew<vtkSphereSource> sphere;
  filter->SetInputConnection(0, sphere->GetOutputPort());
  filter->Update();
  vtkDataArray* array =
    vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0))->GetPointData()->GetArray(name);
  std::vector<double> values;
  for (vtkIdType i = 0; array && i < array->GetNumberOfValues(); ++i)
  {
    values.push_back(array->GetVariantValue(i).ToDouble());
  }
  return values;
}

/// Sets a global controller with a single rank for its lifetime.
struct SingleRank
{
  SingleRank() { vtkMultiProcessController::SetGlobalController(this->Controller); }
  ~SingleRank() { vtkMultiProcessController::SetGlobalController(nullptr); }
  vtkNew<vtkDummyController> Controller;
};

}

TEST(vtkPenumbraDistributedRayCaster, MatchesItsSuperclassOnOneRank)
{
  const SingleRank rank;
  vtkNew<vtkPenumbraRayCaster> plain;
  vtkNew<vtkPenumbraDistributedRayCaster> distributed;
  plain->SetResolution(24, 18);
  distributed->SetResolution(24, 18);
  const std::vector<double> colors = ComputeValues(plain, "Color");
  ASSERT_EQ(colors.size(), 4u * 24u * 18u);
  EXPECT_EQ(ComputeValues(distributed, "Color"), colors);
}

TEST(vtkPenumbraDistributedIrradianceFilter, MatchesItsSuperclassOnOneRank)
{
  const SingleRank rank;
  const std::vector<double> baked =
    ComputeValues(vtkNew<vtkPenumbraIrradianceFilter>(), "AmbientOcclusion");
  ASSERT_FALSE(baked.empty());
  EXPECT_EQ(
    ComputeValues(vtkNew<vtkPenumbraDistributedIrradianceFilter>(), "AmbientOcclusion"), baked);
}
