// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SampleFiles.h"

#include "Meshes.h"
#include "Program.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMetaImageWriter.h"
#include "vtkNIFTIImageWriter.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkXMLImageDataReader.h"
#include "vtkXMLPImageDataWriter.h"
#include "vtkXMLPPolyDataWriter.h"
#include "vtkXMLPRectilinearGridWriter.h"
#include "vtkXMLPStructuredGridWriter.h"
#include "vtkXMLPUnstructuredGridWriter.h"
#include "vtkXMLPartitionedDataSetWriter.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLRectilinearGridReader.h"
#include "vtkXMLStructuredGridReader.h"
#include "vtkXMLUnstructuredGridReader.h"
#if __has_include("vtkHDFWriter.h") // since VTK 9.3
#include "vtkHDFWriter.h"
#endif

#include <algorithm>
#include <cstdint>
#include <filesystem>

namespace penumbra_testing
{
namespace
{

/// Texts, without those that need a folder or a second file.
std::vector<std::pair<std::string, std::string>> MakeTexts()
{
  const auto zeros = [](std::size_t count) { return std::string(count, '\0'); };
  return {
    { "a.pts", "4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n" },
    { "a.nrrd",
      "NRRD0004\ntype: unsigned char\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n\n" +
        std::string(64, 'v') },
    { "a.inp",
      "4 1 1 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n1 1 tet 1 2 3 4\n1 1\ns, m\n1 0\n2 1\n3 2\n"
      "4 3\n" },
    { "a.tec",
      "TITLE = \"t\"\nVARIABLES = \"X\", \"Y\", \"Z\", \"S\"\nZONE T=\"a\", N=4, E=2, F=FEPOINT, "
      "ET=TRIANGLE\n0 0 0 1\n1 0 0 2\n1 1 0 3\n0 1 0 4\n1 2 3\n1 3 4\n" },
    { "a.slc", "11111\n4 4 2 8\n1 1 1\n0 0 0\n0\n2 2 X" + zeros(12) + std::string(32, 'v') },
    { "a.byu", "1 4 2 6\n1 2\n0.0 0.0 0.0 1.0 0.0 0.0\n1.0 1.0 0.0 0.0 1.0 0.0\n1 2 -3 1 3 -4\n" },
    { "a.facet",
      "FACET FILE\n1\nPart\n0\n4 0 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n1\nPart\n2 3\n1 2 3 0 1\n"
      "1 3 4 0 1\n" },
    { "a.neu",
      "        CONTROL INFO 2.4.6\n** GAMBIT NEUTRAL FILE\na\nPROGRAM: Gambit VERSION: 2.4.6\n"
      "1 Jan 2020\nNUMNP NELEM NGRPS NBSETS NDFCD NDFVL\n4 1 1 0 3 3\nENDOFSECTION\n"
      "   NODAL COORDINATES 2.4.6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\nENDOFSECTION\n"
      "      ELEMENTS/CELLS 2.4.6\n1 6 4 1 2 3 4\nENDOFSECTION\n"
      "       ELEMENT GROUP 2.4.6\nGROUP: 1 ELEMENTS: 1 MATERIAL: 2 NFLAGS: 1\nfluid\n0\n1\n"
      "ENDOFSECTION\n" },
    { "a.cas",
      "(0 \"a case\")\n(2 3)\n(10 (0 1 4 0 3))\n(10 (1 1 4 1 3)(\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n))\n"
      "(12 (0 1 1 0))\n(12 (2 1 1 1 2))\n(13 (0 1 4 0))\n(13 (3 1 4 3 3)(\n1 2 3 1 0\n1 2 4 1 0\n"
      "1 3 4 1 0\n2 3 4 1 0\n))\n(45 (2 fluid fluid)())\n(45 (3 wall wall)())\n" },
    { "a.xdmf",
      "<?xml version=\"1.0\" ?>\n<Xdmf Version=\"2.0\">\n<Domain>\n<Grid Name=\"g\">\n<Topology "
      "TopologyType=\"Triangle\" NumberOfElements=\"2\">\n<DataItem Dimensions=\"2 3\" "
      "NumberType=\"Int\" Format=\"XML\">0 1 2 0 2 3</DataItem>\n</Topology>\n<Geometry "
      "GeometryType=\"XYZ\">\n<DataItem Dimensions=\"4 3\" Format=\"XML\">0 0 0 1 0 0 1 1 0 0 1 "
      "0</DataItem>\n</Geometry>\n</Grid>\n</Domain>\n</Xdmf>\n" },
    { "a.vtpc",
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkPartitionedDataSetCollection\" "
      "version=\"1.0\">\n<vtkPartitionedDataSetCollection>\n<Partitions index=\"0\">\n<DataSet "
      "index=\"0\" file=\"sphere.vtp\"/>\n</Partitions>\n</vtkPartitionedDataSetCollection>\n"
      "</VTKFile>\n" },
  };
}

/// A tetrahedron as a case of OpenFOAM.
void WriteFoam(const std::string& folder)
{
  const std::string mesh = folder + "/constant/polyMesh/";
  std::filesystem::create_directories(mesh);
  std::filesystem::create_directories(folder + "/system");
  const auto write = [](const std::string& path, const std::string& name,
                       const std::string& content) {
    WriteText(path + name,
      "FoamFile\n{\nversion 2.0;\nformat ascii;\nclass " + name + ";\nobject " + name + ";\n}\n" +
        content);
  };
  write(folder + "/system/", "controlDict",
    "startFrom startTime;\nstartTime 0;\nstopAt endTime;\nendTime 1;\ndeltaT 1;\nwriteControl "
    "timeStep;\nwriteInterval 1;\n");
  write(mesh, "points", "4\n(\n(0 0 0)\n(1 0 0)\n(0 1 0)\n(0 0 1)\n)\n");
  write(mesh, "faces", "4\n(\n3(0 2 1)\n3(0 1 3)\n3(0 3 2)\n3(1 2 3)\n)\n");
  write(mesh, "owner", "4\n(\n0\n0\n0\n0\n)\n");
  write(mesh, std::string("neighb") + "our", "0\n(\n)\n"); // spelled as by OpenFOAM
  write(mesh, "boundary", "1\n(\nwall\n{\ntype wall;\nnFaces 4;\nstartFace 0;\n}\n)\n");
  WriteText(folder + "/a.foam", "a case\n");
}

/// glTF in one binary file, from the text and its buffer.
void WriteGlb(const std::string& folder)
{
  std::string text = ReadText(folder + "/sphere.gltf");
  std::string bytes = ReadText(folder + "/sphere.bin");
  const std::string reference = "\"uri\":\"sphere.bin\",";
  text.erase(text.find(reference), reference.size());
  text.resize((text.size() + 3) / 4 * 4, ' ');
  bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
  const auto number = [](std::size_t value) {
    const auto word = static_cast<std::uint32_t>(value);
    return std::string(reinterpret_cast<const char*>(&word), 4);
  };
  WriteText(folder + "/sphere.glb",
    "glTF" + number(2) + number(28 + text.size() + bytes.size()) + number(text.size()) + "JSON" +
      text + number(bytes.size()) + std::string("BIN\0", 4) + bytes);
}

template <typename Reader>
vtkSmartPointer<vtkDataObject> Read(const std::string& path)
{
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutputDataObject(0);
}

template <typename Writer>
void WritePieces(vtkDataObject* data, const std::string& path)
{
  vtkNew<Writer> writer;
  writer->SetInputData(data);
  writer->SetFileName(path.c_str());
  writer->SetNumberOfPieces(2);
  writer->SetStartPiece(0);
  writer->SetEndPiece(1);
  writer->Write();
}

void WriteWithVTK(const std::string& folder)
{
  const vtkSmartPointer<vtkDataObject> sphere = Read<vtkXMLPolyDataReader>(folder + "/sphere.vtp");
  const vtkSmartPointer<vtkDataObject> image = Read<vtkXMLImageDataReader>(folder + "/box.vti");
  WritePieces<vtkXMLPPolyDataWriter>(sphere, folder + "/p.pvtp");
  WritePieces<vtkXMLPUnstructuredGridWriter>(
    Read<vtkXMLUnstructuredGridReader>(folder + "/sphere.vtu"), folder + "/u.pvtu");
  WritePieces<vtkXMLPImageDataWriter>(image, folder + "/i.pvti");
  WritePieces<vtkXMLPStructuredGridWriter>(
    Read<vtkXMLStructuredGridReader>(folder + "/box.vts"), folder + "/s.pvts");
  WritePieces<vtkXMLPRectilinearGridWriter>(
    Read<vtkXMLRectilinearGridReader>(folder + "/box.vtr"), folder + "/r.pvtr");
  vtkNew<vtkPartitionedDataSet> partitions;
  partitions->SetPartition(0, vtkPolyData::SafeDownCast(sphere));
  vtkNew<vtkXMLPartitionedDataSetWriter> partitioned;
  partitioned->SetInputData(partitions);
  partitioned->SetFileName((folder + "/d.vtpd").c_str());
  partitioned->Write();
#if __has_include("vtkHDFWriter.h") // since VTK 9.3
  vtkNew<vtkHDFWriter> hdf;
  hdf->SetInputData(sphere);
  hdf->SetFileName((folder + "/sphere.vtkhdf").c_str());
  hdf->Write();
#endif
  vtkNew<vtkMetaImageWriter> meta;
  meta->SetInputData(image);
  meta->SetCompression(false);
  meta->SetFileName((folder + "/box.mha").c_str());
  meta->Write();
  vtkNew<vtkNIFTIImageWriter> nifti;
  nifti->SetInputData(image);
  nifti->SetFileName((folder + "/box.nii").c_str());
  nifti->Write();
}

bool IsDigit(char byte)
{
  return byte >= '0' && byte <= '9';
}

std::string Scratch(std::string bytes, Dice& dice)
{
  const std::size_t scratches = 2 + dice.Below(1 + bytes.size() / 200);
  const std::size_t reach = dice.Below(2) ? std::min<std::size_t>(bytes.size(), 400) : bytes.size();
  for (std::size_t i = 0; i < scratches; ++i)
  {
    bytes[dice.Below(reach)] = static_cast<char>(dice.Below(256));
  }
  return bytes;
}

std::string ChangeDigits(std::string bytes, Dice& dice)
{
  for (int i = 0; i < 200; ++i)
  {
    char& byte = bytes[dice.Below(bytes.size())];
    byte = IsDigit(byte) ? static_cast<char>('0' + dice.Below(10)) : byte;
  }
  return bytes;
}

/// Replaces the first number after a random place; in binary data four bytes.
std::string SetHugeCount(std::string bytes, Dice& dice)
{
  const std::size_t reach = dice.Below(2) ? std::min<std::size_t>(bytes.size(), 600) : bytes.size();
  const std::size_t place = dice.Below(reach);
  std::size_t first = place;
  while (first < bytes.size() && first < place + 60 && !IsDigit(bytes[first]))
  {
    ++first;
  }
  static const char* const counts[] = { "2147483647", "4294967295", "99999999", "-1", "-2147483648",
    "1e30", "9223372036854775807", "0" };
  if (first == bytes.size() || !IsDigit(bytes[first]))
  {
    return bytes.replace(place, std::min<std::size_t>(4, bytes.size() - place), "\xff\xff\xff\x7f");
  }
  std::size_t last = first;
  while (last < bytes.size() && IsDigit(bytes[last]))
  {
    ++last;
  }
  return bytes.replace(first, last - first, counts[dice.Below(std::size(counts))]);
}

std::string MoveBlock(std::string bytes, Dice& dice)
{
  const std::size_t first = dice.Below(bytes.size());
  const std::string block = bytes.substr(first, 1 + dice.Below(1 + bytes.size() / 4));
  if (dice.Below(2))
  {
    return bytes.erase(first, block.size());
  }
  return bytes.insert(dice.Below(bytes.size()), block);
}

}

std::vector<SampleFile> WriteSampleFiles(const std::string& folder)
{
  std::vector<SampleFile> samples;
  for (const std::string& name : WriteSpheres(folder))
  {
    samples.push_back({ name, name });
  }
  for (const auto& [name, text] : MakeTexts())
  {
    WriteText(folder + "/" + name, text);
    samples.push_back({ name, name });
  }
  WriteText(folder + "/a.case", "FORMAT\ntype: ensight gold\n\nGEOMETRY\nmodel: a.geo\n");
  WriteText(folder + "/a.geo",
    "title\nmore\nnode id assign\nelement id assign\npart\n1\nonly\ncoordinates\n4\n0.0\n1.0\n0.0\n"
    "0.0\n0.0\n0.0\n1.0\n0.0\n0.0\n0.0\n0.0\n1.0\ntetra4\n1\n1 2 3 4\n");
  WriteText(folder + "/square.3ds", Make3ds());
  WriteText(folder + "/box.wrl",
    "#VRML V2.0 utf8\nTransform { translation 0.5 0.5 0 children [ Shape {\n"
    "appearance Appearance { material Material { diffuseColor 0.1 0.3 0.9 } }\n"
    "geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0 ] }\n"
    "coordIndex [ 0, 1, 2, -1 ] } } ] }\n");
  WriteText(
    folder + "/red.obj", "mtllib red.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
  WriteText(folder + "/red.mtl", "newmtl red\nKd 0.9 0.1 0.1\nKs 0.5 0.5 0.5\nNs 20\nd 0.5\n");
  WriteGlb(folder);
  WriteFoam(folder);
  WriteWithVTK(folder);
  for (const char* name : { "a.case", "sphere.glb", "p.pvtp", "u.pvtu", "i.pvti", "s.pvts",
         "r.pvtr", "d.vtpd", "sphere.vtkhdf", "box.mha", "box.nii", "square.3ds", "box.wrl" })
  {
    if (std::filesystem::exists(folder + "/" + name))
    {
      samples.push_back({ name, name });
    }
  }
  samples.push_back({ "a.geo", "a.case" });
  samples.push_back({ "red.mtl", "red.obj" });
  samples.push_back({ "sphere.bin", "sphere.gltf" });
  for (const char* name : { "points", "faces", "owner", "boundary" })
  {
    samples.push_back({ std::string("constant/polyMesh/") + name, "a.foam" });
  }
  return samples;
}

const char* NameOf(Damages damage)
{
  static const char* const names[] = { "cut", "scratched", "digits", "huge count", "moved" };
  return names[static_cast<std::size_t>(damage)];
}

std::string Damage(std::string bytes, Damages damage, Dice& dice)
{
  switch (damage)
  {
    case Damages::Cut:
      return bytes.substr(0, dice.Below(bytes.size()));
    case Damages::Scratched:
      return Scratch(bytes, dice);
    case Damages::Digits:
      return ChangeDigits(bytes, dice);
    case Damages::HugeCount:
      return SetHugeCount(bytes, dice);
    case Damages::Moved:
      break;
  }
  return MoveBlock(bytes, dice);
}

}
