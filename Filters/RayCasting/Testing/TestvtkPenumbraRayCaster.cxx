// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraRayCaster.h"

#include "vtkImageData.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

TEST(vtkPenumbraRayCaster, HasTheResolutionAskedFor)
{
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetResolution(17, 5);
  caster->Update();
  int dimensions[3];
  caster->GetOutput()->GetDimensions(dimensions);
  EXPECT_EQ(dimensions[0], 17);
  EXPECT_EQ(dimensions[1], 5);
  EXPECT_EQ(dimensions[2], 1);
}
