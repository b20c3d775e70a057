// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// penumbra bake through the real program.
#include "Program.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPLYReader.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataReader.h"
#include "vtkPolyDataWriter.h"
#include "vtkSphereSource.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVersionMacros.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

using namespace penumbra_testing;

namespace
{

const std::string Head = SourceFolder() + "/Data/head.ply";

void WriteSphere(const std::string& path, int resolution = 8)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(resolution);
  sphere->SetPhiResolution(resolution);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(sphere->GetOutputPort());
  writer->SetFileName(path.c_str());
  writer->Write();
}

/// A Radiance image of 16 x 8 pixels without run-length encoding: radiance 1 in the upper half, 0 below.
void WriteSky(const std::string& path)
{
  std::ofstream file(path, std::ios::binary);
  file << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n";
  const char one[4] = { char(128), char(128), char(128), char(129) }; // 128 * 2^(129 - 136)
  const char none[4] = { 0, 0, 0, 0 };
  for (int texel = 0; texel < 128; ++texel)
  {
    file.write(texel < 64 ? one : none, 4);
  }
}

/// Reads the values of a file with `Reader`.
template <typename Reader>
vtkSmartPointer<vtkDataArray> ValuesIn(
  const std::string& path, const char* name = "AmbientOcclusion")
{
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput()->GetPointData()->GetArray(name);
}

}

TEST(Bake, WritesSameValuesToEveryFormat)
{
  const Folder folder("bake");
  WriteSphere(folder / "sphere.vtp");
  for (const char* name : { "baked.vtp", "baked.vtu", "baked.vtk", "baked.ply" })
  {
    const ProgramResult outcome =
      RunProgram({ "bake", folder / "sphere.vtp", "--output", folder / name });
    ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
    EXPECT_EQ(outcome.Errors, "");
  }
  const auto poly = ValuesIn<vtkXMLPolyDataReader>(folder / "baked.vtp");
  const auto grid = ValuesIn<vtkXMLUnstructuredGridReader>(folder / "baked.vtu");
  const auto legacy = ValuesIn<vtkPolyDataReader>(folder / "baked.vtk");
  ASSERT_TRUE(poly && grid && legacy);
  ASSERT_EQ(poly->GetNumberOfTuples(), 50);
  for (vtkIdType i = 0; i < 50; ++i)
  {
    EXPECT_EQ(poly->GetComponent(i, 0), 0.0); // a convex body is not occluded
    EXPECT_EQ(grid->GetComponent(i, 0), poly->GetComponent(i, 0));
    EXPECT_EQ(legacy->GetComponent(i, 0), poly->GetComponent(i, 0));
  }
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName((folder / "baked.ply").c_str());
  reader->Update();
  vtkDataArray* colors = reader->GetOutput()->GetPointData()->GetScalars();
  ASSERT_TRUE(colors);
  EXPECT_EQ(colors->GetComponent(7, 0), 255.0);
}

TEST(Bake, KeepsUnusualNamesOfArrays)
{
  const Folder folder("bake-names");
  const std::vector<std::string> names = { "a<b> & \"c\" 'd'", "\xcf\x83_xx [MPa]", "line\nbreak",
    "\xe6\xb8\xa9\xe5\xba\xa6", "%s 100%" };
  vtkNew<vtkSphereSource> sphere;
  sphere->Update();
  vtkPolyData* const mesh = sphere->GetOutput();
  const auto add = [mesh](const std::string& name) {
    vtkNew<vtkFloatArray> array;
    array->SetName(name.c_str());
    array->SetNumberOfTuples(mesh->GetNumberOfPoints());
    array->Fill(1.0);
    mesh->GetPointData()->AddArray(array);
  };
  const auto bake = [&folder, mesh](const std::string& name) {
    vtkNew<vtkPolyDataWriter> writer;
    writer->SetInputData(mesh);
    writer->SetFileName((folder / "input.vtk").c_str());
    writer->Write();
    return RunProgram({ "bake", folder / "input.vtk", "--output", folder / name });
  };
  std::for_each(names.begin(), names.end(), add);
  for (const char* output : { "baked.vtp", "baked.vtu", "baked.vtk" })
  {
    const ProgramResult outcome = bake(output);
    ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
    EXPECT_EQ(outcome.Errors, "") << output;
  }
  for (const std::string& name : names)
  {
    EXPECT_TRUE(ValuesIn<vtkXMLPolyDataReader>(folder / "baked.vtp", name.c_str())) << name;
    EXPECT_TRUE(ValuesIn<vtkXMLUnstructuredGridReader>(folder / "baked.vtu", name.c_str())) << name;
    EXPECT_TRUE(ValuesIn<vtkPolyDataReader>(folder / "baked.vtk", name.c_str())) << name;
  }
}

TEST(Bake, ReplacesNamesThatTheFormatDoesNotAllow)
{
  const Folder folder("bake-replaced-names");
  const std::string mesh = "# vtk DataFile Version 4.2\nx\nASCII\nDATASET POLYDATA\n"
                           "POINTS 3 float\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\n"
                           "POINT_DATA 3\nFIELD FieldData 2\n{x} 1 3 float\n1 1 1\n"
                           "a%01 1 3 float\n1 1 1\n";
  WriteText(folder / "input.vtk", mesh);
  const auto bake = [&folder](const std::string& name) {
    const ProgramResult outcome =
      RunProgram({ "bake", folder / "input.vtk", "--output", folder / name });
    EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
    EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
    EXPECT_NE(outcome.Errors.find("is written as"), std::string::npos) << outcome.Errors;
  };
  bake("baked.vtk");
  EXPECT_TRUE(ValuesIn<vtkPolyDataReader>(folder / "baked.vtk", "(x)"));
  bake("baked.vtp");
  EXPECT_TRUE(ValuesIn<vtkXMLPolyDataReader>(folder / "baked.vtp", "a?"));
  EXPECT_TRUE(ValuesIn<vtkXMLPolyDataReader>(folder / "baked.vtp", "{x}"));
}

TEST(Bake, WritesStatistics)
{
  const Folder folder("bake-report");
  const ProgramResult outcome = RunProgram({ "bake", Head, "--output", folder / "head.vtp",
    "--tolerance", ".05", "--statistics", folder / "report.json" });
  ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  const Json report = ReadJson(folder / "report.json");
  const Json& s = report["statistics"];
  EXPECT_EQ(report["tolerance"], .05);
  EXPECT_GT(report["estimated_error"], 0.0);
  EXPECT_LE(report["estimated_error"], .05);
  EXPECT_GT(s["Points/Total"], 1000);
  EXPECT_EQ(s["Rays/Total"], s["Rays/Gather"] + s["Rays/Occlusion"]);
  EXPECT_LT(s["Rays/Total"], 700.0 * s["Points/Total"]);
}

TEST(Bake, RequiresPolygonsOrPointRadius)
{
  const Folder folder("bake-points");
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(5, 5);
  plane->Update();
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(plane->GetOutput()->GetPoints());
  cloud->GetPointData()->SetNormals(plane->GetOutput()->GetPointData()->GetNormals());
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    vertices->InsertNextCell(1, &i);
  }
  cloud->SetVerts(vertices);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(cloud);
  writer->SetFileName((folder / "cloud.vtp").c_str());
  writer->Write();
  const ProgramResult without =
    RunProgram({ "bake", folder / "cloud.vtp", "--output", folder / "baked.vtp" });
  EXPECT_EQ(without.Status, 2);
  EXPECT_NE(without.Errors.find("--point-radius"), std::string::npos) << without.Errors;
  const ProgramResult with = RunProgram(
    { "bake", folder / "cloud.vtp", "--output", folder / "baked.vtp", "--point-radius", ".1" });
  EXPECT_EQ(with.Status, 0) << with.Errors;
  EXPECT_TRUE(ValuesIn<vtkXMLPolyDataReader>(folder / "baked.vtp"));
}

TEST(Bake, WritesStripsToPlyAndReportsLines)
{
  const Folder folder("strips");
  WriteText(folder / "a.vtk",
    "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 6 float\n"
    "0 0 0 0 1 0 1 0 0 1 1 0 2 0 0 2 1 0\nLINES 1 3\n2 0 5\n"
    "POLYGONS 1 4\n3 2 4 3\nTRIANGLE_STRIPS 1 5\n4 0 1 2 3\n");
  const ProgramResult outcome =
    RunProgram({ "bake", folder / "a.vtk", "--output", folder / "a.ply" });
  EXPECT_EQ(outcome.Status, 0);
  EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
  EXPECT_NE(outcome.Errors.find("no lines: 1 were left out"), std::string::npos) << outcome.Errors;
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName((folder / "a.ply").c_str());
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 6);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPolys(), 3);
}

TEST(Bake, WritesColorsOfRequestedQuantity)
{
  const Folder folder("bakeother");
  vtkNew<vtkSphereSource> sphere;
  sphere->Update();
  vtkNew<vtkFloatArray> dark;
  dark->SetName("Irradiance");
  dark->SetNumberOfComponents(3);
  dark->SetNumberOfTuples(sphere->GetOutput()->GetNumberOfPoints());
  dark->Fill(0.0);
  sphere->GetOutput()->GetPointData()->AddArray(dark);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(sphere->GetOutput());
  writer->SetFileName((folder / "sphere.vtp").c_str());
  writer->Write();
  const ProgramResult outcome =
    RunProgram({ "bake", folder / "sphere.vtp", "--output", folder / "baked.ply" });
  ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName((folder / "baked.ply").c_str());
  reader->Update();
  vtkDataArray* colors = reader->GetOutput()->GetPointData()->GetScalars();
  ASSERT_TRUE(colors);
  EXPECT_EQ(colors->GetComponent(7, 0), 255.0); // a convex body is not occluded
}

TEST(Bake, ComputesIrradianceOfConvexBody)
{
  const Folder folder("bakelight");
  WriteSphere(folder / "sphere.vtp");
  for (const char* name : { "baked.vtp", "baked.ply" })
  {
    const ProgramResult outcome =
      RunProgram({ "bake", folder / "sphere.vtp", "--output", folder / name, "--quantity",
        "irradiance", "--environment-color", "1,0.5,0", "--albedo", "0.8" });
    ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
    EXPECT_EQ(outcome.Errors, "");
  }
  const auto light = ValuesIn<vtkXMLPolyDataReader>(folder / "baked.vtp", "Irradiance");
  ASSERT_TRUE(light);
  ASSERT_EQ(light->GetNumberOfComponents(), 3);
  for (vtkIdType i = 0; i < light->GetNumberOfTuples(); ++i)
  {
    EXPECT_NEAR(light->GetComponent(i, 0), 3.14159265, 1e-5);
    EXPECT_NEAR(light->GetComponent(i, 1), 3.14159265 / 2.0, 1e-5);
    EXPECT_EQ(light->GetComponent(i, 2), 0.0);
  }
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName((folder / "baked.ply").c_str());
  reader->Update();
  vtkDataArray* colors = reader->GetOutput()->GetPointData()->GetScalars();
  ASSERT_TRUE(colors);
  EXPECT_EQ(colors->GetComponent(7, 0), 255.0);
  EXPECT_EQ(colors->GetComponent(7, 1), 128.0);
}

TEST(Bake, AppliesNamedFalloff)
{
  const Folder folder("bake-falloff");
  double last = 1.0;
  for (const char* falloff : { "none", "linear", "square-root" }) // decreasing occlusion
  {
    const ProgramResult outcome = RunProgram({ "bake", Head, "--output", folder / "baked.vtp",
      "--falloff", falloff, "--tolerance", "0.2" });
    ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
    const auto values = ValuesIn<vtkXMLPolyDataReader>(folder / "baked.vtp");
    double mean = 0.0;
    for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
    {
      mean += values->GetComponent(i, 0) / static_cast<double>(values->GetNumberOfTuples());
    }
    EXPECT_LT(mean, .95 * last) << falloff;
    EXPECT_GT(mean, .005) << falloff;
    last = mean;
  }
}

TEST(Bake, ComputesIrradianceOfEnvironmentImage)
{
  const Folder folder("bake-sky");
  WriteSphere(folder / "sphere.vtp");
  WriteSky(folder / "sky.hdr");
  const ProgramResult outcome =
    RunProgram({ "bake", folder / "sphere.vtp", "--output", folder / "baked.vtp", "--quantity",
      "irradiance", "--hdri-file", folder / "sky.hdr", "--hdri-up", "+Z", "--bounces", "1" });
  ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_EQ(outcome.Errors, "");
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder / "baked.vtp").c_str());
  reader->Update();
  vtkPointData* arrays = reader->GetOutput()->GetPointData();
  for (vtkIdType i = 0; i < reader->GetOutput()->GetNumberOfPoints(); ++i)
  {
    // Irradiance of a uniform hemisphere: pi (1 + n_z) / 2.
    const double up = arrays->GetNormals()->GetComponent(i, 2);
    EXPECT_NEAR(arrays->GetArray("Irradiance")->GetComponent(i, 1), 1.5707963 * (1.0 + up), .03);
  }
}

TEST(Bake, RejectsInvalidEnvironmentImages)
{
  const Folder folder("bake-no-sky");
  WriteSphere(folder / "sphere.vtp");
  WriteSky(folder / "whole.hdr");
  std::ifstream whole(folder / "whole.hdr", std::ios::binary);
  const std::string bytes{ std::istreambuf_iterator<char>(whole), {} };
  std::ofstream(folder / "cut.hdr", std::ios::binary) << bytes.substr(0, bytes.size() - 20);
  std::ofstream(folder / "text.hdr") << "no image";
  std::ofstream(folder / "empty.hdr") << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 0 +X 4\n";
  for (const char* name : { "none.hdr", "cut.hdr", "text.hdr", "empty.hdr", "sphere.vtp" })
  {
    const ProgramResult outcome = RunProgram({ "bake", folder / "sphere.vtp", "--output",
      folder / "baked.vtp", "--quantity", "irradiance", "--hdri-file", folder / name });
    EXPECT_EQ(outcome.Status, 2) << name << outcome.Errors;
    EXPECT_NE(outcome.Errors.find(name), std::string::npos) << outcome.Errors;
    EXPECT_FALSE(std::ifstream(folder / "baked.vtp")) << name;
  }
}

TEST(Bake, GathersWithCubeMaps)
{
  const Folder folder("bake-cube-map");
  WriteSphere(folder / "sphere.vtp", 24); // enough points for records
  const ProgramResult outcome = RunProgram({ "bake", folder / "sphere.vtp", "--output",
    folder / "baked.vtp", "--gatherer", "cube-map", "--statistics", folder / "s.json" });
  if (outcome.Status == 3)
  {
    GTEST_SKIP() << outcome.Errors;
  }
  ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_GT(ReadJson(folder / "s.json")["statistics"]["CubeMaps/Total"], 0);
  EXPECT_EQ(ValuesIn<vtkXMLPolyDataReader>(folder / "baked.vtp")->GetComponent(7, 0), 0.0);
}

TEST(Bake, ComputesDirectLightOfSeveralSuns)
{
  const Folder folder("direct-light");
  WriteSphere(folder / "sphere.vtp");
  for (const char* name : { "baked.vtp", "baked.ply" })
  {
    const ProgramResult outcome = RunProgram({ "bake", folder / "sphere.vtp", "--output",
      folder / name, "--quantity", "direct-light", "--light-position", "0,0,2,0",
      "--light-position", "1,0,0,0", "--light-angle", "0.53", "--statistics", folder / "s.json" });
    ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
    EXPECT_EQ(outcome.Errors, "");
  }
  const auto values = ValuesIn<vtkXMLPolyDataReader>(folder / "baked.vtp", "DirectLight");
  ASSERT_TRUE(values);
  ASSERT_EQ(values->GetNumberOfComponents(), 1);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder / "baked.vtp").c_str());
  reader->Update();
  vtkDataArray* normals = reader->GetOutput()->GetPointData()->GetNormals();
  vtkNew<vtkPLYReader> colored;
  colored->SetFileName((folder / "baked.ply").c_str());
  colored->Update();
  vtkDataArray* colors = colored->GetOutput()->GetPointData()->GetScalars();
  ASSERT_TRUE(normals && colors);
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    // The polygons shade points next to the horizon of a light.
    const double x = normals->GetComponent(i, 0);
    const double z = normals->GetComponent(i, 2);
    if (std::abs(x) > 0.4 && std::abs(z) > 0.4)
    {
      EXPECT_NEAR(values->GetComponent(i, 0), std::max(x, 0.0) + std::max(z, 0.0), 1e-5);
    }
    EXPECT_NEAR(colors->GetComponent(i, 1),
      std::round(255.0 * std::min(values->GetComponent(i, 0), 1.0)), 1.0);
  }
  EXPECT_NE(ReadText(folder / "s.json").find("Rays/Shadow"), std::string::npos);
}

TEST(Bake, ChecksLightsOfDirectLight)
{
  const Folder folder("direct-light-errors");
  WriteSphere(folder / "sphere.vtp");
  const auto run = [&folder](std::vector<std::string> options) {
    std::vector<std::string> arguments = { "bake", folder / "sphere.vtp", "--output",
      folder / "baked.vtp" };
    arguments.insert(arguments.end(), options.begin(), options.end());
    return RunProgram(arguments);
  };
  const std::string direct = "direct-light";
  const struct
  {
    std::vector<std::string> Options;
    int Status;
    std::string Message;
  } rows[] = {
    { { "--quantity", direct }, 2, "give --light-position" },
    { { "--quantity", direct, "--light-position", "0,0,0,0" }, 2, "nonzero direction" },
    { { "--quantity", direct, "--light-position", "0,0,1,-1" }, 2, "w must be positive" },
    { { "--quantity", direct, "--light-position", "0,nan,1" }, 2, "--light-position" },
    { { "--quantity", direct, "--light-position", "0,0,9", "--light-radius=-1" }, 2,
      "--light-radius" },
    { { "--quantity", direct, "--light-position", "0,0,9", "--light-radius=nan" }, 2,
      "--light-radius" },
    { { "--quantity", direct, "--light-position", "0,0,9,0", "--light-angle=181" }, 2,
      "--light-angle" },
    { { "--quantity", "direct" }, 2, "--quantity" },
    { { "--light-position", "0,0,9" }, 0, "no effect without --quantity direct-light" },
    { { "--quantity", direct, "--light-position", "0,0,9", "--light-angle", "1" }, 0,
      "--light-angle has no effect without a directional" },
    { { "--quantity", direct, "--light-position", "0,0,9,0", "--light-radius", "1" }, 0,
      "--light-radius has no effect without a positional" },
    { { "--quantity", direct, "--light-position", "0,0,1", "--light-radius", "0.9" }, 0,
      "contains or touches a surface" },
  };
  for (const auto& row : rows)
  {
    const ProgramResult outcome = run(row.Options);
    EXPECT_EQ(outcome.Status, row.Status) << row.Message;
    EXPECT_NE(outcome.Errors.find(row.Message), std::string::npos) << outcome.Errors;
  }
}

TEST(Bake, WarnsOnceOfEachOptionThatTheQuantityDoesNotUse)
{
  const Folder folder("bake-ignored");
  WriteSphere(folder / "sphere.vtp");
  const std::vector<std::string> direct = { "--quantity", "direct-light", "--light-position",
    "0,0,9" };
  const std::vector<std::string> irradiance = { "--quantity", "irradiance", "--tolerance", "0.1" };
  const std::string withoutOcclusion = " has no effect without --quantity ambient-occlusion";
  const std::string withoutIrradiance = " has no effect without --quantity irradiance";
  const std::string withoutDirect = " has no effect without --quantity direct-light";
  const struct
  {
    std::vector<std::string> Quantity;
    std::vector<std::string> Options;
    std::string Warning; ///< empty: none
  } rows[] = {
    { {}, { "--environment-color", "1,1,1" }, "--environment-color" + withoutIrradiance },
    { {}, { "--hdri-file", "none.hdr" }, "--hdri-file" + withoutIrradiance }, // is not read
    { {}, { "--hdri-up", "0,0,1" }, "--hdri-up" + withoutIrradiance },
    { {}, { "--albedo", "0.5" }, "--albedo" + withoutIrradiance }, // the default, but given
    { {}, { "--bounces", "2" }, "--bounces" + withoutIrradiance },
    { {}, { "--light-position", "0,0,9" }, "--light-position" + withoutDirect },
    { {}, { "--light-radius", "0" }, "--light-radius" + withoutDirect },
    { {}, { "--light-angle", "1" }, "--light-angle" + withoutDirect },
    { {}, { "--radius", "inf", "--falloff", "linear" },
      "--falloff has no effect with --radius inf" },
    { {}, { "--radius", "1", "--falloff", "linear" }, "" },
    { irradiance, { "--radius", "1" }, "--radius" + withoutOcclusion },
    { irradiance, { "--falloff", "linear" }, "--falloff" + withoutOcclusion },
    { irradiance, { "--light-angle", "1" }, "--light-angle" + withoutDirect },
    { irradiance, { "--hdri-up", "0,0,1" }, "--hdri-up has no effect without --hdri-file" },
    { irradiance, { "--albedo", "0.9", "--bounces", "1" },
      "--albedo has no effect with --bounces 1" },
    { irradiance, { "--albedo", "0.9", "--bounces", "2", "--environment-color", "1,0,0" }, "" },
    { direct, { "--radius", "1" }, "--radius" + withoutOcclusion },
    { direct, { "--falloff", "linear" }, "--falloff" + withoutOcclusion },
    { direct, { "--albedo", "0.9" }, "--albedo" + withoutIrradiance },
    { direct, { "--gatherer", "cube-map" },
      "--gatherer has no effect with --quantity direct-light" },
    { direct, { "--light-radius", "0.5", "--normals", "computed" }, "" },
  };
  for (const auto& row : rows)
  {
    std::vector<std::string> arguments = { "bake", folder / "sphere.vtp", "--output",
      folder / "baked.vtp" };
    arguments.insert(arguments.end(), row.Quantity.begin(), row.Quantity.end());
    arguments.insert(arguments.end(), row.Options.begin(), row.Options.end());
    const ProgramResult outcome = RunProgram(arguments);
    EXPECT_EQ(outcome.Status, 0) << row.Warning << outcome.Errors;
    EXPECT_EQ(CountLines(outcome.Errors), row.Warning.empty() ? 0 : 1) << outcome.Errors;
    EXPECT_NE(outcome.Errors.find(row.Warning), std::string::npos) << row.Warning << outcome.Errors;
  }
}

TEST(Bake, RejectsInvalidOpacityArrays)
{
  const Folder folder("bake-opacity");
  const std::string triangle = "# vtk DataFile Version 3.0\ntriangle\nASCII\nDATASET POLYDATA\n"
                               "POINTS 3 float\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\n";
  const std::string points = "POINT_DATA 3\nFIELD arrays 1\n";
  const std::string invalid = "--opacity-array: alpha must be a point array";
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 0)
  const std::string notFinite = "damaged"; // the reader of this VTK rejects such numbers
#else
  const std::string& notFinite = invalid;
#endif
  const struct
  {
    std::string Arrays;
    int Status;
    std::string Message;
  } rows[] = {
    { "", 2, invalid }, // no such array
    { "CELL_DATA 1\nFIELD arrays 1\nalpha 1 1 float\n0.5\n", 2, invalid },
    { points + "alpha 1 2 float\n0.5 0.5\n", 2, "the array 'alpha' is too short" },
    { points + "alpha 1 4 float\n0.5 0.5 0.5 0.5\n", 2, invalid }, // too long
    { points + "alpha 2 3 float\n0 0 0 0 0 0\n", 2, invalid },     // two components
    { points + "alpha 1 3 string\na\nb\nc\n", 2, invalid },
    { points + "alpha 1 3 float\n0.5 nan 0.5\n", 2, notFinite },
    { points + "alpha 1 3 float\n0.5 inf 0.5\n", 2, notFinite },
    { points + "alpha 1 3 float\n0.5 -0.01 0.5\n", 2, invalid },
    { points + "alpha 1 3 float\n0.5 1.01 0.5\n", 2, invalid },
    { points + "alpha 1 3 float\n0 0.5 1\n", 0, "" },
    { points + "alpha 1 3 unsigned_char\n0 1 1\n", 0, "" },
  };
  for (const char* quantity : { "ambient-occlusion", "direct-light" })
  {
    for (const auto& row : rows)
    {
      if (std::string(quantity) == "direct-light" && row.Status != 0 && !row.Arrays.empty())
      {
        continue; // The array is checked in one place for all quantities.
      }
      WriteText(folder / "mesh.vtk", triangle + row.Arrays);
      std::vector<std::string> arguments = { "bake", folder / "mesh.vtk", "--output",
        folder / "baked.vtp", "--quantity", quantity, "--opacity-array", "alpha" };
      if (std::string(quantity) == "direct-light")
      {
        arguments.insert(arguments.end(), { "--light-position", "0,0,9" });
      }
      const ProgramResult outcome = RunProgram(arguments);
      EXPECT_EQ(outcome.Status, row.Status) << row.Arrays << outcome.Errors;
      EXPECT_EQ(CountLines(outcome.Errors), row.Status == 0 ? 0 : 1) << outcome.Errors;
      if (row.Status != 0)
      {
        EXPECT_NE(outcome.Errors.find(row.Message), std::string::npos) << outcome.Errors;
        EXPECT_NE(outcome.Errors.find("mesh.vtk"), std::string::npos) << outcome.Errors;
        EXPECT_FALSE(std::ifstream(folder / "baked.vtp")) << row.Arrays;
      }
      std::remove((folder / "baked.vtp").c_str());
    }
  }
}
