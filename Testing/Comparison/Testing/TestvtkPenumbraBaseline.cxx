// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Regression tests of an image against its baselines: results, reports, written files, acceptance.
#include "PenumbraGoogleTest.h"

#include "vtkActor.h"
#include "vtkConeSource.h"
#include "vtkImageCanvasSource2D.h"
#include "vtkImageShiftScale.h"
#include "vtkObjectFactory.h"
#include "vtkPNGReader.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <gtest/gtest-spi.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace
{

namespace fs = std::filesystem;

/// Gives every test a separate folder and unsets the environment variables.
class vtkPenumbraBaselineTest : public testing::Test
{
protected:
  void SetUp() override
  {
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    this->Folder = fs::path(testing::TempDir()) / ("penumbra-baseline-" + name);
    fs::remove_all(this->Folder);
    fs::create_directories(this->Folder);
    unsetenv("PENUMBRA_ACCEPT");
    setenv("PENUMBRA_FAILED_IMAGES", this->At("failed").c_str(), 1);
    this->Baseline->SetFileName(this->At("image.png").c_str());
  }
  void TearDown() override
  {
    unsetenv("PENUMBRA_ACCEPT");
    fs::remove_all(this->Folder);
  }

  std::string At(const std::string& name) const { return (this->Folder / name).string(); }

  bool Check(vtkObject* object)
  {
    this->Baseline->SetImage(object);
    return this->Baseline->Check();
  }

  bool CheckAccepting(vtkObject* object, const char* how)
  {
    setenv("PENUMBRA_ACCEPT", how, 1);
    const bool passes = this->Check(object);
    unsetenv("PENUMBRA_ACCEPT");
    return passes;
  }

  bool Reports(const std::string& what)
  {
    return std::string(this->Baseline->GetReport()).find(what) != std::string::npos;
  }

  fs::path Folder;
  vtkNew<vtkPenumbraBaseline> Baseline;
};

/// A gray image of 40x30 pixels with a box of another gray.
vtkSmartPointer<vtkImageCanvasSource2D> Canvas(double gray, int boxSize)
{
  auto canvas = vtkSmartPointer<vtkImageCanvasSource2D>::New();
  canvas->SetScalarTypeToUnsignedChar();
  canvas->SetNumberOfScalarComponents(3);
  canvas->SetExtent(0, 39, 0, 29, 0, 0);
  canvas->SetDrawColor(200, 200, 200);
  canvas->FillBox(0, 39, 0, 29);
  canvas->SetDrawColor(gray, gray, gray);
  canvas->FillBox(10, 9 + boxSize, 10, 9 + boxSize);
  return canvas;
}

TEST_F(vtkPenumbraBaselineTest, FailsWithoutABaselineUntilOneIsAccepted)
{
  EXPECT_FALSE(this->Check(Canvas(50, 8)));
  EXPECT_TRUE(this->Reports("there is no baseline " + this->At("image.png")));
  EXPECT_TRUE(this->Reports("PENUMBRA_ACCEPT=replace"));
  EXPECT_TRUE(this->CheckAccepting(Canvas(50, 8), "replace"));
  EXPECT_TRUE(this->Reports("accepted as " + this->At("image.png")));
  EXPECT_TRUE(this->Check(Canvas(50, 8)));
  EXPECT_STREQ(this->Baseline->GetReport(), "");
}

TEST_F(vtkPenumbraBaselineTest, WritesFailedImagesAndReportsTheRenderer)
{
  ASSERT_TRUE(this->CheckAccepting(Canvas(50, 8), "replace"));
  this->Baseline->SetName("Suite.Test");
  EXPECT_FALSE(this->Check(Canvas(101, 8)));
  // 64 of the 256 pixels of a tile differ by 51/255.
  EXPECT_TRUE(this->Reports("tile-rmse 0.1 (limit 0.0625)")) << this->Baseline->GetReport();
  EXPECT_TRUE(this->Reports("tile-pixels 0.25 (limit 0.03125)"));
  EXPECT_TRUE(this->Reports("max 0.2"));
  EXPECT_TRUE(this->Reports("difference.png, 5 times"));
  EXPECT_TRUE(this->Reports("rendered by: vtkImageCanvasSource2D"));
  EXPECT_TRUE(this->Reports("processor: "));

  vtkNew<vtkPNGReader> reader;
  ASSERT_TRUE(reader->CanReadFile(this->At("failed/Suite.Test.image.actual.png").c_str()));
  reader->SetFileName(this->At("failed/Suite.Test.image.difference.png").c_str());
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetScalarComponentAsDouble(12, 12, 0, 0), 255.0);
  EXPECT_EQ(reader->GetOutput()->GetScalarComponentAsDouble(5, 5, 0, 0), 0.0);
}

TEST_F(vtkPenumbraBaselineTest, RequiresEqualityAtTolerance0)
{
  ASSERT_TRUE(this->CheckAccepting(Canvas(50, 8), "replace"));
  EXPECT_TRUE(this->Check(Canvas(51, 8)));
  this->Baseline->GetComparison()->SetTolerance(0.0);
  EXPECT_FALSE(this->Check(Canvas(51, 8)));
  EXPECT_TRUE(this->Check(Canvas(50, 8)));
}

TEST_F(vtkPenumbraBaselineTest, AcceptsAnyOfSeveralBaselines)
{
  ASSERT_TRUE(this->CheckAccepting(Canvas(50, 8), "replace"));
  ASSERT_TRUE(this->CheckAccepting(Canvas(120, 10), "add"));
  EXPECT_TRUE(fs::exists(this->At("image_1.png")));
  EXPECT_TRUE(this->Check(Canvas(50, 8)));
  EXPECT_TRUE(this->Check(Canvas(120, 10)));
  EXPECT_FALSE(this->Check(Canvas(120, 14)));
  EXPECT_TRUE(this->Reports("not near " + this->At("image_1.png")));
  // An image that is near a baseline already is not added.
  ASSERT_TRUE(this->CheckAccepting(Canvas(120, 10), "add"));
  EXPECT_FALSE(fs::exists(this->At("image_2.png")));
}

TEST_F(vtkPenumbraBaselineTest, StoresFloatsInVti)
{
  const auto floats = [](double shift) {
    auto image = vtkSmartPointer<vtkImageShiftScale>::New();
    image->SetInputConnection(Canvas(50, 8)->GetOutputPort());
    image->SetShift(shift);
    image->SetScale(1.0 / 255.0);
    image->SetOutputScalarTypeToFloat();
    return image;
  };
  this->Baseline->GetComparison()->SetTolerance(0.0);
  for (const char* name : { "floats.vti", "bytes.png" })
  {
    this->Baseline->SetFileName(this->At(name).c_str());
    ASSERT_TRUE(this->CheckAccepting(floats(0.0), "replace")) << this->Baseline->GetReport();
    EXPECT_TRUE(this->Check(floats(0.0))) << this->Baseline->GetReport();
    // Less than half a step of 8 bits.
    EXPECT_EQ(this->Check(floats(0.25)), name == std::string("bytes.png"));
  }
}

TEST_F(vtkPenumbraBaselineTest, ReportsWhatItCannotCompare)
{
  ASSERT_TRUE(this->CheckAccepting(Canvas(50, 8), "replace"));
  vtkNew<vtkImageData> empty;
  EXPECT_FALSE(this->Check(empty));
  EXPECT_TRUE(this->Reports("no image was rendered by vtkImageData"));
  vtkNew<vtkConeSource> cone;
  EXPECT_FALSE(this->Check(cone));
  EXPECT_FALSE(this->Check(nullptr));

  const auto other = Canvas(50, 8);
  other->SetExtent(0, 19, 0, 29, 0, 0);
  EXPECT_FALSE(this->Check(other));
  EXPECT_TRUE(this->Reports("the images differ in size: 20x30 and 40x30"));

  EXPECT_FALSE(this->CheckAccepting(Canvas(90, 8), "yes"));
  EXPECT_TRUE(this->Reports("PENUMBRA_ACCEPT=yes: set it to 'replace' or 'add'"));
  EXPECT_TRUE(this->Check(Canvas(50, 8))) << "the baseline is unchanged";

  this->Baseline->SetFileName(this->At("image.txt").c_str());
  EXPECT_FALSE(this->Check(Canvas(50, 8)));
  std::ofstream(this->At("damaged.png")) << "not an image";
  this->Baseline->SetFileName(this->At("damaged.png").c_str());
  EXPECT_FALSE(this->Check(Canvas(50, 8)));
  EXPECT_TRUE(this->Reports("cannot be read as an image"));
}

TEST_F(vtkPenumbraBaselineTest, RendersWindowsAndReportsTheDriver)
{
  vtkNew<vtkConeSource> cone;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(cone->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->SetSize(64, 48);
  window->AddRenderer(renderer);
  ASSERT_TRUE(this->CheckAccepting(window, "replace")) << this->Baseline->GetReport();
  EXPECT_TRUE(this->Check(window)) << this->Baseline->GetReport();
  renderer->SetBackground(0.0, 0.0, 0.2);
  EXPECT_FALSE(this->Check(window));
  EXPECT_TRUE(this->Reports(std::string("rendered by: ") + window->GetClassName() + ", OpenGL "))
    << this->Baseline->GetReport();
  EXPECT_FALSE(this->Reports("unknown")) << this->Baseline->GetReport();
}

TEST_F(vtkPenumbraBaselineTest, ReportsWindowsWithoutOpenGL)
{
  ASSERT_TRUE(this->CheckAccepting(Canvas(50, 8), "replace"));
  // As in a program without vtk_module_autoinit.
  vtkObjectFactory::SetAllEnableFlags(0, "vtkRenderWindow");
  const auto window = vtkSmartPointer<vtkRenderWindow>::New();
  vtkObjectFactory::SetAllEnableFlags(1, "vtkRenderWindow");
  ASSERT_TRUE(window);
  ASSERT_STREQ(window->GetClassName(), "vtkRenderWindow");
  EXPECT_FALSE(this->Check(window));
  EXPECT_STREQ(this->Baseline->GetReport(),
    "The window has no OpenGL: call vtk_module_autoinit for VTK::RenderingOpenGL2.\n");
}

TEST_F(vtkPenumbraBaselineTest, IsAGoogleTestAssertion)
{
  ASSERT_TRUE(this->CheckAccepting(Canvas(50, 8), "replace"));
  static std::string path;
  static vtkSmartPointer<vtkImageCanvasSource2D> canvas;
  path = this->At("image.png");
  canvas = Canvas(50, 8);
  EXPECT_IMAGE_NEAR(canvas, path, 1.0 / 16.0);
  canvas->Update();
  EXPECT_IMAGE_NEAR(canvas->GetOutput(), path, 0.0);
  canvas = Canvas(90, 8);
  EXPECT_NONFATAL_FAILURE(
    EXPECT_IMAGE_NEAR(canvas, path, 1.0 / 16.0), "canvas: the image is not near");
  EXPECT_TRUE(
    fs::exists(this->At("failed/vtkPenumbraBaselineTest.IsAGoogleTestAssertion.image.actual.png")));

  penumbra::ImageTolerance loose(0.5);
  loose.PixelLimit = 1.0;
  loose.TilePixelLimit = 1.0;
  EXPECT_IMAGE_NEAR(canvas, path, loose);
  penumbra::ImageTolerance elsewhere(0.0);
  const auto mask = Canvas(0, 8);
  mask->Update();
  elsewhere.Mask = mask->GetOutput();
  EXPECT_IMAGE_NEAR(canvas, path, elsewhere);
  canvas = nullptr;
}

}
