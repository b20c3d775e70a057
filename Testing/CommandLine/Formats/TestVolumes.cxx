// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Volumes are where the headers of their files say. The truth is the matrix that each header is
// written from. Colors that a file gives to its values are drawn and shown by the scalar bar.
#include "Program.h"
#include "RenderedImages.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>

using namespace penumbra_testing;

namespace
{

using Vector = std::array<double, 3>;

/// Steps between the 4 x 3 x 2 voxels of a volume, and the position of the first.
struct Frame
{
  const char* Name;
  Vector Steps[3];
  Vector Origin;
};

const Frame Shifted = { "shifted", { { 2, 0, 0 }, { 0, 1, 0 }, { 0, 0, 3 } }, { 10, 20, 30 } };
const Frame Rotated = { "rotated", { { 0, 2, 0 }, { -1, 0, 0 }, { 0, 0, 3 } }, { 10, 20, 30 } };
const Frame Mirrored = { "mirrored", { { -2, 0, 0 }, { 0, 1, 0 }, { 0, 0, 3 } }, { 16, 20, 30 } };
const Frame Tipped = { "tipped", { { 0, 0, 2 }, { 1, 0, 0 }, { 0, 3, 0 } }, { 10, 20, 27 } };

std::string Values()
{
  std::string bytes;
  for (std::int16_t i = 0; i < 24; ++i)
  {
    bytes.append(reinterpret_cast<const char*>(&i), sizeof(i));
  }
  return bytes;
}

template <typename T>
void Put(std::string& bytes, std::size_t offset, T value)
{
  std::memcpy(&bytes[offset], &value, sizeof(value));
}

/// A NIfTI-1 header without transforms.
std::string NiftiHeader(const Frame& frame)
{
  std::string bytes(352, '\0');
  Put<std::int32_t>(bytes, 0, 348);
  const std::int16_t dimensions[] = { 3, 4, 3, 2, 1, 1, 1, 1 };
  std::memcpy(&bytes[40], dimensions, sizeof(dimensions));
  Put<std::int16_t>(bytes, 70, 4);  // 16-bit integers
  Put<std::int16_t>(bytes, 72, 16); // bits
  Put<float>(bytes, 76, 1.f);
  for (int axis = 0; axis < 3; ++axis)
  {
    const Vector& step = frame.Steps[axis];
    Put<float>(bytes, 80 + 4 * axis, static_cast<float>(std::hypot(step[0], step[1], step[2])));
  }
  Put<float>(bytes, 108, 352.f); // offset of the values
  std::memcpy(&bytes[344], "n+1", 4);
  return bytes;
}

std::string NiftiByMatrix(const Frame& frame)
{
  std::string bytes = NiftiHeader(frame);
  Put<std::int16_t>(bytes, 254, 1);
  for (int row = 0; row < 3; ++row)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      Put<float>(bytes, 280 + 16 * row + 4 * axis, static_cast<float>(frame.Steps[axis][row]));
    }
    Put<float>(bytes, 280 + 16 * row + 12, static_cast<float>(frame.Origin[row]));
  }
  return bytes + Values();
}

/// The quaternion of a rotation by `degrees` about z. `qfac` is -1 if the third axis is reversed.
std::string NiftiByQuaternion(const Frame& frame, double degrees, float qfac)
{
  std::string bytes = NiftiHeader(frame);
  Put<std::int16_t>(bytes, 252, 1);
  Put<float>(bytes, 76, qfac);
  Put<float>(bytes, 264, static_cast<float>(std::sin(degrees * M_PI / 360.0)));
  for (int row = 0; row < 3; ++row)
  {
    Put<float>(bytes, 268 + 4 * row, static_cast<float>(frame.Origin[row]));
  }
  return bytes + Values();
}

std::string MetaImage(const Frame& frame)
{
  std::ostringstream text;
  text << "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
          "TransformMatrix =";
  std::ostringstream spacing;
  for (const Vector& step : frame.Steps)
  {
    const double length = std::hypot(step[0], step[1], step[2]);
    spacing << " " << length;
    for (const double component : step)
    {
      text << " " << component / length;
    }
  }
  text << "\nOffset = " << frame.Origin[0] << " " << frame.Origin[1] << " " << frame.Origin[2]
       << "\nElementSpacing =" << spacing.str()
       << "\nDimSize = 4 3 2\nElementType = MET_SHORT\nElementDataFile = LOCAL\n";
  return text.str() + Values();
}

std::string Nrrd(const Frame& frame, bool hasComponents)
{
  std::ostringstream text;
  text << "NRRD0004\ntype: short\ndimension: " << (hasComponents ? 4 : 3)
       << "\nspace: right-anterior-superior\nsizes: " << (hasComponents ? "1 " : "")
       << "4 3 2\nspace directions:" << (hasComponents ? " none" : "");
  for (const Vector& step : frame.Steps)
  {
    text << " (" << step[0] << "," << step[1] << "," << step[2] << ")";
  }
  text << "\nendian: little\nencoding: raw\nspace origin: (" << frame.Origin[0] << ","
       << frame.Origin[1] << "," << frame.Origin[2] << ")\n\n";
  return text.str() + Values();
}

struct Volume
{
  std::string Name; ///< of the image; the extension of the file follows
  std::string Extension;
  Frame Axes;
  std::string Bytes;
};

/// Compares the bounds of the box in an image from +z with those of the frame.
void ExpectBounds(vtkImageData* image, const Frame& frame, const std::string& name)
{
  Vector low = { INFINITY, INFINITY, INFINITY };
  Vector high = { -INFINITY, -INFINITY, -INFINITY };
  for (int corner = 0; corner < 8; ++corner)
  {
    for (int i = 0; i < 3; ++i)
    {
      const double x = frame.Origin[i] + (corner & 1 ? 3 * frame.Steps[0][i] : 0) +
        (corner & 2 ? 2 * frame.Steps[1][i] : 0) + (corner & 4 ? frame.Steps[2][i] : 0);
      low[i] = std::min(low[i], x);
      high[i] = std::max(high[i], x);
    }
  }
  vtkDataArray* depths = image->GetPointData()->GetArray("Depth");
  ASSERT_TRUE(depths) << name;
  int left = 120;
  int right = -1;
  int bottom = 120;
  int top = -1;
  double depth = INFINITY;
  for (int i = 0; i < 120 * 120; ++i)
  {
    if (std::isfinite(depths->GetComponent(i, 0)))
    {
      left = std::min(left, i % 120);
      right = std::max(right, i % 120);
      bottom = std::min(bottom, i / 120);
      top = std::max(top, i / 120);
      depth = std::min(depth, depths->GetComponent(i, 0));
    }
  }
  const double pixel = 12.0 / 120.0;
  EXPECT_NEAR(7.0 + left * pixel, low[0], pixel) << name;
  EXPECT_NEAR(7.0 + (right + 1) * pixel, high[0], pixel) << name;
  EXPECT_NEAR(15.0 + bottom * pixel, low[1], pixel) << name;
  EXPECT_NEAR(15.0 + (top + 1) * pixel, high[1], pixel) << name;
  EXPECT_NEAR(100.0 - depth, high[2], 1e-3) << name;
}

/// Renders the volumes, with one run of the program.
void ExpectBounds(const Folder& folder, const std::vector<Volume>& volumes)
{
  std::vector<std::string> arguments = { "render", "--output", folder / "{name}.vti",
    "--resolution", "120,120", "--camera-orthographic", "--camera-position", "13,21,100",
    "--camera-focal-point", "13,21,31", "--camera-parallel-scale", "6", "--no-lighting" };
  for (const Volume& volume : volumes)
  {
    arguments.push_back(folder / volume.Name + volume.Extension);
    WriteText(arguments.back(), volume.Bytes);
  }
  const ProgramResult outcome = RunProgram(arguments);
  ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_EQ(outcome.Errors, "");
  for (const Volume& volume : volumes)
  {
    ExpectBounds(ReadImage(folder / volume.Name + ".vti"), volume.Axes, volume.Name);
  }
}

TEST(Volumes, AreWhereTheirHeadersSay)
{
  const Folder folder("volumes");
  Frame reversed = Rotated;
  reversed.Steps[2] = { 0, 0, -3 };
  std::vector<Volume> volumes = { { "quaternion", ".nii", Shifted,
                                    NiftiByQuaternion(Shifted, 0.0, 1.f) },
    { "turned", ".nii", Rotated, NiftiByQuaternion(Rotated, 90.0, 1.f) },
    { "reversed", ".nii", reversed, NiftiByQuaternion(Rotated, 90.0, -1.f) } };
  for (const Frame& frame : { Shifted, Rotated, Mirrored, Tipped })
  {
    const std::string name = frame.Name;
    volumes.push_back({ name + "-nifti", ".nii", frame, NiftiByMatrix(frame) });
    volumes.push_back({ name + "-meta", ".mha", frame, MetaImage(frame) });
    volumes.push_back({ name + "-nrrd", ".nrrd", frame, Nrrd(frame, false) });
    volumes.push_back({ name + "-components", ".nrrd", frame, Nrrd(frame, true) });
  }
  ExpectBounds(folder, volumes);
}

TEST(Volumes, FarFromTheOriginKeepTheirShape)
{
  // Single precision has steps of 1 at 1e7.
  const Folder folder("far-volumes");
  const auto write = [](double offset, bool isImage) {
    std::ostringstream text;
    text.precision(12);
    text << "# vtk DataFile Version 3.0\nx\nASCII\nDATASET "
         << (isImage ? "STRUCTURED_POINTS" : "RECTILINEAR_GRID") << "\nDIMENSIONS 4 3 2\n";
    if (isImage)
    {
      text << "ORIGIN " << offset << ' ' << -offset << " 0\nSPACING .125 .25 .5\n";
    }
    else
    {
      text << "X_COORDINATES 4 double\n";
      for (int i = 0; i < 4; ++i)
      {
        text << offset + .125 * i << ' ';
      }
      text << "\nY_COORDINATES 3 double\n"
           << -offset << ' ' << -offset + .25 << ' ' << -offset + .5
           << "\nZ_COORDINATES 2 double\n0 .5\n";
    }
    text << "POINT_DATA 24\nSCALARS v float 1\nLOOKUP_TABLE default\n";
    for (int i = 0; i < 24; ++i)
    {
      text << i << ' ';
    }
    return text.str();
  };
  const auto render = [&](double offset, bool isImage, std::vector<std::string> cuts) {
    WriteText(folder / "a.vtk", write(offset, isImage));
    std::vector<std::string> arguments = { "render", folder / "a.vtk", "--output", folder / "a.vti",
      "--resolution", "40,30", "-s", "-e", "--camera-direction", "-1,-2,-3" };
    arguments.insert(arguments.end(), cuts.begin(), cuts.end());
    const ProgramResult outcome = RunProgram(arguments);
    EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
    EXPECT_EQ(outcome.Errors, "");
    return ReadImage(folder / "a.vti");
  };
  for (const bool isImage : { true, false })
  {
    const std::vector<std::string> kinds[] = { {}, { "--contour", "7.5" },
      { "--threshold", "0,18" }, { "--slice", "10000000.1,0,.2,1,0,3" },
      { "--clip", "10000000.1,0,.2,1,0,3" } };
    for (const std::vector<std::string>& far : kinds)
    {
      std::vector<std::string> near = far;
      if (near.size() == 2 && near[1].rfind("10000000.1", 0) == 0)
      {
        near[1] = ".1,0,.2,1,0,3";
      }
      const auto expected = render(0.0, isImage, near);
      const auto image = render(1e7, isImage, far);
      double difference = 0.0;
      for (int y = 0; y < 30; ++y)
      {
        for (int x = 0; x < 40; ++x)
        {
          difference =
            std::max(difference, std::abs(PixelAt(image, x, y)[1] - PixelAt(expected, x, y)[1]));
        }
      }
      EXPECT_LT(difference, 0.01) << isImage << (far.empty() ? "" : far[0]);
    }
  }
}

TEST(Volumes, CompressedNiftiIsRead)
{
  const Folder folder("compressed");
  const std::string bytes = NiftiByMatrix(Rotated);
  WriteText(folder / "plain", bytes);
  ASSERT_EQ(
    RunShell("gzip -c " + Quote(folder / "plain") + " > " + Quote(folder / "packed")).Status, 0);
  ExpectBounds(folder, { { "a.nii", ".gz", Rotated, ReadText(folder / "packed") } });
}

TEST(Volumes, OnlyTheFirstOfSeveralIsShownWithAWarning)
{
  const Folder folder("steps");
  std::string bytes = NiftiByMatrix(Rotated);
  Put<std::int16_t>(bytes, 40, 4);
  Put<std::int16_t>(bytes, 48, 3);
  WriteText(folder / "steps.nii", bytes + Values() + Values());
  for (const std::vector<std::string>& options :
    { std::vector<std::string>{}, { "--no-materials" } })
  {
    std::vector<std::string> arguments = { "render", folder / "steps.nii", "--resolution", "16,16",
      "--output", folder / "a.png" };
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramResult outcome = RunProgram(arguments);
    EXPECT_EQ(outcome.Status, 0);
    EXPECT_NE(
      outcome.Errors.find("steps.nii: only the first of 3 volumes is read"), std::string::npos)
      << outcome.Errors;
  }
}

TEST(Volumes, ParallelAxesAreRefused)
{
  const Folder folder("axes");
  Frame frame = Shifted;
  frame.Steps[1] = { 1, 0, 0 };
  WriteText(folder / "a.nrrd", Nrrd(frame, false));
  const ProgramResult outcome =
    RunProgram({ "render", folder / "a.nrrd", "--output", folder / "a.png" });
  EXPECT_EQ(outcome.Status, 2);
  EXPECT_EQ(CountLines(outcome.Errors), 1);
  EXPECT_NE(outcome.Errors.find("axes"), std::string::npos) << outcome.Errors;
}

/// Four unit squares in a row with the values 0 to 3 and the colors red, green, blue, white.
std::string SquaresWithColors()
{
  std::string text = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 10 float\n";
  for (const char* x : { "0", "1", "2", "3", "4" })
  {
    text += std::string(x) + " 0 0 " + x + " 1 0\n";
  }
  return text +
    "POLYGONS 4 20\n4 0 2 3 1\n4 2 4 5 3\n4 4 6 7 5\n4 6 8 9 7\nCELL_DATA 4\nSCALARS s int 1\n"
    "LOOKUP_TABLE mine\n0 1 2 3\nLOOKUP_TABLE mine 4\n1 0 0 1\n0 1 0 1\n0 0 1 1\n1 1 1 1\n";
}

std::array<Pixel, 4> RenderSquares(const Folder& folder, const std::vector<std::string>& options)
{
  WriteText(folder / "a.vtk", SquaresWithColors());
  std::vector<std::string> arguments = { "render", folder / "a.vtk", "--output", folder / "a.png",
    "--resolution", "80,20", "--no-lighting", "--camera-orthographic", "--camera-parallel-scale",
    "0.5", "--coloring-by-cells", "--coloring-array", "s" };
  arguments.insert(arguments.end(), options.begin(), options.end());
  const ProgramResult outcome = RunProgram(arguments);
  EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
  const auto image = ReadImage(folder / "a.png");
  return { PixelAt(image, 10, 10), PixelAt(image, 30, 10), PixelAt(image, 50, 10),
    PixelAt(image, 70, 10) };
}

TEST(FileColors, AreUsedWithoutAColormap)
{
  const Folder folder("file-colors");
  const std::array<Pixel, 4> colors = RenderSquares(folder, {});
  EXPECT_EQ(colors,
    (std::array<Pixel, 4>{
      Pixel{ 1, 0, 0 }, Pixel{ 0, 1, 0 }, Pixel{ 0, 0, 1 }, Pixel{ 1, 1, 1 } }));
}

TEST(FileColors, YieldToTheColormapAndItsRange)
{
  const Folder folder("colormap");
  const std::array<Pixel, 4> colors =
    RenderSquares(folder, { "--colormap", "gray", "--coloring-range", "0,6" });
  for (int i = 0; i < 4; ++i)
  {
    for (const double channel : colors[i])
    {
      EXPECT_NEAR(channel, i / 6.0, 1.5 / 255.0) << i;
    }
  }
}

}

TEST(Volumes, RejectInvalidSizesOfNrrd)
{
  const Folder folder("nrrd-sizes");
  const auto refuse = [&folder](const std::string& sizes, const std::string& encoding,
                        const std::string& words) {
    WriteText(folder / "a.nrrd",
      "NRRD0004\ntype: float\ndimension: 3\nsizes: " + sizes + "\nencoding: " + encoding +
        "\nendian: little\n\n" + std::string(64, '\0'));
    const ProgramResult outcome =
      RunProgram({ "render", folder / "a.nrrd", "--output", folder / "p.png" });
    EXPECT_EQ(outcome.Status, 2) << sizes << encoding;
    EXPECT_NE(outcome.Errors.find(words), std::string::npos) << outcome.Errors;
  };
  for (const std::string side : { "2000000000", "4294967296" })
  {
    refuse(side + " " + side + " 4", "raw", "it ends before its last value");
  }
  for (const std::string size : { "4294967296", "-4", "0", "1.5", "x" })
  {
    refuse("4 " + size + " 4", "gzip",
      "'sizes' must be integers from 1 to 2147483647, not '" + size + "'");
    refuse(size + " 4 4", "raw", "the file is damaged");
  }
}
