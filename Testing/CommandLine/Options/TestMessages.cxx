// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Warnings and errors name options of the program, not classes and their properties.
#include "Meshes.h"
#include "Program.h"

#include <gtest/gtest.h>

#include <regex>

using namespace penumbra_testing;

namespace
{

void ExpectOptions(const ProgramResult& outcome, const std::string& option)
{
  EXPECT_NE(outcome.Errors.find(option), std::string::npos) << outcome.Errors;
  // Words such as vtkProperty, EnvironmentColor and AddLight().
  const std::regex names("vtk[A-Z]|\\b[A-Z][a-z]+[A-Z][a-z]+|\\bTolerance\\b|\\w\\(\\)");
  EXPECT_FALSE(std::regex_search(outcome.Errors, names)) << outcome.Errors;
}

TEST(Messages, MissedTolerancesNameOptions)
{
  const Folder folder("tolerance");
  WriteSphereWithArrays(folder / "sphere.vtp");
  const std::vector<std::string> render = { "render", folder / "sphere.vtp", "--output",
    folder / "a.png", "--resolution", "80,60", "--tolerance", "1e-5" };
  std::vector<std::string> coarse = render;
  coarse.insert(coarse.end(), { "--max-level", "0", "--representation", "wireframe" });
  ExpectOptions(RunProgram(coarse), "--tolerance");
  std::vector<std::string> light = render;
  light.insert(light.end(),
    { "--light-position", "2,2,2", "--light-radius", "1", "--light-tolerance", "1e-4",
      "--max-level", "0" });
  ExpectOptions(RunProgram(light), "Increase --");
}

TEST(Messages, BakingWithoutLightNamesOptions)
{
  const Folder folder("black");
  WriteText(folder / "square.stl", SquareStl());
  ExpectOptions(RunProgram({ "bake", folder / "square.stl", "--output", folder / "a.ply",
                  "--quantity", "irradiance", "--environment-color", "0,0,0" }),
    "--environment-color or --hdri-file");
}

TEST(Messages, OpacityArraysNameTheirOption)
{
  const Folder folder("opacity");
  WriteSphereWithArrays(folder / "sphere.vtp");
  const ProgramResult outcome = RunProgram({ "bake", folder / "sphere.vtp", "--output",
    folder / "a.vtp", "--opacity-array", "Direction" });
  EXPECT_EQ(outcome.Status, 2);
  ExpectOptions(outcome, "--opacity-array");
}

TEST(Messages, EnvironmentImagesNameTheirOption)
{
  const Folder folder("environment");
  WriteSphereWithArrays(folder / "sphere.vtp");
  WriteText(folder / "volume.vti",
    "<VTKFile type=\"ImageData\" version=\"0.1\"><ImageData WholeExtent=\"0 1 0 1 0 1\" "
    "Origin=\"0 0 0\" Spacing=\"1 1 1\"><Piece Extent=\"0 1 0 1 0 1\"><PointData Scalars=\"a\">"
    "<DataArray type=\"Float32\" Name=\"a\" format=\"ascii\">1 1 1 1 1 1 1 1</DataArray>"
    "</PointData></Piece></ImageData></VTKFile>");
  const ProgramResult outcome = RunProgram({ "render", folder / "sphere.vtp", "--output",
    folder / "a.png", "--indirect", "--hdri-file", folder / "volume.vti" });
  EXPECT_EQ(outcome.Status, 2);
  ExpectOptions(outcome, "--hdri-file");
}

}
