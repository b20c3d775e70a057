// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshFileValidation.h"

#include "Files/FileExtension.h"
#include "Files/PlyFile.h"
#include "Processes/CommandError.h"
#include "Truncation/Truncation.h"

#include "vtkCellArray.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace penumbra
{

namespace
{

[[noreturn]] void ThrowTruncated(const std::string& path, const std::string& last)
{
  throw CommandError(
    BadInput, path + ": the file is damaged: it ends before its last " + last + "; copy it again");
}

// An ASCII file ends in "endsolid". A binary file has a header of 80 bytes, a count, and 50 bytes per
// triangle.
void CheckStl(const std::string& path)
{
  const std::uintmax_t size = std::filesystem::file_size(path);
  std::ifstream file(path, std::ios::binary);
  std::string beginning(std::min<std::uintmax_t>(size, 512), '\0');
  file.read(&beginning[0], static_cast<std::streamsize>(beginning.size()));
  if (beginning.compare(0, 5, "solid") == 0 && beginning.find('\0') == std::string::npos)
  {
    std::string ending = beginning;
    file.seekg(-static_cast<std::streamoff>(ending.size()), std::ios::end);
    file.read(&ending[0], static_cast<std::streamsize>(ending.size()));
    if (ending.find("endsolid") == std::string::npos)
    {
      ThrowTruncated(path, "line, 'endsolid'");
    }
    return;
  }
  std::uint32_t count = 0;
  if (beginning.size() >= 84)
  {
    std::memcpy(&count, &beginning[80], sizeof(count));
  }
  if (beginning.size() < 84 || size < 84 + 50ull * count)
  {
    ThrowTruncated(path, "triangle");
  }
}

}

DeclaredCounts CheckMeshFile(const std::string& path)
{
  const std::string extension = LowerExtension(path);
  DeclaredCounts counts;
  if (extension == ".stl")
  {
    CheckStl(path);
  }
  else if (extension == ".ply")
  {
    const PlyFile ply = WalkPlyFile(path);
    if (!ply.IsPly)
    {
      throw CommandError(
        BadInput, path + ": the file is damaged or not PLY: its header is invalid");
    }
    if (!ply.IsWhole)
    {
      ThrowTruncated(path, "element");
    }
    counts = { ply.Polygons, ply.Corners };
  }
  else
  {
    const std::string last = FindTruncation(path);
    if (!last.empty())
    {
      ThrowTruncated(path, last);
    }
  }
  return counts;
}

void CheckDeclaredCounts(const std::string& path, vtkDataObject* data, const DeclaredCounts& counts)
{
  vtkPolyData* mesh = vtkPolyData::SafeDownCast(data);
  if (counts.Polygons < 0 || !mesh)
  {
    return;
  }
  if (mesh->GetNumberOfPolys() != counts.Polygons ||
    mesh->GetPolys()->GetNumberOfConnectivityIds() != counts.Corners)
  {
    throw CommandError(BadInput,
      path +
        ": VTK cannot read polygons of more than 255 vertices from this file; triangulate them");
  }
}

}
