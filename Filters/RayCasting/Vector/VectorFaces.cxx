// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "VectorFaces.h"

#include "FaceColors.h"
#include "FaceOrder.h"
#include "Overlay.h"
#include "Scene.h"
#include "Surface.h"
#include "Vectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace penumbra
{
namespace
{

// Width of the strip by which a triangle extends below its neighbor, in pixels: more than the
// diagonal of a pixel.
constexpr double StripWidth = 1.5;
// Half the side of the square that a triangle draws around a vertex below its neighbors, in pixels.
constexpr double SquareRadius = 1.0;
// Pixels around the image to which polygons are clipped.
constexpr double Margin = 4.0;

// Most triangles of the scene per path, of which most are hidden.
constexpr std::size_t MaximumTrianglesPerPath = 4;

constexpr char ColorReason[] =
  "colors change inside triangles by more than the tolerance, as in shadows and textures";

constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

/// A triangle of the scene.
struct Face
{
  glm::dvec3 Points[3];       ///< in scene coordinates, counterclockwise in the image
  std::uint32_t Vertices[3];  ///< indices of positions, equal for equal coordinates
  glm::dvec2 Corners[3];      ///< image coordinates
  bool IsWhole = false;       ///< in front of the camera
  bool IsFlipped = false;     ///< clockwise in the scene
  std::uint32_t Painted = 0;  ///< index of the triangle whose colors it has
  std::uint32_t Order = None; ///< of its first polygon; None: not drawn
};

/// The triangles around a vertex.
struct Fan
{
  std::uint32_t First = None; ///< order of the first one
  bool IsComplete = true;     ///< all are drawn, and each has a neighbor on both sides
  double Radius = std::numeric_limits<double>::max(); ///< of a circle inside them, in pixels
};

/// Returns an index for each position of a surface that is the same for equal coordinates.
std::vector<std::uint32_t> MergePositions(const Surface& surface, std::uint32_t first)
{
  const auto less = [&](std::uint32_t i, std::uint32_t j) {
    const glm::vec3 a = surface.Positions[i];
    const glm::vec3 b = surface.Positions[j];
    return std::tie(a.x, a.y, a.z, i) < std::tie(b.x, b.y, b.z, j);
  };
  std::vector<std::uint32_t> order(surface.Positions.size());
  for (std::uint32_t i = 0; i < order.size(); ++i)
  {
    order[i] = i;
  }
  std::sort(order.begin(), order.end(), less);
  std::vector<std::uint32_t> merged(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    const bool same = k > 0 && surface.Positions[order[k]] == surface.Positions[order[k - 1]];
    merged[order[k]] = same ? merged[order[k - 1]] : first + order[k];
  }
  return merged;
}

class FaceBuilder
{
public:
  explicit FaceBuilder(const CameraRayTracer& tracer)
    : Tracer(tracer),
      ViewCamera(tracer.GetCamera())
  {
  }

  std::string Build(std::size_t maximum, double tolerance, std::vector<FigurePath>& paths)
  {
    if (ExceedTolerance(this->Tracer, tolerance))
    {
      return ColorReason;
    }
    this->Colors = SampleFaceColors(this->Tracer);
    this->FindFaces();
    if (this->Polygons.size() > maximum)
    {
      return "the number of visible triangles exceeds the maximum number of paths";
    }
    if (!SortFaces(maximum, this->Polygons))
    {
      return "triangles overlap in a cycle or intersect too often";
    }
    for (std::uint32_t i = 0; i < this->Polygons.size(); ++i)
    {
      std::uint32_t& order = this->Faces[this->Polygons[i].Face].Order;
      order = std::min(order, i);
    }
    this->FindNeighbors();
    std::vector<FigurePath> faces;
    double squaredError = 0.0;
    for (std::uint32_t i = 0; i < this->Polygons.size(); ++i)
    {
      faces.push_back(this->MakePath(i, squaredError));
    }
    const double samples = static_cast<double>(FaceSamplesPerPixelSide * FaceSamplesPerPixelSide) *
      this->ViewCamera.Width * this->ViewCamera.Height;
    if (std::sqrt(squaredError / (3.0 * samples)) > tolerance)
    {
      return ColorReason;
    }
    paths.insert(paths.end(), faces.begin(), faces.end());
    return {};
  }

private:
  /// Makes a polygon of each visible triangle.
  void FindFaces()
  {
    std::uint32_t firstPosition = 0;
    for (const Surface& surface : this->Tracer.GetScene().Surfaces)
    {
      const std::vector<std::uint32_t> merged = MergePositions(surface, firstPosition);
      firstPosition += static_cast<std::uint32_t>(surface.Positions.size());
      for (std::uint32_t t = 0; t < surface.Triangles.size(); ++t)
      {
        Face face{};
        face.Painted = static_cast<std::uint32_t>(this->Faces.size());
        for (int i = 0; i < 3; ++i)
        {
          face.Points[i] = glm::dvec3(surface.Positions[surface.Triangles[t][i]]);
          face.Vertices[i] = merged[surface.Triangles[t][i]];
        }
        this->Project(face);
        this->Faces.push_back(face);
        if (this->Colors[this->Faces.size() - 1].GetCount() > 0)
        {
          this->AddPolygon(static_cast<std::uint32_t>(this->Faces.size() - 1));
        }
      }
    }
    this->AddHiddenNeighbors();
  }

  static std::pair<std::uint32_t, std::uint32_t> MakeEdge(const Face& face, int i)
  {
    return std::minmax({ face.Vertices[i], face.Vertices[(i + 1) % 3] });
  }

  /// Adds hidden triangles next to visible ones of the same side, in their colors: thin visible parts
  /// next to what hides them may lie between the samples, and would show the background.
  void AddHiddenNeighbors()
  {
    std::map<std::pair<std::uint32_t, bool>, std::uint32_t> visible; // vertex and side to triangle
    for (const FacePolygon& polygon : this->Polygons)
    {
      const Face& face = this->Faces[polygon.Face];
      for (const std::uint32_t vertex : face.Vertices)
      {
        visible.emplace(std::make_pair(vertex, face.IsFlipped), polygon.Face);
      }
    }
    for (std::uint32_t f = 0; f < this->Faces.size(); ++f)
    {
      Face& face = this->Faces[f];
      for (int i = 0; i < 3 && face.IsWhole && this->Colors[f].GetCount() == 0; ++i)
      {
        const auto found = visible.find({ face.Vertices[i], face.IsFlipped });
        if (found != visible.end())
        {
          face.Painted = found->second;
          this->AddPolygon(f);
          break;
        }
      }
    }
  }

  void Project(Face& face) const
  {
    face.IsWhole = true;
    for (int i = 0; i < 3; ++i)
    {
      face.IsWhole = face.IsWhole && this->ViewCamera.Depth(face.Points[i]) > this->GetNear();
    }
    if (!face.IsWhole)
    {
      return;
    }
    const auto project = [&] {
      for (int i = 0; i < 3; ++i)
      {
        face.Corners[i] = this->ViewCamera.Project(face.Points[i]);
      }
      return Cross(face.Corners[1] - face.Corners[0], face.Corners[2] - face.Corners[0]);
    };
    face.IsFlipped = project() < 0.0;
    if (face.IsFlipped)
    {
      std::swap(face.Points[1], face.Points[2]);
      std::swap(face.Vertices[1], face.Vertices[2]);
      project();
    }
  }

  double GetNear() const
  {
    return std::max(this->ViewCamera.Near, this->ViewCamera.Parallel ? 0.0 : 1e-9);
  }

  std::vector<glm::dvec2> ClipToImage(std::vector<glm::dvec2> corners) const
  {
    const glm::dvec2 size(this->ViewCamera.Width, this->ViewCamera.Height);
    corners = ClipPolygon(corners, { Margin, 1.0, 0.0 });
    corners = ClipPolygon(corners, { Margin, 0.0, 1.0 });
    corners = ClipPolygon(corners, { size.x + Margin, -1.0, 0.0 });
    return ClipPolygon(corners, { size.y + Margin, 0.0, -1.0 });
  }

  /// Adds the part of a triangle in front of the camera and in the image.
  void AddPolygon(std::uint32_t index)
  {
    const Face& face = this->Faces[index];
    const Camera& camera = this->ViewCamera;
    std::vector<glm::dvec2> corners;
    for (int i = 0; i < 3; ++i)
    {
      const glm::dvec3 p = face.Points[i];
      const glm::dvec3 q = face.Points[(i + 1) % 3];
      const double atP = camera.Depth(p) - this->GetNear();
      const double atQ = camera.Depth(q) - this->GetNear();
      if (atP >= 0.0)
      {
        corners.push_back(camera.Project(p));
      }
      if ((atP < 0.0 && atQ > 0.0) || (atP > 0.0 && atQ < 0.0))
      {
        corners.push_back(camera.Project(glm::mix(p, q, atP / (atP - atQ))));
      }
    }
    if (ComputeArea(corners) < 0.0)
    {
      std::reverse(corners.begin(), corners.end());
    }
    corners = this->ClipToImage(corners);
    if (corners.size() > 2)
    {
      this->Polygons.push_back({ index, corners, this->ComputeNearness(face), {} });
    }
  }

  /// Returns 1 / depth, or in parallel projection the negative depth, as a function of the image coordinates.
  glm::dvec3 ComputeNearness(const Face& face) const
  {
    const Camera& camera = this->ViewCamera;
    const glm::dvec3 normal =
      glm::cross(face.Points[1] - face.Points[0], face.Points[2] - face.Points[0]);
    const double distance = glm::dot(normal, face.Points[0] - camera.Position);
    const double right = glm::dot(normal, camera.Right) * camera.PixelSize;
    const double up = glm::dot(normal, camera.Up) * camera.PixelSize;
    const double forward = glm::dot(normal, camera.Forward);
    if (camera.Parallel)
    {
      // depth = (distance - q . (right, up)) / forward with q = p - Center
      const double constant = -distance - right * camera.Center.x - up * camera.Center.y;
      return glm::dvec3(constant, right, up) / forward;
    }
    const double constant = forward - right * camera.Center.x - up * camera.Center.y;
    return glm::dvec3(constant, right, up) / distance;
  }

  /// Finds the triangle on the other side of each edge, and the vertices around which all triangles are drawn.
  void FindNeighbors()
  {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<std::uint32_t, 3>> edges;
    for (std::uint32_t f = 0; f < this->Faces.size(); ++f)
    {
      const Face& face = this->Faces[f];
      for (int i = 0; i < 3 && face.Order != None && face.IsWhole; ++i)
      {
        auto& users = edges[MakeEdge(face, i)];
        ++users[2];
        if (users[2] <= 2)
        {
          users[users[2] - 1] = f;
        }
      }
    }
    this->Neighbors.assign(this->Faces.size(), { None, None, None });
    for (std::uint32_t f = 0; f < this->Faces.size(); ++f)
    {
      const Face& face = this->Faces[f];
      for (int i = 0; i < 3 && face.Order != None && face.IsWhole; ++i)
      {
        const auto& users = edges[MakeEdge(face, i)];
        const std::uint32_t other = users[0] == f ? users[1] : users[0];
        // In counterclockwise triangles on both sides of an edge, it runs in opposite directions.
        if (users[2] == 2 &&
          this->FindEdge(this->Faces[other], face.Vertices[(i + 1) % 3], face.Vertices[i]) >= 0)
        {
          this->Neighbors[f][i] = other;
        }
      }
    }
    this->FindFans();
  }

  static int FindEdge(const Face& face, std::uint32_t from, std::uint32_t to)
  {
    for (int i = 0; i < 3; ++i)
    {
      if (face.Vertices[i] == from && face.Vertices[(i + 1) % 3] == to)
      {
        return i;
      }
    }
    return -1;
  }

  /// Finds the first triangle around each vertex that is surrounded by visible triangles.
  void FindFans()
  {
    for (std::uint32_t f = 0; f < this->Faces.size(); ++f)
    {
      const Face& face = this->Faces[f];
      for (int i = 0; i < 3; ++i)
      {
        const bool inside = face.Order != None && this->Neighbors[f][i] != None &&
          this->Neighbors[f][(i + 2) % 3] != None;
        Fan& fan = this->Fans[face.Vertices[i]];
        fan.First = std::min(fan.First, face.Order);
        fan.IsComplete = fan.IsComplete && inside;
        const glm::dvec2 edge = face.Corners[(i + 2) % 3] - face.Corners[(i + 1) % 3];
        const glm::dvec2 spoke = face.Corners[i] - face.Corners[(i + 1) % 3];
        fan.Radius = std::min(fan.Radius, std::abs(Cross(edge, spoke)) / glm::length(edge));
      }
    }
  }

  FigurePath MakePath(std::uint32_t i, double& squaredError) const
  {
    const FacePolygon& polygon = this->Polygons[i];
    const Face& face = this->Faces[polygon.Face];
    FigurePath path;
    path.Points = polygon.Corners;
    const double error = this->Colors[face.Painted].Paint(path);
    squaredError += face.Order == i && face.Painted == polygon.Face ? error : 0.0;
    if (face.IsWhole)
    {
      this->Extend(polygon, i, path);
    }
    return path;
  }

  /// Extends the outline of a triangle into neighbors that are drawn later.
  void Extend(const FacePolygon& polygon, std::uint32_t order, FigurePath& path) const
  {
    const std::uint32_t index = polygon.Face;
    const Face& face = this->Faces[index];
    std::vector<glm::dvec2> outline;
    for (int i = 0; i < 3; ++i)
    {
      const glm::dvec2 a = face.Corners[i];
      const glm::dvec2 b = face.Corners[(i + 1) % 3];
      outline.push_back(a);
      const std::uint32_t other = this->Neighbors[index][i];
      if (other != None && this->Faces[other].Order > order)
      {
        const Face& neighbor = this->Faces[other];
        const int edge = this->FindEdge(neighbor, face.Vertices[(i + 1) % 3], face.Vertices[i]);
        const glm::dvec2 apex = neighbor.Corners[(edge + 2) % 3];
        const double height = Cross(a - b, apex - b) / glm::length(a - b);
        const double t = std::min(0.5, StripWidth / height);
        // The strip tapers to vertices that are not surrounded, because edges that are not shared
        // would be covered twice.
        const bool atA = this->Fans.at(face.Vertices[i]).IsComplete;
        const bool atB = this->Fans.at(face.Vertices[(i + 1) % 3]).IsComplete;
        if (atA)
        {
          outline.push_back(glm::mix(a, apex, t));
        }
        if (atB || !atA)
        {
          outline.push_back(glm::mix(atB ? b : 0.5 * (a + b), apex, t));
        }
      }
      const Fan& fan = this->Fans.at(face.Vertices[i]);
      if (fan.IsComplete && fan.First == order)
      {
        // The square is inside the triangles around the vertex.
        const double r = std::min(SquareRadius, std::sqrt(0.5) * fan.Radius);
        path.Squares.push_back({ a - glm::dvec2(r), glm::dvec2(2.0 * r) });
      }
    }
    outline = this->ClipToImage(outline);
    for (const glm::dvec3 plane : polygon.Planes)
    {
      outline = ClipPolygon(outline, plane);
    }
    path.Points = outline.size() > 2 ? outline : path.Points;
  }

  const CameraRayTracer& Tracer;
  const Camera& ViewCamera;
  std::vector<FaceColor> Colors;
  std::vector<Face> Faces;
  std::vector<FacePolygon> Polygons;
  std::vector<std::array<std::uint32_t, 3>> Neighbors; ///< across the edge from each corner
  std::map<std::uint32_t, Fan> Fans;                   ///< by vertex
};

/// Adds a rectangle with the colors of the background unless it is transparent. Returns false if
/// paths cannot show it.
bool AddBackground(const Scene& scene, std::vector<FigurePath>& paths)
{
  const Background& background = scene.BackgroundColors;
  const bool uniform = background.First == background.Second;
  const bool horizontal = background.Gradient == Background::Gradients::Horizontal;
  const bool vertical = background.Gradient == Background::Gradients::Vertical;
  const bool opaque = background.First.a == 1.f && background.Second.a == 1.f;
  if (background.Image || (!uniform && !(opaque && (horizontal || vertical))))
  {
    return false;
  }
  if (background.First.a == 0.f && uniform)
  {
    return true;
  }
  const glm::dvec2 size(scene.ViewCamera.Width, scene.ViewCamera.Height);
  FigurePath path;
  path.Points = { { 0.0, 0.0 }, { size.x, 0.0 }, size, { 0.0, size.y } };
  path.Color = background.First;
  path.HasGradient = !uniform;
  path.EndColor = background.Second;
  path.To = horizontal ? glm::dvec2(size.x, 0.0) : glm::dvec2(0.0, size.y);
  paths.push_back(path);
  return true;
}

}

std::string AddVisibleFaces(const CameraRayTracer& tracer, std::size_t maximum, double tolerance,
  std::vector<FigurePath>& paths)
{
  const Scene& scene = tracer.GetScene();
  std::size_t triangles = 0;
  for (const Surface& surface : scene.Surfaces)
  {
    triangles += surface.Triangles.size();
    if (surface.IsRound() || surface.IsLineOrPoint || surface.IsAdditive || surface.HidesLines)
    {
      return "the scene contains spheres, tubes, splats or lines that are not strokes";
    }
  }
  if (triangles > MaximumTrianglesPerPath * maximum)
  {
    return "the number of triangles exceeds the maximum number of paths";
  }
  if (tracer.HasTranslucentSurfaces())
  {
    return "the scene contains translucent surfaces";
  }
  if (scene.OverlayImage && !scene.OverlayImage->IsEmpty())
  {
    return "a 2-D actor has a texture or interpolated colors";
  }
  if (tracer.HasShafts())
  {
    return "the scene contains light shafts";
  }
  std::vector<FigurePath> all;
  if (!AddBackground(scene, all))
  {
    return "the background is an image or a radial gradient";
  }
  const std::string reason = FaceBuilder(tracer).Build(maximum, tolerance, all);
  if (reason.empty())
  {
    paths.insert(paths.end(), all.begin(), all.end());
  }
  return reason;
}

}
