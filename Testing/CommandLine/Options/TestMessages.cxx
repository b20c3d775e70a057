// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Warnings and errors name options of the program, not classes and their properties.
#include "Engines/ObjectNames.h"
#include "Input/Surfaces.h"
#include "Meshes.h"
#include "Processes/MessageLog.h"
#include "Program.h"
#include "Scene/SceneBuilder.h"

#include "vtkActor.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderer.h"
#include "vtkStringArray.h"

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(Messages, ReachedTimeLimitsNameTheirOption)
{
  const Folder folder("time-limit");
  WriteSphereWithArrays(folder / "sphere.vtp");
  const std::vector<std::string> render = { "render", folder / "sphere.vtp", "--output",
    folder / "a.png", "--resolution", "80,60", "--time-limit" };
  const auto run = [&](const std::string& seconds) {
    std::vector<std::string> arguments = render;
    arguments.push_back(seconds);
    return RunProgram(arguments);
  };
  const ProgramResult ended = run("1e-9");
  EXPECT_EQ(ended.Status, 0);
  ExpectOptions(ended, "Increase --time-limit");
  EXPECT_EQ(std::count(ended.Errors.begin(), ended.Errors.end(), '\n'), 1) << ended.Errors;
  EXPECT_EQ(run("inf").Errors, "");
  for (const char* seconds : { "-1", "nan" })
  {
    const ProgramResult refused = run(seconds);
    EXPECT_EQ(refused.Status, 2);
    ExpectOptions(refused, "--time-limit");
    EXPECT_EQ(std::count(refused.Errors.begin(), refused.Errors.end(), '\n'), 1) << refused.Errors;
  }
}

TEST(Messages, IndirectLightOnLinesNamesOptions)
{
  const Folder folder("lines");
  WriteText(folder / "lines.obj", "v 0 0 0\nv 1 1 0\nv 1 0 0\nl 1 2 3\n");
  const ProgramResult outcome = RunProgram({ "render", folder / "lines.obj", "--output",
    folder / "a.png", "--resolution", "16,16", "--indirect", "--environment-color", "1,1,1" });
  EXPECT_EQ(outcome.Status, 0);
  EXPECT_EQ(std::count(outcome.Errors.begin(), outcome.Errors.end(), '\n'), 1) << outcome.Errors;
  ExpectOptions(outcome, "--line-radius");
}

TEST(Messages, MarksOfGhostsAreNoColors)
{
  const Folder folder("ghosts");
  const std::string head = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\n"
                           "POINTS 3 float\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\n"
                           "POINT_DATA 3\nFIELD f ";
  const std::string ghosts = "vtkGhostType 1 3 unsigned_char\n0 0 0\n";
  WriteText(folder / "ghosts.vtk", head + "1\n" + ghosts);
  WriteText(folder / "both.vtk", head + "2\n" + ghosts + "z 1 3 float\n0 1 2\n");
  const auto run = [&](const std::string& name, const std::vector<std::string>& options) {
    std::vector<std::string> arguments = { "render", folder / name, "--output", folder / "a.png",
      "--resolution", "16,16" };
    arguments.insert(arguments.end(), options.begin(), options.end());
    return RunProgram(arguments);
  };
  const ProgramResult refused = run("ghosts.vtk", { "-s" });
  EXPECT_EQ(refused.Status, 2);
  EXPECT_NE(refused.Errors.find("no point array"), std::string::npos) << refused.Errors;
  EXPECT_EQ(run("ghosts.vtk", { "--contour", "0.5" }).Status, 2);
  EXPECT_EQ(run("ghosts.vtk", { "--coloring-array", "vtkGhostType" }).Status, 0);
  // The only contour of z is a line.
  EXPECT_EQ(run("both.vtk", { "--contour", "0.5", "-s" }).Errors, "");
}

TEST(Messages, BakedFilesThatLoseDataAreReported)
{
  const Folder folder("lost");
  const std::string triangle = "0 0 1e7 1 0 1e7 0 1 1e7\nPOLYGONS 1 4\n3 0 1 2\n";
  const std::string head = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 3 ";
  WriteText(folder / "far.vtk", head + "double\n" + triangle);
  const auto bake = [&](const std::string& from, const std::string& to) {
    return RunProgram({ "bake", folder / from, "--output", folder / to });
  };
  ExpectOptions(bake("far.vtk", "far.ply"), "multiples of 1;");
  EXPECT_EQ(bake("far.vtk", "far.vtp").Errors, "");
  // Two blocks, of which one has the array.
  EXPECT_EQ(bake("far.vtk", "0.vtp").Status, 0);
  WriteText(folder / "plain.stl", SquareStl());
  EXPECT_EQ(RunProgram({ "bake", folder / "plain.stl", "--quantity", "irradiance", "--output",
                         folder / "1.vtp" })
              .Status,
    0);
  WriteText(folder / "blocks.vtm",
    "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\"><vtkMultiBlockDataSet>"
    "<DataSet index=\"0\" file=\"0.vtp\"/><DataSet index=\"1\" file=\"1.vtp\"/>"
    "</vtkMultiBlockDataSet></VTKFile>");
  const ProgramResult outcome = bake("blocks.vtm", "both.vtp");
  EXPECT_EQ(outcome.Status, 0);
  EXPECT_NE(outcome.Errors.find("AmbientOcclusion, Irradiance"), std::string::npos)
    << outcome.Errors;
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

TEST(Messages, ObjectsAreNamedByTheirFile)
{
  vtkNew<vtkRenderer> renderer;
  for (const char* name : { "a.glb (part 1 of 2)", "a.glb (part 2 of 2)", "b.vtp" })
  {
    vtkNew<vtkStringArray> source;
    source->SetName(penumbra::SourceName);
    source->InsertNextValue(name);
    vtkNew<vtkPolyData> mesh;
    mesh->GetFieldData()->AddArray(source);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(mesh);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    renderer->AddActor(actor);
  }
  EXPECT_EQ(penumbra::NameObjects("Object 2: 3 cells were skipped.", renderer),
    "b.vtp: 3 cells were skipped.");
  EXPECT_EQ(
    penumbra::NameObjects("Object 1, Object 2 and 4 more: Object 0 is not named.", renderer),
    "a.glb (part 2 of 2), b.vtp and 4 more: Object 0 is not named.");
  EXPECT_EQ(penumbra::NameObjects("Object 0 (vtkMapper): x", renderer),
    "a.glb (part 1 of 2) (vtkMapper): x");
  EXPECT_EQ(penumbra::NameObjects("Object 7: x", renderer), "Object 7: x");
  EXPECT_EQ(penumbra::NameObjects("All: Object 0", renderer), "All: Object 0");
}

TEST(Messages, SurfacesAreNamedByTheirFileAndPart)
{
  const Folder folder("names");
  for (const std::string& file : WriteSpheres(folder.Path))
  {
    const bool isMultiBlock = file.find(".vtm") != file.npos;
    if (isMultiBlock || file.find(".vtp") != file.npos)
    {
      const penumbra::Surfaces surfaces = penumbra::ReadSurfaces(folder / file);
      ASSERT_EQ(surfaces.Names.size(), surfaces.Meshes.size());
      const std::string count = std::to_string(surfaces.Meshes.size());
      EXPECT_EQ(surfaces.Names.back(),
        folder / file +
          (surfaces.Meshes.size() > 1 ? " (part " + count + " of " + count + ")" : ""));
    }
  }
}

TEST(Messages, ErrorsOfVTKContainNoPointers)
{
  const std::string head = "ERROR: In a.cxx, line 1\nvtkCompositeDataPipeline (0x61c000001080): ";
  EXPECT_EQ(
    penumbra::StripMessagePrefix(head +
      "Input port 0 of algorithm vtkOpenGLPolyDataMapper (0x61c000001080) has 0 connections "
      "but is not optional.\n\n"),
    "an object has no geometry");
  EXPECT_EQ(penumbra::StripMessagePrefix(head +
              "Algorithm vtkGLTFReader (0x55d0c0ffee00) returned failure for request: "
              "vtkInformation (0x55d0c0ffee10)\n  Debug: Off\n"),
    "the file could not be read completely");
  EXPECT_EQ(
    penumbra::StripMessagePrefix(head + "The array of vtkPolyData (0x55d0c0ffee20) is empty."),
    "The array of an object is empty");
  EXPECT_EQ(penumbra::StripMessagePrefix(head + "The magic number is 0x1f8b"),
    "The magic number is 0x1f8b");
}

}
