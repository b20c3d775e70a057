// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Slices, clips, contours and thresholds: compares silhouettes with those of rectangles and disks whose
// size follows from the field.
#include "Program.h"
#include "RenderedImages.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkXMLImageDataReader.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace penumbra_testing;

namespace
{

using Words = std::vector<std::string>;

constexpr double Pi = 3.14159265358979323846;

// Cells of size 1 from (0, 0, 0) to (2, 1, 1), with the point arrays X (the coordinate) and the cell
// array Number (0 and 1).
const char* const TwoCells =
  "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 3 2 2\n"
  "ORIGIN 0 0 0\nSPACING 1 1 1\nCELL_DATA 2\nSCALARS Number double\nLOOKUP_TABLE default\n0 1\n"
  "POINT_DATA 12\nSCALARS X double\nLOOKUP_TABLE default\n0 1 2 0 1 2 0 1 2 0 1 2\n";

// The same with spacing 0.1 and radius^2 from the center of a cube of side 2.
std::string RadiusField()
{
  std::string text =
    "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 41 "
    "41 41\nORIGIN -1 -1 -1\nSPACING 0.05 0.05 0.05\nPOINT_DATA 68921\nSCALARS R "
    "double\nLOOKUP_TABLE default\n";
  for (int i = 0; i < 41 * 41 * 41; ++i)
  {
    const double x = -1.0 + 0.05 * (i % 41);
    const double y = -1.0 + 0.05 * (i / 41 % 41);
    const double z = -1.0 + 0.05 * (i / 1681);
    text += std::to_string(x * x + y * y + z * z) + "\n";
  }
  return text;
}

// Renders along -z; one world unit has 20 pixels, and (0, 0) is at pixel (20, 10).
ProgramResult Render(const Folder& folder, const std::string& file, const Words& options)
{
  Words arguments = { "render", folder / file, "--output", folder / "a.png", "--resolution",
    "80,40", "--unlit", "--camera-position", "1,0.5,9", "--camera-focal-point", "1,0.5,0",
    "--camera-orthographic", "--camera-parallel-scale", "1" };
  arguments.insert(arguments.end(), options.begin(), options.end());
  return RunProgram(arguments);
}

// Area that the image shows, in square world units.
double Area(const Folder& folder)
{
  const auto image = ReadImage(folder / "a.png");
  double sum = 0.0;
  for (int y = 0; y < 40; ++y)
  {
    for (int x = 0; x < 80; ++x)
    {
      sum += PixelAt(image, x, y)[0];
    }
  }
  return sum / 400.0;
}

// Expects an image of the rectangle from (x0, 0) to (x1, 1).
void ExpectRectangle(const Folder& folder, double x0, double x1, const std::string& what)
{
  const auto image = ReadImage(folder / "a.png");
  for (int x = 0; x < 80; ++x)
  {
    const double left = x / 20.0 - 1.0;
    const double covered = std::max(0.0, std::min(x1, left + 0.05) - std::max(x0, left)) / 0.05;
    EXPECT_NEAR(PixelAt(image, x, 20)[0], covered, 0.01) << what << " " << x;
  }
  EXPECT_NEAR(Area(folder), x1 - x0, 0.005) << what;
}

}

TEST(Cuts, LeaveRectanglesOfTwoCells)
{
  const Folder folder("cells");
  WriteText(folder / "cells.vtk", TwoCells);
  const struct
  {
    Words Options;
    double X0;
    double X1;
  } rows[] = { { {}, 0, 2 }, { { "--slice", "0,0,0.5,0,0,1" }, 0, 2 },
    { { "--clip", "0.75,0,0,1,0,0" }, 0.75, 2 }, { { "--clip", "0.75,0,0,-1,0,0" }, 0, 0.75 },
    { { "--clip", "0.25,0,0,1,0,0", "--clip", "1.5,0,0,-3,0,0" }, 0.25, 1.5 },
    { { "--threshold", "Number:1,1" }, 1, 2 }, { { "--threshold", "Number:-inf,0.5" }, 0, 1 },
    { { "--threshold", "X:0,1" }, 0, 1 }, { { "--threshold", "0,1" }, 0, 1 },
    { { "--threshold", "1,5", "--coloring-array", "Number", "--coloring-by-cells", "--colormap",
        "gray", "--coloring-range", "0,1" },
      1, 2 },
    // Clipped cells have values from 0.5 on.
    { { "--clip", "0.5,0,0,1,0,0", "--threshold", "X:0.4,1.2" }, 0.5, 1 },
    { { "--slice", "0,0,0.5,0,0,1", "--clip", "0.5,0,0,1,0,0" }, 0.5, 2 } };
  for (const auto& row : rows)
  {
    std::string what;
    for (const std::string& word : row.Options)
    {
      what += word + " ";
    }
    const ProgramResult outcome = Render(folder, "cells.vtk", row.Options);
    ASSERT_EQ(outcome.Status, 0) << what << outcome.Errors;
    ExpectRectangle(folder, row.X0, row.X1, what);
  }
}

TEST(Cuts, ContourOfRadiusIsSphere)
{
  const Folder folder("sphere");
  WriteText(folder / "field.vtk", RadiusField());
  // Seen along -z, the sphere of radius 0.5 and its cross-section at z = 0.3 are disks. Chords of the
  // cells of size 0.05 lie inside by less than 0.05^2 / (8 * 0.4).
  ASSERT_EQ(Render(folder, "field.vtk", { "--contour", "0.25" }).Status, 0);
  EXPECT_NEAR(Area(folder), 0.25 * Pi, 0.01);
  ASSERT_EQ(
    Render(folder, "field.vtk", { "--threshold", "R:0,0.25", "--slice", "0,0,0.3,0,0,1" }).Status,
    0);
  EXPECT_LT(Area(folder), 0.16 * Pi); // Whole cells inside of the disk.
  EXPECT_GT(Area(folder), 0.12 * Pi);
  ASSERT_EQ(
    Render(folder, "field.vtk", { "--contour", "R:0.25", "--clip", "0,0,0,1,0,0" }).Status, 0);
  EXPECT_NEAR(Area(folder), 0.125 * Pi, 0.01);
}

TEST(Cuts, KeepCellIdsOfFile)
{
  const Folder folder("ids");
  WriteText(folder / "cells.vtk", TwoCells);
  ASSERT_EQ(
    RunProgram(
      { "render", folder / "cells.vtk", "--output", folder / "a.vti", "--resolution", "80,40",
        "--camera-position", "1,0.5,9", "--camera-focal-point", "1,0.5,0", "--camera-orthographic",
        "--camera-parallel-scale", "1", "--threshold", "Number:1,1", "--slice", "0,0,0.5,0,0,1" })
      .Status,
    0);
  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName((folder / "a.vti").c_str());
  reader->Update();
  vtkDataArray* ids = reader->GetOutput()->GetPointData()->GetArray("CellId");
  ASSERT_NE(ids, nullptr);
  EXPECT_EQ(ids->GetComponent(80 * 20 + 50, 0), 1.0); // x = 1.5
  EXPECT_EQ(ids->GetComponent(80 * 20 + 30, 0), -1.0);
}

TEST(Cuts, ReportInvalidUse)
{
  const Folder folder("bad-cuts");
  WriteText(folder / "cells.vtk", TwoCells);
  WriteText(folder / "vectors.vtk",
    std::string(TwoCells) + "VECTORS V double\n" +
      "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n");
  const struct
  {
    const char* File;
    Words Options;
    const char* Said;
  } rows[] = {
    { "cells.vtk", { "--slice", "0,0,0,0,0" }, "--slice" },
    { "cells.vtk", { "--slice", "0,0,0,0,0,0" }, "normal 0,0,0" },
    { "cells.vtk", { "--slice", "0,0,7,0,0,1" }, "leaves nothing" },
    { "cells.vtk", { "--contour", "7" }, "leaves nothing" },
    { "cells.vtk", { "--contour", "Y:7" }, "does not have the array 'Y'" },
    { "cells.vtk", { "--contour", "nan" }, "--contour" },
    { "cells.vtk", { "--threshold", "1" }, "--threshold" },
    { "cells.vtk", { "--threshold", "2,1" }, "minimum above" },
    // No whole cell is in the range, so that nothing is left to clip.
    { "cells.vtk", { "--threshold", "X:0.4,1.2", "--clip", "0.5,0,0,1,0,0" }, "leaves nothing" },
    { "vectors.vtk", { "--contour", "V:1" }, "one component" },
  };
  for (const auto& row : rows)
  {
    const ProgramResult outcome = Render(folder, row.File, row.Options);
    EXPECT_EQ(outcome.Status, 2) << row.Said;
    EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
    EXPECT_NE(outcome.Errors.find(row.Said), std::string::npos) << row.Said << outcome.Errors;
  }
}
