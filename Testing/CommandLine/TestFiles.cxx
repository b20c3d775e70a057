// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Files are written completely or not at all and never overwrite an input. Truncated files, and files whose
// readers do not end, are reported as damaged.
#include "Meshes.h"
#include "Program.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace penumbra_testing;

namespace
{

namespace fs = std::filesystem;

void ExpectRefused(const ProgramResult& outcome, const std::string& words)
{
  EXPECT_EQ(outcome.Status, 2) << outcome.Errors;
  EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
  EXPECT_NE(outcome.Errors.find(words), std::string::npos) << outcome.Errors;
}

// Runs the program with a limit on the file size. `arguments` are quoted if needed.
ProgramResult RunOnFullDisk(std::uintmax_t bytes, const std::string& arguments)
{
  return RunShell("set -o pipefail; prlimit --fsize=" + std::to_string(bytes) + " $PENUMBRA " +
    arguments + " 2>&1 | cat >&2"); // The limit must not apply to messages.
}

// The disk is full before the last byte of the file, or at its middle.
void ExpectWholeOrNothing(
  const Folder& folder, const std::string& name, const std::string& arguments)
{
  ASSERT_EQ(RunShell("$PENUMBRA " + arguments).Status, 0) << arguments;
  const std::uintmax_t size = fs::file_size(folder / name);
  fs::remove(folder / name);
  const std::vector<std::string> before = folder.List();
  for (const std::uintmax_t limit : { size - 1, size / 2 })
  {
    const ProgramResult outcome = RunOnFullDisk(limit, arguments);
    ExpectRefused(outcome, name + ": cannot be written");
    EXPECT_EQ(outcome.Errors.find("read"), std::string::npos) << outcome.Errors;
    EXPECT_EQ(folder.List(), before) << arguments;
  }
}

TEST(FullDisk, LeavesNoPartialMesh)
{
  const Folder folder("full-mesh");
  WriteText(folder / "square.stl", SquareStl());
  for (const std::string name : { "p.ply", "p.vtk", "p.vtp", "p.vtu" })
  {
    ExpectWholeOrNothing(
      folder, name, "bake " + Quote(folder / "square.stl") + " --output " + Quote(folder / name));
  }
}

TEST(FullDisk, LeavesNoPartialImage)
{
  const Folder folder("full-image");
  WriteText(folder / "square.stl", SquareStl());
  const std::string square = Quote(folder / "square.stl");
  ASSERT_EQ(RunShell("$PENUMBRA render " + square + " --resolution 40,30 --output " +
              Quote(folder / "a.png"))
              .Status,
    0);
  for (const std::string name : { "p.png", "p.jpg", "p.tif", "p.bmp", "p.vti" })
  {
    const std::string output = Quote(folder / name);
    ExpectWholeOrNothing(
      folder, name, "render " + square + " --resolution 40,30 --output " + output);
    ExpectWholeOrNothing(folder, name,
      "compare " + Quote(folder / "a.png") + " " + Quote(folder / "a.png") + " --difference " +
        output);
  }
}

TEST(FullDisk, LeavesNoPartialFrame)
{
  const Folder folder("full-animation");
  WriteText(folder / "square.stl", SquareStl());
  const std::vector<std::string> before = folder.List();
  const ProgramResult outcome = RunOnFullDisk(60,
    "animate " + Quote(folder / "square.stl") + " --frames 20 --resolution 40,30 --output " +
      Quote(folder / "{frame}.tif"));
  EXPECT_EQ(outcome.Status, 2) << outcome.Errors;
  EXPECT_EQ(CountLines(outcome.Errors), 2) << outcome.Errors;
  EXPECT_NE(outcome.Errors.find("0000.tif: cannot be written"), std::string::npos)
    << outcome.Errors;
  EXPECT_NE(outcome.Errors.find("19 more times"), std::string::npos) << outcome.Errors;
  EXPECT_EQ(folder.List(), before);
}

TEST(FullDisk, LeavesNoPartialStatistics)
{
  const Folder folder("full-statistics");
  WriteText(folder / "square.stl", SquareStl());
  const std::string name = "s.json";
  for (const std::string command : { "bake", "render --resolution 9,9" })
  {
    const std::string output = command == "bake" ? "p.ply" : "p.png";
    const std::string arguments = command + " " + Quote(folder / "square.stl") + " --output " +
      Quote(folder / output) + " --statistics " + Quote(folder / name);
    ASSERT_EQ(RunShell("$PENUMBRA " + arguments).Status, 0);
    ASSERT_GT(fs::file_size(folder / name), fs::file_size(folder / output));
    const std::uintmax_t limit = fs::file_size(folder / name) - 40; // Times vary.
    fs::remove(folder / name);
    fs::remove(folder / output);
    const std::vector<std::string> before = folder.List();
    ExpectRefused(RunOnFullDisk(limit, arguments), "s.json: cannot be written");
    EXPECT_EQ(folder.List(), before);
  }
}

// Pieces, blocks and link targets with their expected contents after the run.
class Inputs : public testing::Test
{
protected:
  void ExpectKept(const std::vector<std::string>& arguments, const std::string& name)
  {
    const std::string before = ReadText(this->At / name);
    ASSERT_FALSE(before.empty()) << name;
    const std::vector<std::string> names = this->At.List();
    ExpectRefused(RunProgram(arguments), "the path is an input file");
    EXPECT_EQ(ReadText(this->At / name), before) << name;
    EXPECT_EQ(this->At.List(), names);
  }

  Folder At{ "inputs" };
};

TEST_F(Inputs, AreNotOverwrittenByBake)
{
  WriteSpheres(this->At.Path);
  fs::create_hard_link(this->At / "sphere.ply", this->At / "hard.ply");
  fs::create_symlink("sphere.ply", this->At / "soft.ply");
  const std::string input = this->At / "sphere.ply";
  for (const std::string name : { "sphere.ply", "hard.ply", "soft.ply" })
  {
    this->ExpectKept({ "bake", input, "--output", this->At / name }, name);
  }
  this->ExpectKept(
    { "bake", this->At / "hard.ply", "--output", this->At / "p.ply", "--statistics", input },
    "sphere.ply");
  WriteText(this->At / "block.vtm",
    "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\"><vtkMultiBlockDataSet>"
    "<DataSet index=\"0\" file=\"sphere.vtp\"/></vtkMultiBlockDataSet></VTKFile>");
  this->ExpectKept(
    { "bake", this->At / "block.vtm", "--output", this->At / "sphere.vtp" }, "sphere.vtp");
}

TEST_F(Inputs, AreNotOverwrittenByRender)
{
  WriteText(this->At / "square.stl", SquareStl());
  const std::string square = this->At / "square.stl";
  for (const std::string name : { "sky.png", "piece.vti" })
  {
    ASSERT_EQ(
      RunProgram({ "render", square, "--resolution", "8,4", "--output", this->At / name }).Status,
      0);
  }
  const std::string sky = this->At / "sky.png";
  for (const std::string command : { "render", "animate" })
  {
    const std::string output = command == "render" ? sky : this->At / "{frame}.png";
    if (command == "animate")
    {
      fs::create_hard_link(sky, this->At / "0001.png");
    }
    this->ExpectKept({ command, square, "--output", output, "--hdri-file", sky, "--indirect",
                       "--resolution", "9,9" },
      "sky.png");
  }
  this->ExpectKept({ "bake", square, "--output", this->At / "p.vtp", "--quantity", "irradiance",
                     "--hdri-file", sky, "--statistics", sky },
    "sky.png");
  WriteText(this->At / "whole.pvti",
    "<VTKFile type=\"PImageData\" version=\"0.1\"><PImageData WholeExtent=\"0 7 0 3 0 0\" "
    "GhostLevel=\"0\" Origin=\"0 0 0\" Spacing=\"1 1 1\"><Piece Extent=\"0 7 0 3 0 0\" "
    "Source=\"piece.vti\"/></PImageData></VTKFile>");
  this->ExpectKept({ "render", this->At / "whole.pvti", "--output", this->At / "piece.vti",
                     "--resolution", "9,9" },
    "piece.vti");
  this->ExpectKept({ "compare", sky, this->At / "piece.vti", "--difference", sky }, "sky.png");
  this->ExpectKept({ "compare", sky, sky, "--mask", this->At / "piece.vti", "--difference",
                     this->At / "piece.vti" },
    "piece.vti");
}

TEST(Reading, EndsWithinTimeLimit)
{
  const Folder folder("read-limit");
  // Without a blank line after the header, VTK's reader does not end.
  WriteText(folder / "a.nrrd",
    "NRRD0004\ntype: float\ndimension: 3\nsizes: 4 4 4\n" +
      std::string("spacings: 1 1 1\nencoding: raw\n"));
  WriteSpheres(folder.Path);
  const std::vector<std::string> before = folder.List();
  ExpectRefused(RunShell("timeout 20 $PENUMBRA render " + Quote(folder / "sphere.stl") +
                  " --read-limit 0.0001 --output " + Quote(folder / "p.png")),
    "sphere.stl: reading takes more than 0.0001 s");
  const ProgramResult outcome = RunShell("timeout 20 $PENUMBRA render " + Quote(folder / "a.nrrd") +
    " --read-limit 1 --output " + Quote(folder / "p.png"));
  ExpectRefused(outcome, "a.nrrd: ");
  // With an unknown line, VTK's reader does not end.
  WriteText(folder / "a.case", "FORMAT\ntype: ensight gold\nunknown\nGEOMETRY\nmodel: a.geo\n");
  ExpectRefused(RunShell("timeout 20 $PENUMBRA render " + Quote(folder / "a.case") +
                  " --read-limit 0.5 --output " + Quote(folder / "p.png")),
    "a.case: reading takes more than 0.5 s");
  fs::remove(folder / "a.case");
  EXPECT_EQ(folder.List(), before);
  EXPECT_EQ(RunProgram({ "bake", folder / "sphere.stl", "--read-limit", "inf", "--output",
                         folder / "p.ply" })
              .Status,
    0);
}

TEST(Reading, LimitsMemoryByFileSize)
{
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "The sanitizer counts memory otherwise.";
#endif
  const Folder folder("read-memory");
  WriteText(folder / "huge.vtk",
    "# vtk DataFile Version 3.0\nhuge\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 1000 1000 700\n"
    "SPACING 1 1 1\nORIGIN 0 0 0\nPOINT_DATA 700000000\nSCALARS s float 1\nLOOKUP_TABLE default\n");
  ExpectRefused(RunShell("timeout 30 $PENUMBRA render " + Quote(folder / "huge.vtk") +
                  " --output " + Quote(folder / "p.png")),
    "huge.vtk: the file is damaged");
  WriteText(folder / "huge.vtp",
    "<VTKFile type=\"PolyData\" version=\"0.1\"><PolyData><Piece NumberOfPoints=\"999999999\" "
    "NumberOfPolys=\"0\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" "
    "format=\"ascii\">0 0 0 1 0 0 0 1 0</DataArray></Points></Piece></PolyData></VTKFile>");
  ExpectRefused(RunProgram({ "render", folder / "huge.vtp", "--output", folder / "p.png" }),
    "the file is damaged");
}

struct Sample
{
  std::string Extension;
  std::string Bytes;
};

// Small complete files of the formats whose readers accept truncated files.
std::vector<Sample> Samples()
{
  const auto zeros = [](std::size_t count) { return std::string(count, '\0'); };
  std::vector<Sample> samples = {
    { ".pts", "4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n" },
    { ".nrrd",
      "NRRD0004\ntype: unsigned char\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n\n" +
        std::string(64, 'v') },
    { ".nrrd",
      "NRRD0004\ntype: float\ndimension: 3\nsizes: 2 2 2\nencoding: ascii\n\n0 1 2 3\n4 5 6 7\n" },
    { ".inp",
      "4 1 1 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n1 1 tet 1 2 3 4\n1 1\ns, m\n1 0\n2 1\n3 2\n"
      "4 3\n" },
    { ".tec",
      "TITLE = \"t\"\nVARIABLES = \"X\", \"Y\", \"Z\", \"S\"\nZONE T=\"a\", N=4, E=2, F=FEPOINT, "
      "ET=TRIANGLE\n0 0 0 1\n1 0 0 2\n1 1 0 3\n0 1 0 4\n1 2 3\n1 3 4\n" },
    { ".slc", "11111\n4 4 2 8\n1 1 1\n0 0 0\n0\n2 2 X" + zeros(12) + std::string(32, 'v') },
    { ".slc",
      "11111\n4 4 2 8\n1 1 1\n0 0 0\n1\n2 2 X" + zeros(12) + "3 X\x10\x05" + zeros(1) +
        "3 X\x10\x07" + zeros(1) },
  };
  return samples;
}

// Truncates at fractions that are within a section, and before the last character. One run of the program renders the
// whole file and all parts. `header`: text of a file NAME.case that is opened and refers to the file; or empty.
void ExpectCutsRefused(
  const std::string& extension, const std::string& bytes, const std::string& header = "")
{
  const Folder folder("truncated");
  const std::size_t end = bytes.find_last_not_of(" \n");
  std::vector<std::size_t> cuts = { bytes.size() };
  for (const double fraction : { 0.1, 0.3, 0.5, 0.7, 0.92 })
  {
    cuts.push_back(static_cast<std::size_t>(fraction * static_cast<double>(end)));
  }
  cuts.push_back(end);
  std::string files;
  for (std::size_t i = 0; i < cuts.size(); ++i)
  {
    const std::string name = std::to_string(i);
    WriteText(folder / name + extension, bytes.substr(0, cuts[i]));
    if (!header.empty())
    {
      WriteText(folder / name + ".case", header + name + extension + "\n");
    }
    files += Quote(folder / name + (header.empty() ? extension : ".case")) + " ";
  }
  const ProgramResult outcome = RunShell("timeout 60 $PENUMBRA render " + files +
    "--resolution 9,9 --output " + Quote(folder / "{name}.png"));
  EXPECT_EQ(outcome.Status, 2) << extension;
  EXPECT_EQ(CountLines(outcome.Errors), 6) << extension << ": " << outcome.Errors;
  for (std::size_t i = 0; i < cuts.size(); ++i)
  {
    const std::string name = std::to_string(i);
    EXPECT_EQ(fs::exists(folder / name + ".png"), i == 0)
      << extension << " cut to " << cuts[i] << " of " << bytes.size();
    EXPECT_EQ(outcome.Errors.find("/" + name + ".") == std::string::npos, i == 0) << outcome.Errors;
  }
}

TEST(Truncated, MissingValuesAreReported)
{
  for (const Sample& sample : Samples())
  {
    ExpectCutsRefused(sample.Extension, sample.Bytes);
  }
}

TEST(Truncated, LegacyFilesAreReported)
{
  const Folder folder("truncated-legacy");
  WriteSpheres(folder.Path);
  ExpectCutsRefused(".vtk", ReadText(folder / "sphere.vtk"));
  WriteText(folder / "square.stl", SquareStl());
  ASSERT_EQ(RunProgram({ "bake", folder / "square.stl", "--output", folder / "b.vtk" }).Status, 0);
  ExpectCutsRefused(".vtk", ReadText(folder / "b.vtk"));
  ExpectCutsRefused(".vtk",
    "# vtk DataFile Version 3.0\na grid\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n"
    "0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\nPOINT_DATA 4\n"
    "SCALARS s float 1\nLOOKUP_TABLE default\n0 1 2 3\nVECTORS v float\n0 0 0 1 1 1 2 2 2 3 3 3\n");
}

TEST(Truncated, EnSightGeometriesAreReported)
{
  ExpectCutsRefused(".geo",
    "title\nmore\nnode id assign\nelement id assign\npart\n1\nonly\ncoordinates\n4\n0.0\n1.0\n0.0\n"
    "0.0\n0.0\n0.0\n1.0\n0.0\n0.0\n0.0\n0.0\n1.0\ntetra4\n1\n1 2 3 4\n",
    "FORMAT\ntype: ensight gold\n\nGEOMETRY\nmodel: ");
}

TEST(Faults, ClosedStreamsDoNotChangeImages)
{
  const Folder folder("closed");
  WriteText(folder / "square.stl", SquareStl());
  const std::string render =
    "$PENUMBRA render " + Quote(folder / "square.stl") + " --resolution 40,30 --output ";
  ASSERT_EQ(RunShell(render + Quote(folder / "a.tif")).Status, 0);
  // Use .tif, because libtiff prints warnings on stderr.
  for (const std::string closed : { ">&-", "2>&-", ">&- 2>&-", "<&- >&- 2>&-" })
  {
    EXPECT_EQ(RunShell(render + Quote(folder / "b.tif") + " " + closed).Status, 0) << closed;
    EXPECT_EQ(ReadText(folder / "a.tif"), ReadText(folder / "b.tif")) << closed;
    fs::remove(folder / "b.tif");
  }
  EXPECT_EQ(RunShell("$PENUMBRA list >&-").Status, 3);
  EXPECT_EQ(RunShell("$PENUMBRA list >&- 2>&-").Status, 3);
  EXPECT_EQ(RunShell("$PENUMBRA render missing.stl --output p.png 2>&-").Status, 2);
}

TEST(Faults, NamesWithNewlinesArePrintedInOneLine)
{
  const Folder folder("newlines");
  WriteText(folder / "a\nb.stl", SquareStl());
  const std::string input = folder / "a\nb.stl";
  EXPECT_EQ(
    RunProgram({ "render", input, "--resolution", "9,9", "--output", folder / "p\nq.png" }).Status,
    0);
  EXPECT_TRUE(fs::exists(folder / "p\nq.png"));
  ExpectRefused(
    RunProgram({ "bake", input, "--output", input + ".obj" }), "not a supported mesh format");
  ExpectRefused(RunProgram({ "render", folder / "no\nfile.stl", "--output", folder / "r.png" }),
    "no such file");
  ExpectRefused(
    RunProgram({ "bake", input, "--read-limit", "0.00001", "--output", folder / "r.ply" }),
    "reading takes more");
}

TEST(Faults, ManyThreadsSucceed)
{
  const Folder folder("threads");
  WriteText(folder / "square.stl", SquareStl());
  for (const std::string threads : { "1", "1000" })
  {
    const ProgramResult outcome = RunProgram({ "render", folder / "square.stl", "--resolution",
      "40,30", "--threads", threads, "--output", folder / threads + ".png" });
    EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
  }
  EXPECT_EQ(ReadText(folder / "1.png"), ReadText(folder / "1000.png"));
}

TEST(Faults, ConcurrentWritersLeaveOneCompleteFile)
{
  const Folder folder("writers");
  WriteText(folder / "square.stl", SquareStl());
  const std::string bake = "$PENUMBRA bake " + Quote(folder / "square.stl") + " --output ";
  const ProgramResult outcome = RunShell("for i in 1 2 3 4; do " + bake + Quote(folder / "p.ply") +
    " & done; wait; " + bake + Quote(folder / "q.ply"));
  EXPECT_EQ(outcome.Errors, "");
  EXPECT_EQ(ReadText(folder / "p.ply"), ReadText(folder / "q.ply"));
  EXPECT_EQ(folder.List(), (std::vector<std::string>{ "p.ply", "q.ply", "square.stl" }));
}

TEST(Faults, ReadOnlyFoldersAreReported)
{
  if (RunShell("[ $(id -u) = 0 ] && command -v setpriv >/dev/null").Status != 0)
  {
    GTEST_SKIP() << "Another user is needed, whom permissions bind.";
  }
  const Folder folder("read-only");
  WriteText(folder / "square.stl", SquareStl());
  for (const std::string command : { "bake", "render --resolution 9,9" })
  {
    const std::string output = command == "bake" ? "p.ply" : "p.png";
    ExpectRefused(
      RunShell("cd " + Quote(folder.Path) +
        " && PENUMBRA_LOG=/dev/null exec setpriv --reuid 64123 --clear-groups $PENUMBRA " +
        command + " square.stl --output " + output),
      output + ": cannot be written");
  }
}

TEST(Faults, FoldersThatCannotBeCreatedAreReported)
{
  const Folder folder("no-folder");
  WriteText(folder / "square.stl", SquareStl());
  WriteText(folder / "file", "");
  const std::string options = " " + Quote(folder / "square.stl") + " --resolution 9,9 --output ";
  for (const std::string command : { "animate --frames 1", "render" })
  {
    const std::string output =
      folder / (command == "render" ? "file/{name}/a.png" : "file/sub/{frame}.png");
    ExpectRefused(RunShell("$PENUMBRA " + command + options + Quote(output)),
      "the folder cannot be created: Not a directory");
  }
  if (RunShell("[ $(id -u) = 0 ] && command -v setpriv >/dev/null").Status != 0)
  {
    GTEST_SKIP() << "Another user is needed, whom permissions bind.";
  }
  ExpectRefused(RunShell("PENUMBRA_LOG=/dev/null exec setpriv --reuid 64123 --clear-groups "
                         "$PENUMBRA animate --frames 1" +
                  options + Quote(folder / "sub/{frame}.png")),
    "sub/0000.png: the folder cannot be created: Permission denied");
  EXPECT_EQ(folder.List(), (std::vector<std::string>{ "file", "square.stl" }));
}

TEST(Faults, BrokenLinksToFoldersAreReported)
{
  const Folder folder("broken-link");
  WriteText(folder / "square.stl", SquareStl());
  WriteSpheres(folder.Path);
  ASSERT_EQ(RunShell("ln -s nowhere " + Quote(folder / "link")).Status, 0);
  const std::string reason = folder /
    "link is a symbolic link to nowhere, which does not exist; create that folder or remove the "
    "link";
  const std::string square = Quote(folder / "square.stl") + " --resolution 9,9 --output ";
  ExpectRefused(
    RunShell("$PENUMBRA render " + square + Quote(folder / "link/sub/{name}.png")), reason);
  ExpectRefused(
    RunShell("$PENUMBRA animate --frames 1 " + square + Quote(folder / "link/{frame}.png")),
    reason);
  ExpectRefused(RunShell("$PENUMBRA bake " + Quote(folder / "sphere.ply") + " --output " +
                  Quote(folder / "link/a.vtp")),
    reason);
}

TEST(Faults, SignalsLeaveNoPartialMesh)
{
  const Folder folder("signals-bake");
  WriteSpheres(folder.Path);
  const std::vector<std::string> before = folder.List();
  for (const auto& [name, status] : { std::pair<std::string, int>{ "INT", 130 }, { "TERM", 143 } })
  {
    const ProgramResult outcome =
      RunShell("env --default-signal=INT $PENUMBRA bake " + Quote(folder / "sphere.ply") +
        " --tolerance 0.0001 --quantity irradiance --bounces 64" + " --albedo 1 --output " +
        Quote(folder / "p.ply") + " --statistics " + Quote(folder / "s.json") +
        " & program=$!; sleep 0.1; kill -" + name + " $program; wait $program 2>/dev/null");
    if (outcome.Status != 0) // The program may have ended before.
    {
      EXPECT_EQ(outcome.Status, status);
      EXPECT_EQ(folder.List(), before);
    }
    fs::remove(folder / "p.ply");
    fs::remove(folder / "s.json");
  }
}

}
