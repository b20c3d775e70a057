// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Overlay.h"
#include "Scene.h"
#include "Surface.h"

#include "Import/SceneExtraction.h"

#include "vtkImageData.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkProperty2D.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkScalarBarActor.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVariant.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace penumbra;

namespace
{

ExtractionOptions MakeOptions(int width, int height)
{
  ExtractionOptions options;
  options.Resolution[0] = width;
  options.Resolution[1] = height;
  return options;
}

/// Composites the overlay over transparent black. Returns straight-alpha colors, row by row.
std::vector<glm::vec4> Composite(const Overlay& overlay)
{
  const int width = overlay.GetWidth();
  std::vector<glm::vec4> colors(
    static_cast<std::size_t>(width) * overlay.GetHeight(), glm::vec4(0.f));
  for (int y = 0; y < overlay.GetHeight(); ++y)
  {
    overlay.CompositeOver(0, y, width, &colors[static_cast<std::size_t>(y) * width]);
  }
  return colors;
}

/// Returns the maximum of each channel over the pixels in [low, high).
glm::vec4 ComputeMaximum(const Overlay& overlay, glm::ivec2 low, glm::ivec2 high)
{
  const std::vector<glm::vec4> colors = Composite(overlay);
  glm::vec4 result(0.f);
  for (int y = low.y; y < high.y; ++y)
  {
    for (int x = low.x; x < high.x; ++x)
    {
      result = glm::max(result, colors[static_cast<std::size_t>(y) * overlay.GetWidth() + x]);
    }
  }
  return result;
}

}

// As colors of a framebuffer: text on a background of (255, 255, 255) was nearly invisible.
TEST(Overlay, ClampsColors)
{
  Overlay overlay(2, 1);
  overlay.FillRectangle({ 0.0, 0.0 }, { 2.0, 1.0 }, glm::vec4(255.f, 255.f, -1.f, 1.f));
  overlay.FillRectangle({ 0.0, 0.0 }, { 1.0, 1.0 }, glm::vec4(0.f, 0.f, 0.f, 0.75f));
  OverlayShape shape;
  shape.Color = glm::vec4(255.f, 0.5f, -1.f, 1.f);
  overlay.AddShape(shape);
  const std::vector<glm::vec4> colors = Composite(overlay);
  EXPECT_EQ(colors[0], glm::vec4(0.25f, 0.25f, 0.f, 1.f));
  EXPECT_EQ(colors[1], glm::vec4(1.f, 1.f, 0.f, 1.f));
  EXPECT_EQ(overlay.GetShapes()[0].Color, glm::vec4(1.f, 0.5f, 0.f, 1.f));
}

TEST(Overlay, FillsRectanglesWithExactCoverage)
{
  Overlay overlay(4, 3);
  EXPECT_TRUE(overlay.IsEmpty());
  overlay.FillRectangle({ 0.75, 0.5 }, { 2.5, 1.25 }, { 1.f, 0.5f, 0.f, 1.f });
  const std::vector<glm::vec4> colors = Composite(overlay);
  const float expected[12] = { 0.125f, 0.5f, 0.25f, 0.f, 0.0625f, 0.25f, 0.125f, 0.f };
  for (int i = 0; i < 12; ++i)
  {
    EXPECT_FLOAT_EQ(colors[i].a, expected[i]) << i;
    EXPECT_FLOAT_EQ(colors[i].r, expected[i] > 0.f ? 1.f : 0.f) << i;
  }
}

TEST(Overlay, IgnoresRectanglesOutsideTheImage)
{
  Overlay overlay(4, 3);
  overlay.FillRectangle({ -5.0, -5.0 }, { -1.0, 9.0 }, glm::vec4(1.f));
  overlay.FillRectangle({ 1.0, 2.0 }, { 1.0, 9.0 }, glm::vec4(1.f));
  overlay.FillRectangle({ std::nan(""), 0.0 }, { 3.0, 3.0 }, glm::vec4(1.f));
  EXPECT_TRUE(overlay.IsEmpty());
  overlay.FillRectangle({ -1e9, -1e9 }, { 1e9, 1e9 }, glm::vec4(1.f));
  EXPECT_EQ(Composite(overlay)[11], glm::vec4(1.f));
}

TEST(Overlay, CompositesOverOpaqueAndTranslucentColors)
{
  Overlay overlay(1, 1);
  overlay.FillRectangle({ 0.0, 0.0 }, { 1.0, 1.0 }, { 1.f, 0.f, 0.f, 0.5f });
  glm::vec4 opaque(0.f, 1.f, 0.f, 1.f);
  overlay.CompositeOver(0, 0, 1, &opaque);
  EXPECT_EQ(opaque, glm::vec4(0.5f, 0.5f, 0.f, 1.f));
  glm::vec4 half(0.f, 1.f, 0.f, 0.5f);
  overlay.CompositeOver(0, 0, 1, &half);
  EXPECT_FLOAT_EQ(half.a, 0.75f);
  EXPECT_FLOAT_EQ(half.r, 0.5f / 0.75f);
  EXPECT_FLOAT_EQ(half.g, 0.25f / 0.75f);
}

TEST(Overlay, MatchesVTKForText)
{
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(200, 100);
  window->AddRenderer(renderer);
  renderer->SetBackground(0.2, 0.3, 0.4);
  vtkNew<vtkTextActor> text;
  text->SetInput("Penumbra 3.14");
  text->GetTextProperty()->SetFontSize(24);
  text->GetTextProperty()->SetColor(1.0, 0.8, 0.2);
  text->SetPosition(10, 30);
  renderer->AddViewProp(text);
  window->Render();
  vtkNew<vtkUnsignedCharArray> raster;
  window->GetPixelData(0, 0, 199, 99, 1, raster);

  const Scene scene = ExtractScene(renderer, MakeOptions(200, 100));
  EXPECT_TRUE(scene.Warnings.empty());
  ASSERT_FALSE(scene.OverlayImage->IsEmpty());
  int written = 0;
  for (int y = 0; y < 100; ++y)
  {
    std::vector<glm::vec4> row(200, glm::vec4(0.2f, 0.3f, 0.4f, 1.f));
    scene.OverlayImage->CompositeOver(0, y, 200, row.data());
    for (int x = 0; x < 200; ++x)
    {
      for (int k = 0; k < 3; ++k)
      {
        EXPECT_NEAR(255.f * row[x][k], raster->GetComponent(y * 200 + x, k), 2.0) << x << " " << y;
      }
      written += row[x].r > 0.9f;
    }
  }
  EXPECT_GT(written, 200);
}

TEST(ScalarBar, DrawsColorsLabelsAndTitle)
{
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkLookupTable> table;
  table->SetRange(0.0, 10.0);
  table->SetHueRange(0.0, 0.0);
  table->SetValueRange(0.0, 1.0);
  table->Build();
  for (const bool vertical : { true, false })
  {
    vtkNew<vtkScalarBarActor> bar;
    bar->SetLookupTable(table);
    bar->SetTitle("Height");
    renderer->RemoveAllViewProps();
    renderer->AddViewProp(bar);
    if (!vertical)
    {
      bar->SetOrientationToHorizontal();
      bar->SetPosition(0.1, 0.1);
      bar->SetPosition2(0.8, 0.2);
    }
    const Scene scene = ExtractScene(renderer, MakeOptions(400, 300));
    EXPECT_TRUE(scene.Warnings.empty());
    const std::vector<glm::vec4> colors = Composite(*scene.OverlayImage);
    const auto red = [&](int x, int y) { return colors[y * 400 + x].r; };
    if (vertical)
    {
      // The color bar starts at (0.82, 0.1) of the image size; red increases upward.
      EXPECT_LT(red(335, 35), red(335, 120));
      EXPECT_LT(red(335, 120), red(335, 200));
      EXPECT_GT(ComputeMaximum(*scene.OverlayImage, { 360, 30 }, { 400, 240 }).a, 0.5f);  // labels
      EXPECT_GT(ComputeMaximum(*scene.OverlayImage, { 330, 246 }, { 400, 270 }).a, 0.5f); // title
    }
    else
    {
      EXPECT_LT(red(50, 35), red(200, 35));
      EXPECT_LT(red(200, 35), red(320, 35));
      EXPECT_GT(ComputeMaximum(*scene.OverlayImage, { 40, 50 }, { 360, 72 }).a, 0.5f);
      EXPECT_GT(ComputeMaximum(*scene.OverlayImage, { 150, 72 }, { 250, 90 }).a, 0.5f);
    }
    EXPECT_EQ(ComputeMaximum(*scene.OverlayImage, { 0, 0 }, { 4, 300 }).a, 0.f);
  }
}

/// Renders `bar` with VTK and as overlay. Returns the number of pixels that differ by more than 8 of
/// 255 in a channel.
int CompareWithVTK(vtkScalarBarActor* bar, int width, int height)
{
  const float background[3] = { 0.2f, 0.3f, 0.4f };
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(width, height);
  window->AddRenderer(renderer);
  renderer->SetBackground(background[0], background[1], background[2]);
  renderer->AddViewProp(bar);
  window->Render();
  vtkNew<vtkUnsignedCharArray> raster;
  window->GetPixelData(0, 0, width - 1, height - 1, 1, raster);
  const Scene scene = ExtractScene(renderer, MakeOptions(width, height));
  EXPECT_TRUE(scene.Warnings.empty());
  int different = 0;
  for (int y = 0; y < height; ++y)
  {
    std::vector<glm::vec4> row(width, glm::vec4(background[0], background[1], background[2], 1.f));
    scene.OverlayImage->CompositeOver(0, y, width, row.data());
    for (int x = 0; x < width; ++x)
    {
      bool differs = false;
      for (int k = 0; k < 3; ++k)
      {
        differs =
          differs || std::abs(255.f * row[x][k] - raster->GetComponent(y * width + x, k)) > 8.0;
      }
      different += differs;
    }
  }
  return different;
}

TEST(ScalarBar, MatchesVTK)
{
  vtkNew<vtkLookupTable> table;
  table->SetRange(-2.0, 10.0);
  table->Build();
  for (const bool vertical : { true, false })
  {
    for (const bool precede : { true, false })
    {
      vtkNew<vtkScalarBarActor> bar;
      bar->SetLookupTable(table);
      bar->SetTitle("Height above sea");
      bar->SetNumberOfLabels(7);
      bar->SetTextPosition(
        precede ? vtkScalarBarActor::PrecedeScalarBar : vtkScalarBarActor::SucceedScalarBar);
      if (!vertical)
      {
        bar->SetOrientationToHorizontal();
        bar->SetPosition(0.1, 0.1);
        bar->SetPosition2(0.8, 0.2);
      }
      EXPECT_EQ(CompareWithVTK(bar, 400, 300), 0) << vertical << precede;
    }
  }
}

TEST(ScalarBar, MatchesVTKWithAllParts)
{
  vtkNew<vtkLookupTable> table;
  table->SetRange(1.0, 1000.0);
  table->SetScaleToLog10();
  table->Build();
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(table);
  bar->SetTitle("Height");
  bar->DrawNanAnnotationOn();
  bar->DrawFrameOn();
  bar->DrawBackgroundOn();
  bar->GetBackgroundProperty()->SetColor(0.1, 0.1, 0.5);
  bar->DrawBelowRangeSwatchOn();
  bar->DrawAboveRangeSwatchOn();
  EXPECT_LE(CompareWithVTK(bar, 500, 400), 8);
}

TEST(ScalarBar, MatchesVTKForCategories)
{
  vtkNew<vtkLookupTable> table;
  table->IndexedLookupOn();
  table->SetNumberOfTableValues(3);
  table->SetTableValue(0, 1.0, 0.0, 0.0);
  table->SetTableValue(1, 0.0, 1.0, 0.0);
  table->SetTableValue(2, 0.0, 0.0, 1.0);
  table->SetAnnotation(vtkVariant(1), "skin");
  table->SetAnnotation(vtkVariant(2), "bone");
  table->SetAnnotation(vtkVariant(3), "fat");
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(table);
  bar->SetTitle("Tissue");
  EXPECT_LE(CompareWithVTK(bar, 500, 400), 4);
}
