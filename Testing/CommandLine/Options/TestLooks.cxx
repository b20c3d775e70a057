// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// --look and --config.
#include "Meshes.h"
#include "Program.h"
#include "RenderedImages.h"

#include "vtkImageData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace penumbra_testing;

namespace
{

constexpr int Width = 120;
constexpr int Height = 80;

/// Renders a sphere; returns the result of the program.
ProgramResult Render(
  const Folder& folder, const std::string& output, const std::vector<std::string>& options)
{
  WriteSphereWithArrays(folder / "sphere.vtp");
  std::vector<std::string> arguments = { "render", folder / "sphere.vtp", "--output",
    folder / output, "--resolution", "120,80", "--light-tolerance", "0.05" };
  arguments.insert(arguments.end(), options.begin(), options.end());
  return RunProgram(arguments);
}

/// Expects two renderings to write the same bytes.
void ExpectEqual(
  const Folder& folder, const std::vector<std::string>& a, const std::vector<std::string>& b)
{
  EXPECT_EQ(Render(folder, "a.png", a).Status, 0);
  EXPECT_EQ(Render(folder, "b.png", b).Status, 0);
  EXPECT_EQ(ReadText(folder / "a.png"), ReadText(folder / "b.png"));
}

double Distance(const Pixel& a, const Pixel& b)
{
  return std::max({ std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2]) });
}

TEST(Looks, PlainChangesNothing)
{
  const Folder folder("plain");
  ExpectEqual(folder, {}, { "--look", "plain" });
}

TEST(Looks, FillTheImage)
{
  const Folder folder("fill");
  for (const char* look : { "studio", "outdoor", "figure", "clay" })
  {
    for (const char* up : { "+Y", "+Z" })
    {
      ASSERT_EQ(Render(folder, "look.png", { "--look", look, "--camera-view-up", up }).Status, 0);
      const auto image = ReadImage(folder / "look.png");
      const Pixel background = PixelAt(image, 0, 0);
      int first = Height;
      int last = 0;
      for (int y = 0; y < Height; ++y)
      {
        for (int x = 0; x < Width; ++x)
        {
          if (Distance(PixelAt(image, x, y), background) > 2.0 / 255.0)
          {
            first = std::min(first, y);
            last = std::max(last, y);
          }
        }
      }
      EXPECT_NEAR((last - first + 1.0) / Height, 0.94, 0.05) << look << up;
      EXPECT_NEAR(first, Height - 1 - last, 2) << look << up;
    }
  }
}

TEST(Looks, LightFromAbove)
{
  const Folder folder("above");
  for (const char* look : { "studio", "outdoor", "figure", "clay" })
  {
    ASSERT_EQ(Render(folder, "look.png", { "--look", look }).Status, 0);
    const auto image = ReadImage(folder / "look.png");
    EXPECT_GT(PixelAt(image, Width / 2 - 14, Height / 2 + 14)[1],
      PixelAt(image, Width / 2 + 20, Height / 2 - 20)[1] + 0.1)
      << look;
  }
}

TEST(Looks, SunOfOutdoorHasPenumbrae)
{
  const Folder folder("sun");
  const auto render = [&](const std::string& image, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = { "render", SourceFolder() + "/Data/bracket.stl",
      "--output", folder / image, "--resolution", "160,100", "--look", "outdoor",
      "--camera-view-up", "+Z" };
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(RunProgram(arguments).Status, 0);
  };
  render("default.png", {});
  render("soft.png", { "--light-angle", "3" });
  render("hard.png", { "--light-angle", "0" });
  EXPECT_EQ(ReadText(folder / "default.png"), ReadText(folder / "soft.png"));
  EXPECT_GT(Compare(folder / "hard.png", folder / "soft.png"), 0.05);
}

TEST(Looks, OptionsReplaceTheirSettings)
{
  const Folder folder("replace");
  const std::vector<std::string> options = { "--background-color", "1,0,0", "--color", "0,1,0",
    "--light-position", "0,0,1,0", "--camera-position", "0,0,3", "--no-lighting",
    "--ambient-occlusion-strength", "0" };
  std::vector<std::string> clay = options;
  clay.insert(clay.end(), { "--look", "clay" });
  ASSERT_EQ(Render(folder, "clay.vti", clay).Status, 0);
  const auto image = ReadImage(folder / "clay.vti");
  EXPECT_LE(Distance(PixelAt(image, 0, 0), { 1, 0, 0 }), 1e-6);
  EXPECT_LE(Distance(PixelAt(image, Width / 2, Height / 2), { 0, 1, 0 }), 1e-6);
}

TEST(Looks, CameraOptionsAndLightsOfOptionsAreKept)
{
  const Folder folder("camera");
  const std::vector<std::string> options = { "--background-color", "0.2,0.2,0.2",
    "--light-position", "0,0,1,0", "--camera-direction", "1,0,0", "--camera-zoom-factor", "1",
    "--ambient-occlusion" };
  std::vector<std::string> studio = options;
  studio.insert(studio.end(), { "--look", "studio", "--ambient-occlusion-strength", "1" });
  ExpectEqual(folder, options, studio);
}

TEST(Configuration, HoldsOptions)
{
  const Folder folder("config");
  WriteText(folder / "film.json",
    "{ \"background-color\": [0.5, 0.25, 0], \"show-edges\": true, \"no-lighting\": false,\n"
    "  \"coloring-array\": \"Height\", \"camera-azimuth-angle\": 20,\n"
    "  \"light-position\": [\"1,1,1,0\", [0, 0, 1, 0]] }");
  ExpectEqual(folder, { "--config", folder / "film.json" },
    { "--background-color", "0.5,0.25,0", "--show-edges", "--coloring-array", "Height",
      "--camera-azimuth-angle", "20", "--light-position", "1,1,1,0", "--light-position",
      "0,0,1,0" });
}

TEST(Configuration, YieldsToTheCommandLine)
{
  const Folder folder("precedence");
  WriteText(folder / "film.json",
    "{ \"background-color\": \"0,0,1\", \"light-position\": \"1,1,1,0\", \"edges\": true,\n"
    "  \"look\": \"studio\", \"camera-direction\": [0, 0, -1], \"camera-zoom-factor\": 1 }");
  ExpectEqual(folder,
    { "--config=" + folder / "film.json", "--background-color=1,1,0", "--light-position", "0,0,1,0",
      "-e", "--look", "plain" },
    { "-e", "--background-color", "1,1,0", "--light-position", "0,0,1,0" });
}

// CLI11 takes the next argument as the value of --NAME=, here the one in front of the file.
TEST(Configuration, EmptyValuesAreValues)
{
  const Folder folder("empty");
  WriteText(folder / "empty.json", "{ \"text\": \"\", \"scalar-bar-title\": \"\" }");
  const std::vector<std::string> expected = { "--bar", "--coloring-array", "Height", "--text", "",
    "--scalar-bar-title", "" };
  ExpectEqual(
    folder, { "--config", folder / "empty.json", "--bar", "--coloring-array", "Height" }, expected);
  ExpectEqual(
    folder, { "--bar", "--text=", "--scalar-bar-title=", "--coloring-array", "Height" }, expected);
  EXPECT_EQ(Render(folder, "a.png", { "--config=" }).Status, 2);
  ExpectEqual(folder, { "--text", "--scalar-bar-title=" }, { "--text=--scalar-bar-title=" });
  const ProgramResult outcome = Render(folder, "a.png", { "--tolerance=" });
  EXPECT_EQ(outcome.Status, 2);
  EXPECT_NE(outcome.Errors.find("--tolerance: ''"), std::string::npos) << outcome.Errors;
}

TEST(Configuration, ErrorsNameTheFileAndTheOption)
{
  const Folder folder("errors");
  const auto expect = [&folder](const std::string& text, const std::string& message) {
    WriteText(folder / "bad.json", text);
    const ProgramResult outcome = Render(folder, "a.png", { "--config", folder / "bad.json" });
    EXPECT_EQ(outcome.Status, 2) << text;
    EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
    EXPECT_NE(outcome.Errors.find(message), std::string::npos) << outcome.Errors;
  };
  expect("{ \"backgroundcolor\": [0, 0, 0] }", "the nearest name is 'background-color'");
  expect("{ \"backgroundcolor\": [0, 0, 0] }", "bad.json");
  expect("{ \"qqqqqq\": 1 }", "see `penumbra render --help`");
  expect("{ \"tolerance\": -1 }", "--tolerance");
  expect("{ \"show-edges\": 3 }", "'show-edges' must be true or false");
  expect("{ \"resolution\": { \"w\": 3 } }", "'resolution' is neither");
  expect("[ 1, 2 ]", "JSON object");
  expect("{ \"resolution\": ", "JSON object");
  expect("{ \"config\": \"other.json\" }", "'config' is not an option");
  const ProgramResult outcome = Render(folder, "a.png", { "--config", folder / "none.json" });
  EXPECT_EQ(outcome.Status, 2);
  EXPECT_NE(outcome.Errors.find("no such file"), std::string::npos) << outcome.Errors;
  // The file is an input, which no output replaces.
  WriteText(folder / "c.png", "{}");
  EXPECT_EQ(Render(folder, "c.png", { "--config", folder / "c.png" }).Status, 2);
  EXPECT_EQ(ReadText(folder / "c.png"), "{}");
}

}
