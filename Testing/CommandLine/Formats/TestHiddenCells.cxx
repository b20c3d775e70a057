// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Cells and points of polygons that the array vtkGhostType hides.
#include "Program.h"
#include "RenderedImages.h"

#include "vtkImageData.h"

#include <gtest/gtest.h>

using namespace penumbra_testing;

namespace
{

// Two unit squares; the second one has the corners 1 2 5 4.
std::string TwoSquares(const std::string& pointGhosts, const std::string& cellGhosts)
{
  const auto array = [](const std::string& type, const std::string& name,
                       const std::string& values) {
    return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"ascii\">" + values +
      "</DataArray>";
  };
  return "<VTKFile type=\"PolyData\" version=\"1.0\"><PolyData><Piece NumberOfPoints=\"6\" "
         "NumberOfPolys=\"2\">"
         "<PointData>" +
    array("UInt8", "vtkGhostType", pointGhosts) + "</PointData><CellData>" +
    array("UInt8", "vtkGhostType", cellGhosts) +
    "</CellData><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">"
    "0 0 0 1 0 0 2 0 0 0 1 0 1 1 0 2 1 0</DataArray></Points><Polys>" +
    array("Int64", "connectivity", "0 1 4 3 1 2 5 4") + array("Int64", "offsets", "4 8") +
    "</Polys></Piece></PolyData></VTKFile>";
}

TEST(HiddenCells, AreNotDrawn)
{
  struct Case
  {
    std::string Points;
    std::string Cells;
    double Right;
  };
  // 1: duplicate, 2 of points and 32 of cells: hidden [vtkDataSetAttributes]
  const Case cases[] = { { "0 0 0 0 0 0", "0 0", 1.0 }, { "0 0 0 0 0 0", "0 32", 0.0 },
    { "0 0 0 0 0 0", "0 1", 0.0 }, { "0 0 2 0 0 0", "0 0", 0.0 }, { "0 0 1 0 0 0", "0 0", 1.0 } };
  const Folder folder("hidden-cells");
  for (const Case& one : cases)
  {
    WriteText(folder / "a.vtp", TwoSquares(one.Points, one.Cells));
    const ProgramResult outcome = RunProgram({ "render", folder / "a.vtp", "--output",
      folder / "a.png", "--resolution", "40,20", "--no-lighting", "--color", "1,1,1",
      "--background-color", "0,0,0", "--camera-orthographic", "--camera-position", "1,0.5,9",
      "--camera-focal-point", "1,0.5,0", "--camera-parallel-scale", "0.5" });
    ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
    const auto image = ReadImage(folder / "a.png");
    EXPECT_EQ(PixelAt(image, 10, 10)[0], 1.0) << one.Points << ", " << one.Cells;
    EXPECT_EQ(PixelAt(image, 30, 10)[0], one.Right) << one.Points << ", " << one.Cells;
  }
}

}
