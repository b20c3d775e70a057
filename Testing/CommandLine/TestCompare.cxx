// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// `penumbra compare` through the real program.
#include "Meshes.h"
#include "Program.h"
#include "RenderedImages.h"

#include <gtest/gtest.h>

using namespace penumbra_testing;

namespace
{

// Unlit images of a uniform color.
void Paint(const Folder& folder, const std::string& name, const std::string& color)
{
  WriteText(folder / "square.stl", SquareStl());
  const ProgramResult outcome =
    RunProgram({ "render", folder / "square.stl", "--no-lighting", "--color", color,
      "--camera-zoom-factor", "9", "--resolution", "20,20", "--output", folder / name });
  ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
}

TEST(Compare, ReportsMetricAndThreshold)
{
  const Folder folder("compare");
  Paint(folder, "a.png", "0.4,0.4,0.4");
  Paint(folder, "b.png", "0.6,0.4,0.4");
  const ProgramResult within = RunProgram(
    { "compare", folder / "a.png", folder / "b.png", "--metric", "max", "--threshold", "0.3" });
  EXPECT_EQ(within.Status, 0);
  EXPECT_EQ(within.Output, "max 0.2 from " + folder / "b.png" + ", within 0.3\n");
  const ProgramResult above = RunProgram(
    { "compare", folder / "a.png", folder / "b.png", "--metric", "max", "--threshold", "0.1" });
  EXPECT_EQ(above.Status, 1);
  EXPECT_EQ(above.Errors, "");
  const ProgramResult equal = RunProgram(
    { "compare", folder / "a.png", folder / "a.png", "--metric", "ssim", "--threshold", "0" });
  EXPECT_EQ(equal.Status, 0) << equal.Output;
}

TEST(Compare, UsesNearestBaseline)
{
  const Folder folder("compare-best");
  Paint(folder, "a.png", "0.4,0.4,0.4");
  Paint(folder, "b.png", "0.8,0.4,0.4");
  Paint(folder, "c.vti", "0.4,0.4,0.4");
  const ProgramResult outcome =
    RunProgram({ "compare", folder / "a.png", folder / "b.png", folder / "c.vti", "--json" });
  const Json report = Json::Parse(outcome.Output);
  EXPECT_EQ(report["baseline"], folder / "c.vti");
  EXPECT_EQ(report["metric"], "rmse");
  EXPECT_NEAR(report["value"], 0.0, 1e-6);
  EXPECT_EQ(report["metrics"].GetSize(), 7u);
  EXPECT_EQ(report["above_threshold"], false);
}

TEST(Compare, AppliesTolerance)
{
  const Folder folder("compare-near");
  Paint(folder, "a.png", "0.4,0.4,0.4");
  Paint(folder, "b.png", "0.41,0.4,0.4");
  Paint(folder, "c.png", "0.4,0.6,0.4");
  Paint(folder, "black.png", "0,0,0");
  Paint(folder, "white.png", "1,1,1");
  const auto compare = [&folder](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = { "compare", folder / "a.png", folder / name };
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgram(arguments);
  };
  EXPECT_EQ(compare("b.png", { "--tolerance", "0.0625" }).Status, 0);
  EXPECT_EQ(compare("b.png", { "--tolerance", "0" }).Status, 1);
  EXPECT_EQ(compare("a.png", { "--tolerance", "0" }).Output,
    "excess 0 from " + folder / "a.png" + ", within 1\n");
  // Every pixel differs; 1 % may.
  EXPECT_EQ(compare("c.png", { "--tolerance", "1" }).Output,
    "excess 100 from " + folder / "c.png" + ", above 1\n");
  EXPECT_EQ(compare("c.png", { "--tolerance", "1", "--mask", folder / "white.png" }).Status, 1);
  const ProgramResult nothing = compare("c.png", { "--mask", folder / "black.png" });
  EXPECT_EQ(nothing.Status, 2);
  EXPECT_NE(nothing.Errors.find("the mask excludes all pixels"), std::string::npos)
    << nothing.Errors;
}

TEST(Compare, WritesDifferenceImage)
{
  const Folder folder("compare-difference");
  Paint(folder, "a.png", "0.4,0.4,0.4");
  Paint(folder, "b.png", "0.6,0.4,0.4");
  Paint(folder, "red.png", "1,0,0");
  EXPECT_EQ(RunProgram({ "compare", folder / "a.png", folder / "b.png", "--difference",
                         folder / "difference.png" })
              .Status,
    0);
  EXPECT_EQ(Compare(folder / "difference.png", folder / "red.png"), 0.0);
}

}
