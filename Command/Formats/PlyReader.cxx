// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshReaders.h"

#include "Files/MappedFile.h"
#include "MeshArrays.h"
#include "PlyFile.h"
#include "Processes/CommandError.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <map>

namespace penumbra
{

namespace
{

using Arrays = std::map<std::string, vtkSmartPointer<vtkDataArray>>;
using Names = std::vector<std::string>;

/// Properties that are the components of one array.
struct Group
{
  std::string Name;
  Names Properties;
};

const std::vector<Group>& Groups()
{
  static const std::vector<Group> groups = { { "Points", { "x", "y", "z" } },
    { "Normals", { "nx", "ny", "nz" } }, { "Normals", { "normal_x", "normal_y", "normal_z" } },
    { "Colors", { "red", "green", "blue", "alpha" } }, { "Colors", { "red", "green", "blue" } },
    { "Colors", { "diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha" } },
    { "Colors", { "diffuse_red", "diffuse_green", "diffuse_blue", "alpha" } },
    { "Colors", { "diffuse_red", "diffuse_green", "diffuse_blue" } },
    { "Colors", { "r", "g", "b", "a" } }, { "Colors", { "r", "g", "b" } },
    { "TCoords", { "u", "v" } }, { "TCoords", { "s", "t" } },
    { "TCoords", { "texture_u", "texture_v" } } };
  return groups;
}

std::vector<int> FindProperties(const PlyElement& element, const Names& names)
{
  std::vector<int> found;
  for (const std::string& name : names)
  {
    for (std::size_t i = 0; i < element.Properties.size(); ++i)
    {
      if (element.Properties[i].Name == name && !element.Properties[i].IsList())
      {
        found.push_back(static_cast<int>(i));
        break;
      }
    }
  }
  return found.size() == names.size() ? found : std::vector<int>();
}

/// VTK type of an array of several properties.
int CommonType(
  const PlyElement& element, const std::vector<int>& properties, bool isPosition, bool isAscii)
{
  const auto isFloat = [](int type) { return type == VTK_FLOAT || type == VTK_DOUBLE; };
  const auto isSigned = [](int type) { return vtkDataArray::GetDataTypeMin(type) < 0.0; };
  int widest = element.Properties[properties.front()].Type;
  for (const int i : properties)
  {
    const int type = element.Properties[i].Type;
    const bool isLarger =
      vtkDataArray::GetDataTypeSize(type) > vtkDataArray::GetDataTypeSize(widest);
    const bool isMixed = isFloat(type) != isFloat(widest) || isSigned(type) != isSigned(widest);
    widest = isMixed ? VTK_DOUBLE : isLarger ? type : widest;
  }
  // Digits of a text may exceed the declared type.
  return isPosition && (isAscii || !isFloat(widest)) ? VTK_DOUBLE : widest;
}

/// Directs the single values of an element into arrays, by property.
Arrays AssignArrays(const PlyElement& element, bool isAscii, std::vector<PlyTarget>& targets)
{
  Arrays arrays;
  targets.assign(element.Properties.size(), PlyTarget());
  const auto assign = [&](const std::string& name, const std::vector<int>& properties, int type) {
    const auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
    array->SetName(name.c_str());
    array->SetNumberOfComponents(static_cast<int>(properties.size()));
    array->SetNumberOfTuples(element.Count);
    for (std::size_t component = 0; component < properties.size(); ++component)
    {
      targets[properties[component]] = PlyTarget(array, static_cast<int>(component));
    }
    arrays[name] = array;
  };
  for (const Group& group : Groups())
  {
    const std::vector<int> properties = FindProperties(element, group.Properties);
    if (!properties.empty() && !arrays.count(group.Name))
    {
      const bool isPosition = group.Name == "Points";
      const int type = group.Name == "Normals" || group.Name == "TCoords"
        ? VTK_FLOAT
        : CommonType(element, properties, isPosition, isAscii);
      assign(group.Name, properties, type);
    }
  }
  for (std::size_t i = 0; i < element.Properties.size(); ++i)
  {
    const PlyProperty& property = element.Properties[i];
    if (!property.IsList() && targets[i].IsEmpty() && !arrays.count(property.Name))
    {
      assign(property.Name, { static_cast<int>(i) }, property.Type);
    }
  }
  return arrays;
}

void AddArrays(const Arrays& arrays, vtkDataSetAttributes* attributes)
{
  for (const auto& [name, array] : arrays)
  {
    if (name == "Colors")
    {
      AddColors(attributes, array);
    }
    else if (name == "Normals")
    {
      attributes->SetNormals(array);
    }
    else if (name == "TCoords")
    {
      attributes->SetTCoords(array);
    }
    else if (name != "Points")
    {
      attributes->AddArray(array);
    }
  }
}

int FindIndexList(const PlyElement& element)
{
  int found = -1;
  for (std::size_t i = 0; i < element.Properties.size(); ++i)
  {
    const PlyProperty& property = element.Properties[i];
    if (property.IsList() && property.Name.rfind("vertex_ind", 0) == 0)
    {
      return static_cast<int>(i);
    }
    if (found < 0 && property.IsList() && property.Type != VTK_FLOAT && property.Type != VTK_DOUBLE)
    {
      found = static_cast<int>(i);
    }
  }
  return found;
}

/// Appends the triangles of strips, which -1 separates.
void AppendStrips(const std::vector<vtkIdType>& strip, vtkCellArray* polygons)
{
  std::size_t first = 0;
  for (std::size_t i = 0; i < strip.size(); ++i)
  {
    if (strip[i] < 0)
    {
      first = i + 1;
    }
    else if (i >= first + 2)
    {
      const bool odd = (i - first) % 2 != 0;
      const vtkIdType triangle[3] = { strip[odd ? i - 1 : i - 2], strip[odd ? i - 2 : i - 1],
        strip[i] };
      if (triangle[0] != triangle[1] && triangle[0] != triangle[2] && triangle[1] != triangle[2])
      {
        polygons->InsertNextCell(3, triangle);
      }
    }
  }
}

class Reader
{
public:
  Reader(const std::string& path, const PlyHeader& header, PlyBody& body)
    : Path(path),
      Header(header),
      Body(body)
  {
  }

  vtkSmartPointer<vtkPolyData> Read()
  {
    for (const PlyElement& element : this->Header.Elements)
    {
      this->ReadElement(element);
    }
    this->Mesh->SetPolys(this->Polygons);
    if (this->Polygons->GetNumberOfCells() == 0)
    {
      this->Mesh->SetLines(this->Lines);
    }
    // Strips have no values, so the values of faces next to them have no cells.
    if (!this->HasStrips && this->Polygons->GetNumberOfCells() > 0)
    {
      AddArrays(this->FaceArrays, this->Mesh->GetCellData());
    }
    return this->Mesh;
  }

private:
  void ReadElement(const PlyElement& element)
  {
    std::vector<PlyTarget> targets(element.Properties.size());
    if (element.Properties.empty())
    {
      return;
    }
    if (!this->Body.CanHold(element))
    {
      ThrowTruncated(this->Path, "element");
    }
    if (element.Name == "vertex")
    {
      this->ReadVertices(element);
    }
    else if (element.Name == "face")
    {
      this->FaceArrays = AssignArrays(element, this->Header.IsAscii, targets);
      this->ReadRows(element, targets, [this](const std::vector<vtkIdType>& corners) {
        this->Polygons->InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.data());
      });
    }
    else if (element.Name == "tristrips")
    {
      this->HasStrips = element.Count > 0;
      this->ReadRows(element, targets,
        [this](const std::vector<vtkIdType>& strip) { AppendStrips(strip, this->Polygons); });
    }
    else if (element.Name == "edge")
    {
      this->ReadEdges(element);
    }
    else
    {
      this->ReadRows(element, targets, [](const std::vector<vtkIdType>&) {});
    }
  }

  void ReadVertices(const PlyElement& element)
  {
    std::vector<PlyTarget> targets;
    const Arrays arrays = AssignArrays(element, this->Header.IsAscii, targets);
    const auto coordinates = arrays.find("Points");
    if (coordinates == arrays.end())
    {
      ThrowDamaged(this->Path, "its vertices have no properties x, y and z");
    }
    this->ReadRows(element, targets, [](const std::vector<vtkIdType>&) {});
    vtkNew<vtkPoints> points;
    points->SetData(coordinates->second);
    this->Mesh->SetPoints(points);
    AddArrays(arrays, this->Mesh->GetPointData());
  }

  void ReadEdges(const PlyElement& element)
  {
    const std::vector<int> ends = FindProperties(element, { "vertex1", "vertex2" });
    std::vector<PlyTarget> targets(element.Properties.size());
    const auto ids = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(VTK_DOUBLE));
    ids->SetNumberOfComponents(2);
    ids->SetNumberOfTuples(ends.empty() ? 0 : element.Count);
    for (std::size_t end = 0; end < ends.size(); ++end)
    {
      targets[ends[end]] = PlyTarget(ids, static_cast<int>(end));
    }
    this->ReadRows(element, targets, [](const std::vector<vtkIdType>&) {});
    for (vtkIdType edge = 0; edge < ids->GetNumberOfTuples(); ++edge)
    {
      const vtkIdType points[2] = { static_cast<vtkIdType>(ids->GetComponent(edge, 0)),
        static_cast<vtkIdType>(ids->GetComponent(edge, 1)) };
      this->Lines->InsertNextCell(2, points);
    }
  }

  template <typename Visitor>
  void ReadRows(
    const PlyElement& element, const std::vector<PlyTarget>& targets, const Visitor& visit)
  {
    const int list = FindIndexList(element);
    std::vector<vtkIdType> indices;
    for (long long row = 0; row < element.Count; ++row)
    {
      switch (this->Body.ReadRow(element, row, targets, list, indices))
      {
        case PlyBody::Row::Complete:
          break;
        case PlyBody::Row::Truncated:
          ThrowTruncated(this->Path, "element");
        case PlyBody::Row::Damaged:
          ThrowDamaged(this->Path,
            "a value of " + element.Name + " " + std::to_string(row) + " is not a number");
      }
      if (list >= 0)
      {
        visit(indices);
      }
    }
  }

  const std::string& Path;
  const PlyHeader& Header;
  PlyBody& Body;
  vtkSmartPointer<vtkPolyData> Mesh = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkCellArray> Polygons;
  vtkNew<vtkCellArray> Lines;
  Arrays FaceArrays;
  bool HasStrips = false;
};

}

vtkSmartPointer<vtkDataObject> ReadPly(const std::string& path)
{
  const MappedFile file(path);
  PlyHeader header;
  if (file.Size() == 0 || !ParsePlyHeader(file.Begin(), file.End(), header))
  {
    throw CommandError(BadInput, path + ": the file is damaged or not PLY: its header is invalid");
  }
  PlyBody body(file.Begin() + header.Size, file.End(), header);
  return Reader(path, header, body).Read();
}

}
