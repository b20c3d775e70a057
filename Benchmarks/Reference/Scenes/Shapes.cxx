// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Shapes.h"

#include <glm/gtc/constants.hpp>

#include <cmath>

namespace penumbra
{
namespace
{

constexpr double Pi = glm::pi<double>();

/// Element i of a low-discrepancy sequence in [0, 1), identical on every machine.
double Spread(int i, double step)
{
  return std::fmod(0.5 + i * step, 1.0);
}

constexpr double GoldenRatio = 0.61803398874989485;
constexpr double PlasticRatio = 0.75487766624669276;
constexpr double PlasticSquare = 0.56984029099805327;

}

std::vector<Shape> HalfPlane(int width, int height)
{
  const glm::dvec2 middle(0.5 * width + 0.3, 0.5 * height + 0.1);
  const glm::dvec2 along = glm::normalize(glm::dvec2(0.31, 1.0)) * (2.0 * height);
  const glm::dvec2 aside = glm::normalize(glm::dvec2(-along.y, along.x)) * (2.0 * width);
  Shape shape;
  shape.Center = middle + 0.5 * aside;
  shape.Outline = { middle - along, middle + along, middle + along + aside,
    middle - along + aside };
  return { shape };
}

Shape Disc(glm::dvec2 center, double radius, int edges)
{
  return Star(center, radius, radius, edges);
}

Shape Star(glm::dvec2 center, double outerRadius, double innerRadius, int edges)
{
  Shape shape;
  shape.Center = center;
  for (int i = 0; i < edges; ++i)
  {
    const double angle = 0.05 + 2.0 * Pi * i / edges;
    shape.Outline.push_back(
      center + glm::dvec2(std::cos(angle), std::sin(angle)) * (i % 2 ? innerRadius : outerRadius));
  }
  return shape;
}

std::vector<Shape> SmallDiscs(int width, int height, int perSide)
{
  const glm::dvec2 cell(double(width) / perSide, double(height) / perSide);
  std::vector<Shape> shapes;
  for (int i = 0; i < perSide * perSide; ++i)
  {
    const glm::dvec2 place(
      0.1 + 0.8 * Spread(i, PlasticRatio), 0.1 + 0.8 * Spread(i, PlasticSquare));
    const double radius = 0.025 + 0.225 * Spread(i, GoldenRatio);
    shapes.push_back(Disc((glm::dvec2(i % perSide, i / perSide) + place) * cell, radius, 24));
  }
  return shapes;
}

std::vector<Shape> Rods(int width, int height, int perSide)
{
  const glm::dvec2 cell(double(width) / perSide, double(height) / perSide);
  const double length = 0.7 * std::min(cell.x, cell.y);
  std::vector<Shape> shapes;
  for (int i = 0; i < perSide * perSide; ++i)
  {
    const glm::dvec2 place(
      0.45 + 0.1 * Spread(i, PlasticRatio), 0.45 + 0.1 * Spread(i, PlasticSquare));
    const double angle = Pi * Spread(i, PlasticSquare);
    const glm::dvec2 along = glm::dvec2(std::cos(angle), std::sin(angle)) * (0.5 * length);
    const glm::dvec2 aside =
      glm::dvec2(-std::sin(angle), std::cos(angle)) * (0.04 + 0.16 * Spread(i, GoldenRatio));
    Shape rod;
    rod.Center = (glm::dvec2(i % perSide, i / perSide) + place) * cell;
    rod.Outline = { rod.Center - along - aside, rod.Center + along - aside,
      rod.Center + along + aside, rod.Center - along + aside };
    shapes.push_back(rod);
  }
  return shapes;
}

std::vector<Shape> Comb(int width, int height)
{
  std::vector<Shape> shapes;
  for (double x = 0.06 * width; x < 0.9 * width; x += 2.4137)
  {
    Shape sliver;
    sliver.Outline = { { x, 0.08 * height }, { x + 1.2, 0.081 * height },
      { x + 0.6 + 0.03 * width, 0.92 * height } };
    sliver.Center = (sliver.Outline[0] + sliver.Outline[1] + sliver.Outline[2]) / 3.0;
    shapes.push_back(sliver);
  }
  return shapes;
}

}
