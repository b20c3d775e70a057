// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A table of invalid command lines and files. Each prints one line on stderr, returns the expected exit
// status, and leaves no output file.
#include "Meshes.h"
#include "Program.h"

#include "vtkVersion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

using namespace penumbra_testing;

namespace
{

struct Row
{
  const char* Name;
  int Status;
  const char* File;                 ///< written to mesh.EXTENSION
  const char* Extension;            ///< of the file; null: no file is written
  std::vector<std::string> Options; ///< in addition to render mesh.EXTENSION --output image.png
  std::vector<const char*> Words;   ///< contained in the line on stderr
};

std::ostream& operator<<(std::ostream& os, const Row& row)
{
  return os << row.Name;
}

constexpr const char* Square = "";

const char* const PlyWithNan = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                               "property float y\nproperty float z\nelement face 2\n"
                               "property list uchar int vertex_indices\nend_header\n"
                               "0 0 0\n1 0 0\n1 1 0\nnan 1 0\n3 0 1 2\n3 0 2 3\n";

const char* const ObjWithDegenerateTriangle = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 2 0 0\n"
                                              "f 1 2 3\nf 1 2 4\nf 1 1 2\n";

const char* const VtpOutOfRange =
  R"(<?xml version="1.0"?><VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">
<PolyData><Piece NumberOfPoints="3" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="1">
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points>
<Polys><DataArray type="Int64" Name="connectivity" format="ascii">0 1 7</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray></Polys></Piece></PolyData></VTKFile>)";

const char* const VtuWithShortHexahedron =
  R"(<?xml version="1.0"?><VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="3" NumberOfCells="1">
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">12</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>)";

const Row Rows[] = {
  // Invalid usage
  { "UnknownOption", 2, Square, "stl", { "--sparkle" },
    { "--sparkle", "unknown option", "--help" } },
  { "IndirectLightByRaster", 2, Square, "stl", { "--engine", "raster", "--indirect" },
    { "--indirect", "--engine ray" } },
  { "AlbedoAboveOne", 2, Square, "stl", { "--indirect", "--albedo=1.5" }, { "--albedo", "1" } },
  { "NoBounces", 2, Square, "stl", { "--indirect", "--bounces=0" }, { "--bounces", "1" } },
  { "NegativeEnvironment", 2, Square, "stl", { "--indirect", "--environment-color=-1,0,0" },
    { "--environment-color", "0" } },
  { "UnknownPhase", 2, Square, "stl", { "--light-shafts", "--shafts-phase", "mie" },
    { "--shafts-phase", "mie", "rayleigh" } },
  { "AsymmetryOfOne", 2, Square, "stl", { "--light-shafts", "--shafts-phase", "hg:1" },
    { "--shafts-phase", "0.999" } },
  { "NegativeScattering", 2, Square, "stl", { "--light-shafts", "--shafts-scattering=-1" },
    { "--shafts-scattering" } },
  { "TwoScatteringCoefficients", 2, Square, "stl",
    { "--light-shafts", "--shafts-scattering", "1,2" }, { "--shafts-scattering", "3" } },
  { "InfiniteRayleighScattering", 2, Square, "stl",
    { "--light-shafts", "--shafts-rayleigh", "inf" }, { "--shafts-rayleigh", "inf" } },
  { "NanInOneChannel", 2, Square, "stl", { "--light-shafts", "--shafts-extinction", "1,nan,1" },
    { "--shafts-extinction", "nan" } },
  { "NegativeScaleHeight", 2, Square, "stl", { "--light-shafts", "--shafts-scale-height=-1" },
    { "--shafts-scale-height", "-1" } },
  { "DensityByRaster", 2, Square, "stl",
    { "--engine", "raster", "--light-shafts", "--shafts-density", "a.vti" },
    { "--shafts-density", "--engine ray" } },
  { "DensityOfTriangles", 2, Square, "stl",
    { "--light-shafts", "--light-position", "1,2,3,0", "--shafts-density",
      SourceFolder() + "/Data/bracket.stl" },
    { "--shafts-density", "is a polygonal mesh, not an image" } },
  { "ScatteringBeyondExtinction", 2, Square, "stl",
    { "--light-shafts", "--shafts-scattering", "2", "--shafts-extinction", "1" },
    { "--shafts-extinction", "--shafts-scattering" } },
  { "UnlimitedOcclusionByRaster", 2, Square, "stl",
    { "--engine", "raster", "--ambient-occlusion", "--ambient-occlusion-radius", "inf" },
    { "--ambient-occlusion-radius", "--engine ray" } },
  { "NegativePointRadius", 2, Square, "stl", { "--point-radius=-1" }, { "--point-radius", "-1" } },
  { "PointRadiusZero", 2, Square, "stl", { "--point-radius=0" }, { "--point-radius" } },
  { "LineRadiusNotANumber", 2, Square, "stl", { "--line-radius=nan" }, { "--line-radius", "nan" } },
  { "SpheresByRaster", 2, Square, "stl", { "--engine", "raster", "--point-radius", "1" },
    { "--point-radius", "--engine ray" } },
  { "TubesByRaster", 2, Square, "stl", { "--engine", "raster", "--line-radius", "1" },
    { "--line-radius", "--engine ray" } },
  { "PointSizeOfSpheres", 0, Square, "stl", { "--point-radius", "1", "--point-size", "2" },
    { "warning", "--point-size has no effect with --point-radius" } },
  { "UnknownKernel", 2, Square, "stl",
    { "--engine", "raster", "--ambient-occlusion", "--ambient-occlusion-kernel", "steam" },
    { "--ambient-occlusion-kernel", "steam", "march" } },
  { "NoImage", 2, Square, "stl", { "--indirect", "--hdri-file", "nowhere.hdr" },
    { "--hdri-file", "nowhere.hdr" } },
  { "UnknownFalloff", 2, Square, "stl",
    { "--ambient-occlusion", "--ambient-occlusion-falloff", "steep" },
    { "--ambient-occlusion-falloff", "steep", "square-root" } },
  { "FalloffOfRaster", 2, Square, "stl",
    { "--engine", "raster", "--ambient-occlusion", "--ambient-occlusion-falloff", "linear" },
    { "--ambient-occlusion-falloff", "--engine ray" } },
  { "UnknownGatherer", 2, Square, "stl", { "--ambient-occlusion", "--gatherer", "steam" },
    { "--gatherer", "steam", "cube-map" } },
  { "ShadowsByRaster", 2, Square, "stl", { "--engine", "raster", "--shadows" },
    { "--shadows", "--engine ray" } },
  { "UnknownEngine", 2, Square, "stl", { "--engine", "steam" }, { "--engine", "steam", "raster" } },
  { "MissingValue", 2, Square, "stl", { "--resolution" }, { "--resolution" } },
  { "ZeroResolution", 2, Square, "stl", { "--resolution", "0,600" },
    { "--resolution", "1 to 65535" } },
  { "NegativeResolution", 2, Square, "stl", { "--resolution", "-5,5" }, { "--resolution" } },
  { "FractionalResolution", 2, Square, "stl", { "--resolution", "9.5,5" },
    { "--resolution", "2 integers" } },
  { "ExponentsInAResolution", 2, Square, "stl", { "--resolution", "1e2,1e2" },
    { "--resolution", "1e2,1e2", "2 integers" } },
  { "FractionInAResolution", 2, Square, "stl", { "--resolution", "100,60/2" },
    { "--resolution", "2 integers" } },
  { "ExponentOfAnInteger", 2, Square, "stl", { "--threads", "1e1" },
    { "--threads", "1e1", "an integer" } },
  { "AbsurdSide", 2, Square, "stl", { "--resolution", "65536,1" }, { "--resolution", "65535" } },
  { "MorePixelsThanMemory", 2, Square, "stl", { "--resolution", "65535,65535" },
    { "--resolution", "memory", "smaller" } },
  { "WordForANumber", 2, Square, "stl", { "--tolerance", "fine" }, { "--tolerance", "fine" } },
  { "ZeroTolerance", 2, Square, "stl", { "--tolerance", "0" }, { "--tolerance" } },
  { "DivisionByZero", 2, Square, "stl", { "--tolerance", "1/0" }, { "--tolerance", "1/0" } },
  { "TwoFractions", 2, Square, "stl", { "--tolerance", "1/2/" }, { "--tolerance", "1/2/" } },
  { "InfinitePosition", 2, Square, "stl", { "--camera-position", "inf,0,0" },
    { "--camera-position" } },
  { "TwoCoordinates", 2, Square, "stl", { "--camera-position", "1,2" },
    { "--camera-position", "3 numbers" } },
  { "FourCoordinates", 2, Square, "stl", { "--camera-position", "1,2,3,4" },
    { "--camera-position" } },
  { "NoDirection", 2, Square, "stl", { "--camera-direction", "0,0,0" }, { "--camera-direction" } },
  { "NoUp", 2, Square, "stl", { "--camera-view-up", "0,0,0" }, { "--camera-view-up" } },
  { "EyeAtItsFocus", 2, Square, "stl",
    { "--camera-position", "1,2,3", "--camera-focal-point", "1,2,3" }, { "--camera-focal-point" } },
  { "EyeAtAnotherFocus", 2, Square, "stl",
    { "--camera-position", "0,0,5", "--camera-focal-point", "0,0,5.00000000000001" },
    { "--camera-focal-point", "too close" } },
  { "HugeZoom", 2, Square, "stl", { "--camera-zoom-factor", "1e300" }, { "--camera-zoom-factor" } },
  { "TinyZoom", 2, Square, "stl", { "--camera-zoom-factor", "1e-300" },
    { "--camera-zoom-factor" } },
  { "ZoomIntoAPoint", 2, Square, "stl", { "--camera-zoom-factor", "1e20" },
    { "--camera-zoom-factor", "too close", "smaller" } },
  { "HugePosition", 2, Square, "stl", { "--camera-position", "1e308,0,0" },
    { "--camera-position", "1e+100" } },
  { "HugeFocus", 2, Square, "stl", { "--camera-focal-point", "0,1e200,0" },
    { "--camera-focal-point" } },
  { "HugeScale", 2, Square, "stl", { "--camera-orthographic", "--camera-parallel-scale", "1e300" },
    { "--camera-parallel-scale" } },
  { "TinyAngle", 2, Square, "stl", { "--camera-view-angle", "1e-300" }, { "--camera-view-angle" } },
  { "NegativeLightRadius", 2, Square, "stl", { "--light-radius=-1" }, { "--light-radius" } },
  { "NanLightRadius", 2, Square, "stl", { "--light-radius=nan" }, { "--light-radius" } },
  { "InfiniteLightRadius", 2, Square, "stl", { "--light-radius=inf" }, { "--light-radius" } },
  { "NegativeLightAngle", 2, Square, "stl", { "--light-angle=-0.5" }, { "--light-angle" } },
  { "LightAngleAbove180", 2, Square, "stl", { "--light-angle=181" }, { "--light-angle", "180" } },
  { "LightRadiusByRaster", 2, Square, "stl", { "--engine", "raster", "--light-radius", "1" },
    { "--light-radius", "--engine ray" } },
  { "HugeLight", 2, Square, "stl", { "--light-position", "1,1,1,1e-300" }, { "--light-position" } },
  { "HugeMesh", 2, "v 0 0 0\nv 1e200 0 0\nv 0 1e200 0\nf 1 2 3\n", "obj", {},
    { "meshes are too large" } },
  { "WideAngle", 2, Square, "stl", { "--camera-view-angle", "180" }, { "--camera-view-angle" } },
  { "ColorBeyondOne", 2, Square, "stl", { "--color", "255,0,0" }, { "--color", "from 0 to 1" } },
  { "UnknownColor", 2, Square, "stl", { "--color", "mud" }, { "--color", "mud", "#RRGGBB" } },
  { "NegativeOpacity", 2, Square, "stl", { "--opacity", "-1" }, { "--opacity" } },
  { "NegativeThreads", 2, Square, "stl", { "--threads", "-2" }, { "--threads" } },
  { "UnknownColormap", 2, Square, "stl", { "--scalar-coloring", "--colormap", "mud" },
    { "--colormap", "mud", "viridis" } },
  { "RangeReversed", 2, Square, "stl", { "--coloring-range", "2,1" }, { "--coloring-range" } },
  { "RangeOfWords", 2, Square, "stl", { "--coloring-range", "al" },
    { "--coloring-range: 'al' is neither `all` nor 2 numbers separated by commas" } },
  { "DirectionOfWords", 2, Square, "stl", { "--camera-direction", "up" },
    { "'up' is neither an axis such as +Z nor 3 numbers separated by commas" } },
  { "RadiusOfWords", 2, Square, "stl", { "--ambient-occlusion-radius", "all" },
    { "'all' is neither `inf` nor a number above 0" } },
  { "NoArrays", 2, Square, "stl", { "--scalar-coloring" }, { "--scalar-coloring", "none" } },
  { "UnknownArray", 2, Square, "stl", { "--coloring-array", "Heat" },
    { "--coloring-array", "Heat" } },
  { "LightNowhere", 2, Square, "stl", { "--light-position", "0,0,0,0" }, { "--light-position" } },

  // Output
  { "UnknownImage", 2, Square, "stl", { "--output", "image.webp" }, { "image.webp", ".png" } },
  { "NoFolder", 2, Square, "stl", { "--output", "/nowhere/at/all/image.png" },
    { "--output", "/nowhere/at/all/image.png", "folder" } },
  { "StatisticsNowhere", 2, Square, "stl", { "--statistics", "/nowhere/at/all/s.json" },
    { "--statistics", "folder" } },
  { "TransparentJpeg", 2, Square, "stl", { "--no-background", "--output", "image.jpg" },
    { "--no-background", "image.jpg", ".png" } },

  // Files
  { "NoFile", 2, nullptr, "stl", {}, { "mesh.stl", "no such file" } },
  { "EmptyFile", 2, "\n", "obj", {}, { "mesh.obj", "empty" } },
  { "UnknownExtension", 2, Square, "xyzzy", {}, { "mesh.xyzzy", "unknown extension", "list" } },
  { "NoExtension", 2, Square, "", {}, { "unknown extension" } },
  { "TextAsPly", 2, "hello\n", "ply", {}, { "mesh.ply", "damaged" } },
  { "TextAsStl", 2, "hello\n", "stl", {}, { "mesh.stl", "damaged" } },
  { "TextAsVtp", 2, "hello\n", "vtp", {}, { "mesh.vtp", "damaged" } },
  { "TextAsGltf", 2, "hello\n", "gltf", {}, { "mesh.gltf", "damaged" } },
  { "TextAsOff", 2, "hello\n", "off", {}, { "mesh.off", "damaged" } },
  { "OffOfTwoDimensions", 2, "nOFF\n2\n3 1 3\n0 0\n1 0\n0 1\n3 0 1 2\n", "off", {},
    { "mesh.off", "nOFF has vertices of another dimension" } },
  { "TextAsExodus", 2, "hello\n", "ex2", {}, { "mesh.ex2", "damaged" } },
  { "CutStl", 2, "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n", "stl", {},
    { "mesh.stl", "damaged" } },
  { "CutPly", 2,
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nend_header\n0 0 0\n1 0 0\n",
    "ply", {}, { "mesh.ply", "damaged" } },
  { "OnlyNanPoints", 2, "v nan nan nan\nv nan 0 0\nv 0 nan 0\nf 1 2 3\n", "obj", {},
    { "mesh.obj" } },
  { "IndexOutOfRange", 2, VtpOutOfRange, "vtp", {},
    { "mesh.vtp", "damaged", "point 7", "3 points" } },
  { "ObjIndexOutOfRange", 2, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "obj", {}, { "mesh.obj" } },
  { "CellWithTooFewCorners", 2, VtuWithShortHexahedron, "vtu", {},
    { "mesh.vtu", "damaged", "3 corners instead of 8" } },
  { "UnknownTypeOfCell", 2,
    "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 float\n0 0 0 1 0 0 "
    "0 1 0\n"
    "CELLS 2 8\n3 0 1 2\n3 0 1 2\nCELL_TYPES 2\n5\n99\n",
    "vtk", {}, { "mesh.vtk", "damaged", "cell 1 has the unknown type 99" } },
  { "NoMesh", 2, "# vtk DataFile Version 3.0\nempty\nASCII\nDATASET POLYDATA\nPOINTS 0 float\n",
    "vtk", {}, { "mesh.vtk", "empty" } },

  { "Table", 2,
    "# vtk DataFile Version 3.0\nt\nASCII\nDATASET TABLE\nROW_DATA 2\nFIELD f 1\nx 1 2 float\n1 "
    "2\n",
    "vtk", {}, { "mesh.vtk", "vtkTable cannot be rendered" } },
  { "FourDimensions", 2,
    "ObjectType = Image\nNDims = 4\nDimSize = 2 2 2 2\nElementType = MET_UCHAR\n"
    "ElementDataFile = LOCAL\n0123456789abcdef",
    "mha", {}, { "mesh.mha", "4 dimensions instead of 3" } },

  // Success with one warning
  { "NanPoint", 0, PlyWithNan, "ply", {},
    { "warning", "mesh.ply", "1 of 4 points", "not finite" } },
  { "TrianglesOnALine", 0, "v 0 0 0\nv .1 .1 .1\nv .3 .3 .3\nv .7 .7 .7\nf 1 2 3\nf 2 3 4\n", "obj",
    {}, { "warning", "mesh.obj", "the surface has no area" } },
  { "TrianglesOnALineByRaster", 0, "v 0 0 0\nv 1 1 1\nv 3 3 3\nf 1 2 3\n", "obj",
    { "--engine", "raster" }, { "warning", "mesh.obj", "the surface has no area" } },
  { "StlOfCoincidentCorners", 0,
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 0 0\nendloop\n"
    "endfacet\nendsolid a\n",
    "stl", {}, { "warning", "mesh.stl", "the surface has no area" } },
  { "SurfaceWithoutAreaNextToAnother", 0, "v 0 0 0\nv 1 1 1\nf 1 2 1\n", "obj",
    { SourceFolder() + "/Data/bracket.stl" },
    { "warning", "mesh.obj", "the surface has no area" } },
  { "StripOnALine", 0,
    "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 2 0 0 3 0 "
    "0\n"
    "TRIANGLE_STRIPS 1 5\n4 0 1 2 3\n",
    "vtk", {}, { "warning", "mesh.vtk", "the surface has no area" } },
  { "LinesOfCoincidentPoints", 0, "v 1 2 3\nv 1 2 3\nl 1 2\nl 1 2 1\n", "obj", {},
    { "warning", "mesh.obj", "the lines have no length" } },
  { "LinesOfCoincidentPointsByRaster", 0, "v 1 2 3\nv 1 2 3\nl 1 2\n", "obj",
    { "--engine", "raster" }, { "warning", "mesh.obj", "the lines have no length" } },
  { "TubesOfCoincidentPoints", 0, "v 1 2 3\nv 1 2 3\nl 1 2\n", "obj", { "--line-radius", "1" },
    { "warning", "mesh.obj", "the lines have no length" } },
  { "LinesAndTrianglesOfCoincidentPoints", 0, "v 1 2 3\nv 1 2 3\nl 1 2\nf 1 2 1\n", "obj", {},
    { "warning", "mesh.obj", "the surface has no area" } },
  { "LookingAway", 0, Square, "stl",
    { "--camera-position", "0,0,5", "--camera-focal-point", "0,0,9" },
    { "warning", "no surface is in view", "--camera" } },
  { "BlackOnBlack", 0, Square, "stl", { "--color", "0,0,0" },
    { "warning", "color of the background", "colors" } },
  { "HugeParallelScale", 0, Square, "stl",
    { "--camera-orthographic", "--camera-parallel-scale", "1e20" },
    { "warning", "no surface is in view" } },
  { "FarAway", 0, Square, "stl", { "--camera-position", "0,0,1e99" },
    { "warning", "no surface is in view" } },
  { "RadiusWithoutOcclusion", 0, Square, "stl", { "--ambient-occlusion-radius", "1" },
    { "warning", "--ambient-occlusion-radius has no effect without --ambient-occlusion" } },
  { "ImageWithoutIndirectLight", 0, Square, "stl", { "--hdri-file", "sky.hdr" },
    { "warning", "--hdri-file has no effect without --indirect" } },
  { "UpWithoutAnImage", 0, Square, "stl", { "--indirect", "--hdri-up", "0,0,1" },
    { "warning", "--hdri-up has no effect without --hdri-file" } },
  { "FalloffWithoutOcclusion", 0, Square, "stl", { "--ambient-occlusion-falloff", "linear" },
    { "warning", "--ambient-occlusion-falloff has no effect without --ambient-occlusion" } },
  { "StrengthWithoutOcclusion", 0, Square, "stl", { "--ambient-occlusion-strength", "1" },
    { "warning", "--ambient-occlusion-strength has no effect" } },
  { "AwarenessWithoutOcclusion", 0, Square, "stl", { "--ambient-occlusion-light-awareness", "1" },
    { "warning", "--ambient-occlusion-light-awareness has no effect without" } },
  { "AwarenessByRays", 0, Square, "stl",
    { "--ambient-occlusion", "--ambient-occlusion-light-awareness", "1" },
    { "warning", "--ambient-occlusion-light-awareness has no effect with --engine ray" } },
  { "ScaleInPerspective", 0, Square, "stl", { "--camera-parallel-scale", "2" },
    { "warning", "--camera-parallel-scale has no effect without --camera-orthographic" } },
  { "AngleInParallel", 0, Square, "stl", { "--camera-view-angle", "20", "--camera-orthographic" },
    { "warning", "--camera-view-angle has no effect" } },
  { "ZoomFromAPosition", 0, Square, "stl",
    { "--camera-zoom-factor", "2", "--camera-position", "0,0,9" },
    { "warning", "--camera-zoom-factor has no effect with --camera-position" } },
  { "DirectionFromAPosition", 0, Square, "stl",
    { "--camera-direction", "1,0,0", "--camera-position", "0,0,9" },
    { "warning", "--camera-direction has no effect with --camera-position" } },
  { "LightWithoutLighting", 0, Square, "stl", { "--light-position", "0,0,9", "--no-lighting" },
    { "warning", "--light-position has no effect with --no-lighting" } },
  { "RadiusOfADirectionalLight", 0, Square, "stl",
    { "--light-position", "0,1,1,0", "--light-radius", "1" },
    { "warning", "--light-radius has no effect without a positional" } },
  { "LightInASurface", 0, Square, "stl",
    { "--light-position", "0.5,0.5,0.2", "--light-radius", "1" },
    { "warning", "light at (0.5, 0.5, 0.2)", "contains or touches a surface" } },
  { "ShadowsOfTheHeadlight", 0, Square, "stl", { "--shadows" },
    { "warning", "--shadows has no effect without --light-position" } },
  { "PhaseWithoutShafts", 0, Square, "stl", { "--shafts-phase", "rayleigh" },
    { "warning", "--shafts-phase has no effect without --light-shafts" } },
  { "EstimatorWithoutShafts", 0, Square, "stl", { "--shafts-estimator", "depth" },
    { "warning", "--shafts-estimator has no effect without --light-shafts" } },
  { "BaseHeightWithoutFalloff", 0, Square, "stl",
    { "--light-shafts", "--light-position", "1,2,3,0", "--shafts-base-height", "1" },
    { "warning", "--shafts-base-height has no effect without --shafts-scale-height" } },
  { "RangeWithoutColoring", 0, Square, "stl", { "--coloring-range", "1,2" },
    { "warning", "--coloring-range has no effect without --scalar-coloring" } },
  { "ColormapWithoutColoring", 0, Square, "stl", { "--colormap", "gray" },
    { "warning", "--colormap has no effect without --scalar-coloring" } },
  { "TitleWithoutBar", 0, Square, "stl", { "--scalar-bar-title", "z" },
    { "warning", "--scalar-bar-title has no effect without --coloring-scalar-bar" } },
  { "GathererOfNothing", 0, Square, "stl", { "--gatherer", "cube-map" },
    { "warning", "--gatherer has no effect without --ambient-occlusion or --indirect" } },
  { "WindowOfTheRayEngine", 0, Square, "stl", { "--window", "x" },
    { "warning", "--window has no effect with --engine ray" } },
  { "LevelByRaster", 0, Square, "stl", { "--engine", "raster", "--max-level", "2" },
    { "warning", "--max-level has no effect with --engine raster" } },
  { "KernelByRays", 0, Square, "stl",
    { "--ambient-occlusion", "--ambient-occlusion-kernel", "march" },
    { "warning", "--ambient-occlusion-kernel has no effect with --engine ray" } },
  { "FramesByRays", 0, Square, "stl", { "--frames", "4" },
    { "warning", "--frames has no effect with --engine ray" } },
  { "JobsOfOneImage", 0, Square, "stl", { "--jobs", "2" },
    { "warning", "--jobs has no effect without several files" } },
  { "AllTransparent", 0, Square, "stl", { "--opacity", "0" },
    { "warning", "transparent", "--opacity" } },

  // Success without messages
  { "DegenerateTriangle", 0, ObjWithDegenerateTriangle, "obj", {}, {} },
  { "EyeInTheSurface", 0, Square, "stl", { "--camera-position", "0,0,0.001" }, {} },
  { "FractionForANumber", 0, Square, "stl", { "--tolerance", "1/128" }, {} },
  { "SmallTriangleFarFromTheOrigin", 0, "v 4e6 0 0\nv 4000001 0 0\nv 4e6 .5 0\nf 1 2 3\n", "obj",
    {}, {} },
  { "OnePixel", 0, Square, "stl", { "--resolution", "1,1" }, {} },
  { "ShortDirection", 0, Square, "stl",
    { "--camera-direction", "1e-200,0,-1e-200", "--camera-view-up", "0,1e-300,0" }, {} },
  { "LongDirection", 0, Square, "stl", { "--camera-direction", "1e300,0,-1e300" }, {} },
  { "ShortLight", 0, Square, "stl", { "--light-position", "0,0,1e-300,0" }, {} },
};

class BadInput : public testing::TestWithParam<Row>
{
};

TEST_P(BadInput, PrintsOneLine)
{
  const Row& row = GetParam();
  const Folder folder("bad-input");
  std::string mesh = folder / "mesh";
  mesh += *row.Extension ? std::string(".") + row.Extension : "";
  std::vector<std::string> before;
  if (row.File)
  {
    WriteText(mesh, row.File == Square ? SquareStl() : row.File);
    before = folder.List();
  }
  std::vector<std::string> arguments = { "render", mesh, "--resolution", "16,16", "--output",
    folder / "image.png" };
  for (std::size_t i = 0; i < row.Options.size(); ++i)
  {
    const bool isImage = row.Options[i].rfind("image.", 0) == 0;
    arguments.push_back(isImage ? folder / row.Options[i] : row.Options[i]);
  }

  const ProgramResult outcome = RunProgram(arguments);
  EXPECT_EQ(outcome.Status, row.Status) << outcome.Errors;
  EXPECT_EQ(outcome.Output, "");
  EXPECT_EQ(CountLines(outcome.Errors), row.Words.empty() ? 0 : 1) << outcome.Errors;
  for (const char* word : row.Words)
  {
    EXPECT_NE(outcome.Errors.find(word), std::string::npos) << word << " in " << outcome.Errors;
  }
  if (row.Status == 0)
  {
    before.insert(std::upper_bound(before.begin(), before.end(), "image.png"), "image.png");
  }
  EXPECT_EQ(folder.List(), before);
}

std::string NameOf(const testing::TestParamInfo<Row>& row)
{
  return row.param.Name;
}

INSTANTIATE_TEST_SUITE_P(Table, BadInput, testing::ValuesIn(Rows), NameOf);

TEST(Folders, AreNoFiles)
{
  const Folder folder("folders");
  const ProgramResult outcome =
    RunProgram({ "render", folder.Path, "--output", folder / "image.png" });
  EXPECT_EQ(outcome.Status, 2);
  EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
  EXPECT_NE(outcome.Errors.find("the path is a folder"), std::string::npos) << outcome.Errors;
}

TEST(Folders, OfDecomposedCasesAreNamed)
{
  const Folder folder("decomposed");
  std::filesystem::create_directories(folder / "processor0/constant");
  WriteText(folder / "a.foam", "");
  const ProgramResult outcome =
    RunProgram({ "render", folder / "a.foam", "--output", folder / "image.png" });
  EXPECT_EQ(outcome.Status, 2);
  EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
  EXPECT_NE(outcome.Errors.find("reconstructPar"), std::string::npos) << outcome.Errors;
}

TEST(Blocks, WithoutSurfacesCauseOneWarning)
{
  const Folder folder("blocks");
  WriteText(folder / "a.stl", SquareStl());
  ASSERT_EQ(RunProgram({ "bake", folder / "a.stl", "--output", folder / "a.vtp" }).Status, 0);
  WriteText(folder / "t.vtt",
    R"(<VTKFile type="Table" version="0.1" byte_order="LittleEndian"><Table>
<Piece NumberOfCols="1" NumberOfRows="2"><RowData><DataArray type="Float32" Name="x" format="ascii">1 2</DataArray>
</RowData></Piece></Table></VTKFile>)");
  WriteText(folder / "a.vtm",
    R"(<VTKFile type="vtkMultiBlockDataSet" version="1.0" byte_order="LittleEndian"><vtkMultiBlockDataSet>
<DataSet index="0" file="a.vtp"/><DataSet index="1" file="t.vtt"/></vtkMultiBlockDataSet></VTKFile>)");
  for (const char* command : { "render", "bake" })
  {
    const std::string output = folder / (command == std::string("bake") ? "b.vtp" : "b.png");
    const ProgramResult outcome = RunProgram({ command, folder / "a.vtm", "--output", output });
    EXPECT_EQ(outcome.Status, 0);
    EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
    EXPECT_NE(outcome.Errors.find("a.vtm: blocks of the class vtkTable"), std::string::npos)
      << outcome.Errors;
  }
}

TEST(Lists, AreNamedWithTheFirstFileThatCannotBeRead)
{
  const Folder folder("lists");
  WriteText(folder / "a.stl", SquareStl());
  ASSERT_EQ(RunProgram({ "bake", folder / "a.stl", "--output", folder / "a.vtp" }).Status, 0);
  WriteText(folder / "damaged.vtp", ReadText(folder / "a.vtp").substr(0, 600));
  const auto wrap = [](const std::string& type, const std::string& element) {
    return "<VTKFile type=\"" + type + "\" version=\"1.0\"><" + element + ">";
  };
  for (const std::string piece : { "damaged.vtp", "missing.vtp" })
  {
    const std::string files = "<DataSet index=\"0\" timestep=\"0\" file=\"a.vtp\"/>"
                              "<DataSet index=\"1\" timestep=\"0\" file=\"" +
      piece + "\"/>";
    WriteText(
      folder / "list.pvd", wrap("Collection", "Collection") + files + "</Collection></VTKFile>");
    WriteText(folder / "list.vtm",
      wrap("vtkMultiBlockDataSet", "vtkMultiBlockDataSet") + files +
        "</vtkMultiBlockDataSet></VTKFile>");
    WriteText(folder / "list.pvtp",
      wrap("PPolyData", "PPolyData") +
        "<PPoints><PDataArray type=\"Float32\" NumberOfComponents=\"3\"/></PPoints>"
        "<Piece Source=\"a.vtp\"/><Piece Source=\"" +
        piece + "\"/></PPolyData></VTKFile>");
    std::vector<std::string> lists = { "list.pvd", "list.vtm" };
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0) // before, the reader of parallel files crashes
    lists.push_back("list.pvtp");
#endif
    for (const std::string& list : lists)
    {
      const ProgramResult outcome =
        RunProgram({ "render", folder / list, "--output", folder / "image.png" });
      EXPECT_EQ(outcome.Status, 2);
      EXPECT_EQ(CountLines(outcome.Errors), 1) << outcome.Errors;
      const std::string message = folder / list + ": " + (folder / piece) +
        (piece == "missing.vtp" ? ": no such file" : ": the file is damaged or not VTK polygons");
      EXPECT_NE(outcome.Errors.find(message), std::string::npos) << message << '\n'
                                                                 << outcome.Errors;
    }
  }
}

TEST(InvalidUsage, PrintsOneLineError)
{
  const Folder folder("bad-use");
  WriteText(folder / "square.stl", SquareStl());
  WriteText(folder / "notes.png", "these are notes");
  ASSERT_EQ(RunProgram({ "render", folder / "square.stl", "--resolution", "8,8", "--output",
                         folder / "small.png" })
              .Status,
    0);
  ASSERT_EQ(RunProgram({ "render", folder / "square.stl", "--resolution", "9,8", "--output",
                         folder / "large.png" })
              .Status,
    0);
  ASSERT_EQ(RunProgram({ "render", folder / "square.stl", "--resolution", "8,8", "--output",
                         folder / "grid.vti" })
              .Status,
    0);
  const std::vector<std::vector<std::string>> commands = {
    {},
    { "animate" },
    { "bake", folder / "square.stl" },
    { "bake", folder / "square.stl", "--output", folder / "baked.png" },
    { "bake", folder / "square.stl", "--output", folder / "baked.vtp", "--radius", "0" },
    { "bake", folder / "square.stl", "--output", folder / "baked.vtp", "--tolerance", "-1" },
    { "bake", folder / "missing.stl", "--output", folder / "baked.vtp" },
    { "render" },
    { "render", folder / "square.stl" },
    { "render", "--output", folder / "p.png" },
    { "render", folder.Path, "--output", folder / "p.png" },
    { "render", folder / "square.stl", "--output", folder.Path },
    { "render", folder / "grid.vti", "--output", folder.Path + "/./grid.vti" },
    { "render", folder / "square.stl", "--output", folder / "p.png", "--statistics",
      folder / "square.stl" },
    { "render", folder / "square.stl", "--output", folder / "p.png", "--statistics",
      folder.Path + "/./p.png" },
    { "render", folder / "square.stl", "--output", folder / std::string(252, 'p') + ".png" },
    { "compare", folder / "small.png", folder / "small.png", "--difference",
      folder.Path + "/./small.png" },
    { "frobnicate" },
    { "render", folder / "square.stl", folder / "square.stl", "--output", folder / "{name}.png" },
    { "render", folder / "square.stl", "--output", folder / "p.png", "--statistics",
      folder / "{name}.json" },
    { "compare" },
    { "compare", folder / "small.png" },
    { "compare", folder / "small.png", folder / "missing.png" },
    { "compare", folder / "small.png", folder / "notes.png" },
    { "compare", folder / "small.png", folder / "square.stl" },
    { "compare", folder / "small.png", folder / "large.png" },
    { "compare", folder / "small.png", folder / "small.png", "--metric", "taste" },
    { "compare", folder / "small.png", folder / "small.png", "--threshold", "-1" },
  };
  const std::vector<std::string> before = folder.List();
  for (const std::vector<std::string>& command : commands)
  {
    const ProgramResult outcome = RunProgram(command);
    const std::string name = testing::PrintToString(command);
    EXPECT_EQ(outcome.Status, 2) << name;
    EXPECT_EQ(CountLines(outcome.Errors), 1) << name << outcome.Errors;
    EXPECT_EQ(outcome.Output, "") << name;
  }
  EXPECT_EQ(folder.List(), before);
}

TEST(InvalidUsage, NamesUnknownSubcommand)
{
  EXPECT_NE(
    RunProgram({ "frobnicate" }).Errors.find("frobnicate: unknown subcommand"), std::string::npos);
  EXPECT_NE(RunProgram({ "--frob" }).Errors.find("--frob: unknown option"), std::string::npos);
  EXPECT_NE(RunProgram({}).Errors.find("no subcommand given"), std::string::npos);
}

TEST(InvalidUsage, NamesWhatUnknownWordsResemble)
{
  const std::vector<std::pair<std::vector<std::string>, std::string>> rows = {
    { { "rendr", "mesh.stl" }, "rendr: unknown subcommand; did you mean render?" },
    { { "help" }, "help: unknown subcommand; did you mean --help?" },
    { { "--list" }, "--list: unknown option; see" },
    { { "render", "mesh.stl", "--ouptut", "a.png" }, "did you mean --output?" },
    { { "render", "mesh.stl", "--background", "1,1,1" }, "did you mean --background-color?" },
    { { "render", "mesh.stl", "--size", "9,9" }, "did you mean --point-size?" },
    { { "render", "mesh.stl", "--sparkle" }, "--sparkle: unknown option; see" },
    { { "render", "mesh.stl", "--at", "9" }, "--at: unknown option; see" },
    { { "render", "mesh.stl", "-w", "9" }, "-w: unknown option; see" },
    { { "info", "mesh.stl" }, "mesh.stl: unexpected argument; see" },
    { { "bake", "mesh.stl", "mesh.ply" }, "--output is required; see" },
    { { "render", "mesh.stl", "--samples" }, "penumbra: --samples: 1 required" }, // hidden
  };
  for (const auto& [arguments, expected] : rows)
  {
    const std::string errors = RunProgram(arguments).Errors;
    EXPECT_NE(errors.find(expected), std::string::npos) << errors;
  }
}

// Instead of the required option that is missing because of it.
TEST(InvalidUsage, NamesUnknownOptionsBeforeMissingOnes)
{
  const std::vector<std::vector<std::string>> rows = { { "-o", "image.png" },
    { "--ouptut", "image.png" }, { "--ouptut=image.png" } };
  for (const std::vector<std::string>& row : rows)
  {
    std::vector<std::string> arguments = { "render", "mesh.stl" };
    arguments.insert(arguments.end(), row.begin(), row.end());
    const std::string option = row[0].substr(0, row[0].find('='));
    EXPECT_EQ(RunProgram(arguments).Errors.rfind("penumbra: " + option + ": ", 0), 0u);
  }
  EXPECT_NE(
    RunProgram({ "render", "mesh.stl" }).Errors.find("--output is required"), std::string::npos);
}

}
