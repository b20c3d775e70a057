// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshWriter.h"

#include "MeshReaders.h"
#include "Processes/CommandError.h"

#include "vtkAbstractArray.h"
#include "vtkAppendFilter.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPLYWriter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataWriter.h"
#include "vtkSmartPointer.h"
#include "vtkTriangleFilter.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLPolyDataWriter.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <algorithm>
#include <cstddef>

namespace penumbra
{

namespace
{

template <typename Writer>
bool Write(Writer* writer, vtkDataObject* data, const std::string& path)
{
  writer->SetInputData(data);
  writer->SetFileName(path.c_str());
  return writer->Write() != 0 && writer->GetErrorCode() == 0;
}

/// Length in bytes of the UTF-8 character at the beginning of `text`; 0: the bytes are none, or a control
/// character that XML does not allow.
std::size_t CharacterLength(const std::string& text, std::size_t at)
{
  const auto byte = [&text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(at);
  if (first < 0x80)
  {
    return first >= 0x20 || first == '\t' || first == '\n' || first == '\r' ? 1 : 0;
  }
  const std::size_t length = first >= 0xf0 && first < 0xf5 ? 4
    : first >= 0xe0 && first < 0xf0                        ? 3
    : first >= 0xc2 && first < 0xe0                        ? 2
                                                           : 0;
  if (length == 0 || at + length > text.size())
  {
    return 0;
  }
  for (std::size_t i = 1; i < length; ++i)
  {
    if ((byte(at + i) & 0xc0) != 0x80)
    {
      return 0;
    }
  }
  return length;
}

/// A name that a format allows, and the text by which the format stores it.
struct StoredName
{
  std::string Name;
  std::string Text;
};

/// VTK's writers of XML do not escape names.
StoredName ToXml(const std::string& name)
{
  StoredName stored;
  for (std::size_t i = 0; i < name.size();)
  {
    const std::size_t length = CharacterLength(name, i);
    const std::string character = length > 0 ? name.substr(i, length) : "?";
    i += std::max<std::size_t>(length, 1);
    stored.Name += character;
    const bool isSpecial = length == 1 &&
      (std::string("<>&\"'").find(character) != std::string::npos || character[0] < ' ');
    stored.Text += isSpecial ? "&#" + std::to_string(int(character[0])) + ";" : character;
  }
  return stored;
}

/// VTK 9.7 takes names in legacy files as formats with arguments in braces.
StoredName ToLegacy(const std::string& name)
{
  StoredName stored = { name, "" };
  std::replace(stored.Name.begin(), stored.Name.end(), '{', '(');
  std::replace(stored.Name.begin(), stored.Name.end(), '}', ')');
  stored.Text = stored.Name;
  return stored;
}

void RenameArrays(
  vtkFieldData* arrays, const std::string& extension, std::vector<std::string>& warnings)
{
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* const array = arrays->GetAbstractArray(i);
    const std::string name = array->GetName() ? array->GetName() : "";
    const StoredName stored = extension == ".vtk" ? ToLegacy(name) : ToXml(name);
    if (stored.Name != name)
    {
      warnings.push_back("the array '" + name + "' is written as '" + stored.Name + "', because " +
        extension + " files allow no such name");
    }
    if (!name.empty())
    {
      array->SetName(stored.Text.c_str());
    }
  }
}

/// Returns a copy of the mesh with copies of its arrays whose names are those that the format stores.
vtkSmartPointer<vtkPolyData> CopyWithStoredNames(
  vtkPolyData* mesh, const std::string& extension, std::vector<std::string>& warnings)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->DeepCopy(mesh);
  RenameArrays(copy->GetPointData(), extension, warnings);
  RenameArrays(copy->GetCellData(), extension, warnings);
  RenameArrays(copy->GetFieldData(), extension, warnings);
  return copy;
}

/// Returns the polygons of a mesh and the triangles of its strips, which vtkPLYWriter does not write.
vtkSmartPointer<vtkCellArray> CollectPolygons(vtkPolyData* mesh)
{
  auto polygons = vtkSmartPointer<vtkCellArray>::New();
  polygons->DeepCopy(mesh->GetPolys());
  vtkNew<vtkPolyData> strips;
  strips->SetPoints(mesh->GetPoints());
  strips->SetStrips(mesh->GetStrips());
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(strips);
  triangles->Update();
  polygons->Append(triangles->GetOutput()->GetPolys());
  return polygons;
}

bool HasStoredNames(vtkFieldData* arrays, const std::string& extension)
{
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    const char* name = arrays->GetArrayName(i);
    if (name && (extension == ".vtk" ? ToLegacy(name) : ToXml(name)).Text != name)
    {
      return false;
    }
  }
  return true;
}

}

bool WriteMesh(const std::string& extension, vtkPolyData* mesh, const std::string& path,
  std::vector<std::string>& warnings)
{
  vtkSmartPointer<vtkPolyData> written = mesh;
  if (!HasStoredNames(mesh->GetPointData(), extension) ||
    !HasStoredNames(mesh->GetCellData(), extension) ||
    !HasStoredNames(mesh->GetFieldData(), extension))
  {
    written = CopyWithStoredNames(mesh, extension, warnings);
  }
  if (extension == ".vtp")
  {
    return Write(vtkNew<vtkXMLPolyDataWriter>().Get(), written, path);
  }
  if (extension == ".vtk")
  {
    vtkNew<vtkPolyDataWriter> writer;
    writer->SetFileTypeToBinary();
    return Write(writer.Get(), written, path);
  }
  vtkNew<vtkAppendFilter> convert;
  convert->SetInputData(written);
  convert->Update();
  return Write(vtkNew<vtkXMLUnstructuredGridWriter>().Get(), convert->GetOutput(), path);
}

bool WritePly(vtkPolyData* mesh, const std::string& colors, const std::string& path,
  std::vector<std::string>& warnings)
{
  if (mesh->GetNumberOfLines() > 0)
  {
    warnings.push_back("--output: .ply files have no lines: " +
      std::to_string(mesh->GetNumberOfLines()) + " were left out; use .vtp, .vtu or .vtk");
  }
  vtkNew<vtkPolyData> polygons;
  polygons->SetPoints(mesh->GetPoints());
  polygons->GetPointData()->ShallowCopy(mesh->GetPointData());
  polygons->SetPolys(CollectPolygons(mesh));
  vtkNew<vtkPLYWriter> writer;
  writer->SetArrayName(colors.c_str());
  if (!Write(writer.Get(), polygons, path))
  {
    return false;
  }
  try
  {
    ReadPly(path); // The writer does not detect a full disk.
    return true;
  }
  catch (const CommandError&)
  {
    return false;
  }
}

}
