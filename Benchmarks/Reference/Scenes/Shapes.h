// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Flat shapes that are hard to antialias, in picture coordinates (pixels, y up). Their coverage is
// known exactly.
#ifndef penumbra_Shapes_h
#define penumbra_Shapes_h

#include <glm/glm.hpp>

#include <vector>

namespace penumbra
{

/// A closed polygon, counter-clockwise, every point of which sees Center.
struct Shape
{
  glm::dvec2 Center{ 0.0 };
  std::vector<glm::dvec2> Outline;
};

/// Everything on the left of a slanted line through the middle of a picture.
std::vector<Shape> HalfPlane(int width, int height);

Shape Disc(glm::dvec2 center, double radius, int edges);

/// A star of `edges` / 2 spikes.
Shape Star(glm::dvec2 center, double outerRadius, double innerRadius, int edges);

/// `perSide` x `perSide` discs with diameters from 0.05 to 0.5 pixels, all different, apart.
std::vector<Shape> SmallDiscs(int width, int height, int perSide);

/// `perSide` x `perSide` rods, 0.08 to 0.4 pixels wide, in all directions, apart.
std::vector<Shape> Rods(int width, int height, int perSide);

/// Upright slivers, 1.2 pixels wide below, nothing above, 2.4 pixels apart.
std::vector<Shape> Comb(int width, int height);

}
#endif
