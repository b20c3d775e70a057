// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Wavefront OBJ: polygons, lines and points with normals, texture coordinates and colors of vertices.
#include "MeshReaders.h"

#include "MeshArrays.h"
#include "ObjCorners.h"
#include "Processes/CommandError.h"
#include "TextFile.h"
#include "TextScanner.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <map>

namespace penumbra
{

namespace
{

/// Cells of one kind with the group and material of each.
struct CellList
{
  ObjCells Cells;
  std::vector<int> Groups;
  std::vector<int> Materials;
};

class Reader
{
public:
  Reader(const std::string& path, const TextFile& file)
    : Path(path),
      Text(file.Begin(), file.End(), '#'),
      Corners(file.Size())
  {
  }

  vtkSmartPointer<vtkDataObject> Read()
  {
    while (!this->Text.AtEnd())
    {
      ++this->LineNumber;
      this->ReadLine();
      this->Text.Line();
    }
    if (this->Corners.UsedVertices() > this->Corners.NumberOfVertices())
    {
      ThrowDamaged(this->Path,
        "an element uses vertex " + std::to_string(this->Corners.UsedVertices()) +
          ", but the file has only " + std::to_string(this->Corners.NumberOfVertices()));
    }
    if (this->FreeForms > 0 && this->Faces.Cells.Size() == 0 && this->Lines.Cells.Size() == 0 &&
      this->Points.Cells.Size() == 0)
    {
      throw CommandError(BadInput,
        this->Path + ": the file has only free-form curves and surfaces; export them as polygons");
    }
    this->Corners.CompleteNormals(this->Faces.Cells);
    const bool isMixed = this->Faces.Cells.Size() > 0 &&
      (this->Lines.Cells.Size() > 0 || this->Points.Cells.Size() > 0);
    auto mesh = this->MakeMesh({ &this->Points, &this->Lines, &this->Faces });
    if (!isMixed || !mesh->GetPointData()->GetNormals())
    {
      this->ReportUnread(mesh);
      return mesh;
    }
    // Lines and points have no normals.
    mesh = this->MakeMesh({ &this->Points, &this->Lines });
    mesh->GetPointData()->SetNormals(nullptr);
    vtkNew<vtkMultiBlockDataSet> blocks;
    blocks->SetBlock(0, this->MakeMesh({ &this->Faces }));
    blocks->SetBlock(1, mesh);
    this->ReportUnread(blocks);
    return blocks;
  }

private:
  void ReadLine()
  {
    const std::string_view keyword = this->Text.WordInLine();
    if (keyword == "v")
    {
      this->ReadVertex();
    }
    else if (keyword == "vn")
    {
      float normal[3];
      this->ReadFloats(normal, 3, 3);
      this->Corners.AddNormal(normal);
    }
    else if (keyword == "vt")
    {
      float coordinates[2] = { 0.0f, 0.0f };
      this->ReadFloats(coordinates, 1, 2);
      this->Corners.AddTCoord(coordinates);
    }
    else if (keyword == "f" || keyword == "fo")
    {
      this->ReadCell(this->Faces, 3);
    }
    else if (keyword == "l")
    {
      this->ReadCell(this->Lines, 2);
    }
    else if (keyword == "p")
    {
      this->ReadCell(this->Points, 1);
    }
    else if (keyword == "curv" || keyword == "curv2" || keyword == "surf")
    {
      ++this->FreeForms;
    }
    else if (keyword == "g" || keyword == "o")
    {
      // An object usually contains one group: both lines together start one.
      this->Group = static_cast<int>(this->UsedGroups);
    }
    else if (keyword == "mtllib")
    {
      this->Libraries.push_back(this->Text.WordsInLine());
    }
    else if (keyword == "usemtl")
    {
      const auto [found, isNew] = this->MaterialIds.emplace(
        this->Text.WordsInLine(), static_cast<int>(this->Materials.size()));
      if (isNew)
      {
        this->Materials.push_back(found->first);
      }
      this->Material = found->second;
    }
  }

  void ReadVertex()
  {
    double values[7];
    int count = 0;
    for (std::string_view word = this->Text.WordInLine(); !word.empty() && count < 7;
         word = this->Text.WordInLine())
    {
      if (!ParseNumber(word, values[count]))
      {
        this->FailAt("'" + std::string(word.substr(0, 40)) + "' is not a number");
      }
      ++count;
    }
    if (count < 3)
    {
      this->FailAt("a vertex has fewer than three coordinates");
    }
    this->Corners.AddVertex(values, count >= 6 ? count - 3 : 0);
  }

  void ReadFloats(float* values, int required, int count)
  {
    for (int i = 0; i < count; ++i)
    {
      const std::string_view word = this->Text.WordInLine();
      double value = 0.0;
      if (word.empty() && i >= required)
      {
        return;
      }
      if (!ParseNumber(word, value))
      {
        this->FailAt("a number is missing");
      }
      values[i] = static_cast<float>(value);
    }
  }

  void ReadCell(CellList& list, std::size_t required)
  {
    std::vector<ObjCorner> corners;
    for (std::string_view word = this->Text.WordInLine(); !word.empty();
         word = this->Text.WordInLine())
    {
      ObjCorner corner;
      if (!this->Corners.Parse(word, corner))
      {
        this->FailAt("'" + std::string(word.substr(0, 40)) + "' names no vertex");
      }
      corners.push_back(corner);
    }
    if (corners.size() < required)
    {
      ++this->ShortCells; // It covers nothing.
      return;
    }
    this->Corners.Insert(corners, list.Cells);
    list.Groups.push_back(this->Group);
    list.Materials.push_back(this->Material);
    this->UsedGroups = static_cast<std::size_t>(this->Group) + 1;
  }

  void ReportUnread(vtkDataObject* data) const
  {
    if (this->ShortCells > 0)
    {
      AddUnread(data,
        std::to_string(this->ShortCells) +
          " faces and lines have too few vertices and are not drawn");
    }
    if (this->FreeForms > 0)
    {
      AddUnread(data,
        std::to_string(this->FreeForms) +
          " free-form curves and surfaces are not read; export them as polygons");
    }
  }

  /// Makes a mesh of points, lines and faces in this order, which is the order of VTK's cells.
  vtkSmartPointer<vtkPolyData> MakeMesh(const std::vector<const CellList*>& lists) const
  {
    auto mesh = vtkSmartPointer<vtkPolyData>::New();
    this->Corners.AddTo(mesh);
    vtkNew<vtkIntArray> groups;
    groups->SetName("GroupIds");
    vtkNew<vtkIntArray> materials;
    materials->SetName(ObjMaterialIds);
    for (const CellList* list : lists)
    {
      if (list == &this->Points)
      {
        mesh->SetVerts(this->Corners.MakeCells(list->Cells));
      }
      else if (list == &this->Lines)
      {
        mesh->SetLines(this->Corners.MakeCells(list->Cells));
      }
      else
      {
        mesh->SetPolys(this->Corners.MakeCells(list->Cells));
      }
      for (std::size_t i = 0; i < list->Groups.size(); ++i)
      {
        groups->InsertNextValue(list->Groups[i]);
        materials->InsertNextValue(list->Materials[i]);
      }
    }
    mesh->GetCellData()->SetScalars(groups);
    if (!this->MaterialIds.empty())
    {
      mesh->GetCellData()->AddArray(materials);
      AddNames(ObjMaterialNames, this->Materials, mesh);
      AddNames(ObjLibraryNames, this->Libraries, mesh);
    }
    return mesh;
  }

  static void AddNames(const char* array, const std::vector<std::string>& names, vtkPolyData* mesh)
  {
    vtkNew<vtkStringArray> strings;
    strings->SetName(array);
    for (const std::string& name : names)
    {
      strings->InsertNextValue(name);
    }
    mesh->GetFieldData()->AddArray(strings);
  }

  [[noreturn]] void FailAt(const std::string& reason) const
  {
    ThrowDamaged(this->Path, "line " + std::to_string(this->LineNumber) + ": " + reason);
  }

  const std::string& Path;
  TextScanner Text;
  long long LineNumber = 0;
  ObjCorners Corners;
  CellList Faces;
  CellList Lines;
  CellList Points;
  std::map<std::string, int> MaterialIds;
  std::vector<std::string> Materials; ///< names by id
  std::vector<std::string> Libraries;
  int Group = 0;
  int Material = -1;
  std::size_t UsedGroups = 0;
  long long ShortCells = 0; ///< faces and lines with too few corners
  long long FreeForms = 0;  ///< curves and surfaces
};

}

vtkSmartPointer<vtkDataObject> ReadObj(const std::string& path)
{
  const TextFile file(path);
  return Reader(path, file).Read();
}

}
