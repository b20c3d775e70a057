// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The scalar bar. Figures in .svg hold its texts with their positions and sizes.
#include "Meshes.h"
#include "Program.h"
#include "RenderedImages.h"

#include "vtkImageData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>

using namespace penumbra_testing;

namespace
{

struct Text
{
  double X = 0.0;
  double Y = 0.0; ///< of the baseline, from the top
  double Size = 0.0;
  std::string Contents;
};

std::vector<Text> FindTexts(const std::string& svg)
{
  const std::regex pattern(
    "<text x=\"([^\"]*)\" y=\"([^\"]*)\"[^>]*font-size=\"([^\"]*)\"[^>]*>([^<]*)");
  std::vector<Text> texts;
  for (auto i = std::sregex_iterator(svg.begin(), svg.end(), pattern); i != std::sregex_iterator();
       ++i)
  {
    texts.push_back({ std::stod((*i)[1]), std::stod((*i)[2]), std::stod((*i)[3]), (*i)[4] });
  }
  return texts;
}

ProgramResult Render(
  const Folder& folder, const std::string& output, const std::vector<std::string>& options)
{
  WriteSphereWithArrays(folder / "sphere.vtp");
  std::vector<std::string> arguments = { "render", folder / "sphere.vtp", "--output",
    folder / output, "--resolution", "400,300", "--coloring-array", "Height" };
  arguments.insert(arguments.end(), options.begin(), options.end());
  return RunProgram(arguments);
}

/// Returns the texts of a figure with a scalar bar; the title is the last one.
std::vector<Text> RenderTexts(const std::vector<std::string>& options)
{
  const Folder folder("texts");
  std::vector<std::string> all = options;
  all.insert(
    all.end(), { "-b", "--camera-zoom-factor", "0.1" }); // The sphere takes most of the time.
  const ProgramResult outcome = Render(folder, "bar.svg", all);
  EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
  std::vector<Text> texts = FindTexts(ReadText(folder / "bar.svg"));
  std::stable_partition(texts.begin(), texts.end(), [](const Text& text) {
    return text.Contents.find_first_not_of("-+.e0123456789 m") == std::string::npos;
  });
  return texts;
}

TEST(ScalarBar, TitleIsNotLargerThanLabelsAndDoesNotTouchThem)
{
  for (const std::vector<std::string>& options :
    { std::vector<std::string>{}, { "--resolution", "200,400" }, { "--dpi", "150" },
      { "--scalar-bar-size", "0.6,0.12" }, { "--scalar-bar-size", "0.9,0.02" } })
  {
    const std::vector<Text> texts = RenderTexts(options);
    ASSERT_EQ(texts.size(), 6u);
    const Text& title = texts.back();
    EXPECT_EQ(title.Contents, "Height");
    for (std::size_t i = 0; i + 1 < texts.size(); ++i)
    {
      EXPECT_LE(title.Size, texts[i].Size);
      EXPECT_LT(title.Y, texts[i].Y - 1.2 * texts[i].Size); // above the label
    }
  }
}

TEST(ScalarBar, LabelsHaveTheValuesOfTheirPositions)
{
  std::vector<Text> texts = RenderTexts({ "--coloring-range=-1,3", "--scalar-bar-labels", "3",
    "--scalar-bar-format", "%.2f m", "--scalar-bar-title", "z" });
  ASSERT_EQ(texts.size(), 4u);
  EXPECT_EQ(texts[0].Contents, "-1.00 m");
  EXPECT_EQ(texts[1].Contents, "1.00 m");
  EXPECT_EQ(texts[2].Contents, "3.00 m");
  EXPECT_EQ(texts[3].Contents, "z");
  EXPECT_NEAR(texts[1].Y, 0.5 * (texts[0].Y + texts[2].Y), 1.0);
  EXPECT_GT(texts[0].Y, texts[2].Y);
  // Without labels and title.
  EXPECT_TRUE(RenderTexts({ "--scalar-bar-labels", "0", "--scalar-bar-title", "" }).empty());
}

TEST(ScalarBar, TextsEndWithinTheImage)
{
  const Folder folder("border");
  const std::vector<std::string> wide = { "-b", "--camera-zoom-factor", "0.01", "--coloring-range",
    "-123456,100000", "--scalar-bar-title", "Velocity magnitude [m/s]" };
  for (const std::vector<std::string>& more :
    { std::vector<std::string>{}, { "--scalar-bar-format", "%.8e" },
      { "--scalar-bar-size", "0.1,0.6" }, { "--scalar-bar-size", "0.95,0.1" },
      { "--look", "figure", "--background-color", "black" } })
  {
    std::vector<std::string> options = wide;
    options.insert(options.end(), more.begin(), more.end());
    ASSERT_EQ(Render(folder, "bar.png", options).Status, 0);
    const auto image = ReadImage(folder / "bar.png");
    int lit = 0;
    for (int y = 0; y < 300; ++y)
    {
      for (const int x : { 0, 1, 398, 399 })
      {
        lit += PixelAt(image, x, y)[0] > 0.1;
      }
    }
    EXPECT_EQ(lit, 0) << (more.empty() ? "" : more[1]);
  }
}

TEST(ScalarBar, PositionAndSizeAreFractionsOfTheImage)
{
  const Folder folder("position");
  ASSERT_EQ(Render(folder, "bar.png",
              { "-b", "--camera-zoom-factor", "0.01", "--colormap", "plasma",
                "--scalar-bar-position", "0.1,0.2", "--scalar-bar-size", "0.15,0.6" })
              .Status,
    0);
  const auto image = ReadImage(folder / "bar.png");
  int bounds[4] = { 400, 0, 300, 0 };
  for (int y = 0; y < 300; ++y)
  {
    for (int x = 0; x < 400; ++x)
    {
      // The colors of the bar are the only ones that are not gray.
      const Pixel pixel = PixelAt(image, x, y);
      const bool isSphere = std::abs(x - 200) < 20 && std::abs(y - 150) < 20;
      if (!isSphere && std::abs(pixel[0] - pixel[2]) > 0.1)
      {
        bounds[0] = std::min(bounds[0], x);
        bounds[1] = std::max(bounds[1], x);
        bounds[2] = std::min(bounds[2], y);
        bounds[3] = std::max(bounds[3], y);
      }
    }
  }
  EXPECT_NEAR(bounds[0], 40, 2);
  EXPECT_LE(bounds[1], 100);
  EXPECT_NEAR(bounds[2], 60, 5);
  EXPECT_LE(bounds[3], 240);
  EXPECT_GE(bounds[3] - bounds[2], 130);
}

TEST(ScalarBar, InvalidSettingsAreErrors)
{
  const Folder folder("invalid");
  const std::vector<std::pair<std::string, std::string>> rows = { { "--scalar-bar-format", "%s" },
    { "--scalar-bar-format", "%f %f" }, { "--scalar-bar-format", "3" },
    { "--scalar-bar-format", "%n" }, { "--scalar-bar-format", "%*f" },
    { "--scalar-bar-position", "2,0" }, { "--scalar-bar-size", "0,1" },
    { "--scalar-bar-labels", "65" } };
  for (const auto& [option, value] : rows)
  {
    const ProgramResult outcome = Render(folder, "bar.png", { "-b", option + "=" + value });
    EXPECT_EQ(outcome.Status, 2) << option << value;
    EXPECT_NE(outcome.Errors.find(option), std::string::npos) << outcome.Errors;
  }
}

}
