// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Parts of a film that several processes render, as the tasks of a job array: the files equal those of
// one process.
#include "Meshes.h"
#include "Program.h"
#include "SeriesFiles.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace penumbra_testing;

namespace
{

using Words = std::vector<std::string>;

ProgramResult RunAnimate(Words arguments)
{
  arguments.insert(arguments.begin(), "animate");
  arguments.insert(arguments.end(), { "--resolution", "36,24" });
  return RunProgram(arguments);
}

void Make(const Words& arguments)
{
  const ProgramResult outcome = RunAnimate(arguments);
  EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_EQ(WithoutToleranceWarnings(outcome.Errors), "");
}

Words Join(Words a, const Words& b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::string Number(int frame)
{
  return std::string(frame < 10 ? "000" : "00") + std::to_string(frame) + ".png";
}

void ExpectSameFiles(const Folder& folder, const std::string& a, const std::string& b, int count)
{
  for (int frame = 0; frame < count; ++frame)
  {
    const std::string one = ReadText(folder / (a + "/" + Number(frame)));
    EXPECT_FALSE(one.empty()) << a << frame;
    EXPECT_EQ(one, ReadText(folder / (b + "/" + Number(frame)))) << b << frame;
  }
}

}

TEST(FilmParts, EqualFilmOfOneProcess)
{
  const Folder folder("parts");
  WriteSphereWithArrays(folder / "sphere.vtp");
  WriteFileSeries(folder);
  const struct
  {
    Words Inputs;
    int Frames;
  } rows[] = { { { folder / "sphere.vtp", "--frames", "19", "--ambient-occlusion", "--tolerance",
                   "0.02", "--scalar-coloring", "--light-position", "0,2,9", "--light-shafts" },
                 19 },
    { { folder / "run.pvd", "--frames", "19", "--scalar-coloring", "--coloring-range", "all",
        "--time-label" },
      19 },
    { { folder / "run.pvd", "--time-step", "1", "--frames", "19", "--time-label", "--orbit", "90" },
      19 } };
  for (const auto& row : rows)
  {
    const auto with = [&](const std::string& film, const Words& options) {
      return Join(Join(row.Inputs, { "--output", folder / (film + "/{frame}.png") }), options);
    };
    Make(with("whole", {}));
    Make(with("task", { "--prepare", folder / "film.json" }));
    EXPECT_FALSE(std::filesystem::exists(folder / "task"));
    // Three tasks of different lengths; the middle one begins within a group of frames.
    for (const Words& part : { Words{ "--frames", "0:5" }, Words{ "--frames", "6:13" },
           Words{ "--frame-list", "18,14:16,17" } })
    {
      Make(with("task", Join(part, { "--defaults", folder / "film.json", "--resume" })));
    }
    ExpectSameFiles(folder, "whole", "task", row.Frames);
    std::filesystem::remove_all(folder / "task");
    std::filesystem::remove_all(folder / "whole");
  }
}

TEST(FilmParts, RasterizedFramesEqualFilmOfOneProcess)
{
  const Folder folder("raster-parts");
  WriteSphereWithArrays(folder / "sphere.vtp");
  const Words film = { folder / "sphere.vtp", "--engine", "raster", "--ambient-occlusion",
    "--frames", "5", "--orbit", "4" };
  Make(Join(film, { "--output", folder / "whole/{frame}.png" }));
  Make(Join(film, { "--output", folder / "task/{frame}.png", "--frame-list", "3" }));
  EXPECT_EQ(ReadText(folder / "whole/0003.png"), ReadText(folder / "task/0003.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "task/0002.png"));
}

TEST(FilmParts, ResumeKeepsFramesOfOtherTasks)
{
  const Folder folder("resume-parts");
  WriteSphereWithArrays(folder / "sphere.vtp");
  const Words film = { folder / "sphere.vtp", "--frames", "4", "--output", folder / "{frame}.png",
    "--resume" };
  Make(Join(film, { "--prepare", folder / "film.json" }));
  Make(Join(film, { "--frames", "0:1", "--defaults", folder / "film.json" }));
  const auto before = std::filesystem::last_write_time(folder / "0001.png");
  std::filesystem::remove(folder / "0000.png"); // As if a task had been killed.
  Make(film);                                   // The whole film, without the file of defaults.
  EXPECT_EQ(std::filesystem::last_write_time(folder / "0001.png"), before);
  EXPECT_TRUE(std::filesystem::exists(folder / "0000.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "0003.png"));
  // A changed input is rendered again.
  WriteText(folder / "sphere.vtp", ReadText(folder / "sphere.vtp") + "\n");
  Make(film);
  EXPECT_NE(std::filesystem::last_write_time(folder / "0001.png"), before);
}

TEST(FilmParts, SlurmTasksRenderFilmOfOneProcess)
{
  const Folder folder("slurm");
  WriteFileSeries(folder);
  const std::string options = Quote(folder / "run.pvd") +
    " --frames 7 --scalar-coloring --resolution 36,24 --output " + Quote(folder.Path) + "/";
  const ProgramResult outcome = RunShell("set -e; export PENUMBRA; $PENUMBRA animate " + options +
    "'whole/{frame}.png'; $PENUMBRA animate " + options + "'task/{frame}.png' --prepare " +
    Quote(folder / "film.json") +
    "; for task in 2 0 1 1; do SLURM_ARRAY_TASK_ID=$task SLURM_CPUS_PER_TASK=1 bash " +
    Quote(SourceFolder() + "/Examples/Clusters/film.sbatch") + " 3 " + Quote(folder / "film.json") +
    " " + options + "'task/{frame}.png'; done");
  EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_EQ(outcome.Errors, "");
  ExpectSameFiles(folder, "whole", "task", 7);
}

TEST(FilmParts, SlurmTasksReportInvalidUse)
{
  const Folder folder("bad-slurm");
  WriteText(folder / "empty.json", "");
  WriteText(folder / "cut.json", "{\n \"coloring-range\": [0,2],\n \"ima");
  const std::string usage = "usage: sbatch -a 0-7 film.sbatch 8 FILM.json OPTIONS...\n";
  const struct
  {
    const char* Arguments;
    std::string Said;
  } rows[] = { { "SLURM_ARRAY_TASK_ID=2", usage }, { "SLURM_ARRAY_TASK_ID=2 3", usage },
    { "SLURM_ARRAY_TASK_ID=2 3 cut.json", usage },
    { "SLURM_ARRAY_TASK_ID=2 film cut.json a", usage },
    { "SLURM_ARRAY_TASK_ID=3 3 cut.json a", usage },
    { "-u SLURM_ARRAY_TASK_ID 3 cut.json a", usage },
    { "SLURM_ARRAY_TASK_ID=2 3 cut.json a",
      "film.sbatch: cut.json: no number of images; prepare the film again\n" },
    { "SLURM_ARRAY_TASK_ID=2 3 empty.json a",
      "film.sbatch: empty.json: no number of images; prepare the film again\n" } };
  for (const auto& row : rows)
  {
    std::string arguments = row.Arguments;
    const std::size_t end = arguments.find(' ', arguments[0] == '-' ? 3 : 0);
    const std::string variable = arguments.substr(0, end);
    arguments.erase(0, variable.size());
    const ProgramResult outcome = RunShell("cd " + Quote(folder.Path) + " && env " + variable +
      " bash " + Quote(SourceFolder() + "/Examples/Clusters/film.sbatch") + arguments);
    EXPECT_EQ(outcome.Status, 2) << row.Arguments;
    EXPECT_EQ(outcome.Errors, row.Said) << row.Arguments;
  }
}

TEST(FilmParts, UnreadableStepIsReportedBeforeFirstImage)
{
  const Folder folder("gone-parts");
  const Words range = { "--coloring-array", "T", "--coloring-range", "all" };
  const Words list = { folder / "run_8.vtk", folder / "run_9.vtk", folder / "run_10.vtk",
    "--time-series" };
  const Words output = { "--output", folder / "film/{frame}.png" };
  const Words prepare = { "--prepare", folder / "film.json" };
  for (const auto& [name, isCut] :
    { std::pair("run_8.vtk", false), { "run_9.vtk", true }, { "run_10.vtk", false } })
  {
    const std::string step = folder / name;
    WriteFileSeries(folder);
    std::filesystem::resize_file(step, std::filesystem::file_size(step) / 2);
    if (!isCut)
    {
      std::filesystem::remove(step);
    }
    std::vector<ProgramResult> outcomes = {
      RunAnimate(Join(Join(Join({ folder / "run.pvd" }, range), output), prepare)),
      RunAnimate(Join(Join(Join(list, range), output), prepare)),
      RunAnimate(Join(Join(Join({ folder / "run.pvd" }, range), output), { "--frames", "1:1" })),
      RunProgram(Join({ "render", folder / "run.pvd", "--output", folder / "film.png" }, range)),
    };
    if (step == folder / "run_8.vtk") // Without a range, the first step has the defaults.
    {
      outcomes.push_back(RunAnimate(Join(Join(list, output), prepare)));
      outcomes.push_back(RunAnimate(Join(Join(list, output), { "--frames", "1:1" })));
    }
    for (const ProgramResult& outcome : outcomes)
    {
      EXPECT_EQ(outcome.Status, 2) << step;
      EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
      EXPECT_NE(outcome.Errors.find(step), std::string::npos) << outcome.Errors;
    }
  }
  WriteFileSeries(folder);
  EXPECT_EQ(folder.List(),
    (std::vector<std::string>{
      "run.pvd", "run.vtk.series", "run_10.vtk", "run_8.vtk", "run_9.vtk" }));
}

// Its image reports what is missing; the others are the same as in a film without it.
TEST(FilmParts, FirstStepWithoutTheArrayIsLeftOut)
{
  const Folder folder("lacking-parts");
  WriteFileSeries(folder);
  std::string first = ReadText(folder / "run_8.vtk");
  WriteText(folder / "run_8.vtk", first.replace(first.find("SCALARS T"), 9, "SCALARS U"));
  for (const Words& range : { Words{}, Words{ "--coloring-range", "all" } })
  {
    const Words film =
      Join({ folder / "run.pvd", "--coloring-array", "T", "--output", folder / "film/{frame}.png" },
        range);
    const ProgramResult prepared = RunAnimate(Join(film, { "--prepare", folder / "film.json" }));
    EXPECT_EQ(prepared.Status, 0) << prepared.Errors;
    const ProgramResult part = RunAnimate(Join(film, { "--frames", "1:2" }));
    EXPECT_EQ(part.Status, 0) << part.Errors;
    EXPECT_TRUE(std::filesystem::exists(folder / "film/0002.png"));
    const ProgramResult lacking = RunAnimate(Join(film, { "--frames", "0:0" }));
    EXPECT_EQ(lacking.Status, 2);
    EXPECT_NE(lacking.Errors.find("no point array 'T'"), std::string::npos) << lacking.Errors;
  }
}

TEST(FilmParts, UnreadableStepDoesNotAffectOtherScenes)
{
  const Folder folder("scenes");
  WriteFileSeries(folder);
  std::string steps = ReadText(folder / "run.pvd");
  WriteText(folder / "bad.pvd", steps.replace(steps.find("run_9"), 5, "gone_"));
  const ProgramResult outcome = RunProgram(
    { "render", folder / "bad.pvd", folder / "run.pvd", "--output", folder / "{name}.png",
      "--coloring-array", "T", "--coloring-range", "all", "--resolution", "36,24" });
  EXPECT_EQ(outcome.Status, 2);
  EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
  EXPECT_NE(outcome.Errors.find("gone_.vtk: no such file"), std::string::npos) << outcome.Errors;
  EXPECT_TRUE(std::filesystem::exists(folder / "run.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "bad.png"));
}

TEST(FilmParts, ReportInvalidUse)
{
  const Folder folder("bad-parts");
  WriteSphereWithArrays(folder / "sphere.vtp");
  const Words film = { folder / "sphere.vtp", "--frames", "24", "--output",
    folder / "{frame}.png" };
  Make(Join(film, { "--prepare", folder / "film.json" }));
  WriteText(folder / "damaged.json", "{\"options\": []");
  WriteText(folder / "other.json", "{\"options\": [], \"images\": 3}");
  const struct
  {
    Words Options;
    const char* Said;
  } rows[] = {
    { { "--frames", "20:24" }, "images 0 to 23" },
    { { "--frames", "30:40" }, "images 0 to 23" },
    { { "--frame-list", "3,24" }, "images 0 to 23" },
    { { "--frames", "3:2" }, "begins after its end" },
    { { "--frames", "1:2:3" }, "--frames" },
    { { "--frames", "-1:2" }, "--frames" },
    { { "--frame-list", "1,,2" }, "--frame-list" },
    { { "--frame-list", "1.5" }, "not an integer" },
    { { "--prepare", folder / "a.json", "--defaults", folder / "film.json" }, "--defaults" },
    { { "--defaults", folder / "gone.json" }, "no such file" },
    { { "--defaults", folder / "damaged.json" }, "not written by --prepare" },
    { { "--defaults", folder / "other.json" }, "--defaults" },
    { { "--defaults", folder / "film.json", "--camera-azimuth-angle", "20" },
      "--camera-azimuth-angle is not that of --prepare" },
    { { "--defaults", folder / "film.json", "--frames", "25" }, "24 images, not 25" },
    { { "--prepare", folder / "sphere.vtp" }, "input file" },
  };
  for (const auto& row : rows)
  {
    const ProgramResult outcome = RunAnimate(Join(film, row.Options));
    EXPECT_EQ(outcome.Status, 2) << row.Said;
    EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
    EXPECT_NE(outcome.Errors.find(row.Said), std::string::npos) << row.Said << outcome.Errors;
  }
  EXPECT_EQ(folder.List(),
    (std::vector<std::string>{ "damaged.json", "film.json", "other.json", "sphere.vtp" }));
}
