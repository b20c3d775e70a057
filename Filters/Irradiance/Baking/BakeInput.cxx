// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BakeInput.h"

#include "Execution/RankAgreement.h"
#include "Gathering/IrradianceConstants.h"
#include "Geometry/SurfaceGeometry.h"
#include "OccluderGeometry.h"
#include "PointNormals.h"
#include "Shading/HemisphereSampling.h"
#include "Surface.h"
#include "SurfacePatches.h"
#include "Tessellation/MemoryEstimate.h"

#include "vtkBoundingBox.h"
#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolygon.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace penumbra
{
namespace
{

/// Surface::ObjectId of the surroundings; that of the mesh is 0.
constexpr int SurroundingsId = 1;

/// Number of sides of the disks that represent points.
constexpr unsigned int DiscSides = 6;

void AddFinitePoints(vtkPolyData* mesh, vtkBoundingBox& bounds)
{
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double x[3];
    mesh->GetPoint(i, x);
    if (IsFinite(x))
    {
      bounds.AddPoint(x);
    }
  }
}

void UniteBoxes(RankAgreement* ranks, vtkBoundingBox& box)
{
  double bounds[6];
  box.GetBounds(bounds);
  if (ranks)
  {
    ranks->UniteBounds(bounds);
  }
  if (bounds[0] <= bounds[1])
  {
    box.SetBounds(bounds);
  }
}

/// Extracts occluders and query points from a data set.
class BakeInputBuilder
{
public:
  BakeInputBuilder(
    vtkPointSet* data, const BakeInputOptions& options, const ProgressCallback& progress)
    : Data(data),
      Options(options),
      Progress(progress),
      Mesh(DropMismatchedAttributes(
        FacingOutwards(ExtractSurface(data, progress), data, progress), Result.SkippedAttributes))
  {
  }

  BakeInput Build()
  {
    RequireMemoryForOccluders(this->Mesh, this->Options.PointRadius, this->Options.LineRadius);
    this->Center();
    this->AddTriangles();
    std::vector<double> counts = { static_cast<double>(this->Triangles.size()),
      static_cast<double>(this->Mesh->GetNumberOfPolys() + this->Mesh->GetNumberOfStrips()) };
    if (this->Options.Ranks)
    {
      this->Options.Ranks->Sum(counts);
    }
    this->HasPolygons = counts[1] > 0.0;
    if (counts[0] == 0.0 && this->Options.PointRadius > 0.0)
    {
      this->FindNormals();
      this->AddDiscs();
    }
    else if (this->Options.OnCells)
    {
      this->AddCells();
    }
    else
    {
      this->FindNormals();
      this->AddPoints();
    }
    this->Finish();
    return std::move(this->Result);
  }

private:
  void Center()
  {
    vtkBoundingBox& bounds = this->Result.Bounds;
    AddFinitePoints(this->Mesh, bounds);
    UniteBoxes(this->Options.Ranks, bounds);
    double center[3] = { 0.0, 0.0, 0.0 };
    if (bounds.IsValid())
    {
      bounds.GetCenter(center);
      this->Result.Diagonal = bounds.GetDiagonalLength();
    }
    Scene& scene = this->Result.OccluderScene;
    scene.Origin = { center[0], center[1], center[2] };
    scene.Scale = this->Result.Diagonal > 0.0 ? 1.0 / this->Result.Diagonal : 1.0;
    this->Positions.reserve(this->Mesh->GetNumberOfPoints() + 1);
    for (vtkIdType i = 0; i < this->Mesh->GetNumberOfPoints(); ++i)
    {
      double x[3];
      this->Mesh->GetPoint(i, x);
      this->Positions.emplace_back(scene.FromWorld(x));
    }
    this->Finite.resize(this->Positions.size());
    for (std::size_t i = 0; i < this->Positions.size(); ++i)
    {
      const glm::vec3 p = this->Positions[i];
      this->Finite[i] = std::isfinite(p.x + p.y + p.z);
      this->Positions[i] = this->Finite[i] ? p : glm::vec3(0.f);
    }
  }

  void AddTriangles()
  {
    this->Triangles = Triangulate(this->Mesh, this->Finite, this->Progress);
    this->EdgeSums.assign(this->Positions.size(), 0.f);
    this->EdgeCounts.assign(this->Positions.size(), 0);
    for (const glm::uvec3& corners : this->Triangles)
    {
      for (int k = 0; k < 3; ++k)
      {
        const unsigned int from = corners[k];
        const unsigned int to = corners[(k + 1) % 3];
        const float length = glm::distance(this->Positions[from], this->Positions[to]);
        for (const unsigned int end : { from, to })
        {
          this->EdgeSums[end] += length;
          ++this->EdgeCounts[end];
        }
      }
    }
  }

  void FindNormals()
  {
    this->Normals = this->Mesh->GetPointData()->GetNormals();
    if (!this->Normals || this->Options.ComputeNormals)
    {
      this->Normals = ComputePointNormals(this->Mesh, this->Result.DoubledPolygons, this->Progress);
      this->HasComputedNormals = this->Normals != nullptr;
    }
  }

  /// Returns the unit normal of a point; 0 if it has none.
  glm::vec3 GetNormal(vtkIdType point)
  {
    double n[3] = { 0.0, 0.0, 0.0 };
    if (this->Normals)
    {
      this->Normals->GetTuple(point, n);
    }
    const glm::dvec3 normal(n[0], n[1], n[2]);
    const double length = glm::length(normal);
    return length > 0.0 && std::isfinite(length) ? glm::vec3(normal / length) : glm::vec3(0.f);
  }

  /// Adds a query point for the point or cell `id` of the surface. Returns false if it has none.
  bool AddSite(vtkIdType id, glm::vec3 position, glm::vec3 normal, float spacing)
  {
    if (!this->Originals.empty())
    {
      id = this->Originals[static_cast<std::size_t>(id)];
    }
    if (id < 0)
    {
      return false; // added by the surface extraction
    }
    if (normal == glm::vec3(0.f))
    {
      ++(this->HasComputedNormals ? this->Result.TwoSided : this->Result.NotFinite);
      if (!this->HasComputedNormals)
      {
        return false;
      }
    }
    RecordCandidate site;
    site.Position = position;
    site.Normal = normal;
    site.Pixel = spacing;
    this->Result.Sites.push_back(site);
    this->Result.Ids.push_back(id);
    return true;
  }

  /// Adds the end of the corners of the last query point.
  void EndCorners() { this->Result.CornerEnds.push_back(this->Result.Corners.size()); }

  /// Counts the points or cells, `count` in total, without a query point. A cell may have several,
  /// one per face.
  void CountUnused(vtkIdType count)
  {
    std::vector<vtkIdType> ids = this->Result.Ids;
    std::sort(ids.begin(), ids.end());
    const auto baked = std::unique(ids.begin(), ids.end()) - ids.begin();
    this->Result.Unused = std::max<vtkIdType>(count - baked - this->Result.NotFinite, 0);
  }

  void AddPoints()
  {
    this->Originals = OriginalIds(this->Mesh, this->Data, vtkDataObject::POINT);
    for (std::size_t i = 0; i < this->Positions.size(); ++i)
    {
      const auto point = static_cast<vtkIdType>(i);
      if (!this->Finite[i])
      {
        ++this->Result.NotFinite;
      }
      else if (this->EdgeCounts[i] > 0 &&
        this->AddSite(point, this->Positions[i], this->GetNormal(point),
          this->EdgeSums[i] / static_cast<float>(this->EdgeCounts[i])))
      {
        this->Result.Corners.push_back(static_cast<std::uint32_t>(i));
        this->EndCorners();
      }
    }
    this->CountUnused(this->Data->GetNumberOfPoints());
  }

  void AddCells()
  {
    this->Originals = OriginalIds(this->Mesh, this->Data, vtkDataObject::CELL);
    for (vtkIdType cell = 0; cell < this->Mesh->GetNumberOfCells(); ++cell)
    {
      if (cell % StoppableCells == 0)
      {
        ThrowIfStopped(this->Progress, 0.0);
      }
      vtkCell* polygon = this->Mesh->GetCell(cell);
      if (polygon->GetCellDimension() != 2)
      {
        continue;
      }
      const vtkIdType* const ids = polygon->GetPointIds()->GetPointer(0);
      const std::vector<vtkIdType> corners(ids, ids + polygon->GetNumberOfPoints());
      const auto isFinite = [this](vtkIdType id) { return this->Finite[id] != 0; };
      if (!std::all_of(corners.begin(), corners.end(), isFinite))
      {
        ++this->Result.NotFinite;
      }
      else if (polygon->GetCellType() == VTK_TRIANGLE_STRIP)
      {
        this->AddStrip(cell, corners);
      }
      else
      {
        double n[3];
        vtkPolygon::ComputeNormal(polygon->GetPoints(), n);
        this->AddFace(cell, corners, { n[0], n[1], n[2] });
      }
    }
    this->CountUnused(this->Data->GetNumberOfCells());
  }

  /// Adds a query point for each triangle of a strip: the value of the strip is their mean, weighted
  /// by area.
  void AddStrip(vtkIdType cell, const std::vector<vtkIdType>& corners)
  {
    for (std::size_t i = 2; i < corners.size(); ++i)
    {
      const std::vector<vtkIdType> triangle = { corners[i - 2], corners[i - 1 + i % 2],
        corners[i - i % 2] };
      const glm::vec3 first = this->Positions[triangle[0]];
      const glm::vec3 normal =
        glm::cross(this->Positions[triangle[1]] - first, this->Positions[triangle[2]] - first);
      if (this->AddFace(cell, triangle, normal))
      {
        this->Result.Weights.resize(this->Result.Sites.size(), 1.f);
        this->Result.Weights.back() = .5f * glm::length(normal);
      }
    }
  }

  /// Adds a query point at the center of a polygon of a cell. Returns false if it has none.
  bool AddFace(vtkIdType cell, const std::vector<vtkIdType>& corners, glm::vec3 normal)
  {
    glm::vec3 center(0.f);
    for (const vtkIdType corner : corners)
    {
      center += this->Positions[corner] / static_cast<float>(corners.size());
    }
    float size = 0.f;
    for (const vtkIdType corner : corners)
    {
      size = std::max(size, glm::distance(center, this->Positions[corner]));
    }
    if (normal == glm::vec3(0.f) || !this->AddSite(cell, center, glm::normalize(normal), size))
    {
      return false;
    }
    this->Result.Corners.insert(this->Result.Corners.end(), corners.begin(), corners.end());
    this->EndCorners();
    return true;
  }

  void AddDiscs()
  {
    const auto radius =
      static_cast<float>(this->Options.PointRadius * this->Result.OccluderScene.Scale);
    const auto count = static_cast<vtkIdType>(this->Positions.size());
    for (vtkIdType point = 0; point < count; ++point)
    {
      const glm::vec3 normal = this->GetNormal(point);
      if (!this->Finite[point] || normal == glm::vec3(0.f))
      {
        ++this->Result.NotFinite;
        continue;
      }
      const glm::vec3 center = this->Positions[point];
      const glm::mat3 frame = FrameFromNormal(normal);
      const auto first = static_cast<unsigned int>(this->Positions.size());
      for (unsigned int k = 0; k < DiscSides; ++k)
      {
        const float angle = 6.2831853f * static_cast<float>(k) / DiscSides;
        this->Positions.push_back(
          center + radius * (std::cos(angle) * frame[0] + std::sin(angle) * frame[1]));
        this->Triangles.emplace_back(
          static_cast<unsigned int>(point), first + k, first + (k + 1) % DiscSides);
      }
      this->AddSite(point, center + DiscRayHeight * radius * normal, normal, radius);
    }
  }

  void Finish()
  {
    if (!this->Result.Weights.empty())
    {
      this->Result.Weights.resize(this->Result.Sites.size(), 1.f);
    }
    double sum = 0.0;
    for (const RecordCandidate& site : this->Result.Sites)
    {
      sum += site.Pixel;
    }
    if (!this->Result.Sites.empty())
    {
      this->Result.Spacing =
        static_cast<float>(sum / static_cast<double>(this->Result.Sites.size()));
    }
    for (RecordCandidate& site : this->Result.Sites)
    {
      site.Pixel *= PixelPerSpacing;
      site.MaximumPlaneDistance = site.Pixel;
      site.MaximumRadius = static_cast<float>(MaximumRadiusPixels * site.Pixel);
    }
    Surface surface;
    surface.Positions = std::move(this->Positions);
    surface.Triangles = std::move(this->Triangles);
    const bool isEmptyPart = this->Options.Ranks && this->Mesh->GetNumberOfPoints() == 0;
    if (!isEmptyPart && !SetOpacity(this->Mesh, this->Options.OpacityArray, surface))
    {
      RejectOpacityArray(this->Options.OpacityArray, "");
    }
    this->Result.OccluderScene.Surfaces.push_back(std::move(surface));
    Scene& scene = this->Result.OccluderScene;
    if (this->HasPolygons)
    {
      AddRoundOccluders(this->Mesh, false, this->Options.PointRadius, scene);
    }
    AddRoundOccluders(this->Mesh, true, this->Options.LineRadius, scene);
  }

  vtkPointSet* Data;
  const BakeInputOptions& Options;
  const ProgressCallback& Progress;
  BakeInput Result;
  vtkSmartPointer<vtkPolyData> Mesh;
  vtkSmartPointer<vtkDataArray> Normals;
  bool HasComputedNormals = false;
  bool HasPolygons = false;         ///< on any rank
  std::vector<vtkIdType> Originals; ///< id in Data of each point or cell of Mesh; empty if equal
  std::vector<glm::vec3> Positions;
  std::vector<char> Finite;
  std::vector<glm::uvec3> Triangles;
  std::vector<float> EdgeSums; ///< per point, total length of the edges of its triangles
  std::vector<int> EdgeCounts; ///< per point, number of these edges
};

}

BakeInput PrepareBakeInput(
  vtkPointSet* data, const BakeInputOptions& options, const ProgressCallback& progress)
{
  BakeInput mesh = BakeInputBuilder(data, options, progress).Build();
  LabelPatches(mesh);
  return mesh;
}

void AddOccluders(vtkPolyData* surroundings, const BakeInputOptions& options, BakeInput& mesh,
  const ProgressCallback& progress)
{
  AddFinitePoints(surroundings, mesh.Bounds);
  mesh.Diagonal = mesh.Bounds.IsValid() ? mesh.Bounds.GetDiagonalLength() : 0.0;
  const Scene& scene = mesh.OccluderScene;
  Surface surface;
  std::vector<char> finite;
  for (vtkIdType i = 0; i < surroundings->GetNumberOfPoints(); ++i)
  {
    double x[3];
    surroundings->GetPoint(i, x);
    finite.push_back(IsFinite(x));
    surface.Positions.emplace_back(finite.back() ? scene.FromWorld(x) : glm::dvec3(0.0));
  }
  surface.Triangles = Triangulate(surroundings, finite, progress);
  const std::size_t first = scene.Surfaces.size();
  // The array of the surroundings is optional, but an invalid one is an error.
  if (!SetOpacity(surroundings, options.OpacityArray, surface) &&
    surroundings->GetPointData()->GetAbstractArray(options.OpacityArray.c_str()))
  {
    RejectOpacityArray(options.OpacityArray, " of input port 1");
  }
  mesh.OccluderScene.Surfaces.push_back(std::move(surface));
  AddRoundOccluders(surroundings, false, options.PointRadius, mesh.OccluderScene);
  AddRoundOccluders(surroundings, true, options.LineRadius, mesh.OccluderScene);
  for (std::size_t i = first; i < scene.Surfaces.size(); ++i)
  {
    mesh.OccluderScene.Surfaces[i].ObjectId = SurroundingsId;
  }
}

void UniteBounds(const BakeInputOptions& options, BakeInput& mesh)
{
  UniteBoxes(options.Ranks, mesh.Bounds);
  mesh.Diagonal = mesh.Bounds.IsValid() ? mesh.Bounds.GetDiagonalLength() : 0.0;
}

std::vector<std::string> DescribeDefects(const BakeInputOptions& options, const BakeInput& mesh)
{
  std::vector<std::string> sentences = mesh.SkippedAttributes;
  std::vector<double> counts = { static_cast<double>(mesh.Unused),
    static_cast<double>(mesh.NotFinite), static_cast<double>(mesh.DoubledPolygons),
    static_cast<double>(mesh.TwoSided), static_cast<double>(mesh.Sites.size()) };
  if (options.Ranks)
  {
    options.Ranks->Sum(counts);
    options.Ranks->UniteSentences(sentences);
    if (!options.Ranks->IsFirst())
    {
      return sentences;
    }
  }
  const auto count = [&](int i) { return std::to_string(static_cast<long long>(counts[i])); };
  if (counts[0] > 0.0 || counts[1] > 0.0)
  {
    sentences.push_back(count(0) + (options.OnCells ? " cells" : " points") +
      " do not belong to a surface and " + count(1) +
      " are not finite or have no normal. Their value is 0.");
  }
  // Few such polygons and points are defects of scans that no one sees.
  const double reported = MinimumReportedFraction * counts[4];
  if (counts[2] > reported)
  {
    sentences.push_back(count(2) +
      " polygons have the same points as others that face the opposite side. These "
      "points get the values of the polygons that come first. For values on both "
      "sides, give each polygon its own points.");
  }
  if (counts[3] > reported)
  {
    sentences.push_back(count(3) +
      " points have no normal because their polygons face opposite sides. Their "
      "value is the mean of the values on their polygons.");
  }
  return sentences;
}

}
