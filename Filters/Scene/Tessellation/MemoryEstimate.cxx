// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MemoryEstimate.h"

#include "Execution/AvailableMemory.h"
#include "SceneExtractionInstances.h"

#include "vtkCellArray.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <string>
#include <utility>

namespace penumbra
{
namespace
{

// Bytes of a primitive with its attributes and its share of the BVH while an image is rendered. They
// are about three quarters of what `penumbra render` takes per primitive in addition to the input, so
// that no scene that fits is refused (*measured*: growth of peak_memory_bytes from a file of 0.5 to 4
// million primitives to one of twice as many, without the input: 60, 110 to 180, 110, 550).
constexpr double BytesPerTriangle = 45.0;
constexpr double BytesPerSphere = 80.0;
constexpr double BytesPerTube = 80.0;
/// Of a line or point with a size in pixels.
constexpr double BytesPerSquare = 400.0;
/// Of an instance; the limit of the test Instances.TakeFewBytesPerGlyph is 500.
constexpr double BytesPerGlyph = 200.0;

/// Numbers of primitives.
struct PrimitiveCounts
{
  double Triangles = 0.0;
  double Spheres = 0.0;
  double Tubes = 0.0;
  double Squares = 0.0;
  double Glyphs = 0.0;

  double GetBytes() const
  {
    return BytesPerTriangle * this->Triangles + BytesPerSphere * this->Spheres +
      BytesPerTube * this->Tubes + BytesPerSquare * this->Squares + BytesPerGlyph * this->Glyphs;
  }

  std::string Describe() const
  {
    std::string text;
    for (const auto& [count, name] :
      { std::make_pair(this->Triangles, " triangles"), std::make_pair(this->Spheres, " spheres"),
        std::make_pair(this->Tubes, " tubes"), std::make_pair(this->Squares, " lines and points"),
        std::make_pair(this->Glyphs, " glyphs") })
    {
      if (count > 0.0)
      {
        text += (text.empty() ? "" : ", ") + std::to_string(static_cast<long long>(count)) + name;
      }
    }
    return text;
  }
};

/// Returns the number of triangles of polygons or strips.
double CountTriangles(vtkCellArray* cells)
{
  const auto ids = static_cast<double>(cells->GetNumberOfConnectivityIds());
  return std::max(ids - 2.0 * static_cast<double>(cells->GetNumberOfCells()), 0.0);
}

/// Returns the number of parts of an item, without its glyphs.
PrimitiveCounts CountParts(const DrawItem& item)
{
  PrimitiveCounts counts;
  vtkPolyData* data = item.Data;
  vtkProperty* property = item.Property;
  const auto points = static_cast<double>(data->GetVerts()->GetNumberOfConnectivityIds());
  const double segments =
    std::max(static_cast<double>(data->GetLines()->GetNumberOfConnectivityIds()) -
        static_cast<double>(data->GetLines()->GetNumberOfCells()),
      0.0);
  if (property->GetRepresentation() == VTK_SURFACE)
  {
    counts.Triangles = CountTriangles(data->GetPolys()) + CountTriangles(data->GetStrips());
  }
  const bool areSpheres =
    item.Radii || item.PointRadius > 0.0 || property->GetRenderPointsAsSpheres();
  (areSpheres ? counts.Spheres : counts.Squares) += points;
  const bool areTubes = item.LineRadius > 0.0 || property->GetRenderLinesAsTubes();
  (areTubes ? counts.Tubes : counts.Squares) += segments;
  return counts;
}

/// Returns true if neither edges nor lines nor points keep glyphs from being instances.
bool HasOnlyTriangles(const DrawItem& item, const PrimitiveCounts& parts)
{
  return item.Property->GetRepresentation() == VTK_SURFACE && !item.Property->GetEdgeVisibility() &&
    !item.Property->GetVertexVisibility() && parts.Spheres + parts.Tubes + parts.Squares == 0.0;
}

}

void RequireMemoryForItems(const std::vector<DrawItem>& items)
{
  PrimitiveCounts total;
  for (const DrawItem& item : items)
  {
    const PrimitiveCounts parts = CountParts(item);
    double copies = 1.0;
    if (item.GlyphInstances)
    {
      const auto glyphs = static_cast<double>(item.GlyphInstances->Transforms.size());
      total.Glyphs += glyphs;
      copies = MayHaveInstances(item) && HasOnlyTriangles(item, parts) ? 1.0 : glyphs;
    }
    total.Triangles += copies * parts.Triangles;
    total.Spheres += copies * parts.Spheres;
    total.Tubes += copies * parts.Tubes;
    total.Squares += copies * parts.Squares;
  }
  RequireMemory(total.GetBytes(), total.Describe());
}

void RequireMemoryForOccluders(vtkPolyData* mesh, double pointRadius, double lineRadius)
{
  DrawItem item;
  item.Data = mesh;
  item.Property = vtkSmartPointer<vtkProperty>::New();
  item.PointRadius = pointRadius;
  item.LineRadius = lineRadius;
  PrimitiveCounts counts = CountParts(item);
  counts.Squares = 0.0;
  RequireMemory(counts.GetBytes(), counts.Describe());
}

}
