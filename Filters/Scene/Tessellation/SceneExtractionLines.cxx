// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionLines.h"

#include "LineExpansion.h"
#include "LineMaterials.h"
#include "Scene.h"
#include "SceneExtractionClipping.h"
#include "SceneExtractionSegments.h"
#include "SceneExtractionSurfaces.h"
#include "Surface.h"
#include "SurfaceSlopes.h"

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

/// Shift of an edge toward the camera in front of its polygons, as a multiple of its width and of
/// their slope: half of the width, and a margin for perspective.
constexpr double EdgeShift = 0.55;

/// Frees ids that are 0, 1, 2, ..., see Surface::CellIds.
void DropIdentity(std::vector<std::uint32_t>& ids)
{
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    if (ids[i] != i)
    {
      return;
    }
  }
  std::vector<std::uint32_t>().swap(ids);
}

/// Expands the line segments and points of one draw item to surfaces.
class LineExpander
{
public:
  static constexpr std::uint32_t None = 0xffffffffu;

  LineExpander(const DrawItem& item, double pixelsPerPoint, Scene& scene)
    : Item(item),
      PixelsPerPoint(pixelsPerPoint),
      Target(scene),
      Points(MakePositions(item, scene)),
      Transform(item.ToWorld, scene)
  {
    for (const glm::dvec4& plane : item.ClippingPlanes)
    {
      this->Planes.push_back(ToScene(plane, scene));
    }
    const std::vector<std::uint32_t> cells = MakeCellIndices(item);
    this->Attributes.Front = MakeMaterial(item.Property);
    SetColors(item, cells, this->Attributes);
    SetCellIds(item, cells, this->Attributes);
  }

  /// Gives all that follows the color of edges, see ReplaceColors().
  void SetEdgeMaterial(const Material& material)
  {
    ReplaceColors(material, this->Attributes);
    // EdgeBlending, for translucent surfaces, assumes small shifts.
    this->MaximumSlope = this->Attributes.IsTranslucent() ? 0.0 : MaximumPolygonSlope;
  }

  /// Returns the depth that a polygon traverses per pixel, in pixels; negative if VTK draws nothing
  /// of it: it has no area, or the side that faces the camera is culled.
  double FindSlope(const vtkIdType* ids, vtkIdType size) const
  {
    constexpr double Flat = 1e-6; // relative area, or sine of the angle between ray and polygon
    glm::dvec3 normal(0.0);       // Newell's
    double square = 0.0;          // of the size of the polygon
    for (vtkIdType i = 0; i < size; ++i)
    {
      const auto from = static_cast<std::uint32_t>(ids[i]);
      const auto to = static_cast<std::uint32_t>(ids[(i + 1) % size]);
      if (!this->IsUsable(from) || !this->IsUsable(to))
      {
        return 0.0;
      }
      const glm::dvec3 first = this->Points[static_cast<std::uint32_t>(ids[0])];
      const glm::dvec3 side = glm::dvec3(this->Points[to]) - first;
      normal += glm::cross(glm::dvec3(this->Points[from]) - first, side);
      square = std::max(square, glm::dot(side, side));
    }
    const bool front = this->Item.Property->GetFrontfaceCulling();
    const bool back = this->Item.Property->GetBackfaceCulling();
    const Camera& camera = this->Target.ViewCamera;
    const glm::dvec3 at = this->Points[static_cast<std::uint32_t>(ids[0])];
    const glm::dvec3 view = camera.Parallel ? camera.Forward : at - camera.Position;
    const double facing = glm::dot(normal, view);
    const double edgeOn = Flat * square * glm::length(view);
    const bool isCulled = front || back ? (facing < edgeOn && front) || (facing > -edgeOn && back)
                                        : glm::length(normal) < Flat * square;
    return isCulled ? -1.0 : ComputeSlopeOfPlane(camera, at, normal);
  }

  /// Appearance of segments. If Single is set, it replaces the material and the colors of the item.
  struct LineStyle
  {
    double Width = 1.0;
    bool Lit = false;
    const Material* Single = nullptr;
    bool IsRound = false;      ///< spheres and tubes instead of squares and strips
    double Radius = 0.0;       ///< of spheres and tubes, in world units; 0: half of Width
    double MinimumShift = 0.0; ///< of squares toward the camera; 0: Width
    DepthOffset Offset{};      ///< of squares and strips, see DrawItem
    bool AreEdges = false;     ///< of the polygons of the item
  };

  void Add(const std::vector<LineSegment>& segments, const LineStyle& style)
  {
    if (style.IsRound)
    {
      this->AddRound(segments, style);
      return;
    }
    this->Begin(style);
    this->Result.IsLineOrPoint = true;
    this->Result.DepthRank = static_cast<float>(style.Offset.GetRank());
    this->Result.Front.Lighting = style.Lit && this->Result.Front.Lighting;
    for (const LineSegment& segment : segments)
    {
      this->AddSegment(segment, style);
    }
    if (!this->Result.Triangles.empty())
    {
      this->Result.Positions.reserve(this->Result.Positions.size() + 1);
      this->Result.Triangles.reserve(this->Result.Triangles.size() + 1);
      this->Target.Surfaces.push_back(std::move(this->Result));
    }
  }

  /// Returns the number of points whose radius is not a positive finite number.
  std::size_t GetNumberOfInvalidRadii() const { return this->InvalidRadii; }

private:
  void Begin(const LineStyle& style)
  {
    this->Result = Surface();
    this->Result.ObjectId = this->Item.ObjectId;
    this->Result.Part = ++this->Parts;
    this->Result.Front = style.Single ? *style.Single : this->Attributes.Front;
    if (style.AreEdges)
    {
      this->Result.EdgeWidth = static_cast<float>(style.Width * this->PixelsPerPoint);
    }
    if (!style.Single)
    {
      this->Result.ScalarColoring = this->Attributes.ScalarColoring;
      this->Result.ColorTexture = this->Attributes.ColorTexture;
    }
  }

  /// Adds spheres or tubes. Clipping planes remove only shapes and ends of tubes that are completely
  /// behind them.
  void AddRound(const std::vector<LineSegment>& segments, const LineStyle& style)
  {
    this->Begin(style);
    this->LastEnd = None;
    this->Result.HasFlatEnds = this->Item.HasFlatTubes;
    const bool isUniform = style.Radius > 0.0 && !this->Item.Radii;
    if (isUniform)
    {
      this->Result.Radii.push_back(static_cast<float>(style.Radius * this->Target.Scale));
    }
    const bool areTubes = std::any_of(segments.begin(), segments.end(),
      [](const LineSegment& segment) { return segment.From != segment.To; });
    const std::size_t estimate = segments.size() + (areTubes ? segments.size() / 8 : 0) + 1;
    this->Result.Positions.reserve(estimate);
    this->Result.CellIds.reserve(estimate);
    this->Result.Segments.reserve(areTubes ? estimate : 0);
    for (const LineSegment& segment : segments)
    {
      double start = 0.0;
      double end = 1.0;
      if (!this->IsUsable(segment.From) || !this->IsUsable(segment.To))
      {
        continue;
      }
      const float radii[2] = { this->ComputeRadius(segment.From, style),
        this->ComputeRadius(segment.To, style) };
      if (!(radii[0] > 0.f && radii[1] > 0.f) ||
        !this->Clip(segment, std::max(radii[0], radii[1]), start, end))
      {
        continue;
      }
      const std::uint32_t first = this->AddEnd(segment, style, start, radii, isUniform);
      if (areTubes)
      {
        this->Result.Segments.emplace_back(
          first, this->AddEnd(segment, style, end, radii, isUniform));
      }
      this->Result.CellIds.push_back(this->Attributes.CellIds[segment.Cell]);
      if (!style.Single && !this->Attributes.CellColors.empty())
      {
        this->Result.CellColors.push_back(this->Attributes.CellColors[segment.Cell]);
      }
    }
    if (!this->Result.Positions.empty())
    {
      DropIdentity(this->Result.CellIds);
      this->Target.Surfaces.push_back(std::move(this->Result));
    }
  }

  /// Returns the radius of a sphere or tube at a point in scene units; 0 if it is not drawn.
  float ComputeRadius(std::uint32_t point, const LineStyle& style)
  {
    const Camera& camera = this->Target.ViewCamera;
    double radius = style.Radius * this->Target.Scale;
    if (this->Item.Radii)
    {
      radius = this->Item.Radii->GetComponent(point, 0) * this->Target.Scale;
      if (!(radius > 0.0 && std::isfinite(radius)))
      {
        ++this->InvalidRadii;
        return 0.f;
      }
    }
    else if (!(radius > 0.0))
    {
      const double depth = camera.Depth(glm::dvec3(this->Points[point]));
      radius = 0.5 * style.Width * this->PixelsPerPoint * camera.PixelSize *
        (camera.Parallel ? 1.0 : std::max(depth, camera.Near));
    }
    return static_cast<float>(radius);
  }

  /// Adds the end at parameter t of a segment, or returns the end of the last segment if that is
  /// the same point.
  std::uint32_t AddEnd(const LineSegment& segment, const LineStyle& style, double t,
    const float (&radii)[2], bool isUniform)
  {
    const std::uint32_t point = t == 0.0 ? segment.From : segment.To;
    const auto index = static_cast<std::uint32_t>(this->Result.Positions.size());
    const bool isEnd = t == 0.0 || t == 1.0;
    if (t == 0.0 && this->LastEnd == point && segment.From != segment.To)
    {
      return index - 1;
    }
    this->LastEnd = isEnd ? point : None;
    const glm::vec3 a = this->Points[segment.From];
    const glm::vec3 b = this->Points[segment.To];
    this->Result.Positions.push_back(
      isEnd ? this->Points[point] : glm::vec3(glm::mix(glm::dvec3(a), glm::dvec3(b), t)));
    if (!isUniform)
    {
      this->Result.Radii.push_back(glm::mix(radii[0], radii[1], static_cast<float>(t)));
    }
    LineStyle unlit = style;
    unlit.Lit = false;
    this->AddAttributes(segment, unlit, static_cast<float>(t), glm::dvec3(b) - glm::dvec3(a));
    return index;
  }

  /// Narrows the range [start, end] of a segment to the part that is less than `margin` behind all
  /// clipping planes. Returns false if there is none.
  bool Clip(const LineSegment& segment, double margin, double& start, double& end) const
  {
    const glm::dvec3 a = this->Points[segment.From];
    const glm::dvec3 b = this->Points[segment.To];
    for (const glm::dvec4& plane : this->Planes)
    {
      const double shift = margin > 0.0 ? margin * glm::length(glm::dvec3(plane)) : 0.0;
      const double p = glm::dot(plane, glm::dvec4(a, 1.0)) + shift;
      const double q = glm::dot(plane, glm::dvec4(b, 1.0)) + shift;
      start = p < 0.0 && q > p ? std::max(start, p / (p - q)) : start;
      end = q < 0.0 && p > q ? std::min(end, p / (p - q)) : end;
      if ((p < 0.0 && q < 0.0) || start > end)
      {
        return false;
      }
    }
    return true;
  }

  bool IsUsable(std::uint32_t i) const
  {
    return i < this->Points.size() && std::isfinite(glm::dot(this->Points[i], this->Points[i]));
  }

  void AddSegment(const LineSegment& segment, const LineStyle& style)
  {
    if (!this->IsUsable(segment.From) || !this->IsUsable(segment.To))
    {
      return;
    }
    double start = 0.0;
    double end = 1.0;
    if (!this->Clip(segment, 0.0, start, end))
    {
      return;
    }
    glm::dvec3 a = this->Points[segment.From];
    glm::dvec3 b = this->Points[segment.To];
    Quad quad;
    const double width = style.Width * this->PixelsPerPoint;
    const bool isPoint = segment.From == segment.To;
    const glm::dvec3 direction = b - a;
    b = a + end * direction;
    a = a + start * direction;
    const Camera& camera = this->Target.ViewCamera;
    const double slope = std::min<double>(segment.Slope, this->MaximumSlope);
    const double base = style.MinimumShift > 0.0 ? style.MinimumShift : style.Width;
    const double pixels = std::max(style.Width, std::max(1.0, EdgeShift * slope) * base);
    QuadShift shift{ pixels * this->PixelsPerPoint, style.Offset, 0.0 };
    if (this->Item.Slopes && style.Offset.Factor != 0.0)
    {
      shift.Slope = std::max(this->Item.Slopes->Find(a), this->Item.Slopes->Find(b));
    }
    if ((style.Single || style.AreEdges) && !this->Item.PolygonOffset.IsZero())
    {
      // Edges and vertices move with their polygons, of which the steepest determines the distance.
      shift.Pixels +=
        std::max(0.0, ComputeShift(camera, a, this->Item.PolygonOffset, MaximumPolygonSlope));
    }
    if (isPoint ? ExpandPoint(camera, a, width, shift, quad)
                : ExpandLine(camera, a, b, width, shift, quad))
    {
      this->AddQuad(segment, style, quad, start + quad.Start * (end - start),
        start + quad.End * (end - start), direction);
    }
  }

  void AddQuad(const LineSegment& segment, const LineStyle& style, const Quad& quad, double start,
    double end, glm::dvec3 direction)
  {
    const auto first = static_cast<std::uint32_t>(this->Result.Positions.size());
    for (int i = 0; i < 4; ++i)
    {
      this->Result.Positions.emplace_back(quad.Corners[i]);
      const auto t = static_cast<float>(i == 0 || i == 3 ? start : end);
      this->AddAttributes(segment, style, t, direction);
    }
    this->Result.Triangles.emplace_back(first, first + 1, first + 2);
    this->Result.Triangles.emplace_back(first, first + 2, first + 3);
    this->Result.CellIds.insert(
      this->Result.CellIds.end(), 2, this->Attributes.CellIds[segment.Cell]);
    if (!style.Single && !this->Attributes.CellColors.empty())
    {
      this->Result.CellColors.insert(
        this->Result.CellColors.end(), 2, this->Attributes.CellColors[segment.Cell]);
    }
  }

  /// Adds the attributes at parameter t in [0, 1] of a segment.
  void AddAttributes(
    const LineSegment& segment, const LineStyle& style, float t, glm::dvec3 direction)
  {
    if (style.Lit)
    {
      this->Result.Normals.push_back(this->ComputeNormal(segment, t, direction));
      this->Result.NormalRule = segment.From == segment.To ? Surface::NormalRules::Unchanged
                                                           : Surface::NormalRules::FacingCamera;
    }
    if (style.Single)
    {
      return;
    }
    const auto interpolate = [&](const auto& from, auto& to) {
      if (!from.empty())
      {
        to.push_back(glm::mix(from[segment.From], from[segment.To], t));
      }
    };
    if (!this->Attributes.PointColors.empty())
    {
      this->Result.PointColors.emplace_back(
        glm::mix(glm::vec4(this->Attributes.PointColors[segment.From]),
          glm::vec4(this->Attributes.PointColors[segment.To]), t) +
        0.5f);
    }
    interpolate(this->Attributes.ColorCoordinates, this->Result.ColorCoordinates);
    if (segment.From != segment.To && this->Attributes.LitTexture)
    {
      this->Result.LitTexture = this->Attributes.LitTexture;
      interpolate(this->Attributes.TextureCoordinates, this->Result.TextureCoordinates);
    }
  }

  glm::vec3 ComputeNormal(const LineSegment& segment, float t, glm::dvec3 direction) const
  {
    const auto convert = [&](vtkDataArray* from, std::uint32_t i) {
      double n[3];
      from->GetTuple(i, n);
      return this->Transform.Normal(n);
    };
    vtkPolyData* data = this->Item.Data;
    vtkDataArray* atPoints = data->GetPointData()->GetNormals();
    if (this->Item.Property->GetInterpolation() != VTK_FLAT && atPoints)
    {
      return glm::mix(convert(atPoints, segment.From), convert(atPoints, segment.To), t);
    }
    if (vtkDataArray* atCells = data->GetCellData()->GetNormals())
    {
      return convert(atCells, segment.Cell);
    }
    // As VTK does for wireframes without normals: perpendicular to the line and as far toward the
    // camera as possible.
    const Camera& camera = this->Target.ViewCamera;
    const glm::dvec3 across =
      glm::dot(direction, camera.Up) * camera.Right - glm::dot(direction, camera.Right) * camera.Up;
    return glm::normalize(glm::cross(across, direction));
  }

  const DrawItem& Item;
  double PixelsPerPoint;
  Scene& Target;
  std::vector<glm::vec3> Points;
  SceneTransform Transform;
  std::vector<glm::dvec4> Planes;
  Surface Attributes; ///< material and colors of the item, per point and per cell
  Surface Result;
  std::uint32_t LastEnd = None; ///< point at the last position of Result; None if it is none
  double MaximumSlope = 0.0;    ///< of polygons that their edges are in front of
  std::size_t InvalidRadii = 0;
  int Parts = 0; ///< including those without segments, so that ranks number them alike
};

}

void AddLinesAndPoints(const DrawItem& item, double pixelsPerPoint, Scene& scene)
{
  vtkProperty* property = item.Property;
  const int representation = property->GetRepresentation();
  const bool edges = property->GetEdgeVisibility() && representation == VTK_SURFACE;
  const bool vertices = property->GetVertexVisibility();
  vtkPolyData* data = item.Data;
  const bool cells =
    data->GetVerts()->GetNumberOfCells() > 0 || data->GetLines()->GetNumberOfCells() > 0;
  if (!cells && !edges && !vertices && representation == VTK_SURFACE)
  {
    return;
  }
  // VTK lights lines and points only if they have normals, but always lights wireframes.
  const bool smooth =
    property->GetInterpolation() != VTK_FLAT && data->GetPointData()->GetNormals();
  LineExpander expander(item, pixelsPerPoint, scene);
  const double pointSize = property->GetPointSize();
  const double lineWidth = property->GetLineWidth();
  const bool spheres = item.Radii || item.PointRadius > 0.0 || property->GetRenderPointsAsSpheres();
  const bool tubes = item.LineRadius > 0.0 || property->GetRenderLinesAsTubes();
  const bool roundEdges = property->GetRenderLinesAsTubes();
  const bool roundVertices = property->GetRenderPointsAsSpheres();
  const PolygonSlope findSlope = [&](auto... polygon) { return expander.FindSlope(polygon...); };
  expander.Add(CollectVisiblePoints(item),
    { pointSize, smooth, nullptr, spheres, item.PointRadius, 0.0, item.PointOffset });
  if (representation != VTK_POINTS)
  {
    expander.Add(CollectLines(data),
      { lineWidth, smooth, nullptr, tubes, item.LineRadius, 0.0, item.LineOffset });
  }
  if (representation == VTK_WIREFRAME)
  {
    expander.Add(CollectEdges(item),
      { lineWidth, true, nullptr, tubes, item.LineRadius, 0.0, item.LineOffset });
  }
  if (edges)
  {
    Material material = MakeUnlitMaterial(property->GetEdgeColor(), FindEdgeOpacity(property));
    material.PhysicallyBased = property->GetInterpolation() == VTK_PBR && !property->GetLighting();
    expander.SetEdgeMaterial(roundEdges ? MakeRoundMaterial(property, material) : material);
    LineExpander::LineStyle style;
    style.Width = FindEdgeWidth(property);
    style.IsRound = roundEdges;
    style.AreEdges = true;
    expander.Add(CollectEdges(item, findSlope), style);
  }
  if (vertices)
  {
    // VTK draws vertices over edges, however wide these are.
    constexpr double VertexOffset = 1.5;
    const double edgeWidth = edges ? FindEdgeWidth(property) : lineWidth;
    Material material = MakeUnlitMaterial(property->GetVertexColor(), property->GetOpacity());
    material.PhysicallyBased = property->GetInterpolation() == VTK_PBR;
    const Material round = MakeRoundMaterial(property, material);
    expander.Add(CollectPoints(item, true, edges ? findSlope : PolygonSlope()),
      { pointSize, false, roundVertices ? &round : &material, roundVertices, 0.0,
        edges || representation == VTK_WIREFRAME ? VertexOffset * edgeWidth : 0.0 });
  }
  if (expander.GetNumberOfInvalidRadii() > 0)
  {
    scene.Warnings.push_back(item.Name + ": " + std::to_string(expander.GetNumberOfInvalidRadii()) +
      " points were skipped because their radius is not a positive finite number.");
  }
}

}
