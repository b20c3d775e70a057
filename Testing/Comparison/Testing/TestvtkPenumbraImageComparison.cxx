// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraImageComparison.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

TEST(vtkPenumbraImageComparison, IsAVtkObject)
{
  vtkNew<vtkPenumbraImageComparison> comparison;
  EXPECT_TRUE(comparison->IsA("vtkObject"));
}
