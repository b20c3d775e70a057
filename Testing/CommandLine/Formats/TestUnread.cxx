// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Files of which a part is not drawn: a warning says which, and the rest looks as in a file without it.
#include "Program.h"
#include "RenderedImages.h"

#include <gtest/gtest.h>

#include <string>

using namespace penumbra_testing;

namespace
{

struct Row
{
  const char* Name;
  std::string Text;
  int Status;
  const char* Message; ///< empty: none
};

const std::string ObjSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
const std::string FreeForm = "cstype bezier\ndeg 3\ncurv 0 1 1 2 3 4\nparm u 0 1\nend\n";
const std::string Normals = "vn 0 0 1\nf 1//1 2//1 3//1\nl 1 2\n";

std::string Ply(const std::string& faces, int count)
{
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
         "float z\nelement face " +
    std::to_string(count) +
    "\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n" + faces;
}

std::string Vtk(const std::string& faces, int count, int size)
{
  return "# vtk DataFile Version 3.0\nsquare\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 "
         "1 1 0 0 1 0\nPOLYGONS " +
    std::to_string(count) + " " + std::to_string(size) + "\n" + faces;
}

TEST(UnreadContent, IsNamed)
{
  const Row rows[] = {
    { "all.obj", ObjSquare, 0, "" },
    { "short.obj", ObjSquare + "f 1 2\nl 3\n", 0,
      "2 faces and lines have too few vertices and are not drawn" },
    { "curve.obj", ObjSquare + FreeForm, 0,
      "1 free-form curves and surfaces are not read; export them as polygons" },
    { "mixed.obj", ObjSquare + FreeForm + Normals, 0, "1 free-form curves and surfaces" },
    { "only.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n" + FreeForm, 2,
      "the file has only free-form curves and surfaces; export them as polygons" },
    { "all.ply", Ply("4 0 1 2 3\n", 1), 0, "" },
    { "short.ply", Ply("4 0 1 2 3\n2 0 1\n1 3\n", 3), 0,
      "2 of 3 polygons have fewer than three corners and are not drawn" },
    { "short.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n2 0 2\n", 0,
      "1 of 2 polygons have fewer than three corners" },
    { "all.vtk", Vtk("4 0 1 2 3\n", 1, 5), 0, "" },
    { "short.vtk", Vtk("4 0 1 2 3\n2 0 1\n", 2, 8), 0,
      "1 of 2 polygons have fewer than three corners" },
  };
  const Folder folder("unread");
  for (const Row& row : rows)
  {
    const std::string path = folder / row.Name;
    WriteText(path, row.Text);
    const ProgramResult outcome =
      RunProgram({ "render", path, "--output", path + ".png", "--resolution", "8,8" });
    EXPECT_EQ(outcome.Status, row.Status) << row.Name;
    EXPECT_EQ(CountLines(outcome.Errors), *row.Message ? 1 : 0) << row.Name << outcome.Errors;
    EXPECT_NE(outcome.Errors.find(row.Message), std::string::npos) << row.Message << " in\n"
                                                                   << outcome.Errors;
    if (outcome.Status == 0 && row.Name != std::string("mixed.obj"))
    {
      EXPECT_EQ(Compare(path + ".png", folder / "all.obj.png"), 0.0) << row.Name;
    }
  }
}

}
