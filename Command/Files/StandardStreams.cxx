// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "StandardStreams.h"

#include "Processes/CommandError.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include <unistd.h>

namespace penumbra
{

namespace
{

/// Size of the header and of a triangle of binary STL, and the place of the number of triangles.
constexpr std::size_t StlHeaderBytes = 84;
constexpr std::size_t StlTriangleBytes = 50;
constexpr std::size_t StlCountOffset = 80;

bool IsBinaryStl(const std::string& bytes)
{
  std::uint32_t count = 0;
  if (bytes.size() < StlHeaderBytes)
  {
    return false;
  }
  std::memcpy(&count, bytes.data() + StlCountOffset, sizeof(count));
  return bytes.size() == StlHeaderBytes + StlTriangleBytes * count;
}

// Returns the extension that belongs to the contents of a file; empty if it is unknown.
std::string FindExtension(const std::string& bytes)
{
  const std::string head = bytes.substr(0, 4096);
  const auto begins = [&head](const char* text) { return head.rfind(text, 0) == 0; };
  const auto contains = [&head](const char* text) { return head.find(text) != head.npos; };
  const struct
  {
    bool Matches;
    const char* Extension;
  } rows[] = { { begins("ply"), ".ply" }, { begins("# vtk DataFile"), ".vtk" },
    { begins("glTF"), ".glb" }, { begins("NRRD000"), ".nrrd" },
    { contains("VTKFile") && contains("type=\"PolyData\""), ".vtp" },
    { contains("VTKFile") && contains("type=\"UnstructuredGrid\""), ".vtu" },
    { contains("VTKFile") && contains("type=\"ImageData\""), ".vti" },
    { contains("VTKFile") && contains("type=\"StructuredGrid\""), ".vts" },
    { contains("VTKFile") && contains("type=\"RectilinearGrid\""), ".vtr" },
    { begins("{") && contains("\"asset\""), ".gltf" },
    { contains("ObjectType") && contains("ElementDataFile") && contains("LOCAL"), ".mha" },
    { IsBinaryStl(bytes) || (begins("solid") && contains("facet")), ".stl" },
    { begins("OFF") || begins("COFF") || begins("NOFF"), ".off" },
    { begins("v ") || contains("\nv "), ".obj" } };
  const auto row =
    std::find_if(std::begin(rows), std::end(rows), [](const auto& one) { return one.Matches; });
  return row == std::end(rows) ? std::string() : row->Extension;
}

}

StreamFolder::~StreamFolder()
{
  std::error_code ignored;
  if (!this->Folder.empty())
  {
    std::filesystem::remove_all(this->Folder, ignored);
  }
}

std::string StreamFolder::Locate(const std::string& name)
{
  if (this->Folder.empty())
  {
    std::error_code ignored;
    std::string pattern =
      (std::filesystem::temp_directory_path(ignored) / "penumbra-XXXXXX").string();
    if (!mkdtemp(&pattern[0]))
    {
      throw CommandError(Unavailable, pattern + ": cannot be created: " + strerror(errno));
    }
    this->Folder = pattern;
  }
  return this->Folder + "/" + name;
}

std::string StreamFolder::ReadInput()
{
  const std::string bytes{ std::istreambuf_iterator<char>(std::cin), {} };
  const std::string extension = FindExtension(bytes);
  if (extension.empty())
  {
    throw CommandError(BadInput,
      bytes.empty() ? "-: standard input is empty; pipe a mesh into it"
                    : "-: the format of standard input is unknown; save it to a file");
  }
  std::string path = this->Locate("standard-input" + extension);
  std::ofstream file(path, std::ios::binary);
  if (!file.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush())
  {
    throw CommandError(BadInput, path + ": cannot be written: " + strerror(errno));
  }
  return path;
}

std::string StreamFolder::PrepareOutput()
{
  if (isatty(STDOUT_FILENO))
  {
    throw CommandError(
      BadInput, "--output -: standard output is a terminal; redirect it to a file or a program");
  }
  this->Output = this->Locate("standard-output.png");
  return this->Output;
}

void StreamFolder::WriteOutput() const
{
  std::ifstream file(this->Output, std::ios::binary);
  if (file && !this->Output.empty())
  {
    std::cout << file.rdbuf();
  }
}

}
