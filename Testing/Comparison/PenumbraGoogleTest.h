// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Pictures in GoogleTest:
//
//   EXPECT_IMAGE_NEAR(window, "cone.png", 1.0 / 16.0);
//
// The picture is a vtkRenderWindow, a vtkImageData, or a vtkAlgorithm that makes one, such as
// vtkPenumbraRayCaster; vtkNew and vtkSmartPointer do, too. Baselines lie in the folder that
// PENUMBRA_BASELINE_FOLDER names, a definition of the compiler, else in the current one. Windows are
// OSMesa's unless VTK_DEFAULT_OPENGL_WINDOW says otherwise. See vtkPenumbraBaseline for what happens
// when a picture fails, and how to accept it.
#ifndef PenumbraGoogleTest_h
#define PenumbraGoogleTest_h

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPenumbraBaseline.h"
#include "vtkPenumbraImageComparison.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <string>

#ifndef PENUMBRA_BASELINE_FOLDER
#define PENUMBRA_BASELINE_FOLDER "."
#endif

namespace penumbra
{

/// When a picture is near its baseline; a number alone is the tolerance. See
/// vtkPenumbraImageComparison for meaning, ranges and defaults.
struct ImageTolerance
{
  ImageTolerance(double tolerance = 1.0 / 16.0)
    : Tolerance(tolerance)
  {
  }
  double Tolerance;                   ///< largest RMSE of any 16x16 pixels
  double PixelLimit = 0.01;           ///< largest share of pixels off by more than 4/255
  double TilePixelLimit = 1.0 / 32.0; ///< the same of any 16x16 pixels
  vtkSmartPointer<vtkImageData> Mask; ///< what is black in it does not count
};

/// The windows of this program, opened after its static objects, are OSMesa's.
inline const bool WindowsAreDeterministic = (vtkPenumbraBaseline::PreferOSMesa(), true);

/// For the macros below.
inline testing::AssertionResult IsImageNear(const char* expression, const char*, const char*,
  vtkObject* picture, const std::string& fileName, const ImageTolerance& nearness)
{
  vtkNew<vtkPenumbraBaseline> baseline;
  baseline->SetPicture(picture);
  const bool isAbsolute = !fileName.empty() && fileName.front() == '/';
  baseline->SetFileName((isAbsolute ? fileName : PENUMBRA_BASELINE_FOLDER "/" + fileName).c_str());
  if (const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info())
  {
    std::string name = std::string(test->test_suite_name()) + "." + test->name();
    std::replace(name.begin(), name.end(), '/', '-');
    baseline->SetName(name.c_str());
  }
  vtkPenumbraImageComparison* comparison = baseline->GetComparison();
  comparison->SetTolerance(nearness.Tolerance);
  comparison->SetPixelLimit(nearness.PixelLimit);
  comparison->SetTilePixelLimit(nearness.TilePixelLimit);
  comparison->SetMask(nearness.Mask);
  if (!baseline->Check())
  {
    return testing::AssertionFailure() << expression << ": " << baseline->GetReport();
  }
  std::cout << baseline->GetReport();
  return testing::AssertionSuccess();
}

}

#define EXPECT_IMAGE_NEAR(picture, baseline, tolerance)                                            \
  EXPECT_PRED_FORMAT3(penumbra::IsImageNear, picture, baseline, tolerance)
#define ASSERT_IMAGE_NEAR(picture, baseline, tolerance)                                            \
  ASSERT_PRED_FORMAT3(penumbra::IsImageNear, picture, baseline, tolerance)

#endif
