// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Meshes of Abaqus and CalculiX input files: *NODE, *ELEMENT, *PART, *INSTANCE and *INCLUDE.
#include "MeshReaders.h"

#include "Files/FileExtension.h"
#include "Files/InputFiles.h"
#include "Files/MappedFile.h"
#include "MeshArrays.h"
#include "Processes/CommandError.h"
#include "TextScanner.h"

#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkTransform.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
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
  std::string Name;
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
  static const Family families[] = { { "ac3d", 3, 0 }, { "dcc3d", 3, 0 }, { "dc3d", 3, 0 },
    { "coh3d", 3, 0 }, { "c3d", 3, 0 }, { "sc", 3, 0 }, { "t3d", 1, 0 }, { "t2d", 1, 0 },
    { "r2d", 1, 0 }, { "rax", 1, 0 }, { "sax", 1, 1 }, { "max", 1, 1 }, { "dc1d", 1, 0 },
    { "b33", 1, 2 }, { "b23", 1, 2 }, { "b3", 1, 1 }, { "b2", 1, 1 }, { "pipe3", 1, 1 },
    { "pipe2", 1, 1 }, { "stri", 2, 0 }, { "sfm3d", 2, 0 }, { "m3d", 2, 0 }, { "r3d", 2, 0 },
    { "cps", 2, 0 }, { "cpeg", 2, 0 }, { "cpe", 2, 0 }, { "cgax", 2, 0 }, { "cax", 2, 0 },
    { "dccax", 2, 0 }, { "dcc2d", 2, 0 }, { "dcax", 2, 0 }, { "dc2d", 2, 0 }, { "ac2d", 2, 0 },
    { "acax", 2, 0 }, { "coh2d", 2, 0 }, { "cohax", 2, 0 }, { "ds", 2, 0 }, { "us", 2, 0 },
    { "s", 2, 0 } };
  static const std::map<std::pair<int, int>, int> cells = { { { 3, 4 }, VTK_TETRA },
    { { 3, 10 }, VTK_QUADRATIC_TETRA }, { { 3, 5 }, VTK_PYRAMID }, { { 3, 6 }, VTK_WEDGE },
    { { 3, 15 }, VTK_QUADRATIC_WEDGE }, { { 3, 8 }, VTK_HEXAHEDRON },
    { { 3, 20 }, VTK_QUADRATIC_HEXAHEDRON }, { { 2, 3 }, VTK_TRIANGLE }, { { 2, 4 }, VTK_QUAD },
    { { 2, 6 }, VTK_QUADRATIC_TRIANGLE }, { { 2, 8 }, VTK_QUADRATIC_QUAD },
    { { 2, 9 }, VTK_BIQUADRATIC_QUAD }, { { 1, 2 }, VTK_LINE }, { { 1, 3 }, VTK_QUADRATIC_EDGE } };
  for (const Family& family : families)
  {
    const std::string prefix = family.Prefix;
    if (type.compare(0, prefix.size(), prefix) == 0)
    {
      int nodes = std::atoi(type.c_str() + prefix.size()) + family.Offset;
      nodes = nodes == 65 ? 6 : nodes;  // STRI65
      nodes = nodes == 27 ? 20 : nodes; // C3D27: the first nodes are those of C3D20.
      const auto cell = cells.find({ family.Dimension, nodes });
      return cell == cells.end() ? std::pair<int, int>() : std::make_pair(nodes, cell->second);
    }
  }
  return {};
}

/// Returns the text without blanks and quotation marks around it.
std::string Strip(std::string_view text)
{
  const std::size_t begin = std::min(text.find_first_not_of(" \t\""), text.size());
  const std::size_t end = text.find_last_not_of(" \t\"");
  return std::string(text.substr(begin, end == text.npos ? 0 : end + 1 - begin));
}

/// Returns the same in lower case: names do not depend on it.
std::string Trim(std::string_view text)
{
  return LowerCase(Strip(text));
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

/// Number of files that may include each other.
constexpr int MaximumDepth = 16;

class Reader
{
public:
  explicit Reader(const std::string& path)
    : Path(path)
  {
  }

  vtkSmartPointer<vtkUnstructuredGrid> Read()
  {
    this->ReadFile(this->Path);
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

  void ReadFile(const std::string& path)
  {
    const MappedFile file(path);
    TextScanner text(file.Begin(), file.End());
    const long long outerLine = this->LineNumber;
    this->LineNumber = 0;
    while (!text.AtEnd())
    {
      ++this->LineNumber;
      std::string line(text.Line());
      const std::string start = Trim(line).substr(0, 2);
      if (start.empty() || start == "**")
      {
        continue;
      }
      if (start[0] != '*')
      {
        this->ReadData(SplitAtCommas(line));
        continue;
      }
      while (EndsWithComma(line) && !text.AtEnd())
      {
        ++this->LineNumber;
        line += text.Line();
      }
      this->ReadKeyword(SplitAtCommas(line), line);
    }
    this->LineNumber = outerLine;
  }

  static bool EndsWithComma(const std::string& line)
  {
    const std::size_t last = line.find_last_not_of(" \t");
    return last != line.npos && line[last] == ',';
  }

  /// Reads the file of a parameter INPUT, which is relative to the folder of the first file.
  void Include(const std::string& line)
  {
    const std::size_t parameter = LowerCase(line).find("input");
    const std::size_t sign = parameter == line.npos ? line.npos : line.find('=', parameter);
    const std::size_t end = line.find(',', std::min(sign, line.size()));
    const std::string name = sign == line.npos ? "" : Strip(line.substr(sign + 1, end - sign - 1));
    const std::filesystem::path path = std::filesystem::path(this->Path).parent_path() / name;
    std::error_code error;
    if (name.empty() || !std::filesystem::is_regular_file(path, error))
    {
      throw CommandError(BadInput,
        this->Path + ": the included file '" + name +
          "' is missing; copy it to the folder of the file");
    }
    if (this->Depth == MaximumDepth)
    {
      ThrowDamaged(this->Path, "its files include each other");
    }
    RecordInput(path.string());
    ++this->Depth;
    this->ReadFile(path.string());
    --this->Depth;
  }

  void ReadKeyword(const std::vector<std::string>& fields, const std::string& line)
  {
    const std::string& keyword = fields[0];
    if (keyword == "*include")
    {
      this->Include(line);
      return;
    }
    this->Section = Sections::Ignored;
    this->Missing = 0;
    if (keyword == "*node")
    {
      this->Section = Sections::Nodes;
      const std::string system = Parameter(fields, "system");
      this->System = system.empty() ? 'r' : system[0];
    }
    else if (keyword == "*ngen" || keyword == "*nfill" || keyword == "*ncopy" ||
      keyword == "*nmap" || keyword == "*elgen" || keyword == "*elcopy" || keyword == "*system")
    {
      throw CommandError(BadInput,
        this->Path + ": " + keyword +
          ", which generates or moves nodes or elements, is not supported; write them out");
    }
    else if (keyword == "*element")
    {
      std::tie(this->NodesPerElement, this->CellType) = FindCellType(Parameter(fields, "type"));
      this->Section = this->CellType ? Sections::Elements : Sections::Ignored;
    }
    else if (keyword == "*part")
    {
      this->Current = PartPrefix + Parameter(fields, "name");
    }
    else if (keyword == "*instance")
    {
      // An instance may have nodes and elements of its own in place of those of its part.
      this->Current = InstancePrefix + Parameter(fields, "name");
      this->Instances.push_back({ this->Current, PartPrefix + Parameter(fields, "part"), {} });
      this->Section = Sections::Instances;
    }
    else if (keyword == "*end part" || keyword == "*endpart" || keyword == "*end instance" ||
      keyword == "*endinstance")
    {
      this->Current.clear();
    }
  }

  /// Returns the Cartesian coordinates of a node of the system of *NODE.
  std::array<double, 3> ToCartesian(std::array<double, 3> point) const
  {
    const double radius = point[0];
    const double azimuth = vtkMath::RadiansFromDegrees(point[1]);
    const double elevation = vtkMath::RadiansFromDegrees(point[2]);
    switch (this->System)
    {
      case 'c':
        return { radius * std::cos(azimuth), radius * std::sin(azimuth), point[2] };
      case 's':
        return { radius * std::cos(azimuth) * std::cos(elevation),
          radius * std::sin(azimuth) * std::cos(elevation), radius * std::sin(elevation) };
      default:
        return point;
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
      part.Nodes[static_cast<long long>(this->Number(fields[0]))] = this->ToCartesian(point);
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
      // Without an assembly, the parts are shown.
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
      const Part& own = this->Parts[instance.Name];
      this->Append(own.Nodes.empty() ? this->Parts[instance.Part] : own, transform);
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
      if (element.CellType == VTK_QUADRATIC_EDGE)
      {
        this->MoveMiddleToEnd(corners);
      }
      this->Grid->InsertNextCell(
        element.CellType, static_cast<vtkIdType>(corners.size()), corners.data());
    }
  }

  /// Beams name their middle node second, trusses of some programs last: it is the one between the others.
  void MoveMiddleToEnd(std::vector<vtkIdType>& nodes) const
  {
    std::array<double, 3> p[3];
    for (int i = 0; i < 3; ++i)
    {
      this->Grid->GetPoint(nodes[i], p[i].data());
    }
    const auto distance = [&p](int i, int j) {
      return vtkMath::Distance2BetweenPoints(p[i].data(), p[j].data());
    };
    if (distance(0, 2) > distance(0, 1))
    {
      std::swap(nodes[1], nodes[2]);
    }
  }

  static constexpr const char* PartPrefix = "part ";
  static constexpr const char* InstancePrefix = "instance ";

  const std::string& Path;
  int Depth = 0;     ///< of the included file
  char System = 'r'; ///< of *NODE: r: Cartesian, c: cylindrical, s: spherical
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
  return Reader(path).Read();
}

}
