// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshFileValidation.h"

#include "Files/EarlyEnds.h"
#include "Files/PlyFile.h"
#include "Processes/CommandError.h"

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

[[noreturn]] void FailEarlyEnd(const std::string& path, const std::string& last)
{
  throw CommandError(
    BadInput, path + ": the file is damaged: it ends before its last " + last + "; copy it again");
}

// A text ends in "endsolid"; a binary file is a header of 80 bytes, a count, and 50 bytes a triangle.
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
      FailEarlyEnd(path, "line, 'endsolid'");
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
    FailEarlyEnd(path, "triangle");
  }
}

std::string LowerExtension(const std::string& path)
{
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char letter) { return std::tolower(letter); });
  return extension;
}

}

DeclaredCounts CheckMeshFile(const std::string& path)
{
  const std::string extension = LowerExtension(path);
  DeclaredCounts promise;
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
        BadInput, path + ": the file is damaged or not PLY: its header makes no sense");
    }
    if (!ply.IsWhole)
    {
      FailEarlyEnd(path, "element");
    }
    promise = { ply.Polygons, ply.Corners };
  }
  else
  {
    const std::string last = FindEarlyEnd(path);
    if (!last.empty())
    {
      FailEarlyEnd(path, last);
    }
  }
  return promise;
}

void CheckDeclaredCounts(
  const std::string& path, vtkDataObject* data, const DeclaredCounts& promise)
{
  vtkPolyData* mesh = vtkPolyData::SafeDownCast(data);
  if (promise.Polygons < 0 || !mesh)
  {
    return;
  }
  if (mesh->GetNumberOfPolys() != promise.Polygons ||
    mesh->GetPolys()->GetNumberOfConnectivityIds() != promise.Corners)
  {
    throw CommandError(BadInput,
      path +
        ": polygons of more than 255 vertices cannot be read from this file; triangulate them");
  }
}

}
