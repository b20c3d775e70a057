// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// GoogleTest assertions on images:
//
//   EXPECT_IMAGE_NEAR(window, "cone.png", 1.0 / 16.0);
//
// The first argument is a vtkRenderWindow, a vtkImageData, or a vtkAlgorithm that outputs one, such
// as vtkPenumbraRayCaster; vtkNew and vtkSmartPointer are accepted, too. Relative paths of
// baselines start at the folder PENUMBRA_BASELINE_FOLDER, a compile definition, or at the current
// folder without it. Windows are rendered with OSMesa unless VTK_DEFAULT_OPENGL_WINDOW is set.
// vtkPenumbraBaseline documents what is written when an image fails, and how to accept it.
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

/// Limits within which an image is near its baseline. A single number is the tolerance. See
/// vtkPenumbraImageComparison for meaning, ranges and defaults.
struct ImageTolerance
{
  ImageTolerance(double tolerance = 1.0 / 16.0)
    : Tolerance(tolerance)
  {
  }
  double Tolerance;                   ///< largest RMSE of any 16x16 pixels
  double PixelLimit = 0.01;           ///< largest fraction of pixels that differ by more than 4/255
  double TilePixelLimit = 1.0 / 32.0; ///< the same for any 16x16 pixels
  vtkSmartPointer<vtkImageData> Mask; ///< black pixels are ignored; default: none
};

/// Renders windows of this program with OSMesa if they are created after its static objects.
inline const bool WindowsAreDeterministic = (vtkPenumbraBaseline::PreferOSMesa(), true);

/// Implements the macros below.
inline testing::AssertionResult IsImageNear(const char* expression, const char*, const char*,
  vtkObject* source, const std::string& fileName, const ImageTolerance& limits)
{
  vtkNew<vtkPenumbraBaseline> baseline;
  baseline->SetImage(source);
  const bool isAbsolute = !fileName.empty() && fileName.front() == '/';
  baseline->SetFileName((isAbsolute ? fileName : PENUMBRA_BASELINE_FOLDER "/" + fileName).c_str());
  if (const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info())
  {
    std::string name = std::string(test->test_suite_name()) + "." + test->name();
    std::replace(name.begin(), name.end(), '/', '-');
    baseline->SetName(name.c_str());
  }
  vtkPenumbraImageComparison* comparison = baseline->GetComparison();
  comparison->SetTolerance(limits.Tolerance);
  comparison->SetPixelLimit(limits.PixelLimit);
  comparison->SetTilePixelLimit(limits.TilePixelLimit);
  comparison->SetMask(limits.Mask);
  if (!baseline->Check())
  {
    return testing::AssertionFailure() << expression << ": " << baseline->GetReport();
  }
  std::cout << baseline->GetReport();
  return testing::AssertionSuccess();
}

}

#define EXPECT_IMAGE_NEAR(image, baseline, tolerance)                                              \
  EXPECT_PRED_FORMAT3(penumbra::IsImageNear, image, baseline, tolerance)
#define ASSERT_IMAGE_NEAR(image, baseline, tolerance)                                              \
  ASSERT_PRED_FORMAT3(penumbra::IsImageNear, image, baseline, tolerance)

#endif
