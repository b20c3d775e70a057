// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// `penumbra render` on small meshes through the real program.
#include "Meshes.h"
#include "Program.h"
#include "RenderedImages.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

using namespace penumbra_testing;

namespace
{

// Runs render square.stl --output FOLDER/name OPTIONS... and returns the image.
vtkSmartPointer<vtkImageData> RenderSquare(
  const Folder& folder, const std::string& name, const std::vector<std::string>& options)
{
  WriteText(folder / "square.stl", SquareStl());
  std::vector<std::string> arguments = { "render", folder / "square.stl", "--output", folder / name,
    "--resolution", "40,30" };
  arguments.insert(arguments.end(), options.begin(), options.end());
  const ProgramResult outcome = RunProgram(arguments);
  EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_EQ(outcome.Errors, "");
  return ReadImage(folder / name);
}

TEST(Render, RendersEveryFormatToSameImage)
{
  const Folder folder("formats");
  const std::string readers = RunProgram({ "list" }).Output;
  // One run for all: the file of each format is linked to a name of its own.
  std::vector<std::string> arguments = { "render", "--resolution", "60,40", "--output",
    folder / "{name}.png" };
  std::vector<std::string> names;
  for (const std::string& file : WriteSpheres(folder.Path))
  {
    const std::string extension = file.substr(file.rfind('.'));
    const std::string name = file.substr(0, file.rfind('.')) + "-" + extension.substr(1);
    if (readers.find(extension) != std::string::npos) // else this VTK has no reader for it
    {
      std::filesystem::create_symlink(file, folder / name + extension);
      arguments.push_back(folder / name + extension);
      names.push_back(name);
    }
  }
  const ProgramResult outcome = RunProgram(arguments);
  EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_EQ(outcome.Errors, "");
  for (const std::string& name : names)
  {
    const std::string shape = name.substr(0, name.find('-'));
    const std::string reference = shape == "box" ? "box-vti.png" : shape + "-stl.png";
    EXPECT_LE(Compare(folder / name + ".png", folder / reference), 2.0 / 255.0) << name;
  }
}

TEST(Render, WritesEveryImageFormat)
{
  const Folder folder("images");
  RenderSquare(folder, "reference.vti", {});
  for (const char* extension : { "png", "jpg", "tif", "bmp" })
  {
    const std::string name = std::string("image.") + extension;
    RenderSquare(folder, name, {});
    const double tolerance = std::string(extension) == "jpg" ? 0.05 : 0.003;
    EXPECT_LE(
      Compare(folder / name, folder / "reference.vti", vtkPenumbraImageComparison::RMSE), tolerance)
      << name;
  }
}

TEST(Render, WritesDocumentedArrays)
{
  const Folder folder("arrays");
  const auto image = RenderSquare(folder, "image.vti",
    { "--camera-position", "0,0,10", "--camera-view-angle", "30", "--dpi", "150" });
  vtkPointData* arrays = image->GetPointData();
  const vtkIdType center = 15 * 40 + 20;
  const vtkIdType corner = 0;
  ASSERT_TRUE(arrays->GetArray("Color"));
  EXPECT_EQ(arrays->GetArray("Color")->GetNumberOfComponents(), 4);
  EXPECT_EQ(arrays->GetArray("Color")->GetDataType(), VTK_FLOAT);
  ASSERT_TRUE(arrays->GetArray("Depth"));
  EXPECT_NEAR(arrays->GetArray("Depth")->GetComponent(center, 0), 10.0, 1e-4);
  EXPECT_TRUE(std::isinf(arrays->GetArray("Depth")->GetComponent(corner, 0)));
  ASSERT_TRUE(arrays->GetArray("Normal"));
  EXPECT_NEAR(arrays->GetArray("Normal")->GetComponent(center, 2), 1.0, 1e-6);
  EXPECT_EQ(arrays->GetArray("Normal")->GetComponent(corner, 2), 0.0);
  ASSERT_TRUE(arrays->GetArray("ObjectId"));
  EXPECT_EQ(arrays->GetArray("ObjectId")->GetComponent(center, 0), 0.0);
  EXPECT_EQ(arrays->GetArray("ObjectId")->GetComponent(corner, 0), -1.0);
  ASSERT_TRUE(arrays->GetArray("CellId"));
  EXPECT_EQ(arrays->GetArray("CellId")->GetComponent(corner, 0), -1.0);
  ASSERT_TRUE(arrays->GetArray("AmbientOcclusion"));
  EXPECT_EQ(arrays->GetArray("AmbientOcclusion")->GetComponent(corner, 0), 0.0);
  EXPECT_TRUE(std::isnan(arrays->GetArray("AmbientOcclusion")->GetComponent(center, 0)));
  const auto occluded = RenderSquare(folder, "occluded.vti", { "--ambient-occlusion" });
  EXPECT_NEAR(
    occluded->GetPointData()->GetArray("AmbientOcclusion")->GetComponent(center, 0), 0.0, 0.02);
  EXPECT_EQ(image->GetFieldData()->GetArray("DotsPerInch")->GetComponent(0, 0), 150.0);
}

TEST(Render, WritesCellIdsOfFile)
{
  const Folder folder("cell-ids");
  WriteSpheres(folder.Path);
  RunProgram(
    { "render", folder / "sphere.vtp", "--resolution", "60,40", "--output", folder / "p.vti" });
  RunProgram(
    { "render", folder / "sphere.vtu", "--resolution", "60,40", "--output", folder / "u.vti" });
  const auto mesh = ReadImage(folder / "p.vti");
  const auto grid = ReadImage(folder / "u.vti");
  vtkDataArray* polygons = mesh->GetPointData()->GetArray("CellId");
  vtkDataArray* cells = grid->GetPointData()->GetArray("CellId");
  ASSERT_TRUE(polygons && cells);
  for (vtkIdType i = 0; i < cells->GetNumberOfTuples(); ++i)
  {
    EXPECT_EQ(polygons->GetComponent(i, 0), cells->GetComponent(i, 0)) << i;
  }
}

TEST(Render, WritesDotsPerInch)
{
  const Folder folder("dpi");
  const std::vector<std::string> dpi = { "--dpi", "300" };
  RenderSquare(folder, "p.png", dpi);
  RenderSquare(folder, "p.jpg", dpi);
  RenderSquare(folder, "p.bmp", dpi);
  // 300 / 0.0254 = 11811 pixels per meter = 0x2e23; the checksum of this chunk is well known.
  EXPECT_NE(ReadText(folder / "p.png")
              .find(std::string("\0\0\0\x09pHYs\0\0\x2e\x23\0\0\x2e\x23\x01"
                                "\x78\xa5\x3f\x76",
                21)),
    std::string::npos);
  EXPECT_EQ(ReadText(folder / "p.jpg").substr(13, 5), std::string("\x01\x01\x2c\x01\x2c", 5));
  EXPECT_EQ(ReadText(folder / "p.bmp").substr(38, 8), std::string("\x23\x2e\0\0\x23\x2e\0\0", 8));
}

TEST(Render, WritesStatistics)
{
  const Folder folder("statistics");
  RenderSquare(folder, "p.png",
    { "--statistics", folder / "s.json", "--threads", "1", "--tolerance", "0.002" });
  const Json report = ReadJson(folder / "s.json");
  EXPECT_GE(report["statistics"]["Rays/Primary"], 41 * 31);
  EXPECT_GE(report["statistics"]["Rays/Total"], report["statistics"]["Rays/Primary"]);
  EXPECT_NEAR(
    report["statistics"]["Rays/PerPixel"], report["statistics"]["Rays/Total"] / (40 * 30), 1e-9);
  EXPECT_EQ(report["tolerance"], 0.002);
  EXPECT_EQ(report["threads"], 1);
  EXPECT_LT(report["estimated_error"], 0.1);
  for (const char* part : { "read", "build", "render", "write" })
  {
    EXPECT_GE(report["seconds"][part], 0.0) << part;
    EXPECT_LE(report["seconds"][part], report["seconds"]["total"]) << part;
  }
  EXPECT_GT(report["peak_memory_bytes"], 1000000);
}

TEST(Render, IsIndependentOfThreadCount)
{
  const Folder folder("threads");
  WriteSpheres(folder.Path);
  for (const char* threads : { "1", "2", "5" })
  {
    RunProgram({ "render", folder / "sphere.ply", "--resolution", "90,70", "--threads", threads,
      "--ambient-occlusion", "--output", folder / threads + ".vti" });
  }
  EXPECT_EQ(Compare(folder / "1.vti", folder / "2.vti"), 0.0);
  EXPECT_EQ(Compare(folder / "1.vti", folder / "5.vti"), 0.0);
}

TEST(Render, UsesLastValueOfRepeatedOption)
{
  const Folder folder("repeated");
  const auto image = RenderSquare(folder, "p.png",
    { "--resolution", "7,5", "--resolution", "9,3", "--no-lighting", "--color", "1,0,0", "--color",
      "0,1,0", "--camera-zoom-factor", "5" });
  EXPECT_EQ(image->GetDimensions()[0], 9);
  EXPECT_EQ(image->GetDimensions()[1], 3);
  EXPECT_EQ(PixelAt(image, 4, 1), (Pixel{ 0, 1, 0 }));
}

TEST(Render, PlacesCamera)
{
  const Folder folder("camera");
  const std::vector<std::string> plain = { "--no-lighting", "--camera-position", "0,0,10",
    "--camera-focal-point", "0,0,0", "--camera-orthographic", "--camera-parallel-scale", "2" };
  // The square of side 2 in a view 4 high and 16/3 wide: half of each column, 3/8 of each row.
  const auto image = RenderSquare(folder, "p.vti", plain);
  double sum = 0.0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    sum += image->GetPointData()->GetArray("Color")->GetComponent(i, 0);
  }
  EXPECT_NEAR(sum / image->GetNumberOfPoints(), 0.5 * 3.0 / 8.0, 1e-4);

  // From the side it is a line, from behind it is completely visible.
  std::vector<std::string> turned = plain;
  turned.insert(turned.end(), { "--camera-azimuth-angle", "180" });
  RenderSquare(folder, "behind.vti", turned);
  EXPECT_LE(Compare(folder / "p.vti", folder / "behind.vti"), 1e-4);
}

TEST(Render, FitsBoundsFromAnyDirection)
{
  const Folder folder("fit");
  for (const char* direction : { "0,0,-1", "0,0,1", "-1,-1,-1", "0,-1,0.2", "0,-1,0" })
  {
    for (const char* resolution : { "60,30", "30,60" })
    {
      WriteSpheres(folder.Path);
      RunProgram({ "render", folder / "sphere.vtp", "--no-lighting", "--output", folder / "p.png",
        "--camera-direction", direction, "--resolution", resolution });
      const auto image = ReadImage(folder / "p.png");
      const int* size = image->GetDimensions();
      EXPECT_EQ(PixelAt(image, size[0] / 2, size[1] / 2), (Pixel{ 1, 1, 1 })) << direction;
      for (int x = 0; x < size[0]; ++x)
      {
        EXPECT_EQ(PixelAt(image, x, 0), (Pixel{ 0, 0, 0 })) << direction;
        EXPECT_EQ(PixelAt(image, x, size[1] - 1), (Pixel{ 0, 0, 0 })) << direction;
      }
      for (int y = 0; y < size[1]; ++y)
      {
        EXPECT_EQ(PixelAt(image, 0, y), (Pixel{ 0, 0, 0 })) << direction;
      }
    }
  }
}

TEST(Render, RendersSphereFromItsCenter)
{
  const Folder folder("inside");
  WriteSpheres(folder.Path);
  const ProgramResult outcome = RunProgram({ "render", folder / "sphere.ply", "--camera-position",
    "0,0,0", "--no-lighting", "--resolution", "20,15", "--output", folder / "p.png" });
  EXPECT_EQ(outcome.Status, 0);
  EXPECT_EQ(outcome.Errors, "");
  const auto image = ReadImage(folder / "p.png");
  EXPECT_EQ(PixelAt(image, 0, 0), (Pixel{ 1, 1, 1 }));
  EXPECT_EQ(PixelAt(image, 10, 7), (Pixel{ 1, 1, 1 }));
}

TEST(Render, KeepsSurfacesCloseToTheCamera)
{
  const Folder folder("close-camera");
  for (const char* height : { "0.1", "1e-4" })
  {
    const auto image = RenderSquare(folder, "close.vti",
      { "--no-lighting", "--camera-position", std::string("0,0,") + height, "--camera-focal-point",
        std::string("0,") + height + ",0", "--camera-view-up", "+Z" });
    for (const int y : { 0, 15, 29 })
    {
      EXPECT_EQ(PixelAt(image, 20, y)[0], 1.0) << height << ' ' << y;
    }
  }
}

TEST(Render, FitsSpheresAndTubes)
{
  const Folder folder("fit-round");
  const std::string header =
    "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n"
    "0 0 0\n0 3 0\n";
  WriteText(folder / "points.vtk", header + "VERTICES 2 4\n1 0\n1 1\n");
  WriteText(folder / "line.vtk", header + "LINES 1 3\n2 0 1\n");
  for (const char* file : { "points.vtk", "line.vtk" })
  {
    const ProgramResult outcome =
      RunProgram({ "render", folder / file, "--point-radius", "2", "--line-radius", "2",
        "--no-lighting", "--resolution", "40,30", "--output", folder / "p.vti" });
    EXPECT_EQ(outcome.Errors, "");
    const auto image = ReadImage(folder / "p.vti");
    EXPECT_EQ(PixelAt(image, 20, 15)[0], 1.0) << file;
    for (int x = 0; x < 40; ++x)
    {
      EXPECT_EQ(PixelAt(image, x, 0)[0], 0.0) << file;
      EXPECT_EQ(PixelAt(image, x, 29)[0], 0.0) << file;
    }
  }
}

TEST(Render, ZoomsParallelProjectionWithoutMovingCamera)
{
  const Folder folder("parallel-zoom");
  WriteSpheres(folder.Path);
  const auto draw = [&](const char* zoom) {
    RunProgram({ "render", folder / "sphere.ply", "--camera-orthographic", "--camera-zoom-factor",
      zoom, "--resolution", "21,21", "--output", folder / "p.vti" });
    return ReadImage(folder / "p.vti");
  };
  const auto depths = [](vtkImageData* image) { return image->GetPointData()->GetArray("Depth"); };
  const auto whole = draw("1");
  const auto part = draw("50");
  const vtkIdType middle = 10 * 21 + 10;
  EXPECT_TRUE(std::isinf(depths(whole)->GetComponent(0, 0)));
  EXPECT_NEAR(depths(part)->GetComponent(middle, 0), depths(whole)->GetComponent(middle, 0), 1e-4);
  EXPECT_NEAR(depths(part)->GetComponent(0, 0), depths(part)->GetComponent(middle, 0), 0.02);
}

TEST(Render, PlacesLights)
{
  const Folder folder("lights");
  const auto brightness = [&](const std::vector<std::string>& options) {
    std::vector<std::string> all = { "--camera-zoom-factor", "4" };
    all.insert(all.end(), options.begin(), options.end());
    return PixelAt(RenderSquare(folder, "p.vti", all), 20, 15)[0];
  };
  EXPECT_NEAR(brightness({}), 1.0, 1e-3);
  EXPECT_NEAR(brightness({ "--light-position", "0,3,4,0" }), 0.8, 1e-5);
  EXPECT_NEAR(brightness({ "--light-position", "0,30,40" }), 0.8, 0.02);
  EXPECT_NEAR(brightness({ "--light-position", "0,60,80,2" }), 0.8, 0.02);
  EXPECT_NEAR(brightness({ "--light-position", "0,4,3,0", "--light-position=4,0,3,0" }), 1.2, 1e-5);
}

TEST(Render, RendersLightShafts)
{
  const Folder folder("shafts");
  // The lit medium is infinite next to the square and ends at the square in the middle [Shafts eq. 1].
  const double cosine = -0.6;
  const double light = 0.2 / 0.5 * 3.0 / (16.0 * 3.14159265) * (1.0 + cosine * cosine);
  const auto image = RenderSquare(folder, "p.vti",
    { "--light-shafts", "--light-position=0,0.8,0.6,0", "--shafts-scattering", "0.2",
      "--shafts-extinction", "0.5", "--shafts-phase", "rayleigh", "--camera-orthographic",
      "--color", "0,0,0", "--statistics", folder / "s.json" });
  EXPECT_NEAR(PixelAt(image, 1, 28)[0], light, 1e-5);
  EXPECT_GT(ReadJson(folder / "s.json")["statistics"]["Rays/Shaft"], 0);
  const double depth = image->GetPointData()->GetArray("Depth")->GetComponent(15 * 40 + 20, 0);
  EXPECT_NEAR(PixelAt(image, 20, 15)[0], light * (1.0 - std::exp(-0.5 * depth)), 1e-5);
}

TEST(Render, EnginesRenderSimilarLightShafts)
{
  const Folder folder("engines");
  for (const std::string engine : { "ray", "raster" })
  {
    const ProgramResult outcome = RunProgram({ "render", SourceFolder() + "/Data/bracket.stl",
      "--resolution", "120,90", "--engine", engine, "--output", folder / (engine + ".png"),
      "--light-shafts", "--shafts-phase", "hg:0.6", "--light-position=0.6,0.8,-1,0" });
    ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  }
  EXPECT_LT(
    Compare(folder / "raster.png", folder / "ray.png", vtkPenumbraImageComparison::RMSE), 0.02);
}

TEST(Render, RendersLightShaftsFromShadowMaps)
{
  const Folder folder("shadow-maps");
  const auto render = [&](const std::string& name, const std::vector<std::string>& options) {
    std::vector<std::string> all = { "render", SourceFolder() + "/Data/bracket.stl", "--resolution",
      "120,90", "--output", folder / name, "--light-shafts", "--light-position=-0.5,0.5,-1,0" };
    all.insert(all.end(), options.begin(), options.end());
    const ProgramResult outcome = RunProgram(all);
    EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
    return outcome.Errors;
  };
  render("ray.png", { "--engine", "ray", "--tolerance", "0.001" });
  render("depth.png", { "--engine", "raster" });
  render("map.png", { "--engine", "raster", "--shafts-estimator", "shadow-map" });
  const auto error = [&](const std::string& name) -> double {
    return Compare(folder / name, folder / "ray.png", vtkPenumbraImageComparison::RMSE);
  };
  EXPECT_LT(error("map.png"), error("depth.png"));
  EXPECT_NE(render("unused.png", { "--shafts-estimator", "shadow-map" }).find("--shafts-estimator"),
    std::string::npos);
}

TEST(Render, WarnsThatHeadlightsCastNoShafts)
{
  const Folder folder("headlight");
  WriteText(folder / "square.stl", SquareStl());
  for (const char* engine : { "ray", "raster" })
  {
    const ProgramResult outcome = RunProgram({ "render", folder / "square.stl", "--output",
      folder / "p.png", "--light-shafts", "--engine", engine });
    EXPECT_EQ(outcome.Status, 0);
    EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
    EXPECT_NE(outcome.Errors.find("light"), std::string::npos);
  }
}

// A light in the middle of the scene has no shadow map.
TEST(Render, PrintsWarningsOfPassesOnce)
{
  const Folder folder("pass-warning");
  WriteText(folder / "square.stl", SquareStl());
  const ProgramResult outcome =
    RunProgram({ "render", folder / "square.stl", "--output", folder / "p.png", "--engine",
      "raster", "--frames", "3", "--ambient-occlusion", "--ambient-occlusion-kernel", "march",
      "--light-shafts", "--light-position", "0.5,0.5,0.01", "--shafts-estimator", "shadow-map" });
  EXPECT_EQ(outcome.Status, 0);
  EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
  const std::size_t warning = outcome.Errors.find("has no shadow map");
  EXPECT_NE(warning, std::string::npos) << outcome.Errors;
  EXPECT_EQ(outcome.Errors.find("has no shadow map", warning + 1), std::string::npos);
}

TEST(Render, WritesTransparentBackground)
{
  const Folder folder("alpha");
  const std::vector<std::string> look = { "--no-lighting", "--color", "0.2,0.6,1", "--opacity",
    "0.5", "--camera-direction", "-1,-2,-3", "--no-background" };
  const auto image = RenderSquare(folder, "p.png", look);
  ASSERT_EQ(image->GetPointData()->GetScalars()->GetNumberOfComponents(), 4);
  const double* center = image->GetPointData()->GetScalars()->GetTuple(15 * 40 + 20);
  EXPECT_NEAR(center[0], 51, 1);
  EXPECT_NEAR(center[1], 153, 1);
  EXPECT_NEAR(center[2], 255, 1);
  EXPECT_NEAR(center[3], 128, 1);
  EXPECT_EQ(image->GetPointData()->GetScalars()->GetComponent(0, 3), 0.0);
}

TEST(Render, ColorsByData)
{
  const Folder folder("coloring");
  WriteSphereWithArrays(folder / "sphere.vtp");
  const auto center = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments = { "render", folder / "sphere.vtp", "--no-lighting",
      "--resolution", "31,31", "--output", folder / "p.png", "--colormap", "gray" };
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramResult outcome = RunProgram(arguments);
    EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
    return PixelAt(ReadImage(folder / "p.png"), 15, 15)[0];
  };
  // The camera looks at the pole, where z is largest and the direction is (0, 0, 1).
  EXPECT_NEAR(center({ "--scalar-coloring" }), 1.0, 0.01);
  EXPECT_NEAR(center({ "--coloring-array", "Height", "--coloring-range", "0,1" }), 0.5, 0.02);
  EXPECT_NEAR(center({ "--coloring-array", "Direction", "--coloring-component", "2",
                "--coloring-range", "-1,3" }),
    0.5, 0.02);
  EXPECT_NEAR(center({ "--coloring-array", "Direction", "--coloring-range", "0,2" }), 0.5, 0.02);
  EXPECT_LT(center({ "--coloring-array", "Number", "--coloring-by-cells" }), 0.2);
  const ProgramResult unknown = RunProgram(
    { "render", folder / "sphere.vtp", "--coloring-array", "Heat", "--output", folder / "q.png" });
  EXPECT_EQ(unknown.Status, 2);
  EXPECT_NE(unknown.Errors.find("Height, Direction"), std::string::npos) << unknown.Errors;
  EXPECT_NE(unknown.Errors.find("Number"), std::string::npos) << unknown.Errors;
}

TEST(Render, RendersScalarBarWithBothEngines)
{
  const Folder folder("legend");
  WriteSphereWithArrays(folder / "sphere.vtp");
  for (const char* engine : { "ray", "raster" })
  {
    const ProgramResult outcome =
      RunProgram({ "render", folder / "sphere.vtp", "--coloring-scalar-bar", "--coloring-array",
        "Height", "--resolution", "200,200", "--engine", engine, "--output", folder / "p.png" });
    ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
    EXPECT_EQ(outcome.Errors, "");
    // The band stands at 0.85 to 0.89 of the width and from 0.17 of the height on, beside the sphere.
    const auto image = ReadImage(folder / "p.png");
    const auto low = PixelAt(image, 174, 40);
    const auto high = PixelAt(image, 174, 130);
    EXPECT_GT(low[2] + low[0], 0.2) << engine;
    EXPECT_GT(std::abs(high[1] - low[1]), 0.2) << engine;
  }
}

TEST(Render, RendersOneImagePerFile)
{
  const Folder folder("each");
  WriteSpheres(folder.Path);
  WriteText(folder / "broken.ply", "ply\nno more\n");
  const ProgramResult outcome = RunProgram({ "render", folder / "sphere.stl", folder / "broken.ply",
    folder / "square.stl", "--jobs", "2", "--resolution", "20,20", "--output",
    folder / "out-{name}.png", "--statistics", folder / "out-{name}.json" });
  EXPECT_EQ(outcome.Status, 2);
  EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
  EXPECT_NE(outcome.Errors.find("broken.ply"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder / "out-sphere.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "out-square.json"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out-broken.png"));
}

TEST(Render, RendersAllFilesInOneScene)
{
  const Folder folder("scene");
  WriteText(folder / "square.stl", SquareStl());
  WriteText(folder / "right.obj", "v 2 -1 0\nv 4 -1 0\nv 4 1 0\nv 2 1 0\nf 1 2 3 4\n");
  RunProgram({ "render", folder / "square.stl", folder / "right.obj", "--resolution", "61,21",
    "--output", folder / "p.vti", "--camera-direction", "0,0,-1" });
  const auto image = ReadImage(folder / "p.vti");
  vtkDataArray* objects = image->GetPointData()->GetArray("ObjectId");
  EXPECT_EQ(objects->GetRange(0)[0], -1.0);
  EXPECT_EQ(objects->GetRange(0)[1], 1.0);
}

TEST(Render, AcceptsNamedColorsAndDirections)
{
  const Folder folder("names");
  WriteText(folder / "square.stl", SquareStl());
  const auto draw = [&](const std::string& color, const std::string& direction) {
    const ProgramResult outcome =
      RunProgram({ "render", folder / "square.stl", "--unlit", "--resolution", "9,9", "--output",
        folder / "{model}.png", "--color", color, "--camera-direction", direction });
    EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
    return PixelAt(ReadImage(folder / "square.png"), 4, 4);
  };
  EXPECT_EQ(draw("lime", "-Z"), (Pixel{ 0, 1, 0 }));
  EXPECT_EQ(draw("#FF00ff", "0,0,-1"), (Pixel{ 1, 0, 1 }));
  EXPECT_EQ(draw("1,0,0", "+x"), (Pixel{ 0, 0, 0 })); // seen from its edge
  for (const char* wrong : { "nocolour", "#12345", "#12345g", "1,2,3" })
  {
    const ProgramResult outcome = RunProgram(
      { "render", folder / "square.stl", "--color", wrong, "--output", folder / "w.png" });
    EXPECT_EQ(outcome.Status, 2) << wrong;
    EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
  }
}

TEST(Render, AddsEnvironmentLight)
{
  const Folder folder("indirect");
  const Pixel dark = PixelAt(RenderSquare(folder, "dark.vti", { "--color", "1,0.5,0.25" }), 20, 15);
  const Pixel light = PixelAt(RenderSquare(folder, "light.vti",
                                { "--color", "1,0.5,0.25", "--indirect", "--environment-color",
                                  "0.5,1,2", "--albedo", "0.8", "--bounces", "4" }),
    20, 15);
  // A flat square does not occlude itself.
  EXPECT_NEAR(light[0] - dark[0], .8 * 1.0 * .5, 1e-5);
  EXPECT_NEAR(light[1] - dark[1], .8 * .5 * 1.0, 1e-5);
  EXPECT_NEAR(light[2] - dark[2], .8 * .25 * 2.0, 1e-5);
}

TEST(Render, PrintsRequestedProgress)
{
  const Folder folder("progress");
  WriteText(folder / "square.stl", SquareStl());
  const ProgramResult plain = RunProgram({ "render", folder / "square.stl", "--output",
    folder / "p.png", "--resolution", "50,50", "--progress", "plain" });
  EXPECT_EQ(plain.Status, 0);
  EXPECT_NE(plain.Errors.find("writing 100 %\n"), std::string::npos) << plain.Errors;
  const ProgramResult bar = RunProgram({ "render", folder / "square.stl", "--output",
    folder / "p.png", "--resolution", "50,50", "--progress", "bar" });
  EXPECT_NE(bar.Errors.find("[####"), std::string::npos) << bar.Errors;
}

}
