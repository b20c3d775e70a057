// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Partly hidden lines and points as polygons of one color each. Parts of the width that overlap from one column to the
// next are one strip, which is cut only where its color changes.
#ifndef penumbra_StrokeStrips_h
#define penumbra_StrokeStrips_h

#include "VectorFigure.h"

#include <glm/glm.hpp>

#include <functional>
#include <utility>
#include <vector>

namespace penumbra
{

/// Length in pixels of the pieces of a line, for each of which its color is sampled.
constexpr double StrokePieceLength = 16.0;
/// Length in pixels by which opaque pieces go on below the next one: more than the diagonal of a
/// pixel, so that none shows the background at their border.
constexpr double StrokePieceOverlap = 1.5;

/// The visible parts of the width at a point of the axis of a stroke.
struct StrokeColumn
{
  double T; ///< fraction of the length
  bool AtAxis;
  /// From -0.5 to 0.5. One part if the axis is visible, or else at most one on each side.
  std::vector<std::pair<double, double>> Parts;
};

class StrokeStrips
{
public:
  /// @param across From a side of the stroke to the other one.
  /// @param sampleColor Returns the color of the figure at a position.
  StrokeStrips(glm::dvec2 from, glm::dvec2 to, glm::dvec2 across,
    std::function<glm::vec4(glm::dvec2)> sampleColor, std::vector<FigurePath>& paths);

  /// Adds the polygons of columns in the order of the axis.
  void Add(const std::vector<StrokeColumn>& columns);

private:
  /// One of the parts of a column. Those of a strip follow each other.
  struct Section
  {
    double T;
    std::pair<double, double> Part;
  };
  using Strip = std::vector<Section>;

  glm::dvec2 At(double t, double side) const
  {
    return glm::mix(this->From, this->To, t) + side * this->Across;
  }
  void AddAll(const std::vector<Strip>& strips);
  void AddStrip(const Strip& strip);
  void AddPolygon(const Strip& strip, std::size_t first, std::size_t last, glm::vec4 color);

  const glm::dvec2 From;
  const glm::dvec2 To;
  const glm::dvec2 Across;
  const double Length;
  const std::function<glm::vec4(glm::dvec2)> SampleColor;
  std::vector<FigurePath>& Paths;
};

}
#endif
