// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionSurfaces.h"

#include "Geometry/PolygonTriangulation.h"
#include "Scene.h"
#include "SceneExtractionClipping.h"
#include "Surface.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace penumbra
{
namespace
{

bool IsFinite(glm::vec3 x)
{
  return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z);
}

/// Triangles of consecutive cells.
struct CollectedTriangles
{
  std::vector<glm::uvec3> Triangles;
  std::vector<std::uint32_t> Cells; ///< of each triangle, unless every cell is one triangle
  bool AreCellsTriangles = true;
  std::size_t InvalidCells = 0;
};

/// Collects the triangles of consecutive polygons or strips. One thread uses it.
class PartCollector
{
public:
  /// `first`: index of the first cell.
  PartCollector(const std::vector<glm::vec3>& positions, std::uint32_t first)
    : Positions(positions),
      FirstCell(first),
      NextCell(first)
  {
  }

  void AddCell(vtkCellArray* cells, vtkIdType i, bool isStrip)
  {
    cells->GetCellAtId(i, this->Cell);
    const vtkIdType size = this->Cell->GetNumberOfIds();
    const vtkIdType* ids = this->Cell->GetPointer(0);
    const std::size_t before = this->Found.Triangles.size();
    if (!this->AreValid(ids, size))
    {
      ++this->Found.InvalidCells;
    }
    else if (isStrip)
    {
      this->AddStrip(ids, size);
    }
    else if (size == 3)
    {
      this->Add(ids[0], ids[1], ids[2]);
    }
    else
    {
      this->AddPolygon(ids, size);
    }
    this->RecordCells(this->Found.Triangles.size() - before);
    ++this->NextCell;
  }

  CollectedTriangles Take() { return std::move(this->Found); }

private:
  bool AreValid(const vtkIdType* ids, vtkIdType size) const
  {
    const auto count = static_cast<vtkIdType>(this->Positions.size());
    return std::all_of(ids, ids + size,
      [&](vtkIdType id) { return id >= 0 && id < count && IsFinite(this->Positions[id]); });
  }

  void Add(vtkIdType i, vtkIdType j, vtkIdType k)
  {
    const glm::dvec3 a = this->Positions[i];
    const glm::dvec3 b = this->Positions[j];
    const glm::dvec3 c = this->Positions[k];
    if (glm::cross(b - a, c - a) != glm::dvec3(0.0)) // others have no area and are invisible
    {
      this->Found.Triangles.emplace_back(i, j, k);
    }
  }

  void AddStrip(const vtkIdType* ids, vtkIdType size)
  {
    for (vtkIdType k = 0; k + 2 < size; ++k)
    {
      this->Add(ids[k], ids[k + 1 + k % 2], ids[k + 2 - k % 2]);
    }
  }

  void AddPolygon(const vtkIdType* ids, vtkIdType size)
  {
    this->Corners.clear();
    for (vtkIdType i = 0; i < size; ++i)
    {
      this->Corners.emplace_back(this->Positions[ids[i]]);
    }
    TriangulatePolygon(this->Corners, this->Triangulation);
    for (const glm::uvec3& triangle : this->Triangulation)
    {
      this->Add(ids[triangle.x], ids[triangle.y], ids[triangle.z]);
    }
  }

  void RecordCells(std::size_t triangles)
  {
    if (this->Found.AreCellsTriangles && triangles == 1)
    {
      return;
    }
    if (this->Found.AreCellsTriangles)
    {
      // This is the first cell that is not a single triangle. From here on, the cells are recorded.
      this->Found.AreCellsTriangles = false;
      for (std::uint32_t i = this->FirstCell; i < this->NextCell; ++i)
      {
        this->Found.Cells.push_back(i);
      }
    }
    this->Found.Cells.insert(this->Found.Cells.end(), triangles, this->NextCell);
  }

  const std::vector<glm::vec3>& Positions;
  const std::uint32_t FirstCell;
  std::uint32_t NextCell;
  CollectedTriangles Found;
  vtkNew<vtkIdList> Cell;
  std::vector<glm::dvec3> Corners;
  std::vector<glm::uvec3> Triangulation;
};

/// Collects the triangles of one poly data and counts the cells and triangles that are skipped.
class TriangleCollector
{
public:
  TriangleCollector(const DrawItem& item, Surface& surface)
    : Data(item.Data),
      Progress(item.Progress),
      Target(surface)
  {
    vtkPolyData* data = this->Data;
    const vtkIdType expected = data->GetPolys()->GetNumberOfConnectivityIds() -
      2 * data->GetPolys()->GetNumberOfCells() + data->GetStrips()->GetNumberOfConnectivityIds();
    surface.Triangles.reserve(static_cast<std::size_t>(std::max<vtkIdType>(expected, 0)) + 1);
    const vtkIdType first =
      data->GetVerts()->GetNumberOfCells() + data->GetLines()->GetNumberOfCells();
    this->NextCell = static_cast<std::uint32_t>(first);
    this->AreCellsTriangles = first == 0;
  }

  void AddPolygons() { this->AddCells(this->Data->GetPolys(), false); }

  void AddStrips() { this->AddCells(this->Data->GetStrips(), true); }

  /// Returns the cell of each triangle; empty if it is the triangle's index.
  const std::vector<std::uint32_t>& GetCells() const { return this->Cells; }

  void Warn(const std::string& name, std::vector<std::string>& warnings) const
  {
    if (this->InvalidCells > 0)
    {
      warnings.push_back(name + ": " + std::to_string(this->InvalidCells) +
        " cells use points that do not exist or are not finite. They were skipped.");
    }
  }

private:
  void AddCells(vtkCellArray* cells, bool areStrips)
  {
    const auto count = static_cast<std::size_t>(cells->GetNumberOfCells());
    const std::vector<std::size_t> boundaries = SplitIntoParts(count, StoppableCells);
    std::vector<CollectedTriangles> parts(boundaries.size() - 1);
    const auto collect = [&](int part) {
      const std::size_t first = boundaries[part];
      PartCollector collector(
        this->Target.Positions, this->NextCell + static_cast<std::uint32_t>(first));
      for (std::size_t i = first; i < boundaries[part + 1]; ++i)
      {
        collector.AddCell(cells, static_cast<vtkIdType>(i), areStrips);
      }
      parts[part] = collector.Take();
    };
    if (!ParallelForWithProgress(static_cast<int>(parts.size()), 0.0, 0.0, this->Progress, collect))
    {
      throw Stopped();
    }
    this->Append(parts, boundaries);
    this->NextCell += static_cast<std::uint32_t>(count);
  }

  /// Appends the triangles of parts. Part i starts with cell boundaries[i] after NextCell.
  void Append(std::vector<CollectedTriangles>& parts, const std::vector<std::size_t>& boundaries)
  {
    std::vector<glm::uvec3>& triangles = this->Target.Triangles;
    const std::size_t first = triangles.size();
    std::vector<std::size_t> begin = { first };
    bool areCellsTriangles = this->AreCellsTriangles;
    for (const CollectedTriangles& part : parts)
    {
      begin.push_back(begin.back() + part.Triangles.size());
      areCellsTriangles = areCellsTriangles && part.AreCellsTriangles;
      this->InvalidCells += part.InvalidCells;
    }
    triangles.resize(begin.back());
    if (!areCellsTriangles)
    {
      this->Cells.resize(begin.back());
    }
    if (this->AreCellsTriangles && !areCellsTriangles)
    {
      std::iota(this->Cells.begin(), this->Cells.begin() + static_cast<std::ptrdiff_t>(first), 0);
    }
    this->AreCellsTriangles = areCellsTriangles;
    ParallelFor<std::size_t>(0, parts.size(), 1, [&](std::size_t i) {
      CollectedTriangles& part = parts[i];
      std::copy(part.Triangles.begin(), part.Triangles.end(), triangles.data() + begin[i]);
      if (!areCellsTriangles && part.AreCellsTriangles)
      {
        std::iota(this->Cells.data() + begin[i], this->Cells.data() + begin[i + 1],
          this->NextCell + static_cast<std::uint32_t>(boundaries[i]));
      }
      else if (!areCellsTriangles)
      {
        std::copy(part.Cells.begin(), part.Cells.end(), this->Cells.data() + begin[i]);
      }
      part = {};
    });
  }

  vtkPolyData* Data;
  const ProgressCallback& Progress;
  Surface& Target;
  std::vector<std::uint32_t> Cells;
  std::uint32_t NextCell = 0;
  bool AreCellsTriangles = true; ///< true as long as cell i is triangle i
  std::size_t InvalidCells = 0;
};

/// Returns the number of values per cell that `surface` needs: the size of `cells`, or the number
/// of triangles if `cells` is empty.
std::size_t CountValues(const std::vector<std::uint32_t>& cells, const Surface& surface)
{
  return cells.empty() ? surface.Triangles.size() : cells.size();
}

std::uint32_t FindCell(const std::vector<std::uint32_t>& cells, std::size_t triangle)
{
  return cells.empty() ? static_cast<std::uint32_t>(triangle) : cells[triangle];
}

void SetNormals(const DrawItem& item, const SceneTransform& transform,
  const std::vector<std::uint32_t>& cells, Surface& surface)
{
  const auto convert = [&](vtkDataArray* from, vtkIdType i) {
    double n[3];
    from->GetTuple(i, n);
    return transform.Normal(n);
  };
  vtkDataArray* pointNormals = item.Data->GetPointData()->GetNormals();
  if (item.Property->GetInterpolation() != VTK_FLAT && pointNormals)
  {
    surface.Normals.resize(surface.Positions.size());
    ParallelFor<std::size_t>(0, surface.Normals.size(), ArrayGrain, [&](std::size_t i) {
      surface.Normals[i] = convert(pointNormals, static_cast<vtkIdType>(i));
    });
    return;
  }
  if (vtkDataArray* cellNormals = item.Data->GetCellData()->GetNormals())
  {
    surface.TriangleNormals.resize(surface.Triangles.size());
    ParallelFor<std::size_t>(0, surface.Triangles.size(), ArrayGrain, [&](std::size_t i) {
      surface.TriangleNormals[i] = convert(cellNormals, FindCell(cells, i));
    });
  }
}

/// Sets the tangents if the material uses them. As VTK's shaders do, they are transformed like
/// normals.
void SetTangents(const DrawItem& item, const SceneTransform& transform, Surface& surface)
{
  vtkDataArray* from = item.Data->GetPointData()->GetTangents();
  if (!surface.Front.PhysicallyBased || !from || from->GetNumberOfComponents() != 3)
  {
    return;
  }
  surface.Tangents.reserve(surface.Positions.size());
  for (std::size_t i = 0; i < surface.Positions.size(); ++i)
  {
    double tangent[3];
    from->GetTuple(static_cast<vtkIdType>(i), tangent);
    surface.Tangents.push_back(transform.Normal(tangent));
  }
}

glm::u8vec4 GetColor(vtkUnsignedCharArray* colors, vtkIdType i)
{
  const unsigned char* c = colors->GetPointer(4 * i);
  return { c[0], c[1], c[2], c[3] };
}

std::vector<glm::vec2> MakeTextureCoordinates(vtkDataArray* from)
{
  std::vector<glm::vec2> result(static_cast<std::size_t>(from->GetNumberOfTuples()));
  const bool two = from->GetNumberOfComponents() > 1;
  ParallelFor<std::size_t>(0, result.size(), ArrayGrain, [&](std::size_t i) {
    const auto tuple = static_cast<vtkIdType>(i);
    result[i] = { from->GetComponent(tuple, 0), two ? from->GetComponent(tuple, 1) : 0.0 };
  });
  return result;
}

}

std::vector<glm::vec3> MakePositions(const DrawItem& item, const Scene& scene)
{
  const SceneTransform transform(item.ToWorld, scene);
  const auto count = static_cast<std::size_t>(item.Data->GetNumberOfPoints());
  std::vector<glm::vec3> positions;
  positions.reserve(count + 1);
  positions.resize(count);
  ParallelFor<std::size_t>(0, count, ArrayGrain, [&](std::size_t i) {
    double x[3];
    item.Data->GetPoints()->GetPoint(static_cast<vtkIdType>(i), x);
    positions[i] = transform.Point(x);
  });
  return positions;
}

void SetColors(const DrawItem& item, const std::vector<std::uint32_t>& cells, Surface& surface)
{
  const Coloring& coloring = item.Colors;
  surface.ScalarColoring = coloring.Mode != Coloring::Modes::None;
  switch (coloring.Mode)
  {
    case Coloring::Modes::None:
      break;
    case Coloring::Modes::PerPoint:
      surface.PointColors.resize(static_cast<std::size_t>(item.Data->GetNumberOfPoints()));
      ParallelFor<std::size_t>(0, surface.PointColors.size(), ArrayGrain, [&](std::size_t i) {
        surface.PointColors[i] = GetColor(coloring.Colors, static_cast<vtkIdType>(i));
      });
      break;
    case Coloring::Modes::PerCell:
      surface.CellColors.resize(CountValues(cells, surface));
      ParallelFor<std::size_t>(0, surface.CellColors.size(), ArrayGrain, [&](std::size_t i) {
        surface.CellColors[i] = GetColor(coloring.Colors, FindCell(cells, i));
      });
      break;
    case Coloring::Modes::Single:
      surface.Front.AmbientColor = glm::vec3(coloring.SingleColor) / 255.f;
      surface.Front.DiffuseColor = surface.Front.AmbientColor;
      surface.Front.Opacity *= static_cast<float>(coloring.SingleColor.a) / 255.f;
      break;
    case Coloring::Modes::Texture:
      surface.ColorTexture = coloring.Map;
      surface.ColorCoordinates = MakeTextureCoordinates(coloring.Coordinates);
      break;
  }
  vtkDataArray* coordinates = item.Data->GetPointData()->GetTCoords();
  if ((item.LitTexture || item.BaseColorTexture || item.DetailTextures) && coordinates)
  {
    surface.LitTexture = item.LitTexture;
    surface.BaseColorTexture = item.BaseColorTexture;
    surface.DetailTextures = item.DetailTextures;
    surface.TextureCoordinates = MakeTextureCoordinates(coordinates);
    surface.TextureOnBackfaces = item.Property->GetShowTexturesOnBackface();
  }
}

void SetCellIds(const DrawItem& item, const std::vector<std::uint32_t>& cells, Surface& surface)
{
  surface.CellIds = cells;
  if (item.CellIds)
  {
    surface.CellIds.resize(CountValues(cells, surface));
    ParallelFor<std::size_t>(0, surface.CellIds.size(), ArrayGrain, [&](std::size_t i) {
      surface.CellIds[i] =
        static_cast<std::uint32_t>(item.CellIds->GetComponent(FindCell(cells, i), 0));
    });
  }
}

void AddSurface(const DrawItem& item, Scene& scene)
{
  if (item.Data->GetPolys()->GetNumberOfCells() + item.Data->GetStrips()->GetNumberOfCells() == 0)
  {
    return;
  }
  Surface surface;
  surface.ObjectId = item.ObjectId;
  surface.Positions = MakePositions(item, scene);
  TriangleCollector triangles(item, surface);
  triangles.AddPolygons();
  triangles.AddStrips();
  triangles.Warn(item.Name, scene.Warnings);
  if (surface.Triangles.empty())
  {
    return;
  }
  ParallelFor<std::size_t>(0, surface.Positions.size(), ArrayGrain, [&](std::size_t i) {
    glm::vec3& x = surface.Positions[i];
    x = IsFinite(x) ? x : glm::vec3(0.f);
  });
  surface.Front = MakeMaterial(item.Property);
  surface.HasBackMaterial = item.BackProperty && item.Colors.Mode == Coloring::Modes::None;
  if (surface.HasBackMaterial)
  {
    surface.Back = MakeMaterial(item.BackProperty);
  }
  surface.Backfaces = !item.Property->GetBackfaceCulling();
  surface.Frontfaces = !item.Property->GetFrontfaceCulling();
  surface.IsLineOrPoint = item.FacingSplats != nullptr;
  surface.IsAdditive = item.FacingSplats && item.FacingSplats->IsAdditive;
  const std::vector<std::uint32_t>& cells = triangles.GetCells();
  SetNormals(item, SceneTransform(item.ToWorld, scene), cells, surface);
  SetTangents(item, SceneTransform(item.ToWorld, scene), surface);
  SetColors(item, cells, surface);
  SetCellIds(item, cells, surface);
  ClipSurface(item.ClippingPlanes, scene, surface);
  if (!item.PolygonOffset.IsZero())
  {
    OffsetSurface(scene.ViewCamera, item.PolygonOffset, surface);
    surface.DepthRank = static_cast<float>(item.PolygonOffset.GetRank());
  }
  if (!surface.Triangles.empty())
  {
    scene.Surfaces.push_back(std::move(surface));
  }
}

}
