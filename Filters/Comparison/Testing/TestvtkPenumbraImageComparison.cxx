// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Every metric against values that were derived by hand.
#include "vtkPenumbraImageComparison.h"

#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGReader.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace
{

using Image = vtkSmartPointer<vtkImageData>;
using Color = std::vector<double>;
using Painter = std::function<Color(int x, int y)>;

Image Paint(vtkDataArray* color, int width, int height, const Painter& painter)
{
  auto image = Image::New();
  image->SetDimensions(width, height, 1);
  color->SetName("Color");
  color->SetNumberOfComponents(static_cast<int>(painter(0, 0).size()));
  color->SetNumberOfTuples(image->GetNumberOfPoints());
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      color->SetTuple(y * width + x, painter(x, y).data());
    }
  }
  image->GetPointData()->SetScalars(color);
  return image;
}

Image Floats(int width, int height, const Painter& painter)
{
  vtkNew<vtkFloatArray> color;
  return Paint(color, width, height, painter);
}

Image Bytes(int width, int height, const Painter& painter)
{
  vtkNew<vtkUnsignedCharArray> color;
  return Paint(color, width, height, painter);
}

Painter Constant(const Color& color)
{
  return [color](int, int) { return color; };
}

double Value(vtkImageData* image, vtkImageData* baseline, int metric)
{
  vtkNew<vtkPenumbraImageComparison> comparison;
  comparison->SetImage(image);
  comparison->AddBaseline(baseline);
  EXPECT_TRUE(comparison->Compare()) << comparison->GetErrorText();
  return comparison->GetValue(metric);
}

using Comparison = vtkPenumbraImageComparison;

TEST(vtkPenumbraImageComparison, IsZeroForEqualImages)
{
  const Image a = Floats(31, 17, [](int x, int y) { return Color{ x / 31., y / 17., 0.5, 1. }; });
  for (int metric = 0; metric < Comparison::NUMBER_OF_METRICS; ++metric)
  {
    EXPECT_NEAR(Value(a, a, metric), 0.0, 1e-12) << Comparison::GetMetricName(metric);
  }
}

TEST(vtkPenumbraImageComparison, MeasuresAConstantOffset)
{
  const Image a = Floats(32, 32, Constant({ 0.3, 0.3, 0.3 }));
  const Image b = Floats(32, 32, Constant({ 0.4, 0.4, 0.4 }));
  EXPECT_NEAR(Value(a, b, Comparison::RMSE), 0.1, 1e-7);
  EXPECT_NEAR(Value(a, b, Comparison::MAXIMUM), 0.1, 1e-7);
  EXPECT_EQ(Value(a, b, Comparison::PIXELS), 1.0);
  // Without variance only the luminance term of the similarity remains.
  const double similarity = (2 * 0.3 * 0.4 + 1e-4) / (0.3 * 0.3 + 0.4 * 0.4 + 1e-4);
  EXPECT_NEAR(Value(a, b, Comparison::SSIM), 1.0 - similarity, 1e-6);
}

TEST(vtkPenumbraImageComparison, MeasuresOneMissingLine)
{
  const Image line = Bytes(50, 40, [](int x, int) { return Color(3, x == 20 ? 255. : 0.); });
  const Image nothing = Bytes(50, 40, Constant({ 0, 0, 0 }));
  EXPECT_NEAR(Value(line, nothing, Comparison::RMSE), std::sqrt(1.0 / 50.0), 1e-12);
  EXPECT_EQ(Value(line, nothing, Comparison::MAXIMUM), 1.0);
  EXPECT_NEAR(Value(line, nothing, Comparison::PIXELS), 1.0 / 50.0, 1e-12);

  // At distance d from the line its weight under the window is g(d): mean g, variance g - g^2,
  // against mean and variance 0. Window centers are at x = 5..44. Beyond distance 5 the images are
  // equal.
  double weights = 0.0;
  for (int d = -5; d <= 5; ++d)
  {
    weights += std::exp(-0.5 * d * d / 2.25);
  }
  double similarity = 0.0;
  for (int x = 5; x <= 44; ++x)
  {
    const int d = x - 20;
    const double g = std::abs(d) > 5 ? 0.0 : std::exp(-0.5 * d * d / 2.25) / weights;
    similarity += 1e-4 / (g * g + 1e-4) * 9e-4 / (g - g * g + 9e-4);
  }
  EXPECT_NEAR(Value(line, nothing, Comparison::SSIM), 1.0 - similarity / 40.0, 1e-9);
}

TEST(vtkPenumbraImageComparison, DetectsSwappedChannels)
{
  const Image red = Bytes(16, 16, Constant({ 255, 0, 0 }));
  const Image blue = Bytes(16, 16, Constant({ 0, 0, 255 }));
  EXPECT_NEAR(Value(red, blue, Comparison::RMSE), std::sqrt(2.0 / 3.0), 1e-12);
  EXPECT_EQ(Value(red, blue, Comparison::MAXIMUM), 1.0);
  EXPECT_EQ(Value(red, blue, Comparison::PIXELS), 1.0);
  // Two of three channels have only the constant C1 / (1 + C1) in common.
  EXPECT_NEAR(Value(red, blue, Comparison::SSIM), 2.0 / 3.0 * (1.0 - 1e-4 / (1.0 + 1e-4)), 1e-9);
}

TEST(vtkPenumbraImageComparison, AcceptsFourStepsButNotFive)
{
  const Image zero = Bytes(8, 8, Constant({ 100, 100, 100 }));
  const Image four = Bytes(8, 8, Constant({ 104, 96, 100 }));
  const Image five = Bytes(8, 8, [](int x, int) { return Color{ 100, 100, x < 2 ? 105. : 100. }; });
  EXPECT_EQ(Value(zero, four, Comparison::PIXELS), 0.0);
  EXPECT_EQ(Value(zero, five, Comparison::PIXELS), 0.25);
}

TEST(vtkPenumbraImageComparison, IgnoresTheColorOfWhatIsTransparent)
{
  const Image a = Floats(12, 12, Constant({ 1., 0., 0., 0. }));
  const Image b = Floats(12, 12, Constant({ 0., 1., 0., 0. }));
  const Image half = Floats(12, 12, Constant({ 0., 1., 0., 0.5 }));
  EXPECT_EQ(Value(a, b, Comparison::RMSE), 0.0);
  // Green with half opacity: green and alpha differ by 1/2, red and blue do not.
  EXPECT_NEAR(Value(a, half, Comparison::RMSE), std::sqrt(2 * 0.25 / 4), 1e-12);
}

TEST(vtkPenumbraImageComparison, TreatsGrayAndBytesAndFloatsAsEqual)
{
  const Image gray = Bytes(12, 12, Constant({ 51 }));
  const Image color = Bytes(12, 12, Constant({ 51, 51, 51, 255 }));
  const Image floats = Floats(12, 12, Constant({ 0.2, 0.2, 0.2, 1. }));
  EXPECT_EQ(Value(gray, color, Comparison::MAXIMUM), 0.0);
  EXPECT_NEAR(Value(gray, floats, Comparison::MAXIMUM), 0.0, 1e-7);
}

TEST(vtkPenumbraImageComparison, ComparesImagesSmallerThanTheWindow)
{
  const Image a = Floats(1, 3, Constant({ 0.3 }));
  const Image b = Floats(1, 3, Constant({ 0.4 }));
  const double similarity = (2 * 0.3 * 0.4 + 1e-4) / (0.3 * 0.3 + 0.4 * 0.4 + 1e-4);
  EXPECT_NEAR(Value(a, b, Comparison::SSIM), 1.0 - similarity, 1e-6);
}

TEST(vtkPenumbraImageComparison, SelectsTheNearestBaseline)
{
  vtkNew<vtkPenumbraImageComparison> comparison;
  comparison->SetImage(Floats(4, 4, Constant({ 0.5 })));
  comparison->AddBaseline(Floats(4, 4, Constant({ 0.9 })));
  comparison->AddBaseline(Floats(4, 4, Constant({ 0.45 })));
  comparison->AddBaseline(Floats(4, 4, Constant({ 0.1 })));
  ASSERT_TRUE(comparison->Compare());
  EXPECT_EQ(comparison->GetBestBaseline(), 1);
  EXPECT_NEAR(comparison->GetValue(Comparison::RMSE), 0.05, 1e-7);
}

TEST(vtkPenumbraImageComparison, RendersTheDifference)
{
  vtkNew<vtkPenumbraImageComparison> comparison;
  comparison->SetImage(Floats(4, 4, Constant({ 0.5, 0.25, 0. })));
  comparison->AddBaseline(Floats(4, 4, Constant({ 0.25, 0.5, 0. })));
  ASSERT_TRUE(comparison->Compare());
  const Image difference = comparison->MakeDifference();
  double* tuple = difference->GetPointData()->GetArray("Color")->GetTuple4(7);
  EXPECT_EQ(tuple[0], 0.25);
  EXPECT_EQ(tuple[1], 0.25);
  EXPECT_EQ(tuple[2], 0.0);
  EXPECT_EQ(tuple[3], 1.0);
}

TEST(vtkPenumbraImageComparison, FindsTheWorstTileAtAnyPosition)
{
  // 4x4 pixels around the corner of four tiles of a fixed grid differ by 1/2.
  const auto spot = [](int x, int y) {
    return Color(3, x >= 14 && x < 18 && y >= 30 && y < 34 ? 0.5 : 0.0);
  };
  const Image a = Floats(64, 48, spot);
  const Image nothing = Floats(64, 48, Constant({ 0., 0., 0. }));
  EXPECT_NEAR(Value(a, nothing, Comparison::TILE_RMSE), 0.5 * 4 / 16, 1e-12);
  EXPECT_EQ(Value(a, nothing, Comparison::TILE_PIXELS), 16.0 / 256.0);
}

TEST(vtkPenumbraImageComparison, MeasuresADefectIndependentlyOfImageSize)
{
  const auto flaw = [](int x, int y) { return Color(3, x == 9 && y > 3 && y < 12 ? 0.7 : 0.2); };
  for (int size : { 16, 40, 150 })
  {
    const Image a = Floats(size, size, flaw);
    const Image b = Floats(size, size, Constant({ 0.2, 0.2, 0.2 }));
    EXPECT_NEAR(Value(a, b, Comparison::TILE_RMSE), 0.5 * std::sqrt(8.0) / 16, 1e-7) << size;
    EXPECT_EQ(Value(a, b, Comparison::TILE_PIXELS), 8.0 / 256.0) << size;
  }
}

TEST(vtkPenumbraImageComparison, TreatsASmallImageAsOneTile)
{
  const Image a = Floats(5, 2, [](int x, int) { return Color(3, x == 0 ? 1. : 0.); });
  const Image b = Floats(5, 2, Constant({ 0., 0., 0. }));
  EXPECT_NEAR(Value(a, b, Comparison::TILE_RMSE), std::sqrt(0.2), 1e-12);
  EXPECT_NEAR(Value(a, b, Comparison::TILE_PIXELS), 0.2, 1e-12);
}

bool IsNear(vtkImageData* image, vtkImageData* baseline, double tolerance = 1.0 / 16.0)
{
  vtkNew<vtkPenumbraImageComparison> comparison;
  comparison->SetImage(image);
  comparison->AddBaseline(baseline);
  comparison->SetTolerance(tolerance);
  EXPECT_TRUE(comparison->Compare()) << comparison->GetErrorText();
  return comparison->IsNear();
}

TEST(vtkPenumbraImageComparison, RejectsOneMissingLineInALargeImage)
{
  // A light gray line on white, horizontal or diagonal: a mean over the image does not detect it.
  const Image nothing = Bytes(500, 300, Constant({ 255, 255, 255 }));
  for (const int slope : { 0, 1 })
  {
    const Image line = Bytes(500, 300,
      [slope](int x, int y) { return Color(3, y - 150 == slope * (x - 250) ? 235. : 255.); });
    EXPECT_LT(Value(line, nothing, Comparison::RMSE), 0.005) << slope;
    EXPECT_LT(Value(line, nothing, Comparison::PIXELS), 0.005) << slope;
    EXPECT_FALSE(IsNear(line, nothing)) << slope;
  }
}

TEST(vtkPenumbraImageComparison, RejectsSwappedColorsOfASmallObject)
{
  const auto object = [](const Color& color) {
    return [color](int x, int y) {
      return x / 4 == 50 && y / 4 == 40 ? color : Color{ 30, 40, 50 };
    };
  };
  const Image red = Bytes(500, 300, object({ 200, 60, 50 }));
  const Image blue = Bytes(500, 300, object({ 50, 60, 200 }));
  EXPECT_LT(Value(red, blue, Comparison::PIXELS), 2e-4);
  EXPECT_FALSE(IsNear(red, blue));
}

TEST(vtkPenumbraImageComparison, AcceptsOnePixelOfATileAndNoneAtTolerance0)
{
  const auto pixels = [](int pitch) {
    return Bytes(100, 100,
      [pitch](int x, int y) { return Color(3, x % pitch == 3 && y % pitch == 3 ? 255. : 0.); });
  };
  const Image nothing = Bytes(100, 100, Constant({ 0, 0, 0 }));
  EXPECT_TRUE(IsNear(pixels(16), nothing));
  EXPECT_FALSE(IsNear(pixels(15), nothing));
  EXPECT_TRUE(IsNear(nothing, nothing, 0.0));
  EXPECT_FALSE(IsNear(Bytes(100, 100, Constant({ 0, 0, 1 })), nothing, 0.0));
}

Image Recorded(const std::string& name)
{
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName((PENUMBRA_PAIRS "/" + name + ".png").c_str());
  reader->Update();
  return reader->GetOutput();
}

TEST(vtkPenumbraImageComparison, AcceptsDifferencesOfDriversAndProcessors)
{
  const std::pair<const char*, const char*> pairs[] = { { "scalars", "softpipe" },
    { "edges", "softpipe" }, { "occlusion", "sse2" }, { "texture", "sse2" } };
  for (const auto& [scene, other] : pairs)
  {
    const Image one = Recorded(std::string(scene) + "-llvmpipe");
    const Image two = Recorded(std::string(scene) + "-" + other);
    EXPECT_GT(Value(one, two, Comparison::MAXIMUM), 0.0) << scene;
    EXPECT_TRUE(IsNear(one, two)) << scene;
    EXPECT_TRUE(IsNear(two, one)) << scene;
  }
  EXPECT_FALSE(IsNear(Recorded("wires-llvmpipe"), Recorded("wires-softpipe")));
  EXPECT_FALSE(IsNear(Recorded("edges-llvmpipe"), Recorded("scalars-llvmpipe")));
}

TEST(vtkPenumbraImageComparison, RejectsARecordedImageWithSwappedColorsOrAMissingLine)
{
  const Image image = Recorded("scalars-llvmpipe");
  vtkDataArray* pixels = image->GetPointData()->GetScalars();
  const int width = image->GetDimensions()[0];
  const auto change = [&](const std::function<vtkIdType(vtkIdType, int)>& source) {
    return Bytes(width, image->GetDimensions()[1], [&, source](int x, int y) {
      Color color;
      for (int c = 0; c < 3; ++c)
      {
        const vtkIdType from = source(static_cast<vtkIdType>(y) * width + x, c);
        color.push_back(pixels->GetComponent(from / 3, static_cast<int>(from % 3)));
      }
      return color;
    });
  };
  EXPECT_TRUE(IsNear(image, change([](vtkIdType i, int c) { return 3 * i + c; })));
  EXPECT_FALSE(IsNear(image, change([](vtkIdType i, int c) { return 3 * i + 2 - c; })));
  // The middle row of pixels is replaced by a copy of its neighbor.
  const vtkIdType middle = image->GetDimensions()[1] / 2;
  EXPECT_FALSE(IsNear(image,
    change([&](vtkIdType i, int c) { return 3 * (i / width == middle ? i - width : i) + c; })));
}

TEST(vtkPenumbraImageComparison, IgnoresMaskedPixels)
{
  const Image a = Floats(40, 20, [](int x, int) { return Color(3, x < 10 ? 1. : 0.1); });
  const Image b = Floats(40, 20, Constant({ 0., 0., 0. }));
  const Image mask = Bytes(40, 20, [](int x, int) { return Color{ x < 10 ? 0. : 9., 0, 0, 255 }; });
  vtkNew<vtkPenumbraImageComparison> comparison;
  comparison->SetImage(a);
  comparison->AddBaseline(b);
  comparison->SetMask(mask);
  ASSERT_TRUE(comparison->Compare());
  EXPECT_NEAR(comparison->GetValue(Comparison::RMSE), 0.1, 1e-7);
  EXPECT_NEAR(comparison->GetValue(Comparison::MAXIMUM), 0.1, 1e-7);
  EXPECT_NEAR(comparison->GetValue(Comparison::TILE_RMSE), 0.1, 1e-7);
  EXPECT_EQ(comparison->GetValue(Comparison::PIXELS), 1.0);
  EXPECT_EQ(comparison->MakeDifference()->GetPointData()->GetScalars()->GetComponent(5, 0), 0.0);

  comparison->SetMask(Bytes(40, 20, Constant({ 0, 0, 0, 255 })));
  EXPECT_FALSE(comparison->Compare());
  EXPECT_STREQ(comparison->GetErrorText(), "the mask excludes all pixels");
  comparison->SetMask(Bytes(40, 21, Constant({ 1, 0, 0 })));
  EXPECT_FALSE(comparison->Compare());
  EXPECT_STREQ(comparison->GetErrorText(), "the mask differs in size: 40x20 and 40x21");
}

TEST(vtkPenumbraImageComparison, RejectsImagesThatCannotBeCompared)
{
  vtkNew<vtkPenumbraImageComparison> comparison;
  EXPECT_FALSE(comparison->Compare());
  comparison->SetImage(Floats(4, 4, Constant({ 0.5 })));
  EXPECT_FALSE(comparison->Compare());
  comparison->AddBaseline(Floats(4, 5, Constant({ 0.5 })));
  EXPECT_FALSE(comparison->Compare());
  EXPECT_STREQ(comparison->GetErrorText(), "the images differ in size: 4x4 and 4x5");
  EXPECT_EQ(comparison->GetBestBaseline(), -1);
  comparison->RemoveAllBaselines();
  comparison->AddBaseline(Floats(4, 4, Constant({ std::numeric_limits<double>::quiet_NaN() })));
  EXPECT_FALSE(comparison->Compare());
  EXPECT_STREQ(comparison->GetErrorText(), "an image has values that are not finite");
}

}
