// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Flat shapes that are difficult to antialias, in pixel coordinates (y up). Their coverage is known
// exactly.
#ifndef penumbra_Shapes_h
#define penumbra_Shapes_h

#include <glm/glm.hpp>

#include <vector>

namespace penumbra
{

/// A closed, counterclockwise, star-shaped polygon: Center is visible from every point.
struct Shape
{
  glm::dvec2 Center{ 0.0 };
  std::vector<glm::dvec2> Outline;
};

/// Half-plane on the left of a slanted line through the center of an image.
std::vector<Shape> HalfPlane(int width, int height);

Shape Disc(glm::dvec2 center, double radius, int edges);

/// A star of `edges` / 2 spikes.
Shape Star(glm::dvec2 center, double outerRadius, double innerRadius, int edges);

/// `perSide` x `perSide` disjoint discs with different diameters in [0.05, 0.5] pixels.
std::vector<Shape> SmallDiscs(int width, int height, int perSide);

/// `perSide` x `perSide` disjoint rods, 0.08 to 0.4 pixels wide, in all directions.
std::vector<Shape> Rods(int width, int height, int perSide);

/// Upright triangles, 1.2 pixels wide at the bottom and 0 at the top, with a spacing of 2.4 pixels.
std::vector<Shape> Comb(int width, int height);

}
#endif
