// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// penumbra animate: compares each image with the one that `render` makes of the same view.
#include "Meshes.h"
#include "Program.h"
#include "RenderedImages.h"

#include "vtkImageData.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>

using namespace penumbra_testing;

namespace
{

/// A square of side 2 with its center at (x, y, 0).
std::string SquareStl(double x, double y)
{
  const double corners[6][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, -1 }, { 1, 1 }, { -1, 1 } };
  std::string text = "solid square\n";
  for (int i = 0; i < 6; ++i)
  {
    text += i % 3 == 0 ? " facet normal 0 0 1\n  outer loop\n" : "";
    text += "   vertex " + std::to_string(x + corners[i][0]) + " " +
      std::to_string(y + corners[i][1]) + " 0\n";
    text += i % 3 == 2 ? "  endloop\n endfacet\n" : "";
  }
  return text + "endsolid square\n";
}

/// Adds the options that all tests share.
std::vector<std::string> Small(std::vector<std::string> arguments)
{
  arguments.insert(arguments.end(), { "--resolution", "48,40" });
  return arguments;
}

void Make(const std::vector<std::string>& arguments)
{
  const ProgramResult outcome = RunProgram(Small(arguments));
  ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  ASSERT_EQ(WithoutToleranceWarnings(outcome.Errors), "");
}

}

TEST(Animate, OccludesTubesAsRenderDoes)
{
  const Folder folder("tubes");
  WriteText(folder / "lines.vtk",
    "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\n"
    "POINTS 4 float\n-1 0 0 1 0 0 0 -1 0 0 1 0\n"
    "LINES 2 6\n2 0 1\n2 2 3\n");
  const std::vector<std::string> options = { folder / "lines.vtk", "--line-radius", "0.3",
    "--ambient-occlusion", "--tolerance", "0.05", "--resolution", "60,40", "--output" };
  std::vector<std::string> render = { "render" };
  render.insert(render.end(), options.begin(), options.end());
  render.push_back(folder / "image.png");
  EXPECT_EQ(RunProgram(render).Status, 0);
  std::vector<std::string> animate = { "animate", "--frames", "1", "--orbit", "90" };
  animate.insert(animate.end(), options.begin(), options.end());
  animate.push_back(folder / "frame-{frame}.png");
  EXPECT_EQ(RunProgram(animate).Status, 0);
  EXPECT_EQ(
    Compare(folder / "image.png", folder / "frame-0000.png", vtkPenumbraImageComparison::RMSE),
    0.0);
}

TEST(Animate, OrbitMatchesRenderedViews)
{
  const Folder folder("orbit");
  WriteSphereWithArrays(folder / "sphere.vtp");
  Make({ "animate", folder / "sphere.vtp", "--output", folder / "{frame}.png", "--frames", "3",
    "--coloring-array", "Height", "--camera-elevation-angle", "30" });
  EXPECT_EQ(
    folder.List(), (std::vector<std::string>{ "0000.png", "0001.png", "0002.png", "sphere.vtp" }));
  Make({ "render", folder / "sphere.vtp", "--output", folder / "first.png", "--coloring-array",
    "Height", "--camera-elevation-angle", "30" });
  EXPECT_EQ(Compare(folder / "0000.png", folder / "first.png"), 0.0);
  Make({ "render", folder / "sphere.vtp", "--output", folder / "turned.png", "--coloring-array",
    "Height", "--camera-azimuth-angle", "120" });
  Make({ "animate", folder / "sphere.vtp", "--output", folder / "level{frame}.png", "--frames", "3",
    "--coloring-array", "Height" });
  EXPECT_EQ(Compare(folder / "level0001.png", folder / "turned.png"), 0.0);
}

TEST(Animate, OrbitOfATiltedViewTurnsAboutTheUpDirection)
{
  const Folder folder("tilted");
  WriteSphereWithArrays(folder / "sphere.vtp");
  for (const char* up : { "0,1,0", "0,0,1", "0.2,1,0.1" })
  {
    Make({ "animate", folder / "sphere.vtp", "--output", folder / "{frame}.png", "--frames", "3",
      "--coloring-array", "Height", "--camera-direction=-1,-1,-2", "--camera-view-up", up });
    Make({ "render", folder / "sphere.vtp", "--output", folder / "turned.png", "--coloring-array",
      "Height", "--camera-direction=-1,-1,-2", "--camera-view-up", up, "--camera-azimuth-angle",
      "120" });
    EXPECT_LE(Compare(folder / "0001.png", folder / "turned.png"), 1.01 / 255.0) << up;
  }
}

TEST(Animate, MovesFileWithFixedCamera)
{
  const Folder folder("move");
  WriteText(folder / "still.stl", SquareStl(0.0, 0.0));
  WriteText(folder / "start.stl", SquareStl(2.0, 0.0));
  WriteText(folder / "end.stl", SquareStl(2.0, 1.5));
  const std::vector<std::string> camera = { "--camera-position", "1,0,12", "--camera-focal-point",
    "1,0,0" };
  std::vector<std::string> animate = { "animate", folder / "still.stl", folder / "start.stl",
    "--output", folder / "{frame}.png", "--frames", "4", "--move", "2:0,1.5,0" };
  animate.insert(animate.end(), camera.begin(), camera.end());
  Make(animate);
  std::vector<std::string> render = { "render", folder / "still.stl", folder / "end.stl",
    "--output", folder / "end.png" };
  render.insert(render.end(), camera.begin(), camera.end());
  Make(render);
  EXPECT_EQ(Compare(folder / "0003.png", folder / "end.png"), 0.0);
  EXPECT_GT(Compare(folder / "0000.png", folder / "end.png"), 0.5);
}

TEST(Animate, KeepsCameraOfFirstTimeStepAndReportsBadFile)
{
  const Folder folder("steps");
  WriteText(folder / "0.stl", SquareStl(0.0, 0.0));
  WriteText(folder / "1.stl", "solid nothing of the kind");
  WriteText(folder / "2.stl", SquareStl(0.5, 0.0));
  const ProgramResult outcome = RunProgram(Small({ "animate", folder / "0.stl", folder / "1.stl",
    folder / "2.stl", "--time-series", "--output", folder / "{frame}.png" }));
  EXPECT_EQ(outcome.Status, 2);
  EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
  EXPECT_NE(outcome.Errors.find("1.stl"), std::string::npos) << outcome.Errors;
  EXPECT_EQ(
    folder.List(), (std::vector<std::string>{ "0.stl", "0000.png", "0002.png", "1.stl", "2.stl" }));
  // Side 2 fills the same number of pixels in both, a quarter of it further to the right.
  const auto first = ReadImage(folder / "0000.png");
  const auto last = ReadImage(folder / "0002.png");
  double sums[2] = { 0.0, 0.0 };
  double moments[2] = { 0.0, 0.0 };
  for (int x = 0; x < 48; ++x)
  {
    const double values[2] = { PixelAt(first, x, 20)[0], PixelAt(last, x, 20)[0] };
    for (int i = 0; i < 2; ++i)
    {
      sums[i] += values[i];
      moments[i] += values[i] * x;
    }
  }
  EXPECT_NEAR(sums[0], sums[1], 0.02);
  EXPECT_NEAR(moments[1] / sums[1] - moments[0] / sums[0], 0.25 * sums[0], 0.02);
}

TEST(Animate, MakesTheOtherImagesIfOneCannotBeWritten)
{
  for (const char* engine : { "ray", "raster" })
  {
    const Folder folder("one-bad-image");
    WriteText(folder / "0.stl", SquareStl(0.0, 0.0));
    std::filesystem::create_directories(folder / "0001.png/kept");
    const ProgramResult outcome = RunProgram(Small({ "animate", folder / "0.stl", "--frames", "3",
      "--orbit", "60", "--engine", engine, "--output", folder / "{frame}.png" }));
    EXPECT_EQ(outcome.Status, 2);
    EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
    EXPECT_NE(outcome.Errors.find("0001.png"), std::string::npos) << outcome.Errors;
    EXPECT_TRUE(std::filesystem::is_regular_file(folder / "0000.png"));
    EXPECT_TRUE(std::filesystem::is_regular_file(folder / "0002.png"));
  }
}

TEST(Animate, ReportsAnErrorOfAllImagesOnce)
{
  const Folder folder("damaged");
  WriteText(folder / "mesh.stl", "hello\n");
  const ProgramResult outcome = RunProgram({ "animate", folder / "mesh.stl", "--frames", "20",
    "--jobs", "2", "--output", folder / "{frame}.png" });
  EXPECT_EQ(outcome.Status, 2);
  EXPECT_EQ(CountLines(outcome.Errors), 2) << outcome.Errors;
  EXPECT_NE(outcome.Errors.find("mesh.stl: the file is damaged"), std::string::npos)
    << outcome.Errors;
  EXPECT_NE(outcome.Errors.find("the same error occurred 2 more times"), std::string::npos)
    << outcome.Errors;
}

TEST(Animate, CreatesTheFolderOfEachImage)
{
  const Folder folder("folders");
  WriteText(folder / "0.stl", SquareStl(0.0, 0.0));
  Make({ "animate", folder / "0.stl", "--frames", "3", "--orbit", "60", "--output",
    folder / "{frame}/image.png", "--statistics", folder / "{frame}/more/report.json" });
  for (const std::string frame : { "0000", "0001", "0002" })
  {
    EXPECT_TRUE(std::filesystem::exists(folder / (frame + "/image.png"))) << frame;
    EXPECT_TRUE(std::filesystem::exists(folder / (frame + "/more/report.json"))) << frame;
  }
}

TEST(Animate, ResumesToSameImages)
{
  const struct
  {
    const char* Engine;
    int Frames;
    std::vector<int> Missing;
  } rows[] = { { "ray", 9, { 5, 6 } }, { "raster", 3, { 1 } } };
  for (const auto& row : rows)
  {
    const Folder folder(std::string("resume-") + row.Engine);
    WriteSphereWithArrays(folder / "sphere.vtp");
    const auto image = [&](int i) { return folder / ("000" + std::to_string(i) + ".png"); };
    const std::vector<std::string> command = { "animate", folder / "sphere.vtp", "--output",
      folder / "{frame}.png", "--frames", std::to_string(row.Frames), "--orbit", "4", "--engine",
      row.Engine, "--ambient-occlusion", "--resume" };
    Make(command);
    std::vector<std::string> whole;
    for (int i = 0; i < row.Frames; ++i)
    {
      whole.push_back(ReadText(image(i)));
    }
    // The state after a killed run; the last image was made with other options.
    for (const int missing : row.Missing)
    {
      std::filesystem::remove(image(missing));
    }
    std::filesystem::copy_file(
      image(0), image(row.Frames - 1), std::filesystem::copy_options::overwrite_existing);
    const auto kept = std::filesystem::last_write_time(image(0));
    Make(command);
    for (int i = 0; i < row.Frames; ++i)
    {
      EXPECT_EQ(ReadText(image(i)), whole[i]) << row.Engine << i;
    }
    EXPECT_EQ(std::filesystem::last_write_time(image(0)), kept);
  }
}

TEST(Animate, IsIndependentOfJobCount)
{
  const Folder folder("jobs");
  WriteSphereWithArrays(folder / "sphere.vtp");
  Make(
    { "animate", folder / "sphere.vtp", "--output", folder / "one{frame}.png", "--frames", "17" });
  Make({ "animate", folder / "sphere.vtp", "--output", folder / "two{frame}.png", "--frames", "17",
    "--jobs", "3" });
  for (const char* number : { "0000", "0008", "0016" })
  {
    EXPECT_EQ(ReadText(folder / (std::string("one") + number + ".png")).size(),
      ReadText(folder / (std::string("two") + number + ".png")).size());
    EXPECT_EQ(Compare(folder / (std::string("one") + number + ".png"),
                folder / (std::string("two") + number + ".png")),
      0.0);
  }
}

TEST(Animate, ReportsInvalidOptions)
{
  const Folder folder("wrong");
  WriteText(folder / "a.stl", SquareStl(0.0, 0.0));
  const struct
  {
    std::vector<std::string> Options;
    const char* Said;
  } rows[] = {
    { { "--output", folder / "a.png" }, "{frame}" },
    { { "--output", folder / "{frame}.jpg", "--resume" }, "--resume" },
    { { "--output", folder / "{frame}.png", "--move", "2:1,0,0" }, "at most 1" },
    { { "--output", folder / "{frame}.png", "--move", "1,0,0" }, "N:X,Y,Z" },
    { { "--output", folder / "{frame}.png", "--time-series", "--frames", "3" }, "--time-series" },
    { { "--output", folder / "{frame}.png", "--frames", "0" }, "--frames" },
    { { "--output", folder / "{frame}.png", "--statistics", folder / "s.json" }, "--statistics" },
  };
  for (const auto& row : rows)
  {
    std::vector<std::string> arguments = { "animate", folder / "a.stl" };
    arguments.insert(arguments.end(), row.Options.begin(), row.Options.end());
    const ProgramResult outcome = RunProgram(arguments);
    EXPECT_EQ(outcome.Status, 2) << row.Said;
    EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
    EXPECT_NE(outcome.Errors.find(row.Said), std::string::npos) << outcome.Errors;
  }
  EXPECT_EQ(folder.List(), (std::vector<std::string>{ "a.stl" }));
}
