// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Titles of scalar bars with characters that VTK's font lacks.
#include "Program.h"
#include "RenderedImages.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <utility>

using namespace penumbra_testing;

namespace
{

/// Renders a square that is colored by an array with this name, with its scalar bar.
ProgramResult RenderTitle(const Folder& folder, const std::string& name, const std::string& image,
  const std::string& setting = std::string())
{
  WriteText(folder / "a.vtp",
    "<VTKFile type=\"PolyData\" version=\"0.1\"><PolyData><Piece NumberOfPoints=\"3\" "
    "NumberOfPolys=\"1\"><PointData><DataArray type=\"Float32\" format=\"ascii\" Name=\"" +
      name +
      "\">0 1 2</DataArray></PointData><Points><DataArray type=\"Float32\" "
      "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0</DataArray></Points><Polys>"
      "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>"
      "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys></Piece>"
      "</PolyData></VTKFile>");
  return RunProgram({ "render", folder / "a.vtp", "--output", folder / image, "--resolution",
                      "160,120", "--coloring-array", name, "--coloring-scalar-bar" },
    setting);
}

// A font without the characters draws the same box for both. The last ones are not of 16 bits.
TEST(Titles, AreDrawnOrAWarningNamesTheFont)
{
  const Folder folder("titles");
  for (const auto& [a, b] :
    { std::pair("\xcf\x83\xcf\x83", "\xcf\x84\xcf\x84"), std::pair("\xe6\xb8\xa9", "\xe5\xba\xa6"),
      std::pair("\xf0\x9f\x98\x80", "\xf0\x9f\x98\x85") })
  {
    const ProgramResult first = RenderTitle(folder, a, "a.png");
    const ProgramResult second = RenderTitle(folder, b, "b.png");
    ASSERT_EQ(first.Status, 0) << first.Errors;
    ASSERT_EQ(second.Status, 0) << second.Errors;
    if (first.Errors.empty() && second.Errors.empty())
    {
      EXPECT_GT(Compare(folder / "a.png", folder / "b.png"), 0.2) << a;
    }
    else
    {
      const std::string warning = first.Errors.empty() ? second.Errors : first.Errors;
      EXPECT_EQ(CountLines(warning), 1);
      EXPECT_NE(warning.find("PENUMBRA_FONT"), std::string::npos) << warning;
    }
  }
}

TEST(Titles, UseTheFontOfTheEnvironment)
{
  const Folder folder("font");
  const ProgramResult missing =
    RenderTitle(folder, "T", "a.png", "PENUMBRA_FONT=/nowhere/font.ttf");
  EXPECT_EQ(missing.Status, 2);
  EXPECT_EQ(CountLines(missing.Errors), 1);
  EXPECT_NE(missing.Errors.find("/nowhere/font.ttf"), std::string::npos) << missing.Errors;
  const std::string serif = "/usr/share/fonts/truetype/dejavu/DejaVuSerif-Bold.ttf";
  if (!std::filesystem::exists(serif))
  {
    GTEST_SKIP() << "The test needs DejaVu fonts.";
  }
  ASSERT_EQ(RenderTitle(folder, "T", "a.png").Errors, "");
  ASSERT_EQ(RenderTitle(folder, "T", "b.png", "PENUMBRA_FONT=" + serif).Errors, "");
  EXPECT_GT(Compare(folder / "a.png", folder / "b.png"), 0.2);
}

}
