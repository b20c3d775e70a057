// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Meshes from standard input and images to standard output.
#include "Meshes.h"
#include "Program.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace penumbra_testing;

TEST(Streams, RenderLikeFiles)
{
  const Folder folder("streams");
  const std::string temporary = "export TMPDIR=" + Quote(folder / "tmp") + "; ";
  std::filesystem::create_directory(folder / "tmp");
  WriteSpheres(folder.Path);
  const std::string options = " --resolution 40,30 --output ";
  for (const std::string name : { "sphere.stl", "sphere.ply", "sphere.obj", "sphere.vtp",
         "sphere.vtk", "sphere.vtu", "sphere.off" })
  {
    if (!std::filesystem::exists(folder / name))
    {
      continue;
    }
    const ProgramResult outcome = RunShell(temporary + "$PENUMBRA render " + Quote(folder / name) +
      options + Quote(folder / "file.png") + " && $PENUMBRA render - < " + Quote(folder / name) +
      options + "- | cat > " + Quote(folder / "stream.png"));
    EXPECT_EQ(outcome.Status, 0) << name << outcome.Errors;
    EXPECT_EQ(outcome.Errors, "") << name;
    const std::string expected = ReadText(folder / "file.png");
    EXPECT_GT(expected.size(), 500u);
    EXPECT_EQ(ReadText(folder / "stream.png"), expected) << name;
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder / "tmp"));
}

TEST(Streams, ReportUnknownFormatsAndFullDevices)
{
  const Folder folder("bad-streams");
  WriteText(folder / "square.stl", SquareStl());
  const struct
  {
    std::string Command;
    int Status;
    const char* Said;
  } rows[] = { { "echo notes | $PENUMBRA render - --output -", 2, "format of standard input" },
    { "$PENUMBRA render - --output - < /dev/null", 2, "standard input is empty" },
    { "$PENUMBRA render " + Quote(folder / "square.stl") +
        " --resolution 40,30 --output - > /dev/full",
      3, "standard output cannot be written" } };
  for (const auto& row : rows)
  {
    const ProgramResult outcome = RunShell(row.Command);
    EXPECT_EQ(outcome.Status, row.Status) << row.Command << outcome.Errors;
    EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
    EXPECT_NE(outcome.Errors.find(row.Said), std::string::npos) << outcome.Errors;
  }
}
