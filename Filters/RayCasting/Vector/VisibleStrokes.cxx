// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "VisibleStrokes.h"

#include "EdgeVisibility.h"
#include "FigureText.h"
#include "Scene.h"
#include "StrokeStrips.h"
#include "Surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace penumbra
{
namespace
{

// Positions at which a piece of a stroke may be in front, as fractions of its length and, from its axis, of its width.
constexpr double AlongFractions[] = { 0.5, 0.05, 0.95, 0.25, 0.75 };
constexpr double SideFractions[] = { 0.0, -0.45, 0.45 };
// Widths are rounded to multiples of this, in pixels, so that equal pens are joined.
constexpr double WidthPrecision = 1e-3;
// Distance of the tests of a side of a stroke from its axis, as a fraction of its width: inside the stroke.
constexpr double TestedSide = 0.49;
// Distance in pixels between the tests of the width of a partly hidden stroke.
constexpr double ColumnDistance = 0.5;
// Precision of the boundary of what hides a stroke partly, in pixels.
constexpr double SidePrecision = 0.01;
// Depth by which strokes are in front of the surfaces that they belong to, in pixel sizes, beside their width.
constexpr double StrokeOffset = 2.0;
// Most strokes of the same surface that are skipped in front of a stroke, and the distance behind each at which the
// next one is searched, as a fraction of the depth.
constexpr int MaximumStrokesInFront = 64;
constexpr float HitOffset = 1e-6f;

/// A line or point, which the scene contains as a quad of two triangles.
struct Stroke
{
  std::uint32_t Surface;
  std::uint32_t Triangle; ///< the first one
  glm::dvec2 From;
  glm::dvec2 To;
  double DepthFrom;
  double DepthTo;
  double Width;
  glm::dvec2 Across; ///< from the axis to a side, twice as long

  double GetLength() const { return glm::length(this->To - this->From); }
  /// @param t Fraction of the length.
  /// @param side Fraction of the width from the axis.
  glm::dvec2 At(double t, double side = 0.0) const
  {
    return glm::mix(this->From, this->To, t) + side * this->Across;
  }
  double DepthAt(const Camera& camera, double t) const
  {
    return camera.Parallel ? glm::mix(this->DepthFrom, this->DepthTo, t)
                           : 1.0 / glm::mix(1.0 / this->DepthFrom, 1.0 / this->DepthTo, t);
  }
  bool IsHitBy(const Hit& hit) const
  {
    return hit.IsHit() && hit.Surface == this->Surface && hit.Primitive / 2 == this->Triangle / 2;
  }
};

/// Returns the lines and points, the farthest first.
std::vector<Stroke> FindStrokes(const Scene& scene)
{
  const Camera& camera = scene.ViewCamera;
  std::vector<Stroke> strokes;
  for (std::size_t i = 0; i < scene.Surfaces.size(); ++i)
  {
    const Surface& surface = scene.Surfaces[i];
    for (std::size_t j = 0; HasStrokes(surface) && j + 1 < surface.Triangles.size(); j += 2)
    {
      const glm::uvec3 corners = surface.Triangles[j];
      const glm::dvec3 a(surface.Positions[corners.x]);
      const glm::dvec3 b(surface.Positions[corners.y]);
      const glm::dvec3 c(surface.Positions[corners.z]);
      const glm::dvec3 d(surface.Positions[surface.Triangles[j + 1].z]);
      Stroke stroke{};
      stroke.Surface = static_cast<std::uint32_t>(i);
      stroke.Triangle = static_cast<std::uint32_t>(j);
      stroke.From = 0.5 * (camera.Project(a) + camera.Project(d));
      stroke.To = 0.5 * (camera.Project(b) + camera.Project(c));
      stroke.DepthFrom = 0.5 * (camera.Depth(a) + camera.Depth(d));
      stroke.DepthTo = 0.5 * (camera.Depth(b) + camera.Depth(c));
      const double width = glm::length(camera.Project(a) - camera.Project(d));
      stroke.Width = std::max(1.0, std::round(width / WidthPrecision)) * WidthPrecision;
      const glm::dvec2 step = stroke.To - stroke.From;
      if (stroke.GetLength() > 0.0)
      {
        stroke.Across = stroke.Width / stroke.GetLength() * glm::dvec2(-step.y, step.x);
        strokes.push_back(stroke);
      }
    }
  }
  std::stable_sort(strokes.begin(), strokes.end(), [](const Stroke& x, const Stroke& y) {
    return x.DepthFrom + x.DepthTo > y.DepthFrom + y.DepthTo;
  });
  return strokes;
}

/// Narrows [low, high] to the part of the segment from a to b in the image, enlarged by `margin`.
bool ClipToImage(
  const Camera& camera, glm::dvec2 a, glm::dvec2 b, double margin, double& low, double& high)
{
  const glm::dvec2 size(camera.Width + margin, camera.Height + margin);
  for (int axis = 0; axis < 2; ++axis)
  {
    const double step = b[axis] - a[axis];
    const double first = (-margin - a[axis]) / step;
    const double last = (size[axis] - a[axis]) / step;
    if (step != 0.0)
    {
      low = std::max(low, std::min(first, last));
      high = std::min(high, std::max(first, last));
    }
    else if (a[axis] < -margin || a[axis] > size[axis])
    {
      return false;
    }
  }
  return low < high;
}

/// Returns a color as the file has it, with straight alpha.
glm::vec4 ToFigureColor(glm::vec4 color)
{
  glm::vec4 straight =
    color.a > 0.f ? glm::vec4(glm::vec3(color) / color.a, color.a) : glm::vec4(0.f);
  for (int c = 0; c < 4; ++c)
  {
    straight[c] = static_cast<float>(ToByte(straight[c])) / 255.f;
  }
  return straight;
}

/// Finds the visible parts of one stroke.
class StrokeParts
{
public:
  StrokeParts(const CameraRayTracer& tracer, const Stroke& stroke, std::vector<FigurePath>& paths)
    : Tracer(tracer),
      ViewCamera(tracer.GetCamera()),
      Line(stroke),
      Paths(paths)
  {
  }

  void Add()
  {
    double low = 0.0;
    double high = 1.0;
    if (!ClipToImage(this->ViewCamera, this->Line.From, this->Line.To, this->Line.Width, low, high))
    {
      return;
    }
    const auto isAnyVisible = [this](double t) {
      return this->IsVisible(t, 0.0) || this->IsVisible(t, TestedSide) ||
        this->IsVisible(t, -TestedSide);
    };
    for (const Interval& visible : this->FindIntervals({ low, high }, isAnyVisible))
    {
      this->AddVisible(visible);
    }
  }

private:
  using Interval = std::pair<double, double>; ///< of fractions of the length or width

  double GetLength(const Interval& part) const
  {
    return (part.second - part.first) * this->Line.GetLength();
  }

  template <typename Function>
  std::vector<Interval> FindIntervals(const Interval& part, const Function& holds) const
  {
    std::vector<Interval> intervals = FindVisibleIntervals(
      this->GetLength(part), [&](double s) { return holds(glm::mix(part.first, part.second, s)); });
    for (Interval& interval : intervals)
    {
      interval = { glm::mix(part.first, part.second, interval.first),
        glm::mix(part.first, part.second, interval.second) };
    }
    return intervals;
  }

  bool IsVisible(double t, double side) const
  {
    const double depth = this->Line.DepthAt(this->ViewCamera, t);
    const double own = depth - this->ViewCamera.DepthOfRayOrigins() -
      (this->Line.Width + StrokeOffset) * ComputePixelSize(this->ViewCamera, depth);
    // Strokes of the same surface are drawn over those behind them, which may be wider than they hide.
    Ray ray = this->Tracer.MakeRay(this->Line.At(t, side));
    Hit hit = this->Tracer.GetRays().Intersect(ray);
    for (int i = 0; i < MaximumStrokesInFront && hit.IsHit() && hit.Surface == this->Line.Surface;
         ++i)
    {
      if (hit.Distance >= own)
      {
        return true;
      }
      ray.Near = hit.Distance + HitOffset * static_cast<float>(depth);
      hit = this->Tracer.GetRays().Intersect(ray);
    }
    return false;
  }

  /// Adds a part where something of the width is visible. Strokes next to polygons would have seams.
  void AddVisible(const Interval& visible)
  {
    const auto isWhole = [this](double t) {
      return this->IsVisible(t, 0.0) && this->IsVisible(t, TestedSide) &&
        this->IsVisible(t, -TestedSide);
    };
    const std::vector<Interval> whole = this->FindIntervals(visible, isWhole);
    if (whole.size() == 1 && this->GetLength(visible) - this->GetLength(whole[0]) < SidePrecision)
    {
      this->AddPieces(visible);
      return;
    }
    std::vector<StrokeColumn> columns;
    double end = visible.first;
    for (const Interval& part : whole)
    {
      this->AppendColumns({ end, part.first }, columns);
      this->AppendWholeColumns(part, columns);
      end = part.second;
    }
    this->AppendColumns({ end, visible.second }, columns);
    const auto sampleColor = [this](glm::dvec2 position) { return this->SampleColorAt(position); };
    StrokeStrips(this->Line.From, this->Line.To, this->Line.Across, sampleColor, this->Paths)
      .Add(columns);
  }

  /// Adds a part in pieces, whose colors are sampled.
  void AddPieces(const Interval& part)
  {
    const int pieces =
      std::max(1, static_cast<int>(std::ceil(this->GetLength(part) / StrokePieceLength)));
    for (int i = 0; i < pieces; ++i)
    {
      const double begin = glm::mix(part.first, part.second, static_cast<double>(i) / pieces);
      const double end = glm::mix(part.first, part.second, static_cast<double>(i + 1) / pieces);
      FigurePath path;
      path.Width = this->Line.Width;
      path.Color = this->SampleColor({ begin, end });
      const double overlap =
        path.Color.a == 1.f ? StrokePieceOverlap / this->Line.GetLength() : 0.0;
      const glm::dvec2 to = this->Line.At(std::min(end + overlap, part.second));
      if (i > 0 && path.Color == this->Paths.back().Color)
      {
        this->Paths.back().Points.back() = to;
        continue;
      }
      path.Points = { this->Line.At(begin), to };
      this->Paths.push_back(path);
    }
  }

  /// Returns the color of a piece at a position where it is in front, on its axis or beside it, or else in its
  /// middle: strokes in front are drawn over all of the piece.
  glm::vec4 SampleColor(const Interval& piece) const
  {
    glm::dvec2 position = this->Line.At(0.5 * (piece.first + piece.second));
    bool found = false;
    for (const double side : SideFractions)
    {
      for (const double t : AlongFractions)
      {
        const glm::dvec2 candidate = this->Line.At(glm::mix(piece.first, piece.second, t), side);
        if (!found && this->Line.IsHitBy(this->Tracer.TraceFirstHit(candidate)))
        {
          position = candidate;
          found = true;
        }
      }
    }
    return this->SampleColorAt(position);
  }

  glm::vec4 SampleColorAt(glm::dvec2 position) const
  {
    RayCounts counts;
    return ToFigureColor(this->Tracer.TraceSample(position, counts).Color);
  }

  /// Returns the visible part of half of the width, as fractions of the width from the axis; empty if there is none.
  /// @param sign The half: 1 or -1.
  Interval FindHalf(double t, double sign, bool atAxis) const
  {
    const bool atSide = this->IsVisible(t, sign * TestedSide);
    if (atAxis == atSide)
    {
      return { 0.0, atAxis ? 0.5 : 0.0 };
    }
    double low = 0.0;
    double high = TestedSide;
    while ((high - low) * this->Line.Width > SidePrecision)
    {
      const double middle = 0.5 * (low + high);
      (this->IsVisible(t, sign * middle) == atAxis ? low : high) = middle;
    }
    return atAxis ? Interval{ 0.0, low } : Interval{ high, 0.5 };
  }

  std::vector<Interval> FindParts(double t, bool atAxis) const
  {
    const Interval left = this->FindHalf(t, -1.0, atAxis);
    const Interval right = this->FindHalf(t, 1.0, atAxis);
    if (atAxis)
    {
      return { { -left.second, right.second } };
    }
    std::vector<Interval> parts;
    if (left.first < left.second)
    {
      parts.emplace_back(-left.second, -left.first);
    }
    if (right.first < right.second)
    {
      parts.push_back(right);
    }
    return parts;
  }

  /// Appends columns along a partly hidden part of the length.
  void AppendColumns(const Interval& part, std::vector<StrokeColumn>& columns) const
  {
    const double length = this->GetLength(part);
    const int steps = static_cast<int>(std::ceil(length / ColumnDistance));
    for (int i = 0; i <= steps && length > 0.0; ++i)
    {
      // The visibility changes at both ends.
      const double inside = std::clamp(static_cast<double>(i), 0.01, steps - 0.01) / steps;
      const double t = glm::mix(part.first, part.second, inside);
      const bool atAxis = this->IsVisible(t, 0.0);
      const StrokeColumn column{ glm::mix(part.first, part.second, static_cast<double>(i) / steps),
        atAxis, this->FindParts(t, atAxis) };
      const StrokeColumn last = columns.empty() ? column : columns.back();
      if (last.AtAxis != atAxis && last.Parts.size() + column.Parts.size() == 3)
      {
        // The two sides reach the column that they part from or join.
        columns.push_back({ atAxis ? column.T : last.T, false, (atAxis ? last : column).Parts });
      }
      columns.push_back(column);
    }
  }

  /// The same for a part that is not hidden.
  void AppendWholeColumns(const Interval& part, std::vector<StrokeColumn>& columns) const
  {
    const int steps =
      std::max(1, static_cast<int>(std::ceil(this->GetLength(part) / StrokePieceLength)));
    for (int i = 0; i <= steps; ++i)
    {
      columns.push_back({ glm::mix(part.first, part.second, static_cast<double>(i) / steps), true,
        { { -0.5, 0.5 } } });
    }
  }

  const CameraRayTracer& Tracer;
  const Camera& ViewCamera;
  const Stroke& Line;
  std::vector<FigurePath>& Paths;
};

/// Sorts opaque paths of one color that follow each other by their width, so that those with the same pen are drawn
/// as one and have no seams. Their order does not matter.
void JoinPens(std::vector<FigurePath>::iterator first, std::vector<FigurePath>::iterator last)
{
  while (first != last)
  {
    const glm::vec4 color = first->Color;
    const auto end = std::find_if(
      first, last, [&](const FigurePath& path) { return path.Color != color || color.a < 1.f; });
    std::stable_sort(
      first, end, [](const FigurePath& a, const FigurePath& b) { return a.Width > b.Width; });
    first = end == first ? first + 1 : end;
  }
}

}

bool HasStrokes(const Surface& surface)
{
  return surface.IsLineOrPoint && !surface.IsAdditive && !surface.HidesLines &&
    !surface.HasHiddenLines && !surface.LitTexture && !surface.IsRound() &&
    2 * surface.Triangles.size() == surface.Positions.size();
}

void AddVisibleLines(const CameraRayTracer& tracer, std::vector<FigurePath>& paths)
{
  const auto before = static_cast<std::ptrdiff_t>(paths.size());
  for (const Stroke& stroke : FindStrokes(tracer.GetScene()))
  {
    StrokeParts(tracer, stroke, paths).Add();
  }
  JoinPens(paths.begin() + before, paths.end());
}

}
