// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ObjCorners.h"

#include "MeshArrays.h"
#include "TextScanner.h"

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>

namespace penumbra
{

namespace
{

/// Parses an index that counts from 1, or backward from the last of `size` if it is negative.
bool ParseIndex(std::string_view word, std::size_t size, std::size_t limit, int& index)
{
  long long number = 0;
  if (!ParseInteger(word, number) || number == 0)
  {
    return false;
  }
  const long long found = number > 0 ? number - 1 : static_cast<long long>(size) + number;
  index = static_cast<int>(found);
  return found >= 0 && found < static_cast<long long>(limit) && found <= VTK_INT_MAX;
}

/// Newell's normal of a polygon.
void ComputeNormal(const std::vector<const double*>& corners, float normal[3])
{
  double sum[3] = { 0.0, 0.0, 0.0 };
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const double* a = corners[i];
    const double* b = corners[(i + 1) % corners.size()];
    const double* origin = corners[0];
    double u[3];
    double v[3];
    double cross[3];
    vtkMath::Subtract(a, origin, u);
    vtkMath::Subtract(b, origin, v);
    vtkMath::Cross(u, v, cross);
    vtkMath::Add(sum, cross, sum);
  }
  vtkMath::Normalize(sum);
  std::copy(sum, sum + 3, normal);
}

}

void ObjCorners::AddVertex(const double* values, int colorComponents)
{
  this->Vertices.insert(this->Vertices.end(), values, values + 3);
  if (colorComponents > 0 && this->ColorComponents == 0)
  {
    // Vertices before the first color are white.
    this->Colors.assign(4 * (this->NumberOfVertices() - 1), 1.0f);
  }
  this->ColorComponents = std::max(this->ColorComponents, colorComponents);
  for (int i = 0; this->ColorComponents > 0 && i < 4; ++i)
  {
    this->Colors.push_back(i < colorComponents ? static_cast<float>(values[3 + i]) : 1.0f);
  }
}

void ObjCorners::AddNormal(const float normal[3])
{
  this->Normals.insert(this->Normals.end(), normal, normal + 3);
}

void ObjCorners::AddTCoord(const float coordinates[2])
{
  this->TCoords.insert(this->TCoords.end(), coordinates, coordinates + 2);
}

bool ObjCorners::Parse(std::string_view word, ObjCorner& corner) const
{
  const std::size_t first = std::min(word.find('/'), word.size());
  const std::size_t second = std::min(word.find('/', first + 1), word.size());
  if (!ParseIndex(word.substr(0, first), this->NumberOfVertices(), this->Limit, corner.Vertex))
  {
    return false;
  }
  const auto parseOptional = [&](std::size_t begin, std::size_t end, std::size_t size) {
    int index = -1;
    const bool found =
      begin < end && ParseIndex(word.substr(begin, end - begin), size, size, index);
    return found ? index : -1;
  };
  corner.TCoord = parseOptional(first + 1, second, this->TCoords.size() / 2);
  corner.Normal = parseOptional(second + 1, word.size(), this->Normals.size() / 3);
  return true;
}

int ObjCorners::AddDuplicate(const ObjCorner& corner)
{
  Point point;
  point.Corner = corner;
  this->Duplicates.push_back(point);
  return -static_cast<int>(this->Duplicates.size());
}

const ObjCorner& ObjCorners::Decode(int code) const
{
  return code >= 0 ? this->Firsts[code].Corner : this->Duplicates[-1 - code].Corner;
}

int ObjCorners::Encode(const ObjCorner& corner)
{
  if (static_cast<std::size_t>(corner.Vertex) >= this->Firsts.size())
  {
    this->Firsts.resize(
      std::max<std::size_t>(corner.Vertex + std::size_t(1), this->NumberOfVertices()));
  }
  Point* point = &this->Firsts[corner.Vertex];
  if (point->Corner.Vertex < 0)
  {
    point->Corner = corner;
    return corner.Vertex;
  }
  int code = corner.Vertex;
  const auto matches = [&corner](const ObjCorner& other) {
    return other.TCoord == corner.TCoord && other.Normal == corner.Normal;
  };
  while (!matches(point->Corner) && point->Next >= 0)
  {
    code = -1 - point->Next;
    point = &this->Duplicates[point->Next];
  }
  if (matches(point->Corner))
  {
    return code;
  }
  point->Next = static_cast<int>(this->Duplicates.size());
  return this->AddDuplicate(corner);
}

void ObjCorners::Insert(const std::vector<ObjCorner>& corners, ObjCells& cells)
{
  bool hasNormals = true;
  for (const ObjCorner& corner : corners)
  {
    cells.Codes.push_back(this->Encode(corner));
    hasNormals = hasNormals && corner.Normal >= 0;
    this->HasNormals = this->HasNormals || corner.Normal >= 0;
    this->HasTCoords = this->HasTCoords || corner.TCoord >= 0;
  }
  cells.Ends.push_back(cells.Codes.size());
  cells.HasNormals.push_back(hasNormals);
}

void ObjCorners::CompleteNormals(ObjCells& polygons)
{
  std::size_t begin = 0;
  for (std::size_t cell = 0; this->HasNormals && cell < polygons.Size(); ++cell)
  {
    const std::size_t end = polygons.Ends[cell];
    if (!polygons.HasNormals[cell])
    {
      std::vector<const double*> corners;
      for (std::size_t i = begin; i < end; ++i)
      {
        corners.push_back(&this->Vertices[3 * this->Decode(polygons.Codes[i]).Vertex]);
      }
      float normal[3];
      ComputeNormal(corners, normal);
      this->AddNormal(normal);
      for (std::size_t i = begin; i < end; ++i)
      {
        ObjCorner corner = this->Decode(polygons.Codes[i]);
        corner.Normal = static_cast<int>(this->Normals.size() / 3) - 1;
        polygons.Codes[i] = this->AddDuplicate(corner);
      }
    }
    begin = end;
  }
}

void ObjCorners::AddTo(vtkPolyData* mesh) const
{
  const std::size_t vertices = this->NumberOfVertices();
  const auto size = static_cast<vtkIdType>(vertices + this->Duplicates.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(size);
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(this->HasNormals ? size : 0);
  normals->FillValue(0.0f);
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetName("TCoords");
  coordinates->SetNumberOfComponents(2);
  coordinates->SetNumberOfTuples(this->HasTCoords ? size : 0);
  coordinates->FillValue(0.0f);
  vtkNew<vtkFloatArray> colors;
  colors->SetNumberOfComponents(std::max(this->ColorComponents, 1));
  colors->SetNumberOfTuples(this->ColorComponents > 0 ? size : 0);
  for (vtkIdType id = 0; id < size; ++id)
  {
    const bool isFirst = id < static_cast<vtkIdType>(vertices);
    ObjCorner corner;
    if (!isFirst || id < static_cast<vtkIdType>(this->Firsts.size()))
    {
      corner = isFirst ? this->Firsts[id].Corner : this->Duplicates[id - vertices].Corner;
    }
    const std::size_t vertex = isFirst ? id : corner.Vertex;
    points->SetPoint(id, &this->Vertices[3 * vertex]);
    if (corner.Normal >= 0)
    {
      normals->SetTypedTuple(id, &this->Normals[3 * corner.Normal]);
    }
    if (corner.TCoord >= 0)
    {
      coordinates->SetTypedTuple(id, &this->TCoords[2 * corner.TCoord]);
    }
    if (this->ColorComponents > 0)
    {
      colors->SetTypedTuple(id, &this->Colors[4 * vertex]);
    }
  }
  mesh->SetPoints(points);
  if (this->HasNormals)
  {
    mesh->GetPointData()->SetNormals(normals);
  }
  if (this->HasTCoords)
  {
    mesh->GetPointData()->SetTCoords(coordinates);
  }
  if (this->ColorComponents > 0)
  {
    AddColors(mesh->GetPointData(), colors);
  }
}

vtkSmartPointer<vtkCellArray> ObjCorners::MakeCells(const ObjCells& cells) const
{
  auto made = vtkSmartPointer<vtkCellArray>::New();
  made->AllocateExact(
    static_cast<vtkIdType>(cells.Size()), static_cast<vtkIdType>(cells.Codes.size()));
  const auto vertices = static_cast<vtkIdType>(this->NumberOfVertices());
  std::size_t begin = 0;
  for (const std::size_t end : cells.Ends)
  {
    made->InsertNextCell(static_cast<int>(end - begin));
    for (std::size_t i = begin; i < end; ++i)
    {
      const int code = cells.Codes[i];
      made->InsertCellPoint(code >= 0 ? code : vertices - 1 - code);
    }
    begin = end;
  }
  return made;
}

}
