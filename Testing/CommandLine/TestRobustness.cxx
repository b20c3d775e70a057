// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Missing resources: full disks, cancellation, missing libraries, too little memory.
#include "Meshes.h"
#include "Program.h"
#include "RenderedImages.h"

#include "vtkImageData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>
#include <utility>

using namespace penumbra_testing;

namespace
{

// Lists the libraries that the program and its workers load, as reported by the dynamic linker.
std::string LibrariesOf(const Folder& folder, const std::string& engine)
{
  const std::string list = folder / engine;
  RunShell("env -u DISPLAY LD_DEBUG=files LD_DEBUG_OUTPUT=" + Quote(list) + " $PENUMBRA render " +
    Quote(folder / "square.stl") + " --resolution 16,16 --engine " + engine + " --output " +
    Quote(folder / "p.png"));
  std::string text;
  for (const std::string& name : folder.List())
  {
    text += name.rfind(engine + ".", 0) == 0 ? ReadText(folder / name) : "";
  }
  return text;
}

TEST(RayEngine, UsesNeitherOpenGLNorWindow)
{
  if (RunShell("ldd $PENUMBRA | grep -qE 'libGL|libEGL|libOSMesa|libX11'").Status == 0)
  {
    GTEST_SKIP() << "This VTK itself links OpenGL.";
  }
  const Folder folder("no-opengl");
  WriteText(folder / "square.stl", SquareStl());
  const std::string rays = LibrariesOf(folder, "ray");
  EXPECT_TRUE(std::filesystem::exists(folder / "p.png"));
  ASSERT_NE(rays.find("libc.so"), std::string::npos);
  for (const char* library : { "libGL", "libEGL", "libOSMesa", "libX11", "libgallium" })
  {
    EXPECT_EQ(rays.find(library), std::string::npos) << library;
  }
  if (RunShell("$PENUMBRA info | grep -q '^raster.*OpenGL'").Status == 0)
  {
    EXPECT_NE(LibrariesOf(folder, "raster").find("libglapi"), std::string::npos);
  }
}

TEST(RasterEngine, MatchesRayEngine)
{
  const Folder folder("engines");
  WriteSpheres(folder.Path);
  for (const char* engine : { "ray", "raster" })
  {
    const ProgramResult outcome = RunProgram({ "render", folder / "sphere.ply", "--engine", engine,
      "--resolution", "200,150", "--output", folder / engine + ".png" });
    if (outcome.Status == 3)
    {
      GTEST_SKIP() << outcome.Errors;
    }
    ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
    EXPECT_EQ(outcome.Errors, "");
  }
  // Only edges differ: multisampling against exact coverage.
  for (const auto metric : { vtkPenumbraImageComparison::RMSE, vtkPenumbraImageComparison::PIXELS })
  {
    EXPECT_LT(Compare(folder / "ray.png", folder / "raster.png", metric), 0.02);
  }
}

TEST(RasterEngine, RendersEffectsUpToTheLargestTexture)
{
  const Folder folder("wide");
  WriteSpheres(folder.Path);
  const auto render = [&](const std::string& width, const std::vector<std::string>& options) {
    std::vector<std::string> arguments = { "render", folder / "sphere.ply", "--engine", "raster",
      "--resolution", width + ",16", "--output", folder / "wide.png" };
    arguments.insert(arguments.end(), options.begin(), options.end());
    return RunProgram(arguments);
  };
  const ProgramResult tooWide = render("65535", {});
  EXPECT_EQ(tooWide.Status, 3);
  EXPECT_EQ(tooWide.Output, "");
  EXPECT_EQ(CountLines(tooWide.Errors), 1) << tooWide.Errors;
  if (tooWide.Errors.find("at most 16384 pixels") == std::string::npos)
  {
    GTEST_SKIP() << tooWide.Errors;
  }
  // Margins do not fit; rays need none.
  const std::pair<bool, std::vector<std::string>> effects[] = { { false,
                                                                  { "--ambient-occlusion" } },
    { true, { "--ambient-occlusion", "--ambient-occlusion-kernel", "march" } },
    { true, { "--light-shafts", "--light-position", "1,1,1,0" } } };
  for (const auto& [hasMargin, options] : effects)
  {
    const ProgramResult outcome = render("16384", options);
    EXPECT_EQ(outcome.Status, 0);
    EXPECT_EQ(CountLines(outcome.Errors), hasMargin ? 1 : 0) << outcome.Errors;
    EXPECT_EQ(outcome.Errors.find("at most 16384 pixels") != std::string::npos, hasMargin);
    EXPECT_EQ(outcome.Output, "");
  }
}

TEST(MissingOpenGL, PrintsOneLineError)
{
  const Folder folder("no-display");
  WriteText(folder / "square.stl", SquareStl());
  for (const char* option : { "--engine raster", "--ambient-occlusion --gatherer cube-map",
         "--indirect --gatherer cube-map" })
  {
    const ProgramResult outcome =
      RunShell("env -u DISPLAY -u VTK_DEFAULT_OPENGL_WINDOW $PENUMBRA render " +
        Quote(folder / "square.stl") + " " + option + " --window x --output " +
        Quote(folder / "p.png"));
    EXPECT_EQ(outcome.Status, 3);
    EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
    EXPECT_NE(outcome.Errors.find("--window x"), std::string::npos) << outcome.Errors;
    EXPECT_FALSE(std::filesystem::exists(folder / "p.png"));
  }
}

TEST(Output, IsCompleteOrMissingOnFullDisk)
{
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "VTK's TIFF library leaks a file that it cannot write.";
#endif
  const Folder folder("full-disk");
  WriteSpheres(folder.Path);
  const std::vector<std::string> before = folder.List();
  for (const char* extension : { "png", "jpg", "tif", "bmp", "vti" })
  {
    // A file may grow to 1 KiB at most.
    const ProgramResult outcome =
      RunShell("ulimit -f 1; $PENUMBRA render " + Quote(folder / "sphere.stl") +
        " --no-background --resolution 300,300 --output " + Quote(folder / "p." + extension));
    if (std::string(extension) == "jpg" || std::string(extension) == "bmp")
    {
      EXPECT_EQ(outcome.Status, 2); // These formats have no alpha channel.
      continue;
    }
    EXPECT_EQ(outcome.Status, 2) << extension;
    EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
    EXPECT_NE(outcome.Errors.find("cannot be written"), std::string::npos) << outcome.Errors;
    EXPECT_EQ(folder.List(), before) << extension;
  }
}

TEST(Output, KeepsOldImageIfNewOneFails)
{
  const Folder folder("old-image");
  WriteText(folder / "square.stl", SquareStl());
  WriteText(folder / "p.png", "precious");
  EXPECT_EQ(
    RunProgram({ "render", folder / "missing.stl", "--output", folder / "p.png" }).Status, 2);
  EXPECT_EQ(ReadText(folder / "p.png"), "precious");
  std::filesystem::create_symlink("target.png", folder / "link.png");
  EXPECT_EQ(RunProgram({ "render", folder / "square.stl", "--resolution", "9,9", "--output",
                         folder / "link.png" })
              .Status,
    0);
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.png"));
  EXPECT_TRUE(std::filesystem::is_regular_file(folder / "target.png"));
}

TEST(Output, AcceptsLongestFileName)
{
  const Folder folder("long-name");
  WriteText(folder / "square.stl", SquareStl());
  const std::string name = std::string(251, 'p') + ".png";
  const ProgramResult outcome = RunProgram(
    { "render", folder / "square.stl", "--resolution", "9,9", "--output", folder / name });
  EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_TRUE(std::filesystem::exists(folder / name));
}

TEST(Program, LoadsNoLibraryOfTests)
{
  const ProgramResult libraries = RunShell("ldd $PENUMBRA | cut -d = -f 1"); // names without paths
  EXPECT_NE(libraries.Output.find("libvtkPenumbraFiltersComparison"), std::string::npos);
  for (const char* name : { "Testing", "gtest", "Reference" })
  {
    EXPECT_EQ(libraries.Output.find(name), std::string::npos) << libraries.Output;
  }
}

TEST(StandardOutput, ReportsFullDevice)
{
  const Folder folder("full-output");
  WriteText(folder / "square.stl", SquareStl());
  RunProgram(
    { "render", folder / "square.stl", "--resolution", "9,9", "--output", folder / "p.png" });
  const std::string image = Quote(folder / "p.png");
  for (const std::string& command :
    { std::string("list"), std::string("info"), std::string("--help"), std::string("--version"),
      "compare " + image + " " + image, "compare --json " + image + " " + image })
  {
    const ProgramResult outcome = RunShell("$PENUMBRA " + command + " > /dev/full");
    EXPECT_EQ(outcome.Status, 3) << command;
    EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
    EXPECT_NE(outcome.Errors.find("standard output"), std::string::npos) << outcome.Errors;
  }
}

// Starts a long render in the background, then runs `script` with its process id in $program.
ProgramResult InterruptRender(const Folder& folder, const std::string& script)
{
  // Shells start background processes with SIGINT ignored.
  return RunShell("env --default-signal=INT $PENUMBRA render " + Quote(folder / "sphere.stl") +
    " --resolution 6000,6000 --ambient-occlusion --tolerance 0.0001 --output " +
    Quote(folder / "p.png") + " & program=$!; sleep 1; " + script);
}

TEST(Cancelling, RemovesFilesAndEndsBySignal)
{
  const Folder folder("cancel");
  WriteSpheres(folder.Path);
  const std::vector<std::string> before = folder.List();
  for (const auto& [name, status] :
    { std::pair<std::string, int>{ "INT", 130 }, { "TERM", 143 }, { "HUP", 129 } })
  {
    // The shell reports the signal.
    const ProgramResult outcome =
      InterruptRender(folder, "kill -" + name + " $program; wait $program 2>/dev/null");
    EXPECT_EQ(outcome.Status, status) << name;
    EXPECT_EQ(outcome.Errors, "");
    EXPECT_EQ(folder.List(), before);
  }
}

TEST(Cancelling, EndsWorkersOfKilledSupervisor)
{
  const Folder folder("killed");
  WriteSpheres(folder.Path);
  const std::vector<std::string> before = folder.List();
  const ProgramResult outcome = InterruptRender(folder,
    "worker=$(pgrep -P $program); kill -KILL $program; wait $program 2>/dev/null; "
    "for i in $(seq 100); do kill -0 $worker 2>/dev/null || exit 0; sleep 0.05; done; exit 1");
  EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_EQ(folder.List(), before);
}

TEST(Cancelling, LeavesNoPartialFileIfAllProcessesAreKilled)
{
  const Folder folder("all-killed");
  WriteSpheres(folder.Path);
  const std::vector<std::string> before = folder.List();
  // Kills all processes at once while the file is written.
  const ProgramResult outcome = RunShell("cd " + Quote(folder.Path) +
    " && { setsid $PENUMBRA render sphere.stl --resolution 700,700 --output p.vti & } && "
    "program=$!; "
    "until [ -n \"$(find . -name '.p.vti*' -size +0)\" ] || [ -e p.vti ]; do kill -0 $program || "
    "exit 9; done; "
    "kill -KILL -- -$program; wait $program 2>/dev/null; exit 0");
  EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
  for (const std::string& name : folder.List())
  {
    const bool isInput = std::find(before.begin(), before.end(), name) != before.end();
    // The kill may come after the last byte.
    const bool isWhole =
      name == "p.vti" && ReadText(folder / name).find("</VTKFile>") != std::string::npos;
    EXPECT_TRUE(isInput || isWhole || name.rfind(".p.vti.", 0) == 0) << name;
  }
}

TEST(Cancelling, RespectsIgnoredSignals)
{
  const Folder folder("nohup");
  WriteSpheres(folder.Path);
  const ProgramResult outcome = RunShell("trap '' HUP; $PENUMBRA render " +
    Quote(folder / "sphere.stl") + " --resolution 1000,1000 --output " + Quote(folder / "p.png") +
    " & program=$!; for i in 1 2 3 4 5 6 7 8; do kill -HUP $program 2>/dev/null; sleep 0.05; "
    "done; wait $program");
  EXPECT_EQ(outcome.Status, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "p.png"));
}

TEST(Cancelling, EndsComparisonWithoutOutput)
{
  const Folder folder("cancel-compare");
  WriteText(folder / "square.stl", SquareStl());
  RunProgram(
    { "render", folder / "square.stl", "--resolution", "1500,1500", "--output", folder / "p.png" });
  const std::vector<std::string> before = folder.List();
  for (const char* delay : { "0.2", "0.5" })
  {
    const ProgramResult outcome = RunShell("$PENUMBRA compare " + Quote(folder / "p.png") + " " +
      Quote(folder / "p.png") + " --difference " + Quote(folder / "d.png") +
      " & program=$!; sleep " + delay + "; kill -TERM $program; wait $program");
    std::filesystem::remove(folder / "d.png"); // The program may have ended before.
    EXPECT_EQ(folder.List(), before) << outcome.Status;
  }
}

TEST(Workers, AreCollectedForAnyInheritedSignalMask)
{
  const Folder folder("signals");
  WriteText(folder / "square.stl", SquareStl());
  for (const char* option : { "--block-signal=CHLD", "--ignore-signal=CHLD" })
  {
    const ProgramResult outcome =
      RunShell(std::string("timeout -k 1 60 env ") + option + " $PENUMBRA render " +
        Quote(folder / "square.stl") + " --resolution 9,9 --output " + Quote(folder / "p.png"));
    EXPECT_EQ(outcome.Status, 0) << option << outcome.Errors;
  }
}

TEST(Workers, ReportProcessLimit)
{
  if (RunShell("[ $(id -u) = 0 ] && command -v setpriv >/dev/null").Status != 0)
  {
    GTEST_SKIP()
      << "The process limit applies to all processes of the user; this test needs a separate user.";
  }
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "LeakSanitizer itself needs another process.";
#endif
  const Folder folder("processes");
  WriteText(folder / "square.stl", SquareStl());
  std::filesystem::permissions(folder.Path, std::filesystem::perms::all);
  const ProgramResult outcome = RunShell("cd " + Quote(folder.Path) +
    " && PENUMBRA_LOG=/dev/null exec setpriv --reuid 64123 --clear-groups bash -c "
    "'ulimit -u 1; exec $PENUMBRA render square.stl --output p.png'");
  EXPECT_EQ(outcome.Status, 3) << outcome.Errors;
  EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
  EXPECT_NE(outcome.Errors.find("cannot start a process"), std::string::npos) << outcome.Errors;
}

TEST(SetUpScript, ListsBenchmarks)
{
  for (const char* arguments : { "benchmark", "benchmark wishful", "--system-vtk benchmark flat" })
  {
    const ProgramResult outcome = RunShell(Quote(SourceFolder() + "/penumbra") + " " + arguments);
    EXPECT_EQ(outcome.Status, 2) << arguments;
    EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
    const bool ours = std::string(arguments).rfind("benchmark", 0) == 0;
    EXPECT_NE(outcome.Errors.find(ours ? "antialiasing" : "--system-vtk"), std::string::npos)
      << outcome.Errors;
  }
}

TEST(OutOfMemory, RefusesScenesThatDoNotFit)
{
  const Folder folder("refusal");
  WriteText(folder / "square.stl", SquareStl());
  const std::vector<std::string> before = folder.List();
  const std::string file = folder / "square.stl";
  const std::vector<std::vector<std::string>> commands = { { "render", file, "--output",
                                                             folder / "p.png" },
    { "bake", file, "--output", folder / "p.vtp" },
    { "animate", file, "--output", folder / "p{frame}.png", "--frames", "2", "--orbit", "360" } };
  for (const std::vector<std::string>& command : commands)
  {
    const ProgramResult outcome = RunProgram(command, "PENUMBRA_AVAILABLE_MEMORY=1e-5");
    EXPECT_EQ(outcome.Status, 3) << outcome.Errors;
    EXPECT_NE(
      outcome.Errors.find("Not enough memory: 2 triangles need at least"), std::string::npos)
      << outcome.Errors;
    EXPECT_EQ(folder.List(), before) << command[0];
    const ProgramResult wrong = RunProgram(command, "PENUMBRA_AVAILABLE_MEMORY=much");
    EXPECT_NE(wrong.Status, 0) << command[0];
    EXPECT_NE(wrong.Errors.find("must be a positive number of MiB"), std::string::npos)
      << wrong.Errors;
  }
  EXPECT_EQ(RunProgram(commands[0], "PENUMBRA_AVAILABLE_MEMORY=1").Status, 0);
}

TEST(OutOfMemory, ReportsError)
{
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "The sanitizer needs more.";
#endif
  const Folder folder("memory");
  WriteText(folder / "square.stl", SquareStl());
  const std::vector<std::string> before = folder.List();
  const ProgramResult outcome = RunShell("ulimit -v 3000000; $PENUMBRA render " +
    Quote(folder / "square.stl") + " --resolution 16000,16000 --output " + Quote(folder / "p.png"));
  EXPECT_EQ(outcome.Status, 3) << outcome.Errors;
  EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
  EXPECT_NE(outcome.Errors.find("memory"), std::string::npos) << outcome.Errors;
  EXPECT_EQ(folder.List(), before);
}

}
