// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// How much of each pixel polygons cover: Green's theorem in double, no samples. The truth for
// everything flat and of one colour.
#ifndef penumbra_ExactCoverage_h
#define penumbra_ExactCoverage_h

#include <glm/glm.hpp>

#include <vector>

namespace penumbra
{

class ExactCoverage
{
public:
  /// Pixel (i, j) covers [i, i+1] x [j, j+1]; row 0 is the lowest.
  ExactCoverage(int width, int height);

  /// Adds a closed polygon: counter-clockwise covers, clockwise cuts a hole. It may be concave and
  /// may reach beyond the picture. Polygons that overlap are counted twice.
  void AddPolygon(const std::vector<glm::dvec2>& polygon);

  /// The covered share of every pixel, row after row.
  std::vector<double> GetShares() const;

private:
  void AddEdge(glm::dvec2 from, glm::dvec2 to);
  void AddInRow(int row, double fromX, double toX, double rise);

  int Width;
  int Height;
  /// What a pixel's share differs by from that of its left neighbour; one column more than pixels.
  std::vector<double> Changes;
};

}
#endif
