// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes.h"

#include "Program.h"

#include "vtkAppendFilter.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetWriter.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkGeometryFilter.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkOBJWriter.h"
#include "vtkPLYWriter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSTLWriter.h"
#include "vtkSphereSource.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLImageDataWriter.h"
#include "vtkXMLMultiBlockDataWriter.h"
#include "vtkXMLPolyDataWriter.h"
#include "vtkXMLRectilinearGridWriter.h"
#include "vtkXMLStructuredGridWriter.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>

namespace penumbra_testing
{

namespace
{

vtkSmartPointer<vtkPolyData> Sphere()
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(0.5);
  source->SetThetaResolution(12);
  source->SetPhiResolution(8);
  source->GenerateNormalsOff();
  source->Update();
  return source->GetOutput();
}

template <typename Writer>
void Write(vtkDataObject* data, const std::string& path)
{
  vtkNew<Writer> writer;
  writer->SetInputData(data);
  writer->SetFileName(path.c_str());
  writer->Write();
}

void WriteOff(vtkPolyData* mesh, const std::string& path)
{
  std::ofstream file(path);
  file << "OFF\n" << mesh->GetNumberOfPoints() << " " << mesh->GetNumberOfCells() << " 0\n";
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    const double* x = mesh->GetPoint(i);
    file << x[0] << " " << x[1] << " " << x[2] << "\n";
  }
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    mesh->GetCellPoints(i, corners);
    file << "3 " << corners->GetId(0) << " " << corners->GetId(1) << " " << corners->GetId(2)
         << "\n";
  }
}

// glTF with a separate buffer file.
void WriteGltf(vtkPolyData* mesh, const std::string& folder)
{
  std::ofstream buffer(folder + "/sphere.bin", std::ios::binary);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    const double* x = mesh->GetPoint(i);
    const float position[3] = { float(x[0]), float(x[1]), float(x[2]) };
    buffer.write(reinterpret_cast<const char*>(position), sizeof(position));
  }
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    mesh->GetCellPoints(i, corners);
    for (int c = 0; c < 3; ++c)
    {
      const auto index = static_cast<unsigned int>(corners->GetId(c));
      buffer.write(reinterpret_cast<const char*>(&index), sizeof(index));
    }
  }
  const vtkIdType pointBytes = 12 * mesh->GetNumberOfPoints();
  const vtkIdType indexBytes = 12 * mesh->GetNumberOfCells();
  std::ofstream(folder + "/sphere.gltf")
    << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
    << R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
    << R"("buffers":[{"uri":"sphere.bin","byteLength":)" << pointBytes + indexBytes << "}],"
    << R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":)" << pointBytes
    << R"(},{"buffer":0,"byteOffset":)" << pointBytes << R"(,"byteLength":)" << indexBytes << "}],"
    << R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)"
    << mesh->GetNumberOfPoints() << R"(,"min":[-0.5,-0.5,-0.5],"max":[0.5,0.5,0.5]},)"
    << R"({"bufferView":1,"componentType":5125,"type":"SCALAR","count":)"
    << 3 * mesh->GetNumberOfCells() << "}]}";
}

// Boxes in the structured formats: 5 x 5 x 5 points centered at the origin.
void WriteGrids(const std::string& folder)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(5, 5, 5);
  image->SetOrigin(-0.5, -0.5, -0.5);
  image->SetSpacing(0.25, 0.25, 0.25);
  image->AllocateScalars(VTK_FLOAT, 1);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    image->GetPointData()->GetScalars()->SetComponent(i, 0, static_cast<double>(i % 7));
  }
  Write<vtkXMLImageDataWriter>(image, folder + "/box.vti");

  vtkNew<vtkFloatArray> axis;
  for (int i = 0; i < 5; ++i)
  {
    axis->InsertNextValue(0.25f * i - 0.5f);
  }
  vtkNew<vtkRectilinearGrid> rectilinear;
  rectilinear->SetDimensions(5, 5, 5);
  rectilinear->SetXCoordinates(axis);
  rectilinear->SetYCoordinates(axis);
  rectilinear->SetZCoordinates(axis);
  Write<vtkXMLRectilinearGridWriter>(rectilinear, folder + "/box.vtr");

  vtkNew<vtkPoints> points;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    points->InsertNextPoint(image->GetPoint(i));
  }
  vtkNew<vtkStructuredGrid> structured;
  structured->SetDimensions(5, 5, 5);
  structured->SetPoints(points);
  Write<vtkXMLStructuredGridWriter>(structured, folder + "/box.vts");
}

}

namespace
{

std::string Chunk(std::uint16_t id, const std::string& contents)
{
  const auto length = static_cast<std::uint32_t>(contents.size() + 6);
  return std::string(reinterpret_cast<const char*>(&id), 2) +
    std::string(reinterpret_cast<const char*>(&length), 4) + contents;
}

std::string Words(const std::vector<std::uint16_t>& words)
{
  return std::string(reinterpret_cast<const char*>(words.data()), 2 * words.size());
}

std::string Floats(const std::vector<float>& values)
{
  return std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
}

}

std::string Make3ds()
{
  const std::string end(1, '\0');
  const std::string name = "red" + end;
  const auto color = [](char r, char g, char b) { return Chunk(0x0011, std::string({ r, g, b })); };
  const std::string material = Chunk(0xafff,
    Chunk(0xa000, name) + Chunk(0xa010, color(0, 0, 0)) +
      Chunk(0xa020, color(static_cast<char>(200), 20, 30)) + Chunk(0xa030, color(-1, -1, -1)));
  const std::string points =
    Chunk(0x4110, Words({ 4 }) + Floats({ 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 }));
  const std::string faces =
    Chunk(0x4120, Words({ 2, 0, 1, 2, 7, 0, 2, 3, 7 }) + Chunk(0x4130, name + Words({ 2, 0, 1 })));
  const std::string object = Chunk(0x4000, "square" + end + Chunk(0x4100, points + faces));
  const std::string camera = Chunk(
    0x4000, "view" + end + Chunk(0x4700, Floats({ 0.5f, 0.5f, 6.f, 0.5f, 0.5f, 0.f, 0.f, 50.f })));
  return Chunk(0x4d4d, Chunk(0x3d3d, material + object + camera));
}

std::string SquareStl()
{
  return "solid square\n"
         "facet normal 0 0 1\nouter loop\n"
         "vertex -1 -1 0\nvertex 1 -1 0\nvertex 1 1 0\nendloop\nendfacet\n"
         "facet normal 0 0 1\nouter loop\n"
         "vertex -1 -1 0\nvertex 1 1 0\nvertex -1 1 0\nendloop\nendfacet\n"
         "endsolid square\n";
}

std::vector<std::string> WriteSpheres(const std::string& folder)
{
  const vtkSmartPointer<vtkPolyData> sphere = Sphere();
  vtkNew<vtkSTLWriter> stl;
  stl->SetInputData(sphere);
  stl->SetFileName((folder + "/sphere.stl").c_str());
  stl->SetFileTypeToBinary();
  stl->Write();
  WriteText(folder + "/square.stl", SquareStl());
  Write<vtkPLYWriter>(sphere, folder + "/sphere.ply");
  Write<vtkOBJWriter>(sphere, folder + "/sphere.obj");
  Write<vtkXMLPolyDataWriter>(sphere, folder + "/sphere.vtp");
  Write<vtkDataSetWriter>(sphere, folder + "/sphere.vtk");
  WriteOff(sphere, folder + "/sphere.off");
  WriteGltf(sphere, folder);
  vtkNew<vtkAppendFilter> grid;
  grid->SetInputData(sphere);
  grid->Update();
  Write<vtkXMLUnstructuredGridWriter>(grid->GetOutput(), folder + "/sphere.vtu");
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, sphere);
  blocks->SetBlock(1, grid->GetOutput());
  Write<vtkXMLMultiBlockDataWriter>(blocks, folder + "/sphere.vtm");
  WriteGrids(folder);
  return { "sphere.stl", "square.stl", "sphere.ply", "sphere.obj", "sphere.vtp", "sphere.vtk",
    "sphere.off", "sphere.gltf", "sphere.vtu", "sphere.vtm", "box.vti", "box.vtr", "box.vts" };
}

void WriteSphereWithArrays(const std::string& path)
{
  const vtkSmartPointer<vtkPolyData> sphere = Sphere();
  vtkNew<vtkDoubleArray> height;
  height->SetName("Height");
  vtkNew<vtkFloatArray> direction;
  direction->SetName("Direction");
  direction->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < sphere->GetNumberOfPoints(); ++i)
  {
    const double* x = sphere->GetPoint(i);
    height->InsertNextValue(x[2]);
    direction->InsertNextTuple3(2 * x[0], 2 * x[1], 2 * x[2]);
  }
  vtkNew<vtkIdTypeArray> number;
  number->SetName("Number");
  for (vtkIdType i = 0; i < sphere->GetNumberOfCells(); ++i)
  {
    number->InsertNextValue(i);
  }
  sphere->GetPointData()->AddArray(height);
  sphere->GetPointData()->AddArray(direction);
  sphere->GetCellData()->AddArray(number);
  Write<vtkXMLPolyDataWriter>(sphere, path);
}

}
