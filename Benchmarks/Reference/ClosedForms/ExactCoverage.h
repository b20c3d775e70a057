// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Exact coverage of pixels by polygons, with Green's theorem in double precision. Reference for
// flat shapes of a single color.
#ifndef penumbra_ExactCoverage_h
#define penumbra_ExactCoverage_h

#include <glm/glm.hpp>

#include <vector>

namespace penumbra
{

class ExactCoverage
{
public:
  /// Pixel (i, j) covers [i, i+1] x [j, j+1]; row 0 is the bottom row.
  ExactCoverage(int width, int height);

  /// Adds a closed polygon, which may be concave and may extend beyond the image. Counterclockwise
  /// polygons add coverage, clockwise polygons cut holes. Overlaps are counted twice.
  void AddPolygon(const std::vector<glm::dvec2>& polygon);

  /// Returns the coverage of every pixel in [0, 1], row by row.
  std::vector<double> GetShares() const;

private:
  void AddEdge(glm::dvec2 from, glm::dvec2 to);
  void AddInRow(int row, double fromX, double toX, double rise);

  int Width;
  int Height;
  /// Difference of each pixel's coverage from that of its left neighbor; one more column than
  /// pixels.
  std::vector<double> Changes;
};

}
#endif
