// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// `penumbra chart --quick` through the real program.
#include "Meshes.h"
#include "Program.h"
#include "RenderedImages.h"

#include "vtkImageData.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <sstream>

using namespace penumbra_testing;

namespace
{

struct Row
{
  std::string Line;
  double Asked = 0.0;
  double Error = 0.0;
  double Seconds = 0.0;
  double Count = 0.0;
};

/// Rows of a chart's table by method and setting.
std::map<std::string, Row> ReadRows(const std::string& path)
{
  std::map<std::string, Row> rows;
  std::istringstream text(ReadText(path));
  for (std::string line; std::getline(text, line);)
  {
    std::istringstream fields(line);
    std::string field[7];
    for (std::string& each : field)
    {
      std::getline(fields, each, ',');
    }
    if (line[0] != '#' && field[0] != "scene")
    {
      rows[field[1] + ", " + field[2]] = { line, std::stod(field[3]), std::stod(field[4]),
        std::stod(field[5]), std::stod(field[6]) };
    }
  }
  return rows;
}

ProgramResult RunChart(const Folder& folder, const std::string& family)
{
  return RunProgram({ "chart", "--quick", "--family", family, "--output", folder / "charts" });
}

TEST(Chart, RanksExactEdgesAboveSampling)
{
  const Folder folder("chart");
  const ProgramResult outcome = RunChart(folder, "aa");
  ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_EQ(outcome.Errors, "");
  std::map<std::string, Row> rows = ReadRows(folder / "charts/aa.csv");
  EXPECT_EQ(rows.size(), 10u);
  for (const auto& [name, row] : rows)
  {
    EXPECT_GT(row.Seconds, 0.0) << name;
    EXPECT_GE(row.Count, 1.0) << name;
    EXPECT_LT(row.Error, 1.0) << name;
  }
  const Row& ours = rows["Penumbra automatic, --tolerance 1/256"];
  EXPECT_NEAR(ours.Asked, 1.0 / 256.0, 1e-6);
  EXPECT_LT(ours.Error, 1e-4);
  EXPECT_GT(rows["rays on a grid, 4 x 4"].Error, 0.01);
  EXPECT_LT(ours.Count, rows["rays on a grid, 4 x 4"].Count);

  // Exact edges are on the Pareto front by rays; times of such a small image are not reproducible.
  const std::string front = ReadText(folder / "charts/aa-front.csv");
  EXPECT_EQ(CountLines(front), 3) << front;
  EXPECT_NE(front.find("thin rods,Penumbra automatic,--tolerance 1/256,"), std::string::npos);

  const auto image = ReadImage(folder / "charts/aa.png");
  EXPECT_GT(image->GetDimensions()[0], 1000);
  EXPECT_NE(ReadText(folder / "charts/aa.svg").find("<svg"), std::string::npos);
}

TEST(Chart, IsCompleteWhenCancelledAndResumes)
{
  const Folder folder("chart-cancelled");
  const std::string path = folder / "charts/irradiance.csv";
  // The signal comes after the first row. Shells start background processes with SIGINT ignored.
  const ProgramResult cancelled =
    RunShell("env --default-signal=INT $PENUMBRA chart --quick --family "
             "irradiance --output " +
      Quote(folder / "charts") +
      " & program=$!; while kill -0 $program && ! grep -q 'sphere on a floor' " + Quote(path) +
      " 2>/dev/null; do sleep .01; done; kill -INT $program; wait $program 2>/dev/null");
  EXPECT_EQ(cancelled.Status, 130) << "the shell sees the signal as the program's end";
  EXPECT_EQ(cancelled.Errors, "");
  for (const auto& entry : std::filesystem::directory_iterator(folder / "charts"))
  {
    EXPECT_EQ(entry.path().filename(), "irradiance.csv");
  }
  const std::string table = ReadText(path);
  EXPECT_EQ(table.back(), '\n');
  const std::map<std::string, Row> before = ReadRows(path);
  ASSERT_GE(before.size(), 1u);

  ASSERT_EQ(RunChart(folder, "irradiance").Status, 0);
  const std::map<std::string, Row> after = ReadRows(path);
  EXPECT_GT(after.size(), before.size());
  for (const auto& [name, row] : before)
  {
    EXPECT_EQ(after.at(name).Line, row.Line);
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "charts/irradiance.png"));
}

TEST(Chart, BakesOntoMeshPoints)
{
  const Folder folder("chart-baking");
  WriteSphereWithArrays(folder / "ball.vtp");
  const ProgramResult outcome = RunProgram({ "chart", folder / "ball.vtp", "--quick", "--family",
    "irradiance", "--output", folder / "charts" });
  ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  const std::map<std::string, Row> rows = ReadRows(folder / "charts/irradiance.csv");
  ASSERT_EQ(rows.size(), 2u);
  for (const auto& [name, row] : rows)
  {
    EXPECT_EQ(row.Line.rfind("ball,", 0), 0u) << row.Line;
    EXPECT_LE(row.Error, row.Asked) << name;
  }
  EXPECT_LE(rows.at("Penumbra automatic (baked), tolerance 0.03").Count,
    rows.at("rays at every point, tolerance 0.03").Count);
}

TEST(Chart, RejectsInvalidFoldersAndMeshes)
{
  const Folder folder("chart-bad");
  WriteText(folder / "aa.csv", "something else\n");
  const ProgramResult other =
    RunProgram({ "chart", "--quick", "--family", "aa", "--output", folder / "." });
  EXPECT_EQ(other.Status, 2);
  EXPECT_EQ(CountLines(other.Errors), 1) << other.Errors;
  EXPECT_EQ(ReadText(folder / "aa.csv"), "something else\n");
  const ProgramResult none = RunProgram(
    { "chart", folder / "none.ply", "--quick", "--family", "aa", "--output", folder / "x" });
  EXPECT_EQ(none.Status, 2);
  EXPECT_EQ(CountLines(none.Errors), 1) << none.Errors;
  const ProgramResult empty = RunProgram({ "chart" });
  EXPECT_EQ(empty.Status, 2);
  EXPECT_EQ(CountLines(empty.Errors), 1) << empty.Errors;
  EXPECT_EQ(empty.Output, "");
}

}
