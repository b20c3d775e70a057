// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionLines.h"

#include "LineExpansion.h"
#include "SceneExtractionClipping.h"
#include "SceneExtractionSegments.h"
#include "SceneExtractionSurfaces.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{
namespace
{

// Edges have a width and an opacity of their own since VTK 9.3 and 9.4.
template <typename Property>
auto EdgeWidth(Property* property, int)
  -> decltype(property->GetUseLineWidthForEdgeThickness(), property->GetEdgeWidth())
{
  return property->GetUseLineWidthForEdgeThickness() ? property->GetLineWidth()
                                                     : property->GetEdgeWidth();
}
template <typename Property>
float EdgeWidth(Property* property, long)
{
  return property->GetLineWidth();
}
template <typename Property>
auto EdgeOpacity(Property* property, int) -> decltype(property->GetEdgeOpacity())
{
  return property->GetEdgeOpacity();
}
template <typename Property>
double EdgeOpacity(Property*, long)
{
  return 1.0;
}

/// One colour whatever the light.
Material MakeUnlit(const double color[3], double opacity)
{
  Material material;
  material.AmbientColor = glm::vec3(color[0], color[1], color[2]);
  material.DiffuseColor = material.AmbientColor;
  material.Ambient = 1.f;
  material.Diffuse = 0.f;
  material.Opacity = static_cast<float>(opacity);
  material.Lighting = false;
  return material;
}

/// Widens marks of one piece into surfaces.
class Widener
{
public:
  Widener(const DrawItem& piece, double pixelsPerPoint, Scene& scene)
    : From(piece),
      PixelsPerPoint(pixelsPerPoint),
      To(scene),
      Points(MakePositions(piece, scene)),
      Place(piece.ToWorld, scene)
  {
    for (const glm::dvec4& plane : piece.ClippingPlanes)
    {
      this->Planes.push_back(ToScene(plane, scene));
    }
    const std::vector<std::uint32_t> cells = MakeCellNumbers(piece);
    this->Own.Front = MakeMaterial(piece.Property);
    SetColors(piece, cells, this->Own);
    SetCellIds(piece, cells, this->Own);
  }

  /// How marks are drawn: in the piece's own look or in one colour of their own.
  struct Look
  {
    double Width = 1.0;
    bool Lit = false;
    const Material* Single = nullptr;
  };

  void Add(const std::vector<LineSegment>& marks, const Look& look)
  {
    this->Result = Surface();
    this->Result.ObjectId = this->From.ObjectId;
    this->Result.IsLineOrPoint = true;
    this->Result.Front = look.Single ? *look.Single : this->Own.Front;
    this->Result.Front.Lighting = look.Lit && this->Result.Front.Lighting;
    if (!look.Single)
    {
      this->Result.ScalarColoring = this->Own.ScalarColoring;
      this->Result.ColorTexture = this->Own.ColorTexture;
    }
    for (const LineSegment& mark : marks)
    {
      this->Widen(mark, look);
    }
    if (!this->Result.Triangles.empty())
    {
      this->Result.Positions.reserve(this->Result.Positions.size() + 1);
      this->Result.Triangles.reserve(this->Result.Triangles.size() + 1);
      this->To.Surfaces.push_back(std::move(this->Result));
    }
  }

private:
  bool IsUsable(std::uint32_t i) const
  {
    return i < this->Points.size() && std::isfinite(glm::dot(this->Points[i], this->Points[i]));
  }

  void Widen(const LineSegment& mark, const Look& look)
  {
    if (!this->IsUsable(mark.From) || !this->IsUsable(mark.To))
    {
      return;
    }
    glm::dvec3 a = this->Points[mark.From];
    glm::dvec3 b = this->Points[mark.To];
    double start = 0.0;
    double end = 1.0;
    for (const glm::dvec4& plane : this->Planes)
    {
      const double p = glm::dot(plane, glm::dvec4(a, 1.0));
      const double q = glm::dot(plane, glm::dvec4(b, 1.0));
      start = p < 0.0 && q > p ? std::max(start, p / (p - q)) : start;
      end = q < 0.0 && p > q ? std::min(end, p / (p - q)) : end;
      if ((p < 0.0 && q < 0.0) || start > end)
      {
        return;
      }
    }
    Quad quad;
    const double width = look.Width * this->PixelsPerPoint;
    const bool isPoint = mark.From == mark.To;
    const glm::dvec3 way = b - a;
    b = a + end * way;
    a = a + start * way;
    if (isPoint ? ExpandPoint(this->To.ViewCamera, a, width, quad)
                : ExpandLine(this->To.ViewCamera, a, b, width, quad))
    {
      this->AddQuad(mark, look, quad, start + quad.Start * (end - start),
        start + quad.End * (end - start), way);
    }
  }

  void AddQuad(const LineSegment& mark, const Look& look, const Quad& quad, double start,
    double end, glm::dvec3 way)
  {
    const auto first = static_cast<std::uint32_t>(this->Result.Positions.size());
    for (int i = 0; i < 4; ++i)
    {
      this->Result.Positions.emplace_back(quad.Corners[i]);
      const auto t = static_cast<float>(i == 0 || i == 3 ? start : end);
      this->AddAttributes(mark, look, t, way);
    }
    this->Result.Triangles.emplace_back(first, first + 1, first + 2);
    this->Result.Triangles.emplace_back(first, first + 2, first + 3);
    this->Result.CellIds.insert(this->Result.CellIds.end(), 2, this->Own.CellIds[mark.Cell]);
    if (!look.Single && !this->Own.CellColors.empty())
    {
      this->Result.CellColors.insert(
        this->Result.CellColors.end(), 2, this->Own.CellColors[mark.Cell]);
    }
  }

  /// The attributes at the share t of a mark.
  void AddAttributes(const LineSegment& mark, const Look& look, float t, glm::dvec3 way)
  {
    if (look.Lit)
    {
      this->Result.Normals.push_back(this->Normal(mark, t, way));
      this->Result.NormalRule =
        mark.From == mark.To ? Surface::NormalRules::AsTheyAre : Surface::NormalRules::TowardsEye;
    }
    if (look.Single)
    {
      return;
    }
    const auto blend = [&](const auto& from, auto& to) {
      if (!from.empty())
      {
        to.push_back(glm::mix(from[mark.From], from[mark.To], t));
      }
    };
    if (!this->Own.PointColors.empty())
    {
      this->Result.PointColors.emplace_back(glm::mix(glm::vec4(this->Own.PointColors[mark.From]),
                                              glm::vec4(this->Own.PointColors[mark.To]), t) +
        .5f);
    }
    blend(this->Own.ColorCoordinates, this->Result.ColorCoordinates);
    if (mark.From != mark.To && this->Own.LitTexture)
    {
      this->Result.LitTexture = this->Own.LitTexture;
      blend(this->Own.TextureCoordinates, this->Result.TextureCoordinates);
    }
  }

  glm::vec3 Normal(const LineSegment& mark, float t, glm::dvec3 way) const
  {
    const auto convert = [&](vtkDataArray* from, std::uint32_t i) {
      double n[3];
      from->GetTuple(i, n);
      return this->Place.Normal(n);
    };
    vtkPolyData* data = this->From.Data;
    vtkDataArray* atPoints = data->GetPointData()->GetNormals();
    if (this->From.Property->GetInterpolation() != VTK_FLAT && atPoints)
    {
      return glm::mix(convert(atPoints, mark.From), convert(atPoints, mark.To), t);
    }
    if (vtkDataArray* atCells = data->GetCellData()->GetNormals())
    {
      return convert(atCells, mark.Cell);
    }
    // VTK's choice for wireframes without normals: across the line, as much towards the eye as can
    // be.
    const Camera& eye = this->To.ViewCamera;
    const glm::dvec3 across = glm::dot(way, eye.Up) * eye.Right - glm::dot(way, eye.Right) * eye.Up;
    return glm::normalize(glm::cross(across, way));
  }

  const DrawItem& From;
  double PixelsPerPoint;
  Scene& To;
  std::vector<glm::vec3> Points;
  SceneTransform Place;
  std::vector<glm::dvec4> Planes;
  Surface Own; ///< holds the piece's colours, per point and per cell
  Surface Result;
};

}

void AddLinesAndPoints(const DrawItem& piece, double pixelsPerPoint, Scene& scene)
{
  vtkProperty* property = piece.Property;
  const int representation = property->GetRepresentation();
  const bool edges = property->GetEdgeVisibility() && representation == VTK_SURFACE;
  const bool vertices = property->GetVertexVisibility();
  vtkPolyData* data = piece.Data;
  const bool cells =
    data->GetVerts()->GetNumberOfCells() > 0 || data->GetLines()->GetNumberOfCells() > 0;
  if (!cells && !edges && !vertices && representation == VTK_SURFACE)
  {
    return;
  }
  // VTK lights lines and points only where they have normals to be lit by; wireframes always.
  const bool smooth =
    property->GetInterpolation() != VTK_FLAT && data->GetPointData()->GetNormals();
  Widener widener(piece, pixelsPerPoint, scene);
  const double pointSize = property->GetPointSize();
  const double lineWidth = property->GetLineWidth();
  widener.Add(CollectPoints(piece, representation == VTK_POINTS), { pointSize, smooth, nullptr });
  if (representation != VTK_POINTS)
  {
    widener.Add(CollectLines(data), { lineWidth, smooth, nullptr });
  }
  if (representation == VTK_WIREFRAME)
  {
    widener.Add(CollectEdges(piece), { lineWidth, true, nullptr });
  }
  if (edges)
  {
    const Material look =
      MakeUnlit(property->GetEdgeColor(), property->GetOpacity() * EdgeOpacity(property, 0));
    widener.Add(CollectEdges(piece), { EdgeWidth(property, 0), false, &look });
  }
  if (vertices)
  {
    const Material look = MakeUnlit(property->GetVertexColor(), property->GetOpacity());
    widener.Add(CollectPoints(piece, true), { pointSize, false, &look });
  }
}

}
