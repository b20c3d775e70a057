// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Meshes of Abaqus and CalculiX input files: *NODE, *ELEMENT, *PART and *INSTANCE.
#include "MeshReaders.h"

#include "Files/FileExtension.h"
#include "Files/MappedFile.h"
#include "MeshArrays.h"
#include "Processes/CommandError.h"
#include "TextScanner.h"

#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkTransform.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace penumbra
{

namespace
{

struct Element
{
  int CellType = 0;
  std::vector<long long> Nodes;
};

struct Part
{
  std::map<long long, std::array<double, 3>> Nodes;
  std::vector<Element> Elements;
};

struct Instance
{
  std::string Part;
  std::vector<std::vector<double>> Lines; ///< translation; two points of an axis and an angle
};

/// Number of nodes and VTK's cell type of an element; zeros if it has no shape, such as a mass.
std::pair<int, int> FindCellType(const std::string& type)
{
  struct Family
  {
    const char* Prefix;
    int Dimension;
    int Offset; ///< number of nodes minus the number that follows the prefix
  };
  static const Family families[] = { { "ac3d", 3, 0 }, { "dc3d", 3, 0 }, { "c3d", 3, 0 },
    { "sc", 3, 0 }, { "t3d", 1, 0 }, { "t2d", 1, 0 }, { "r2d", 1, 0 }, { "b3", 1, 1 },
    { "b2", 1, 1 }, { "stri", 2, 0 }, { "sfm3d", 2, 0 }, { "m3d", 2, 0 }, { "r3d", 2, 0 },
    { "cps", 2, 0 }, { "cpe", 2, 0 }, { "cgax", 2, 0 }, { "cax", 2, 0 }, { "dc2d", 2, 0 },
    { "ds", 2, 0 }, { "s", 2, 0 } };
  static const std::map<std::pair<int, int>, int> cells = { { { 3, 4 }, VTK_TETRA },
    { { 3, 10 }, VTK_QUADRATIC_TETRA }, { { 3, 5 }, VTK_PYRAMID }, { { 3, 6 }, VTK_WEDGE },
    { { 3, 15 }, VTK_QUADRATIC_WEDGE }, { { 3, 8 }, VTK_HEXAHEDRON },
    { { 3, 20 }, VTK_QUADRATIC_HEXAHEDRON }, { { 2, 3 }, VTK_TRIANGLE }, { { 2, 4 }, VTK_QUAD },
    { { 2, 6 }, VTK_QUADRATIC_TRIANGLE }, { { 2, 8 }, VTK_QUADRATIC_QUAD }, { { 1, 2 }, VTK_LINE },
    { { 1, 3 }, VTK_QUADRATIC_EDGE } };
  for (const Family& family : families)
  {
    const std::string prefix = family.Prefix;
    if (type.compare(0, prefix.size(), prefix) == 0)
    {
      int nodes = std::atoi(type.c_str() + prefix.size()) + family.Offset;
      nodes = nodes == 65 ? 6 : nodes; // STRI65
      const auto cell = cells.find({ family.Dimension, nodes });
      return cell == cells.end() ? std::pair<int, int>() : std::make_pair(nodes, cell->second);
    }
  }
  return {};
}

std::string Trim(std::string_view text)
{
  const std::size_t begin = std::min(text.find_first_not_of(" \t\""), text.size());
  const std::size_t end = text.find_last_not_of(" \t\"");
  return LowerCase(std::string(text.substr(begin, end == text.npos ? 0 : end + 1 - begin)));
}

std::vector<std::string> SplitAtCommas(std::string_view line)
{
  std::vector<std::string> fields;
  for (std::size_t begin = 0; begin <= line.size();)
  {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    fields.push_back(Trim(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return fields;
}

class Reader
{
public:
  Reader(const std::string& path, const MappedFile& file)
    : Path(path),
      Text(file.Begin(), file.End())
  {
  }

  vtkSmartPointer<vtkUnstructuredGrid> Read()
  {
    while (!this->Text.AtEnd())
    {
      ++this->LineNumber;
      const std::string_view line = this->Text.Line();
      const std::string start = Trim(line.substr(0, 2));
      if (start.empty() || start == "**")
      {
        continue;
      }
      const std::vector<std::string> fields = SplitAtCommas(line);
      start[0] == '*' ? this->ReadKeyword(fields) : this->ReadData(fields);
    }
    if (this->Missing > 0)
    {
      ThrowTruncated(this->Path, "node of an element");
    }
    this->Append();
    return this->Grid;
  }

private:
  enum class Sections
  {
    Ignored,
    Nodes,
    Elements,
    Instances
  };

  static std::string Parameter(const std::vector<std::string>& fields, const std::string& name)
  {
    for (const std::string& field : fields)
    {
      const std::size_t sign = field.find('=');
      if (sign != field.npos && Trim(field.substr(0, sign)) == name)
      {
        return Trim(field.substr(sign + 1));
      }
    }
    return {};
  }

  void ReadKeyword(const std::vector<std::string>& fields)
  {
    const std::string& keyword = fields[0];
    this->Section = Sections::Ignored;
    this->Missing = 0;
    if (keyword == "*node")
    {
      this->Section = Sections::Nodes;
    }
    else if (keyword == "*element")
    {
      std::tie(this->NodesPerElement, this->CellType) = FindCellType(Parameter(fields, "type"));
      this->Section = this->CellType ? Sections::Elements : Sections::Ignored;
    }
    else if (keyword == "*part")
    {
      this->Current = Parameter(fields, "name");
    }
    else if (keyword == "*end part" || keyword == "*endpart")
    {
      this->Current.clear();
    }
    else if (keyword == "*instance")
    {
      this->Instances.push_back({ Parameter(fields, "part"), {} });
      this->Section = Sections::Instances;
    }
    else if (keyword == "*include")
    {
      throw CommandError(BadInput,
        this->Path + ": it includes '" + Parameter(fields, "input") +
          "', which is not read; merge the files");
    }
  }

  double Number(const std::string& field) const
  {
    double value = 0.0;
    if (!ParseNumber(field, value))
    {
      ThrowDamaged(this->Path,
        "line " + std::to_string(this->LineNumber) + ": '" + field.substr(0, 40) +
          "' is not a number");
    }
    return value;
  }

  void ReadData(const std::vector<std::string>& fields)
  {
    Part& part = this->Parts[this->Current];
    if (this->Section == Sections::Nodes)
    {
      std::array<double, 3> point = {};
      for (std::size_t i = 1; i < fields.size() && i < 4; ++i)
      {
        point[i - 1] = fields[i].empty() ? 0.0 : this->Number(fields[i]);
      }
      part.Nodes[static_cast<long long>(this->Number(fields[0]))] = point;
    }
    else if (this->Section == Sections::Elements)
    {
      std::size_t first = 0;
      if (this->Missing == 0)
      {
        part.Elements.emplace_back();
        part.Elements.back().CellType = this->CellType;
        this->Missing = this->NodesPerElement;
        first = 1; // after the number of the element
      }
      for (std::size_t i = first; i < fields.size() && this->Missing > 0; ++i)
      {
        if (!fields[i].empty())
        {
          part.Elements.back().Nodes.push_back(static_cast<long long>(this->Number(fields[i])));
          --this->Missing;
        }
      }
    }
    else if (this->Section == Sections::Instances)
    {
      std::vector<double> numbers;
      for (const std::string& field : fields)
      {
        numbers.push_back(field.empty() ? 0.0 : this->Number(field));
      }
      this->Instances.back().Lines.push_back(numbers);
    }
  }

  void Append()
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    this->Grid->SetPoints(points);
    this->Grid->Allocate(1);
    vtkNew<vtkTransform> identity;
    for (const auto& [name, part] : this->Parts)
    {
      if (name.empty() || this->Instances.empty())
      {
        this->Append(part, identity);
      }
    }
    for (const Instance& instance : this->Instances)
    {
      vtkNew<vtkTransform> transform;
      if (!instance.Lines.empty() && instance.Lines[0].size() >= 3)
      {
        transform->Translate(instance.Lines[0].data());
      }
      if (instance.Lines.size() > 1 && instance.Lines[1].size() >= 7)
      {
        // The rotation follows the translation, about an axis through a and b.
        const std::vector<double>& r = instance.Lines[1];
        transform->PostMultiply();
        transform->Translate(-r[0], -r[1], -r[2]);
        transform->RotateWXYZ(r[6], r[3] - r[0], r[4] - r[1], r[5] - r[2]);
        transform->Translate(r[0], r[1], r[2]);
      }
      this->Append(this->Parts[instance.Part], transform);
    }
  }

  void Append(const Part& part, vtkTransform* transform)
  {
    std::map<long long, vtkIdType> ids;
    for (const auto& [node, point] : part.Nodes)
    {
      ids[node] = this->Grid->GetPoints()->InsertNextPoint(transform->TransformPoint(point.data()));
    }
    for (const Element& element : part.Elements)
    {
      std::vector<vtkIdType> corners;
      for (const long long node : element.Nodes)
      {
        const auto found = ids.find(node);
        if (found == ids.end())
        {
          ThrowDamaged(
            this->Path, "an element uses node " + std::to_string(node) + ", which does not exist");
        }
        corners.push_back(found->second);
      }
      this->Grid->InsertNextCell(
        element.CellType, static_cast<vtkIdType>(corners.size()), corners.data());
    }
  }

  const std::string& Path;
  TextScanner Text;
  long long LineNumber = 0;
  Sections Section = Sections::Ignored;
  int NodesPerElement = 0;
  int CellType = 0;
  int Missing = 0; ///< nodes of the element that continues on the next line
  std::string Current;
  std::map<std::string, Part> Parts;
  std::vector<Instance> Instances;
  vtkNew<vtkUnstructuredGrid> Grid;
};

}

bool IsAbaqus(const std::string& path)
{
  const MappedFile file(path);
  TextScanner text(file.Begin(), file.End());
  return text.Word().substr(0, 1) == "*";
}

vtkSmartPointer<vtkDataObject> ReadAbaqus(const std::string& path)
{
  const MappedFile file(path);
  return Reader(path, file).Read();
}

}
