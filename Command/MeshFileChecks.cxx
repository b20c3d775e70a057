// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshFileChecks.h"

#include "Failure.h"

#include "vtkCellArray.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace penumbra
{

namespace
{

std::string ReadBeginning(const std::string& path, std::size_t size)
{
  std::ifstream file(path, std::ios::binary);
  std::string bytes(size, '\0');
  file.read(&bytes[0], static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

// Elements of a kind that the header of a PLY file announces.
long long CountInPlyHeader(const std::string& header, const std::string& kind)
{
  const std::string key = "element " + kind + " ";
  const std::size_t at = header.find(key);
  return at == std::string::npos ? 0 : std::atoll(header.c_str() + at + key.size());
}

void CheckPly(const std::string& path, vtkPolyData* mesh)
{
  std::string header = ReadBeginning(path, 65536);
  header.resize(std::min(header.size(), header.find("end_header")));
  const long long points = CountInPlyHeader(header, "vertex");
  const long long faces = CountInPlyHeader(header, "face");
  if (mesh->GetNumberOfPoints() != points)
  {
    throw Failure(BadInput, path + ": the file is damaged: it ends before its last vertex");
  }
  if (faces > 0 && mesh->GetNumberOfPolys() != faces)
  {
    std::ostringstream message;
    message
      << path << ": only " << mesh->GetNumberOfPolys() << " of " << faces
      << " faces could be read; polygons of more than 255 vertices must be triangulated first";
    throw Failure(BadInput, message.str());
  }
}

// A binary STL file is a header of 80 bytes, a count, and 50 bytes a triangle.
void CheckStl(const std::string& path)
{
  const std::string beginning = ReadBeginning(path, 512);
  const bool text =
    beginning.compare(0, 5, "solid") == 0 && beginning.find("facet") != std::string::npos;
  if (text)
  {
    std::ifstream file(path, std::ios::binary);
    file.seekg(-std::min<std::streamoff>(512, std::filesystem::file_size(path)), std::ios::end);
    std::string ending(512, '\0');
    file.read(&ending[0], 512);
    if (ending.find("endsolid") == std::string::npos)
    {
      throw Failure(BadInput, path + ": the file is damaged: it ends before its 'endsolid'");
    }
    return;
  }
  std::uint32_t count = 0;
  if (beginning.size() >= 84)
  {
    std::memcpy(&count, &beginning[80], sizeof(count));
  }
  if (beginning.size() < 84 || std::filesystem::file_size(path) < 84 + 50ull * count)
  {
    throw Failure(BadInput, path + ": the file is damaged: it ends before its last triangle");
  }
}

}

void CheckAgainstHeader(const std::string& path, vtkDataObject* data)
{
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char letter) { return std::tolower(letter); });
  vtkPolyData* mesh = vtkPolyData::SafeDownCast(data);
  if (extension == ".ply" && mesh)
  {
    CheckPly(path, mesh);
  }
  else if (extension == ".stl")
  {
    CheckStl(path);
  }
}

}
