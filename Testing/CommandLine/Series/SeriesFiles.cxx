// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SeriesFiles.h"

#include "vtkVersion.h"

#include <filesystem>

namespace penumbra_testing
{

namespace
{

const char* const Times[] = { "0", "0.5", "1.5" };

void WriteEnSight(const Folder& folder)
{
  WriteText(folder / "steps.case",
    "FORMAT\ntype: ensight gold\n\nGEOMETRY\nmodel: steps.geo\n\nVARIABLE\n"
    "scalar per node: 1 T T.***\n\nTIME\ntime set: 1\nnumber of steps: 3\n"
    "filename start number: 0\nfilename increment: 1\ntime values:\n0 0.5 1.5\n");
  WriteText(folder / "steps.geo",
    "title\nmore\nnode id assign\nelement id assign\npart\n1\nonly\ncoordinates\n4\n"
    "-1\n1\n1\n-1\n-1\n-1\n1\n1\n0\n0\n0\n0\nquad4\n1\n1 2 3 4\n");
  for (int step = 0; step < 3; ++step)
  {
    const std::string value = std::to_string(step) + "\n";
    WriteText(folder / ("T.00" + std::to_string(step)),
      "T\npart\n1\ncoordinates\n" + value + value + value + value);
  }
}

void WriteFoam(const Folder& folder)
{
  const auto write = [&](const std::string& path, const std::string& type,
                       const std::string& content) {
    std::filesystem::create_directories(std::filesystem::path(folder / path).parent_path());
    WriteText(folder / path,
      "FoamFile\n{\nversion 2.0;\nformat ascii;\nclass " + type + ";\nobject " +
        std::filesystem::path(path).filename().string() + ";\n}\n" + content);
  };
  write("foam/system/controlDict", "dictionary",
    "startFrom startTime;\nstartTime 0;\nstopAt endTime;\nendTime 1.5;\ndeltaT 0.5;\n"
    "writeControl timeStep;\nwriteInterval 1;\n");
  const std::string mesh = "foam/constant/polyMesh/";
  write(mesh + "points", "vectorField",
    "8\n(\n(-1 -1 -1)\n(1 -1 -1)\n(1 1 -1)\n(-1 1 -1)\n(-1 -1 0)\n(1 -1 0)\n(1 1 0)\n(-1 1 "
    "0)\n)\n");
  write(mesh + "faces", "faceList",
    "6\n(\n4(0 3 2 1)\n4(4 5 6 7)\n4(0 1 5 4)\n4(3 7 6 2)\n4(0 4 7 3)\n4(1 2 6 5)\n)\n");
  write(mesh + "owner", "labelList", "6\n(\n0\n0\n0\n0\n0\n0\n)\n");
  write(mesh + "neighb" + "our", "labelList", "0\n(\n)\n"); // spelled as by OpenFOAM
  write(mesh + "boundary", "polyBoundaryMesh",
    "1\n(\nwall\n{\ntype wall;\nnFaces 6;\nstartFace 0;\n}\n)\n");
  for (int step = 0; step < 3; ++step)
  {
    write(std::string("foam/") + Times[step] + "/T", "volScalarField",
      "dimensions [0 0 0 1 0 0 0];\ninternalField uniform " + std::to_string(step) +
        ";\nboundaryField\n{\nwall\n{\ntype zeroGradient;\n}\n}\n");
  }
  WriteText(folder / "foam/steps.foam", ""); // as by "touch"
}

void WriteXdmf(const Folder& folder)
{
  std::string text = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\"><Domain>"
                     "<Grid Name=\"steps\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (int step = 0; step < 3; ++step)
  {
    const std::string value = std::to_string(step);
    text += "<Grid Name=\"step" + value + "\"><Time Value=\"" + Times[step] +
      "\"/><Topology TopologyType=\"Quadrilateral\" NumberOfElements=\"1\">"
      "<DataItem Dimensions=\"4\" Format=\"XML\">0 1 2 3</DataItem></Topology>"
      "<Geometry GeometryType=\"XYZ\"><DataItem Dimensions=\"4 3\" Format=\"XML\">"
      "-1 -1 0 1 -1 0 1 1 0 -1 1 0</DataItem></Geometry>"
      "<Attribute Name=\"T\" Center=\"Node\"><DataItem Dimensions=\"4\" Format=\"XML\">" +
      value + " " + value + " " + value + " " + value + "</DataItem></Attribute></Grid>\n";
  }
  WriteText(folder / "steps.xdmf", text + "</Grid></Domain></Xdmf>\n");
}

// A glTF square whose node moves linearly from x = 0 to x = 3 in 1.5 s.
void WriteAnimation(const Folder& folder)
{
  const float numbers[] = { -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, -1, 0, 1, 1, 0, -1, 1, 0, 0.0f, 1.5f,
    0, 0, 0, 3, 0, 0 };
  WriteText(
    folder / "steps.bin", std::string(reinterpret_cast<const char*>(numbers), sizeof(numbers)));
  WriteText(folder / "steps.gltf",
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"buffers":[{"byteLength":104,"uri":"steps.bin"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":72},
{"buffer":0,"byteOffset":72,"byteLength":8},{"buffer":0,"byteOffset":80,"byteLength":24}],
"accessors":[{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[1.5]},
{"bufferView":2,"componentType":5126,"count":2,"type":"VEC3"}],
"animations":[{"samplers":[{"input":1,"output":2}],
"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}]}]})");
}

}

std::string SquareWithValue(double x, double value)
{
  std::string text = "# vtk DataFile Version 3.0\nstep\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n";
  for (const auto& corner : { std::make_pair(-1, -1), { 1, -1 }, { 1, 1 }, { -1, 1 } })
  {
    text += std::to_string(x + corner.first) + " " + std::to_string(corner.second) + " 0\n";
  }
  text += "POLYGONS 1 5\n4 0 1 2 3\nPOINT_DATA 4\nSCALARS T double\nLOOKUP_TABLE default\n";
  for (int i = 0; i < 4; ++i)
  {
    text += std::to_string(value) + "\n";
  }
  return text;
}

void WriteFileSeries(const Folder& folder)
{
  std::string collection = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\"><Collection>\n";
  std::string series = "{\"file-series-version\": \"1.0\", \"files\": [";
  for (int step = 2; step >= 0; --step)
  {
    const std::string name = "run_" + std::to_string(8 + step) + ".vtk";
    WriteText(folder / name, SquareWithValue(0.25 * step, step));
    collection += std::string("<DataSet timestep=\"") + Times[step] +
      "\" group=\"\" part=\"0\" file=\"" + name + "\"/>\n";
    series += std::string(step < 2 ? "," : "") + "{\"name\": \"" + name +
      "\", \"time\": " + Times[step] + "}";
  }
  WriteText(folder / "run.pvd", collection + "</Collection></VTKFile>\n");
  WriteText(folder / "run.vtk.series", series + "]}\n");
}

std::vector<SeriesFile> WriteSeries(const Folder& folder)
{
  WriteFileSeries(folder);
  WriteEnSight(folder);
  WriteFoam(folder);
  WriteAnimation(folder);
  std::vector<SeriesFile> series = { { folder / "run.pvd" }, { folder / "run.vtk.series" },
    { folder / "steps.case" }, { folder / "foam/steps.foam" }, { folder / "steps.gltf", false } };
  WriteXdmf(folder);
  const std::string readers = RunProgram({ "list" }).Output;
  const struct
  {
    const char* Reader;
    std::string Path;
  } optional[] = {
    { "vtkXdmfReader", folder / "steps.xdmf" },
    { "vtkExodusIIReader", SourceFolder() + "/Testing/CommandLine/Series/Data/steps.e" },
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0) // before, only the first step is read
    { "vtkHDFReader", SourceFolder() + "/Testing/CommandLine/Series/Data/steps.vtkhdf" },
#endif
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 7, 0) // of composite data
    { "vtkHDFReader", SourceFolder() + "/Testing/CommandLine/Series/Data/blocks.vtkhdf" },
#endif
    { "vtkCGNSReader", SourceFolder() + "/Testing/CommandLine/Series/Data/steps.cgns" }
  };
  for (const auto& row : optional)
  {
    if (readers.find(row.Reader) != std::string::npos)
    {
      series.push_back({ row.Path });
    }
  }
  return series;
}

}
