// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Variants that mesh formats allow. The truth is the image of the same mesh in a VTK XML file.
#include "Program.h"
#include "RenderedImages.h"

#include "vtkCellArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkXMLPolyDataWriter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>

using namespace penumbra_testing;

namespace
{

using Point = std::array<double, 3>;
using Face = std::vector<int>;

struct Mesh
{
  std::vector<Point> Points;
  std::vector<Face> Faces;
};

Mesh Cube()
{
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
  {
    mesh.Points.push_back({ double(i & 1), double(i >> 1 & 1), double(i >> 2) });
  }
  mesh.Faces = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 }, { 0, 4, 6, 2 },
    { 1, 3, 7, 5 } };
  return mesh;
}

/// Waves of 4 cm on a terrain of 5 m, in the coordinates of a UTM zone if `shift` is 1.
Mesh Terrain(double shift)
{
  constexpr int size = 12;
  Mesh mesh;
  for (int j = 0; j < size; ++j)
  {
    for (int i = 0; i < size; ++i)
    {
      const double x = 5.0 * i / (size - 1);
      const double y = 5.0 * j / (size - 1);
      mesh.Points.push_back({ x + shift * 500000.0, y + shift * 5400000.0,
        0.4 * std::sin(2.0 * x) * std::cos(3.0 * y) + shift * 300.0 });
    }
  }
  for (int j = 0; j + 1 < size; ++j)
  {
    for (int i = 0; i + 1 < size; ++i)
    {
      const int a = j * size + i;
      mesh.Faces.push_back({ a, a + 1, a + size + 1 });
      mesh.Faces.push_back({ a, a + size + 1, a + size });
    }
  }
  return mesh;
}

void WriteVtp(const Mesh& mesh, const std::string& path)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Point& point : mesh.Points)
  {
    points->InsertNextPoint(point.data());
  }
  vtkNew<vtkCellArray> polygons;
  for (const Face& face : mesh.Faces)
  {
    const std::vector<vtkIdType> ids(face.begin(), face.end());
    polygons->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(polygons);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetFileName(path.c_str());
  writer->Write();
}

/// A line of text for each point or face; `suffix` ends it.
std::string PointLines(const Mesh& mesh, const std::string& prefix, const std::string& suffix)
{
  std::ostringstream text;
  text.precision(12);
  for (const Point& point : mesh.Points)
  {
    text << prefix << point[0] << " " << point[1] << " " << point[2] << suffix << "\n";
  }
  return text.str();
}

std::string FaceLines(const Mesh& mesh, const std::string& prefix, int first,
  const std::string& cornerSuffix = "", const std::string& suffix = "")
{
  std::ostringstream text;
  for (const Face& face : mesh.Faces)
  {
    text << (prefix.empty() ? std::to_string(face.size()) : prefix);
    for (const int corner : face)
    {
      text << " " << corner + first << cornerSuffix;
    }
    text << suffix << "\n";
  }
  return text.str();
}

std::string Replace(std::string text, const std::string& from, const std::string& to)
{
  for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
  {
    text.replace(at, from.size(), to);
  }
  return text;
}

std::string Upper(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// The text in UTF-16 with a byte order mark.
std::string Utf16(const std::string& text)
{
  std::string units = "\xff\xfe";
  for (const char c : text)
  {
    units += { c, '\0' };
  }
  return units;
}

std::string Stl(const Mesh& mesh)
{
  std::ostringstream text;
  text.precision(12);
  for (const Face& face : mesh.Faces)
  {
    for (std::size_t i = 2; i < face.size(); ++i)
    {
      text << "facet normal 0 0 0\n  outer loop\n";
      for (const int corner : { face[0], face[i - 1], face[i] })
      {
        const Point& point = mesh.Points[corner];
        text << "    vertex " << point[0] << " " << point[1] << " " << point[2] << "\n";
      }
      text << "  endloop\nendfacet\n";
    }
  }
  return text.str();
}

std::string Solid(const std::string& body)
{
  return "solid a\n" + body + "endsolid a\n";
}

std::string Obj(const Mesh& mesh)
{
  return PointLines(mesh, "v ", "") + FaceLines(mesh, "f", 1);
}

std::string Off(const Mesh& mesh, const std::string& header = "OFF\n",
  const std::string& vertexSuffix = "", const std::string& faceSuffix = "")
{
  return header + std::to_string(mesh.Points.size()) + " " + std::to_string(mesh.Faces.size()) +
    " 0\n" + PointLines(mesh, "", vertexSuffix) + FaceLines(mesh, "", 0, "", faceSuffix);
}

std::string PlyHeader(const Mesh& mesh, const std::string& format, const std::string& coordinate,
  const std::string& list)
{
  return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(mesh.Points.size()) +
    "\nproperty " + coordinate + " x\nproperty " + coordinate + " y\nproperty " + coordinate +
    " z\nelement face " + std::to_string(mesh.Faces.size()) + "\nproperty list " + list +
    " vertex_indices\nend_header\n";
}

std::string Ply(const Mesh& mesh, const std::string& list = "uchar int")
{
  return PlyHeader(mesh, "ascii", "float", list) + PointLines(mesh, "", "") +
    FaceLines(mesh, "", 0);
}

template <typename T>
void Append(std::string& bytes, T value, bool bigEndian)
{
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (bigEndian)
  {
    std::reverse(raw, raw + sizeof(T));
  }
  bytes.append(raw, sizeof(T));
}

/// Binary PLY with coordinates of type double, ushort counts and int64 indices.
std::string BinaryPly(const Mesh& mesh, bool bigEndian)
{
  std::string bytes = PlyHeader(
    mesh, bigEndian ? "binary_big_endian" : "binary_little_endian", "double", "ushort int64");
  for (const Point& point : mesh.Points)
  {
    for (const double coordinate : point)
    {
      Append(bytes, coordinate, bigEndian);
    }
  }
  for (const Face& face : mesh.Faces)
  {
    Append(bytes, static_cast<std::uint16_t>(face.size()), bigEndian);
    for (const int corner : face)
    {
      Append(bytes, static_cast<std::int64_t>(corner), bigEndian);
    }
  }
  return bytes;
}

using Variants = std::vector<std::pair<std::string, std::string>>;

ProgramResult Render(const std::vector<std::string>& meshes, const std::string& output)
{
  std::vector<std::string> arguments = { "render", "--output", output, "--resolution", "80,64",
    "--camera-direction=-1,-1.2,-2" };
  arguments.insert(arguments.end(), meshes.begin(), meshes.end());
  return RunProgram(arguments);
}

/// Renders the texts as files, all with one run of the program, and compares with the image of `mesh` in a .vtp file.
void ExpectImagesOf(
  const Folder& folder, const Mesh& mesh, const std::string& extension, const Variants& variants)
{
  std::vector<std::string> files = { folder / "truth.vtp" };
  WriteVtp(mesh, files[0]);
  for (const auto& [name, text] : variants)
  {
    files.push_back(folder / name + extension);
    WriteText(files.back(), text);
  }
  const ProgramResult outcome = Render(files, folder / "{name}.png");
  EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_EQ(outcome.Errors, "");
  for (const auto& [name, text] : variants)
  {
    EXPECT_LE(Compare(folder / name + ".png", folder / "truth.png"), 1.01 / 255.0)
      << name << extension;
  }
}

TEST(Stl, TextVariantsGiveTheSameImage)
{
  const Folder folder("stl");
  const Mesh cube = Cube();
  const std::string body = Stl(cube);
  const Variants variants = { { "plain", Solid(body) }, { "upper", Upper(Solid(body)) },
    { "end-solid", "solid a\n" + body + "end solid a\n" },
    { "indented", "  " + Replace(Solid(body), "\n", "\n\t ") }, { "utf-16", Utf16(Solid(body)) },
    { "blank-first", "\n\n" + Solid(body) }, { "mark", "\xef\xbb\xbf" + Solid(body) },
    { "carriage-return", Replace(Solid(body), "\n", "\r") },
    { "dos", Replace(Solid(body), "\n", "\r\n") }, { "nameless", "solid\n" + body + "endsolid\n" },
    { "named-facet", "solid facet of a facet\n" + body + "endsolid facet\n" },
    { "one-line", Replace(Solid(body), "\n", " ") },
    { "trailing", Solid(body) + std::string(700, ' ') + "\n; exported\n" },
    { "color", "solid a\ncolor 0.5 0.2 0.1\n" + body + "endsolid a\n" } };
  ExpectImagesOf(folder, cube, ".stl", variants);
}

TEST(Obj, VariantsGiveTheSameImage)
{
  const Folder folder("obj");
  const Mesh cube = Cube();
  const std::string points = PointLines(cube, "v ", "");
  const Variants variants = { { "plain", Obj(cube) },
    { "groups", points + "o a\ng b\nusemtl red\n" + FaceLines(cube, "f", 1) },
    { "utf-16", Utf16(Obj(cube)) }, { "negative", points + FaceLines(cube, "f", -8) },
    { "texture", points + "vt 0 0\nvt 1\n" + FaceLines(cube, "f", 1, "/1") },
    { "broken-lines", points + Replace(FaceLines(cube, "f", 1), "f ", "f \\\n ") },
    { "comments", "# a\n" + points + FaceLines(cube, "f", 1, "", " # b") },
    { "faces-first", FaceLines(cube, "f", 1) + points },
    { "weights", PointLines(cube, "v ", " 1.0") + FaceLines(cube, "f", 1) },
    { "missing-normals", points + FaceLines(cube, "f", 1, "//7") },
    { "dos", Replace(Obj(cube), "\n", "\r\n") } };
  ExpectImagesOf(folder, cube, ".obj", variants);
}

TEST(Off, VariantsGiveTheSameImage)
{
  const Folder folder("off");
  const Mesh cube = Cube();
  const std::string body = PointLines(cube, "", "") + FaceLines(cube, "", 0);
  const Variants variants = { { "plain", Off(cube) }, { "lower", Off(cube, "off\n") },
    { "same-line", Off(cube, "OFF ") }, { "glued", Off(cube, "OFF") },
    { "headless", Off(cube, "") }, { "comments", "# a\nOFF # b\n# c\n8 6 # d\n" + body + "# e\n" },
    { "blank-lines", Replace(Off(cube), "\n", "\n\n") },
    { "colors", Off(cube, "COFF\n", " 255 0 0 255") },
    { "appended-colors", Off(cube, "OFF\n", " 1.0 0 0") },
    { "coordinates", Off(cube, "STOFF\n", " 0 0") },
    { "meshlab", Off(cube, "CSTOFF\n", " 255 0 0 255 0 0") },
    { "weights", Off(cube, "4OFF\n", " 1") }, { "face-colors", Off(cube, "OFF\n", "", " 0 255 0") },
    { "face-indices", Off(cube, "OFF\n", "", " 7") },
    { "one-line", Replace(Off(cube), "\n", " ") + "\n" },
    { "dos", Replace(Off(cube), "\n", "\r\n") } };
  ExpectImagesOf(folder, cube, ".off", variants);
}

TEST(Off, NormalsAreThoseOfPly)
{
  const Folder folder("noff");
  const Mesh cube = Cube();
  const std::string normal = " 0.6 0 0.8";
  WriteText(folder / "normals.off", Off(cube, "NOFF\n", normal));
  WriteText(folder / "plain.off", Off(cube));
  WriteText(folder / "reference.ply",
    Replace(PlyHeader(cube, "ascii", "double", "uchar int"), "property double z\n",
      "property double z\nproperty float nx\nproperty float ny\nproperty float nz\n") +
      PointLines(cube, "", normal) + FaceLines(cube, "", 0));
  const ProgramResult outcome =
    Render({ folder / "normals.off", folder / "plain.off", folder / "reference.ply" },
      folder / "{name}.png");
  ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_EQ(Compare(folder / "normals.png", folder / "reference.png"), 0.0);
  EXPECT_GT(Compare(folder / "normals.png", folder / "plain.png"), 0.1);
}

TEST(Ply, VariantsGiveTheSameImage)
{
  const Folder folder("ply");
  const Mesh cube = Cube();
  const std::string strips = "ply\nformat ascii 1.0\nelement vertex 8\nproperty int x\n"
                             "property int y\nproperty int z\nelement tristrips 1\n"
                             "property list int int vertex_indices\nend_header\n" +
    PointLines(cube, "", "") +
    "29 0 2 1 3 -1 4 5 6 7 -1 0 1 4 5 -1 2 6 3 7 -1 0 4 2 6 -1 1 3 5 7\n";
  const std::string texture =
    Replace(PlyHeader(cube, "ascii", "double", "uchar int"), "property list",
      "property list uchar float texcoord\nproperty list") +
    PointLines(cube, "", "") +
    Replace("\n" + FaceLines(cube, "", 0), "\n4", "\n2 .5 .5 4").substr(1);
  const Variants variants = { { "plain", Ply(cube) }, { "uint", Ply(cube, "uint uint") },
    { "short", Ply(cube, "short int64") }, { "little", BinaryPly(cube, false) },
    { "big", BinaryPly(cube, true) }, { "strips", strips }, { "texture", texture },
    { "dos", Replace(Ply(cube), "\n", "\r\n") },
    { "carriage-return", Replace(Ply(cube), "\n", "\r") },
    { "comments", Replace(Ply(cube), "element vertex", "comment a\nobj_info b\nelement vertex") } };
  ExpectImagesOf(folder, cube, ".ply", variants);
}

TEST(Formats, KeepTheDigitsOfLargeCoordinates)
{
  const Folder folder("digits");
  const Mesh near = Terrain(0.0);
  const Mesh far = Terrain(1.0);
  ExpectImagesOf(
    folder, near, ".ply", { { "little", BinaryPly(far, false) }, { "text", Ply(far) } });
  ExpectImagesOf(folder, near, ".obj", { { "text", Obj(far) } });
  ExpectImagesOf(folder, near, ".off", { { "text", Off(far) } });
  ExpectImagesOf(folder, near, ".stl", { { "text", Solid(Stl(far)) } });
}

TEST(Formats, SinglePrecisionOfLargeCoordinatesIsReported)
{
  const Folder folder("single");
  const std::string header(80, ' ');
  for (const double offset : { 0.0, 5400000.0 })
  {
    std::string bytes = header;
    Append(bytes, std::uint32_t(1), false);
    for (const double value : { 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 5.0, 0.0, 0.0, 0.0, 5.0, 0.0 })
    {
      Append(bytes, static_cast<float>(value + offset), false);
    }
    Append(bytes, std::uint16_t(0), false);
    WriteText(folder / "a.stl", bytes);
    const ProgramResult outcome = Render({ folder / "a.stl" }, folder / "a.png");
    EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
    EXPECT_EQ(CountLines(outcome.Errors), offset > 0.0 ? 1 : 0) << outcome.Errors;
    EXPECT_EQ(outcome.Errors.find("multiples of 0.5") != std::string::npos, offset > 0.0)
      << outcome.Errors;
  }
}

TEST(Ply, PolygonsOfManyVerticesAreRead)
{
  const Folder folder("polygon");
  Mesh mesh;
  mesh.Faces.emplace_back();
  for (int i = 0; i < 300; ++i)
  {
    mesh.Points.push_back({ std::cos(i * M_PI / 150), std::sin(i * M_PI / 150), 0.0 });
    mesh.Faces[0].push_back(i);
  }
  ExpectImagesOf(folder, mesh, ".ply", { { "disk", Ply(mesh, "ushort int") } });
}

/// A square whose vertices have the color `values` in properties of type `type`.
std::string ColoredSquare(
  const std::string& type, const std::string& values, const std::vector<std::string>& names)
{
  std::string text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                     "property float z\n";
  for (const std::string& name : names)
  {
    text += "property " + type + " " + name + "\n";
  }
  text += "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  for (const char* point : { "0 0 0 ", "1 0 0 ", "1 1 0 ", "0 1 0 " })
  {
    text += point + values + "\n";
  }
  return text + "4 0 1 2 3\n";
}

TEST(Ply, ColorsOfAnyTypeAreDrawn)
{
  const std::vector<std::string> rgb = { "red", "green", "blue" };
  const std::vector<std::string> diffuse = { "diffuse_red", "diffuse_green", "diffuse_blue" };
  const Pixel expected = { 51 / 255.0, 102 / 255.0, 1.0 };
  struct Row
  {
    const char* Type;
    const char* Values;
    const std::vector<std::string>* Names;
  };
  const Folder folder("colors");
  for (const Row& row : { Row{ "uchar", "51 102 255", &rgb },
         Row{ "uchar", "51 102 255", &diffuse }, Row{ "float", "0.2 0.4 1", &rgb },
         Row{ "double", "0.2 0.4 1.0", &diffuse }, Row{ "float", "51 102 255", &rgb },
         Row{ "ushort", "13107 26214 65535", &rgb }, Row{ "int", "51 102 255", &rgb } })
  {
    const std::string path = folder / "square.ply";
    WriteText(path, ColoredSquare(row.Type, row.Values, *row.Names));
    const ProgramResult outcome = RunProgram({ "render", path, "--output", path + ".png",
      "--resolution", "20,20", "--scalar-coloring", "--no-lighting", "--camera-orthographic" });
    ASSERT_EQ(outcome.Status, 0) << row.Type << outcome.Errors;
    const Pixel pixel = PixelAt(ReadImage(path + ".png"), 10, 10);
    for (int i = 0; i < 3; ++i)
    {
      EXPECT_NEAR(pixel[i], expected[i], 0.6 / 255.0) << row.Type << " " << row.Values;
    }
  }
}

TEST(Obj, LinesAndPointsBesideFacesAreDrawn)
{
  // Normals give the corners of the faces other indices than those of the vertices.
  const std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nv 1.5 0.5 0\n"
                           "vn 0 0 1\nvn 0 0 1\nusemtl red\nf 1//2 2//1 3//2 4//1\nl 5 6\np 7\n";
  const Folder folder("lines");
  const std::string path = folder / "mixed.obj";
  WriteText(path, text);
  const ProgramResult outcome = RunProgram(
    { "render", path, "--output", path + ".png", "--resolution", "200,100", "--no-lighting",
      "--camera-orthographic", "--camera-position", "1,0.5,5", "--camera-focal-point", "1,0.5,0",
      "--camera-parallel-scale", "0.55", "--line-width", "4", "--point-size", "8" });
  ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  const auto image = ReadImage(path + ".png");
  const double scale = 100 / 1.1; // pixels per unit
  const auto at = [&](double x, double y) {
    return PixelAt(
      image, static_cast<int>(100 + scale * (x - 1)), static_cast<int>(50 + scale * (y - 0.5)))[0];
  };
  EXPECT_EQ(at(0.5, 0.5), 1.0);
  EXPECT_EQ(at(2.0, 0.3), 1.0);
  EXPECT_EQ(at(1.5, 0.5), 1.0);
  EXPECT_EQ(at(1.5, 0.2), 0.0);
  EXPECT_EQ(at(1.2, 0.5), 0.0);
}

}
