// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ForkedRanks.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkNew.h"
#include "vtkPenumbraDistributedIrradianceFilter.h"
#include "vtkPointData.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <string>

namespace
{

using penumbra::RunRanks;

}

TEST(vtkPenumbraDistributedIrradianceFilter, MatchesItsSuperclassOnOneRank)
{
  const auto bake = [](vtkPenumbraIrradianceFilter* filter) {
    vtkNew<vtkSphereSource> sphere;
    filter->SetInputConnection(0, sphere->GetOutputPort());
    filter->Update();
    std::string values;
    vtkDataArray* array = vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0))
                            ->GetPointData()
                            ->GetArray("AmbientOcclusion");
    for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
    {
      values += std::to_string(array->GetComponent(i, 0)) + " ";
    }
    return values;
  };
  const std::string baked =
    RunRanks(1, [&](int) { return bake(vtkNew<vtkPenumbraIrradianceFilter>()); })[0].Value;
  ASSERT_FALSE(baked.empty());
  const auto distributed =
    RunRanks(1, [&](int) { return bake(vtkNew<vtkPenumbraDistributedIrradianceFilter>()); });
  EXPECT_EQ(distributed[0].Value, baked);
}
