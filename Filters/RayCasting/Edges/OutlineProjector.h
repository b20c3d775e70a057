// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Projection of lines and arcs of circles in space to edges within a rectangle of the image.
#ifndef penumbra_OutlineProjector_h
#define penumbra_OutlineProjector_h

#include "Silhouettes.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace penumbra
{

inline constexpr double FullAngle = glm::two_pi<double>();
/// Number of chords that are skipped together if they are outside the rectangle.
inline constexpr int ChordsPerBlock = 16;
/// Range of the number of chords of a full circle.
inline constexpr double MinimumChords = 12.0;
inline constexpr double MaximumChords = 16384.0;

/// Returns half the length of the chords, in pixels, of a circle of the given radius in pixels. The
/// area between an arc and its chord is proportional to h^3 / radius. It is below 5e-5 for short
/// chords; chords longer than half a pixel have a sagitta below 1e-4. The sagitta stays below
/// EdgePrecision.
inline double ComputeHalfChord(double radius)
{
  const double byArea = std::cbrt(3.9e-4 * radius);
  const double byHeight = std::max(0.35, std::sqrt(1.5e-4 * radius));
  return std::min({ byArea, byHeight, std::sqrt(2e-3 * radius) });
}

/// Minimum depth that is projected.
inline double ComputeNear(const Camera& camera)
{
  return std::max(camera.Near, camera.Parallel ? -1e300 : 1e-9);
}

/// An arc of a circle in space: Center + cos(angle) * U + sin(angle) * V.
struct Arc
{
  glm::dvec3 Center;
  glm::dvec3 U;
  glm::dvec3 V;
  double Begin = 0.0;
  double Size = FullAngle;

  glm::dvec3 At(double angle, double scale = 1.0) const
  {
    return this->Center + scale * (std::cos(angle) * this->U + std::sin(angle) * this->V);
  }
};

/// Projects arcs and lines to edges within a rectangle of the image.
class OutlineProjector
{
public:
  OutlineProjector(
    const Camera& camera, glm::dvec2 low, glm::dvec2 high, std::vector<ProjectedEdge>& edges)
    : View(camera),
      Low(low),
      High(high),
      Near(ComputeNear(camera)),
      Edges(edges)
  {
  }

  void AddLine(glm::dvec3 a, glm::dvec3 b)
  {
    double depthA = this->View.Depth(a);
    double depthB = this->View.Depth(b);
    if (depthA < this->Near && depthB < this->Near)
    {
      return;
    }
    if (depthA < this->Near || depthB < this->Near)
    {
      const glm::dvec3 cut = a + (b - a) * ((this->Near - depthA) / (depthB - depthA));
      (depthA < this->Near ? a : b) = cut;
      (depthA < this->Near ? depthA : depthB) = this->Near;
    }
    const bool parallel = this->View.Parallel;
    ProjectedEdge edge{ this->View.Project(a), this->View.Project(b),
      parallel ? depthA : 1.0 / depthA, parallel ? depthB : 1.0 / depthB };
    if (ClipToRectangle(edge, this->Low, this->High))
    {
      this->Edges.push_back(edge);
    }
  }

  /// Adds an arc whose full circle has about the given radius in the image, in pixels.
  void AddArc(const Arc& arc, double radius)
  {
    const double chords = glm::pi<double>() * radius / std::max(ComputeHalfChord(radius), 1e-9);
    const bool closed = arc.Size >= FullAngle;
    const int count = std::max(
      static_cast<int>(
        std::ceil(std::clamp(chords, MinimumChords, MaximumChords) * arc.Size / FullAngle)),
      1);
    const double step = arc.Size / count;
    // The polygon has the area of the circle. The ends of an open arc stay in place.
    const double scale = std::sqrt(step / std::sin(step));
    const auto at = [&](int i) {
      const bool end = !closed && (i == 0 || i == count);
      return arc.At(arc.Begin + step * (closed && i == count ? 0 : i), end ? 1.0 : scale);
    };
    for (int first = 0; first < count; first += ChordsPerBlock)
    {
      const int last = std::min(first + ChordsPerBlock, count);
      glm::dvec3 from = at(first);
      if (count > ChordsPerBlock && this->IsOutside(from, at(last), step * (last - first), radius))
      {
        continue;
      }
      for (int i = first; i < last; ++i)
      {
        const glm::dvec3 to = at(i + 1);
        this->AddLine(from, to);
        from = to;
      }
    }
  }

private:
  /// Returns true if an arc of `angle` between two points does not reach the rectangle.
  bool IsOutside(glm::dvec3 a, glm::dvec3 b, double angle, double radius) const
  {
    if (this->View.Depth(a) < this->Near || this->View.Depth(b) < this->Near)
    {
      return false;
    }
    const glm::dvec2 p = this->View.Project(a);
    const glm::dvec2 q = this->View.Project(b);
    // Twice the sagitta of the arc.
    const double margin = 4.0 *
      (glm::distance(p, q) + radius * (1.0 - std::cos(std::min(0.5 * angle, glm::pi<double>()))));
    const glm::dvec2 low = glm::min(p, q) - margin;
    const glm::dvec2 high = glm::max(p, q) + margin;
    return high.x < this->Low.x || high.y < this->Low.y || low.x > this->High.x ||
      low.y > this->High.y;
  }

  const Camera& View;
  glm::dvec2 Low;
  glm::dvec2 High;
  double Near;
  std::vector<ProjectedEdge>& Edges;
};

}
#endif
