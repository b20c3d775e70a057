// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Pixels/PixelArrangement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

using namespace penumbra;

namespace
{

PixelArrangement Arrange(std::vector<PixelSegment> segments)
{
  segments.erase(std::remove_if(segments.begin(), segments.end(),
                   [](PixelSegment& s) { return !ClipToPixel(s); }),
    segments.end());
  PixelArrangement arrangement;
  arrangement.Build(segments.data(), static_cast<int>(segments.size()));
  return arrangement;
}

std::vector<double> SortedAreas(const PixelArrangement& arrangement)
{
  std::vector<double> areas;
  for (const auto& face : arrangement.GetFaces())
  {
    areas.push_back(face.Area);
  }
  std::sort(areas.begin(), areas.end());
  return areas;
}

}

TEST(PixelArrangement, WithoutSegmentsIsOneFace)
{
  const PixelArrangement arrangement = Arrange({});
  ASSERT_EQ(arrangement.GetFaces().size(), 1u);
  EXPECT_DOUBLE_EQ(arrangement.GetFaces()[0].Area, 1.0);
  EXPECT_EQ(arrangement.GetFaces()[0].Corners, 15u);
}

TEST(PixelArrangement, ComputesTheAreasOnBothSidesOfALine)
{
  // y = 0.25 + 0.5 x has 0.5 below it.
  const PixelArrangement arrangement = Arrange({ { { -1.0, -0.25 }, { 2.0, 1.25 } } });
  const std::vector<double> areas = SortedAreas(arrangement);
  ASSERT_EQ(areas.size(), 2u);
  EXPECT_NEAR(areas[0], 0.5, 1e-12);
  EXPECT_NEAR(areas[1], 0.5, 1e-12);
}

TEST(PixelArrangement, HandlesVerticalAndHorizontalSegments)
{
  const PixelArrangement arrangement =
    Arrange({ { { 0.25, -1.0 }, { 0.25, 2.0 } }, { { -1.0, 0.5 }, { 2.0, 0.5 } } });
  const std::vector<double> areas = SortedAreas(arrangement);
  ASSERT_EQ(areas.size(), 4u);
  EXPECT_NEAR(areas[0], 0.125, 1e-12);
  EXPECT_NEAR(areas[1], 0.125, 1e-12);
  EXPECT_NEAR(areas[2], 0.375, 1e-12);
  EXPECT_NEAR(areas[3], 0.375, 1e-12);
}

TEST(PixelArrangement, FindsATriangleInsideThePixel)
{
  const glm::dvec2 a(0.3, 0.3), b(0.6, 0.4), c(0.35, 0.7);
  const PixelArrangement arrangement = Arrange({ { a, b }, { b, c }, { c, a } });
  const double area = 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  const std::vector<double> areas = SortedAreas(arrangement);
  ASSERT_EQ(areas.size(), 2u);
  EXPECT_NEAR(areas[0], area, 1e-12);
  EXPECT_NEAR(areas[1], 1.0 - area, 1e-12);
}

// Both ends of the corner are at one point up to rounding, as those of two edges of one vertex.
TEST(PixelArrangement, SeparatesTheSidesOfACornerWithASteepSide)
{
  const double x = 0.254346;
  const double y = 0.184362;
  for (const double slant : { 1e-9, 1e-8, 1.5e-7, 1e-5, 1e-3 })
  {
    for (const double rounding : { -9e-11, -1e-16, 0.0, 1e-16, 9e-11 })
    {
      for (const double sign : { -1.0, 1.0 })
      {
        const PixelArrangement arrangement =
          Arrange({ { { x + sign * slant, 1.5 }, { x, y } }, { { 1.5, y }, { x + rounding, y } } });
        const std::vector<double> areas = SortedAreas(arrangement);
        ASSERT_EQ(areas.size(), 2u) << slant << " " << rounding << " " << sign;
        EXPECT_NEAR(areas[1], (1.0 - x) * (1.0 - y), slant + 1e-9);
        EXPECT_EQ(arrangement.GetFaces()[0].Corners ^ arrangement.GetFaces()[1].Corners, 15u);
      }
    }
  }
}

TEST(PixelArrangement, SeparatesTheSidesOfASteepSegmentThatCrossesAnotherNearItsEnd)
{
  for (const double width : { 0.0, 1e-12, 6e-9, 1e-7, 1e-6, 9e-6 })
  {
    for (const double distance : { 0.5, 2e-3, 1e-4 })
    {
      const double y = 1.0 - distance;
      const PixelArrangement arrangement = Arrange({ { { 0.4, -0.2 }, { 0.4 + width, 1.2 } },
        { { 0.2, y }, { 1.8, y } }, { { 0.2, -1.0 }, { 0.2, y } } });
      const std::vector<double> areas = SortedAreas(arrangement);
      ASSERT_EQ(areas.size(), 4u) << width << " " << distance;
      std::vector<double> expected = { 0.2 * y, 0.2 + 0.2 * distance, 0.6 * y, 0.6 * distance };
      std::sort(expected.begin(), expected.end());
      for (std::size_t i = 0; i < expected.size(); ++i)
      {
        EXPECT_NEAR(areas[i], expected[i], 1e-5);
      }
    }
  }
}

TEST(PixelArrangement, KeepsFacesOfSteepSegmentsThatEndOnSlopedOnes)
{
  // Slope of the line through (.4, .5), and the areas above, and below on the left and the right.
  for (const std::array<double, 4>& row : { std::array<double, 4>{ 1.0, 0.405, 0.12, 0.475 },
         { -1.0, 0.595, 0.28, 0.125 }, { -5.0, 0.6, 0.375, 0.025 } })
  {
    // The end is this distance above the line.
    for (const double overlap : { 0.0, 2e-6 })
    {
      for (const double width : { 1e-7, 1e-6, 3e-6, 9e-6 })
      {
        for (const bool isMirrored : { false, true })
        {
          const auto mirror = [&](glm::dvec2 p) {
            return isMirrored ? glm::dvec2(p.x, 1.0 - p.y) : p;
          };
          const glm::dvec2 end(0.4 + width, 0.5);
          const glm::dvec2 direction(1.0, row[0]);
          const std::vector<double> areas =
            SortedAreas(Arrange({ { mirror({ 0.4, -0.2 }), mirror(end + glm::dvec2(0.0, overlap)) },
              { mirror(end - 2.0 * direction), mirror(end + 2.0 * direction) } }));
          SCOPED_TRACE(
            testing::Message() << row[0] << " " << overlap << " " << width << " " << isMirrored);
          std::vector<double> expected(row.begin() + 1, row.end());
          std::sort(expected.begin(), expected.end());
          ASSERT_EQ(areas.size(), 3u);
          for (std::size_t i = 0; i < 3; ++i)
          {
            EXPECT_NEAR(areas[i], expected[i], 1e-4);
          }
        }
      }
    }
  }
}

TEST(PixelArrangement, KeepsSidesOfThePixelClosedNextToSteepSegments)
{
  for (const double x : { 0.0, 1.0 })
  {
    const double sign = x > 0.5 ? -1.0 : 1.0;
    const std::vector<double> areas =
      SortedAreas(Arrange({ { { x - sign * 1e-7, 0.4 }, { x + sign * 4e-7, 0.6 } },
        { { -1.0, 0.3 }, { 2.0, 0.3 } }, { { -1.0, 0.7 }, { 2.0, 0.7 } } }));
    ASSERT_EQ(areas.size(), 3u);
    EXPECT_NEAR(areas[0], 0.3, 1e-5);
    EXPECT_NEAR(areas[1], 0.3, 1e-5);
    EXPECT_NEAR(areas[2], 0.4, 1e-5);
  }
}

TEST(PixelArrangement, KeepsOneFaceAroundOpenSegments)
{
  EXPECT_EQ(Arrange({ { { 0.2, 0.2 }, { 0.8, 0.7 } } }).GetFaces().size(), 1u);
  EXPECT_EQ(Arrange({ { { 0.5, 0.0 }, { 0.5, 0.9 } } }).GetFaces().size(), 1u);
  EXPECT_EQ(Arrange({ { { 0.5, 0.0 }, { 0.5, 1.0 } } }).GetFaces().size(), 2u);
}

TEST(PixelArrangement, SatisfiesEulersFormulaForRandomLines)
{
  // n lines in general position with k crossings inside the pixel form 1 + n + k faces of total
  // area 1.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-0.5, 1.5);
  for (int trial = 0; trial < 200; ++trial)
  {
    std::vector<PixelSegment> lines;
    for (int i = 0; i < 1 + trial % 9; ++i)
    {
      const glm::dvec2 p(coordinate(random), coordinate(random));
      const glm::dvec2 q(coordinate(random), coordinate(random));
      PixelSegment line{ p - 100.0 * (q - p), p + 100.0 * (q - p) };
      if (ClipToPixel(line))
      {
        lines.push_back(line);
      }
    }
    std::size_t crossings = 0;
    for (std::size_t i = 0; i < lines.size(); ++i)
    {
      for (std::size_t j = 0; j < i; ++j)
      {
        const auto side = [](const PixelSegment& s, glm::dvec2 p) {
          const glm::dvec2 d = s.B - s.A;
          return d.x * (p.y - s.A.y) - d.y * (p.x - s.A.x);
        };
        crossings += side(lines[i], lines[j].A) * side(lines[i], lines[j].B) < 0.0 &&
          side(lines[j], lines[i].A) * side(lines[j], lines[i].B) < 0.0;
      }
    }
    const PixelArrangement arrangement = Arrange(lines);
    EXPECT_EQ(arrangement.GetFaces().size(), 1 + lines.size() + crossings);
    double area = 0.0;
    for (const auto& face : arrangement.GetFaces())
    {
      area += face.Area;
    }
    EXPECT_NEAR(area, 1.0, 1e-9);
  }
}

TEST(PixelArrangement, PlacesTheFacePointInsideTheFace)
{
  // The centroid of the ring lies in its hole.
  const glm::dvec2 a(0.2, 0.2), b(0.8, 0.2), c(0.8, 0.8), d(0.2, 0.8);
  const PixelArrangement arrangement = Arrange({ { a, b }, { b, c }, { c, d }, { d, a } });
  ASSERT_EQ(arrangement.GetFaces().size(), 2u);
  for (const auto& face : arrangement.GetFaces())
  {
    const bool inner = face.Corners == 0u;
    const glm::dvec2 p = face.Point;
    EXPECT_EQ(inner, p.x > 0.2 && p.x < 0.8 && p.y > 0.2 && p.y < 0.8);
    EXPECT_NEAR(face.Area, inner ? 0.36 : 0.64, 1e-12);
  }
}

TEST(PixelArrangement, StopsAtTheLimits)
{
  std::vector<PixelSegment> segments;
  for (int i = 0; i < 20; ++i) // a grid of 400 crossings, 441 faces
  {
    const double at = (i + 0.5) / 20.0;
    segments.push_back({ { 0.0, at }, { 1.0, at } });
    segments.push_back({ { at - 1e-3, 0.0 }, { at + 1e-3, 1.0 } });
  }
  const int count = static_cast<int>(segments.size());
  PixelArrangement arrangement;
  EXPECT_FALSE(arrangement.Build(segments.data(), count, { 399, 1000000 }));
  EXPECT_FALSE(arrangement.Build(segments.data(), count, { 400, 2000 }));
  ASSERT_TRUE(arrangement.Build(segments.data(), count, { 400, 1000000 }));
  EXPECT_EQ(arrangement.GetFaces().size(), 441u);
}

TEST(PixelArrangement, ListsTheTrapezoidsOfEachFaceInOrder)
{
  std::vector<PixelSegment> segments;
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> coordinate(0.0, 1.0);
  for (int i = 0; i < 40; ++i)
  {
    segments.push_back({ { coordinate(generator), coordinate(generator) },
      { coordinate(generator), coordinate(generator) } });
  }
  const PixelArrangement arrangement = Arrange(segments);
  std::size_t visited = 0;
  for (std::size_t face = 0; face < arrangement.GetFaces().size(); ++face)
  {
    double area = 0.0;
    const PixelArrangement::Trapezoid* last = nullptr;
    arrangement.VisitTrapezoids(face, [&](const PixelArrangement::Trapezoid& t) {
      EXPECT_EQ(t.Face, static_cast<int>(face));
      EXPECT_LT(last, &t);
      last = &t;
      area += t.Area();
      ++visited;
    });
    EXPECT_DOUBLE_EQ(area, arrangement.GetFaces()[face].Area);
  }
  EXPECT_EQ(visited, arrangement.GetTrapezoids().size());
}
