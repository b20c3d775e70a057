// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Time steps of files and of file series: compares images of steps with those of files that hold the
// step only.
#include "Program.h"
#include "RenderedImages.h"
#include "SeriesFiles.h"

#include "vtkImageData.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace penumbra_testing;

namespace
{

using Words = std::vector<std::string>;

// An orthographic view of x from -2 to 2 with the colors of the array T, without shading.
Words View(Words arguments, const std::string& range = "0,2")
{
  arguments.insert(arguments.end(),
    { "--resolution", "40,30", "--unlit", "--camera-position", "0,0,5", "--camera-focal-point",
      "0,0,0", "--camera-orthographic", "--camera-parallel-scale", "1.5" });
  if (!range.empty())
  {
    arguments.insert(arguments.end(), { "--coloring-array", "T", "--coloring-range", range });
  }
  return arguments;
}

ProgramResult Make(const Words& arguments)
{
  ProgramResult outcome = RunProgram(arguments);
  EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_EQ(WithoutToleranceWarnings(outcome.Errors), "");
  return outcome;
}

/// Renders the files of WriteFileSeries() to run_8.png, run_9.png and run_10.png.
void RenderSteps(const Folder& folder)
{
  Make(View({ "render", folder / "run_8.vtk", folder / "run_9.vtk", folder / "run_10.vtk",
    "--output", folder / "{name}.png" }));
}

void ExpectRefused(const Words& arguments, const std::string& words)
{
  const ProgramResult outcome = RunProgram(arguments);
  EXPECT_EQ(outcome.Status, 2) << outcome.Errors;
  EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
  EXPECT_NE(outcome.Errors.find(words), std::string::npos) << words << ": " << outcome.Errors;
}

}

#ifdef __SANITIZE_ADDRESS__ // which checks the code, not colors
constexpr int FirstStep = 2;
#else
constexpr int FirstStep = 0;
#endif

TEST(Series, StepsOfEveryFormatHaveTheirColors)
{
  const Folder folder("formats");
  const std::vector<SeriesFile> series = WriteSeries(folder);
  EXPECT_GE(series.size(), 6u);
  for (int step = FirstStep; step < 3; ++step)
  {
    WriteText(folder / "still.vtk", SquareWithValue(0.0, step));
    Make(View({ "render", folder / "still.vtk", "--output", folder / "still.png" }));
    const Pixel expected = PixelAt(ReadImage(folder / "still.png"), 20, 15);
    for (const SeriesFile& file : series)
    {
      if (!file.IsColored)
      {
        continue;
      }
      const Words choice = step == 1 ? Words{ "--time", "0.7" } // shows the step at 0.5
                                     : Words{ "--time-step", std::to_string(step) };
      Words arguments = View({ "render", file.Path, "--output", folder / "step.png" });
      arguments.insert(arguments.end(), choice.begin(), choice.end());
      Make(arguments);
      EXPECT_EQ(PixelAt(ReadImage(folder / "step.png"), 20, 15), expected)
        << file.Path << " " << choice[0] << " " << choice[1];
    }
  }
}

TEST(Series, FramesOfEveryFormatEqualStillsOfSteps)
{
  const Folder folder("films");
  for (const SeriesFile& file : WriteSeries(folder))
  {
    if (!file.IsColored)
    {
      continue;
    }
    const std::string name = std::filesystem::path(file.Path).filename().string();
    Make(View({ "animate", file.Path, "--output", folder / ("film/" + name + "{frame}.png") }));
    for (int step = 0; step < 3; ++step)
    {
      Make(View({ "render", file.Path, "--time-step", std::to_string(step), "--output",
        folder / "still.png" }));
      EXPECT_EQ(Compare(folder / ("film/" + name + "000" + std::to_string(step) + ".png"),
                  folder / "still.png"),
        0.0)
        << name << step;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / ("film/" + name + "0003.png")));
  }
}

TEST(Series, FrameOfThirdStepEqualsStillOfThirdFile)
{
  const Folder folder("third");
  WriteFileSeries(folder);
  Make(View({ "render", folder / "run_10.vtk", "--output", folder / "still.png" }));
  for (const std::string list : { "run.pvd", "run.vtk.series" })
  {
    Make(View({ "animate", folder / list, "--output", folder / "{frame}.png" }));
    EXPECT_EQ(Compare(folder / "0002.png", folder / "still.png"), 0.0) << list;
    EXPECT_GT(Compare(folder / "0001.png", folder / "still.png"), 0.1) << list;
  }
}

TEST(Series, ListsInShellOrderAreSortedByNumber)
{
  const Folder folder("natural");
  WriteFileSeries(folder);
  const auto film = [&](Words files, const std::string& output) {
    Words arguments = View({ "animate", "--time-series", "--output", folder / output });
    for (const std::string& file : files)
    {
      arguments.push_back(folder / file);
    }
    Make(arguments);
  };
  film({ "run_10.vtk", "run_8.vtk", "run_9.vtk" }, "shell{frame}.png");
  film({ "run_9.vtk", "run_10.vtk", "run_8.vtk" }, "given{frame}.png");
  const struct
  {
    const char* Still;
    const char* Sorted;
    const char* Given;
  } rows[] = { { "run_8.png", "0000", "0002" }, { "run_9.png", "0001", "0000" },
    { "run_10.png", "0002", "0001" } };
  RenderSteps(folder);
  for (const auto& row : rows)
  {
    for (const std::string& frame :
      { std::string("shell") + row.Sorted, std::string("given") + row.Given })
    {
      EXPECT_EQ(Compare(folder / (frame + ".png"), folder / row.Still), 0.0) << frame;
    }
  }
}

TEST(Series, AnimationsMoveBetweenTheirKeys)
{
  const Folder folder("gltf");
  WriteSeries(folder);
  // The square moves to x = 2 T: at 0.25 it covers x from -0.5 to 1.5, which are 20 of 40 pixels.
  Make(
    View({ "render", folder / "steps.gltf", "--time", "0.25", "--output", folder / "a.png" }, ""));
  const auto image = ReadImage(folder / "a.png");
  for (int x = 0; x < 40; ++x)
  {
    EXPECT_NEAR(PixelAt(image, x, 15)[0], x >= 15 && x < 35 ? 1.0 : 0.0, 0.01) << x;
  }
}

TEST(Series, AnimationsHaveThirtyImagesPerSecond)
{
  const Folder folder("gltf-film");
  WriteSeries(folder);
  // 1.5 s are 46 images.
  Words film = View({ "animate", folder / "steps.gltf", "--output", folder / "{frame}.vti" }, "");
  film.insert(film.end(), { "--camera-parallel-scale", "4" });
  Make(film);
  EXPECT_TRUE(std::filesystem::exists(folder / "0045.vti"));
  EXPECT_FALSE(std::filesystem::exists(folder / "0046.vti"));
}

TEST(Series, TimesSelectStepsAndNameFiles)
{
  const Folder folder("times");
  WriteFileSeries(folder);
  Make(View({ "render", folder / "run.pvd", "--times", "0.4:", "--output",
    folder / "stills/{name}-{time}.png", "--jobs", "2" }));
  const auto exists = [&](
                        const std::string& name) { return std::filesystem::exists(folder / name); };
  EXPECT_TRUE(exists("stills/run-0.5.png") && exists("stills/run-1.5.png"));
  EXPECT_FALSE(exists("stills/run-0.png"));
  // A constant step of time: at 0, 0.4, 0.8, 1.2 the steps 0, 0, 1, 1 are shown.
  Make(View({ "animate", folder / "run.pvd", "--times", "0:1.5:0.4", "--output",
    folder / "film/{frame}_{time}.png" }));
  RenderSteps(folder);
  EXPECT_EQ(Compare(folder / "film/0000_0.png", folder / "run_8.png"), 0.0);
  EXPECT_EQ(Compare(folder / "film/0001_0.4.png", folder / "run_8.png"), 0.0);
  EXPECT_EQ(Compare(folder / "film/0002_0.8.png", folder / "run_9.png"), 0.0);
  EXPECT_EQ(Compare(folder / "film/0003_1.2.png", folder / "run_9.png"), 0.0);
  EXPECT_FALSE(exists("film/0004_1.6.png"));
  // The last step by number.
  Make(View({ "render", folder / "run.pvd", "--time-step=-1", "--output", folder / "last.png" }));
  EXPECT_EQ(Compare(folder / "last.png", folder / "stills/run-1.5.png"), 0.0);
}

TEST(Series, RangeOfAllStepsColorsEveryImage)
{
  const Folder folder("range");
  WriteFileSeries(folder);
  Make(View({ "animate", folder / "run.pvd", "--output", folder / "all{frame}.png" }, "all"));
  Make(View(
    { "render", folder / "run.pvd", "--time", "0.5", "--output", folder / "still.png" }, "all"));
  const Words files = { folder / "run_8.vtk", folder / "run_9.vtk", folder / "run_10.vtk" };
  Words list = View({ "animate", "--time-series", "--output", folder / "list{frame}.png" }, "all");
  list.insert(list.end(), files.begin(), files.end());
  Make(list);
  RenderSteps(folder);
  for (int step = 0; step < 3; ++step)
  {
    const std::string number = "000" + std::to_string(step) + ".png";
    const std::string expected = folder / ("run_" + std::to_string(8 + step) + ".png");
    EXPECT_EQ(Compare(folder / ("all" + number), expected), 0.0) << step;
    EXPECT_EQ(Compare(folder / ("list" + number), expected), 0.0) << step;
  }
  EXPECT_EQ(Compare(folder / "still.png", folder / "all0001.png"), 0.0);
}

TEST(Series, EmptyStepsAreEmptyImages)
{
  const Folder folder("empty");
  WriteFileSeries(folder);
  WriteText(folder / "none.vtk",
    "# vtk DataFile Version 3.0\nstep\nASCII\nDATASET POLYDATA\nPOINTS 0 double\n");
  // Camera and colors are those of the first step that is not empty.
  const ProgramResult outcome = RunProgram({ "animate", folder / "none.vtk", folder / "run_9.vtk",
    folder / "run_10.vtk", "--time-series", "--output", folder / "{frame}.png", "--coloring-array",
    "T", "--resolution", "40,30", "--unlit" });
  EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
  EXPECT_NE(outcome.Errors.find("0000.png: the time step is empty"), std::string::npos)
    << outcome.Errors;
  Make({ "render", folder / "run_9.vtk", "--output", folder / "still.png", "--coloring-array", "T",
    "--resolution", "40,30", "--unlit" });
  EXPECT_EQ(Compare(folder / "0001.png", folder / "still.png"), 0.0);
  const auto image = ReadImage(folder / "0000.png");
  for (int x = 0; x < 40; ++x)
  {
    EXPECT_EQ(PixelAt(image, x, 15), (Pixel{ 0, 0, 0 }));
  }
  ExpectRefused({ "animate", folder / "none.vtk", folder / "none.vtk", "--time-series", "--output",
                  folder / "{frame}.png" },
    "all time steps are empty");
}

TEST(Series, ShowsTextAndTimeInCorner)
{
  const Folder folder("label");
  WriteFileSeries(folder);
  // Dark pixels on white above the square, which covers rows 0 to 100 of 150.
  const auto countDark = [&](const Words& options) {
    Words arguments = { "render", folder / "run.pvd", "--output", folder / "a.png", "--resolution",
      "300,150", "--camera-position", "0,-1,9", "--camera-focal-point", "0,1,0",
      "--camera-orthographic", "--camera-parallel-scale", "3", "--unlit", "--background-color",
      "1,1,1", "--color", "0.8,0.8,0.8" };
    arguments.insert(arguments.end(), options.begin(), options.end());
    Make(arguments);
    const auto image = ReadImage(folder / "a.png");
    int left = 0;
    int right = 0;
    for (int y = 100; y < 150; ++y)
    {
      for (int x = 0; x < 300; ++x)
      {
        (x < 150 ? left : right) += PixelAt(image, x, y)[0] < 0.5 ? 1 : 0;
      }
    }
    EXPECT_EQ(right, 0);
    return left;
  };
  EXPECT_EQ(countDark({}), 0);
  const int label = countDark({ "--time-label", "--time", "0.5" });
  EXPECT_GT(label, 100);
  // The same text by another option.
  EXPECT_EQ(countDark({ "--text", "Time: {time}", "--time", "0.5" }), label);
  EXPECT_EQ(countDark({ "--text", "Time: 0.5" }), label);
  EXPECT_NE(countDark({ "--time-label", "--time", "1.5" }), label);
}

TEST(Series, ReportsInvalidSelections)
{
  const Folder folder("bad");
  WriteFileSeries(folder);
  WriteText(folder / "bad.pvd", "<VTKFile type=\"Collection\"><Collection><DataSet");
  WriteText(folder / "none.pvd", "<VTKFile type=\"Collection\"><Collection/></VTKFile>");
  WriteText(folder / "bad.series", "{\"files\": [{\"time\": 0}]}");
  WriteText(folder / "gone.pvd",
    "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0\" file=\"gone.vtp\"/>"
    "</Collection></VTKFile>");
  const struct
  {
    Words Arguments;
    const char* Said;
  } rows[] = {
    { { "run.pvd", "--time", "2" }, "has times from 0 to 1.5" },
    { { "run.pvd", "--time", "-1" }, "has times from 0 to 1.5" },
    { { "run.pvd", "--time-step", "3" }, "steps 0 to 2" },
    { { "run.pvd", "--time-step=-4" }, "steps 0 to 2" },
    { { "run.pvd", "--time-step", "1.5" }, "not an integer" },
    { { "run.pvd", "--times", "0.6:1" }, "has times from 0 to 1.5" },
    { { "run.pvd", "--times", "1" }, "A:B" },
    { { "run.pvd", "--times", "1:0" }, "begins after its end" },
    { { "run.pvd", "--times", "0:1:0" }, "above 0" },
    { { "run.pvd", "--times", "0:1" }, "{time}" },
    { { "run.pvd", "--time", "0", "--time-step", "0" }, "cannot be combined" },
    { { "run_8.vtk", "--time", "0" }, "has no time steps" },
    { { "run_8.vtk", "--time-label" }, "has no time steps" },
    { { "bad.pvd" }, "not a time series" },
    { { "none.pvd" }, "lists no file" },
    { { "bad.series" }, "not a time series" },
    { { "gone.pvd" }, "gone.vtp: no such file" },
  };
  for (const auto& row : rows)
  {
    Words arguments = { "render", folder / row.Arguments[0], "--output", folder / "a.png",
      "--resolution", "16,16" };
    arguments.insert(arguments.end(), row.Arguments.begin() + 1, row.Arguments.end());
    ExpectRefused(arguments, row.Said);
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
}

TEST(Series, XdmfMeshesAreIncludedByNamespacesOfEitherScheme)
{
  if (RunProgram({ "list" }).Output.find("vtkXdmfReader") == std::string::npos)
  {
    GTEST_SKIP() << "VTK has no XDMF";
  }
  const Folder folder("included & more"); // which is no text of XML
  const auto data = [](const std::string& dimensions, const std::string& file) {
    return "<DataItem Format=\"Binary\" Dimensions=\"" + dimensions + "\">\n" + file +
      "</DataItem>";
  };
  const float points[] = { -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0 };
  WriteText(folder / "p.bin", std::string(reinterpret_cast<const char*>(points), sizeof(points)));
  for (const std::string scheme : { "http", "https" })
  {
    std::string text = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\" xmlns:xi=\"" + scheme +
      "://www.w3.org/2001/XInclude\"><Domain><!-- " + data("4", "old.bin") +
      " --><Grid Name=\"mesh\" GridType=\"Uniform\">"
      "<Topology TopologyType=\"Quadrilateral\" NumberOfElements=\"1\"><DataItem Dimensions=\"4\" "
      "Format=\"XML\">0 1 2 3</DataItem></Topology><Geometry GeometryType=\"XYZ\">" +
      data("4 3", "p.bin") +
      "</Geometry></Grid>"
      "<Grid Name=\"T\" GridType=\"Collection\" CollectionType=\"Temporal\">";
    for (int step = 0; step < 2; ++step)
    {
      const std::string name = "T" + std::to_string(step) + ".bin";
      const std::vector<float> values(4, 1.f + step);
      WriteText(folder / name, std::string(reinterpret_cast<const char*>(values.data()), 16));
      text += "<Grid Name=\"T\" GridType=\"Uniform\"><xi:include xpointer=\"xpointer("
              "/Xdmf/Domain/Grid[@GridType='Uniform'][1]/*[self::Topology or self::Geometry])\"/>"
              "<Time Value=\"" +
        std::to_string(step) + "\"/><Attribute Name=\"T\" Center=\"Node\">" + data("4", name) +
        "</Attribute></Grid>";
    }
    WriteText(folder / scheme + ".xdmf", text + "</Grid></Domain></Xdmf>\n");
    Make(View({ "render", folder / scheme + ".xdmf", "--time", "1", "--output",
      folder / scheme + ".png" }));
  }
  WriteText(folder / "still.vtk", SquareWithValue(0.0, 2.0));
  Make(View({ "render", folder / "still.vtk", "--output", folder / "still.png" }));
  EXPECT_EQ(Compare(folder / "http.png", folder / "still.png"), 0.0);
  EXPECT_EQ(Compare(folder / "https.png", folder / "still.png"), 0.0);

  std::filesystem::remove(folder / "T1.bin");
  ExpectRefused({ "render", folder / "https.xdmf", "--time", "1", "--output", folder / "a.png" },
    "its data in 'T1.bin' are missing");
}

TEST(Series, MissingFileOfStepFailsOnlyItsImage)
{
  const Folder folder("missing");
  WriteFileSeries(folder);
  std::filesystem::remove(folder / "run_8.vtk");
  const ProgramResult outcome =
    RunProgram(View({ "animate", folder / "run.pvd", "--output", folder / "{frame}.png" }));
  EXPECT_EQ(outcome.Status, 2);
  EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
  EXPECT_NE(outcome.Errors.find("run_8.vtk: no such file"), std::string::npos) << outcome.Errors;
  Make(View({ "render", folder / "run_10.vtk", "--output", folder / "still.png" }));
  EXPECT_EQ(Compare(folder / "0002.png", folder / "still.png"), 0.0);
  EXPECT_FALSE(std::filesystem::exists(folder / "0000.png"));
}

TEST(Series, MissingArrayOfStepFailsOnlyItsImage)
{
  const Folder folder("array");
  WriteFileSeries(folder);
  const std::string text = ReadText(folder / "run_9.vtk");
  WriteText(folder / "run_9.vtk", text.substr(0, text.find("POINT_DATA")));
  const std::string output = folder / "{frame}.png";
  const ProgramResult outcome =
    RunProgram(View({ "animate", folder / "run.pvd", "--output", output }));
  EXPECT_EQ(outcome.Status, 2);
  EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
  EXPECT_NE(outcome.Errors.find("0001.png: --coloring-array"), std::string::npos) << outcome.Errors;
  EXPECT_TRUE(std::filesystem::exists(folder / "0000.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "0001.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "0002.png"));
}
