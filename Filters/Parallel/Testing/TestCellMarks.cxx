// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Shadows/CellMarks.h"
#include "Shadows/RankCells.h"

#include "Light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace
{

using penumbra::AxisAlignedBox;
using penumbra::CellMarks;
using penumbra::Light;

/// The bounds of 64 cells with a side of 0.25 along x.
const AxisAlignedBox Bounds{ { -3.f, 0.f, 5.f }, { 13.f, 8.f, 17.f } };

class Numbers
{
public:
  float Get(float low, float high)
  {
    return std::uniform_real_distribution<float>(low, high)(this->Engine);
  }

  glm::vec3 GetPoint(const AxisAlignedBox& box)
  {
    return { this->Get(box.Low.x, box.High.x), this->Get(box.Low.y, box.High.y),
      this->Get(box.Low.z, box.High.z) };
  }

  AxisAlignedBox GetBox(float size)
  {
    AxisAlignedBox box;
    const glm::vec3 corner = this->GetPoint(Bounds);
    box.Add(corner);
    box.Add(glm::clamp(
      corner + this->GetPoint({ glm::vec3(-size), glm::vec3(size) }), Bounds.Low, Bounds.High));
    return box;
  }

private:
  std::mt19937 Engine{ 7 };
};

/// Returns true if the box may have a part in a marked cell.
bool Meet(const CellMarks& marks, const AxisAlignedBox& box)
{
  bool isMarked = false;
  marks.VisitRows(box, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t cell = first; cell < last; ++cell)
    {
      isMarked = isMarked || marks.IsMarked(cell);
    }
  });
  return isMarked;
}

AxisAlignedBox MakePoint(glm::vec3 point)
{
  return { point, point };
}

bool Contains(const AxisAlignedBox& box, glm::vec3 point)
{
  return glm::clamp(point, box.Low, box.High) == point;
}

Light MakePositional(glm::vec3 position, Light::Kinds kind = Light::Kinds::Positional)
{
  Light light;
  light.Kind = kind;
  light.Position = position;
  return light;
}

Light MakeDirectional(glm::vec3 direction)
{
  Light light;
  light.Direction = direction;
  return light;
}

/// Turns a unit vector by an angle toward another one.
glm::dvec3 Tilt(glm::dvec3 direction, glm::dvec3 aside, double angle)
{
  const glm::dvec3 across = glm::normalize(aside - glm::dot(aside, direction) * direction);
  return std::cos(angle) * direction + std::sin(angle) * across;
}

/// Lights inside and outside of the bounds, on borders, corners and centers of cells, and along axes.
std::vector<Light> MakeLights(Numbers& numbers)
{
  std::vector<Light> lights{ MakePositional({ 1.f, 4.f, 9.f }), MakePositional({ 1.f, 4.1f, 9.2f }),
    MakePositional({ 1.125f, 4.125f, 9.125f }), MakePositional(Bounds.Low),
    MakePositional({ 5.f, 4.f, 17.1f }), MakePositional({ 1e30f, -1e20f, 0.f }),
    MakeDirectional({ 0.f, 0.f, -1.f }), MakeDirectional({ 1.f, 0.f, 0.f }),
    MakeDirectional(glm::normalize(glm::vec3(1.f, -1.f, 1.f))) };
  for (int i = 0; i < 20; ++i)
  {
    const glm::vec3 inside = numbers.GetPoint(Bounds);
    lights.push_back(MakePositional(inside, Light::Kinds::Spot));
    lights.push_back(MakePositional(5.f * inside));
    lights.push_back(
      MakeDirectional(glm::normalize(numbers.GetPoint({ glm::vec3(-1.f), glm::vec3(1.f) }))));
  }
  const std::size_t count = lights.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    lights.push_back(lights[i]);
    lights.back().Radius = numbers.Get(0.f, 1.f) * (i % 2 == 0 ? 0.5f : 6.f);
    lights.back().AngularRadius = numbers.Get(0.f, 1.f) * (i % 2 == 0 ? 0.2f : 1.5f);
  }
  return lights;
}

}

TEST(CellMarks, MeetWhatIsBetweenBoxesAndLights)
{
  Numbers numbers;
  for (const Light& light : MakeLights(numbers))
  {
    SCOPED_TRACE(testing::Message()
      << light.Position.x << " " << light.Position.y << " " << light.Position.z << " direction "
      << light.Direction.x << " " << light.Direction.y << " " << light.Direction.z);
    for (const float size : { 0.f, 0.3f, 16.f })
    {
      const AxisAlignedBox box = numbers.GetBox(size);
      CellMarks seen(Bounds);
      seen.Mark(box);
      CellMarks needed(Bounds);
      needed.MarkToward(light, seen);
      for (int i = 0; i < 3000; ++i)
      {
        const glm::dvec3 from = numbers.GetPoint(box);
        const glm::dvec3 aside =
          glm::normalize(glm::dvec3(numbers.GetPoint({ glm::vec3(-1.f), glm::vec3(1.f) })));
        const glm::dvec3 toLight = light.Kind == Light::Kinds::Directional
          ? 30.0 * Tilt(-glm::dvec3(light.Direction), aside, light.AngularRadius)
          : glm::dvec3(light.Position) + 1.0 * light.Radius * aside - from;
        const double most = std::min(1.0, 30.0 / glm::length(toLight));
        const glm::vec3 between(from + most * numbers.Get(0.f, 1.f) * toLight);
        if (Contains(Bounds, between))
        {
          ASSERT_TRUE(Meet(needed, MakePoint(between)))
            << between.x << " " << between.y << " " << between.z;
        }
      }
    }
  }
}

TEST(CellMarks, DoNotMeetWhatIsFarFromRays)
{
  CellMarks seen(Bounds);
  seen.Mark(MakePoint({ 1.f, 4.f, 9.f }));
  const glm::vec3 farAside(1.f, 7.f, 13.f);
  const glm::vec3 behind(1.f, 4.f, 8.f);
  const glm::vec3 beyondTheLight(1.f, 4.f, 16.f);
  CellMarks toward(Bounds);
  toward.MarkToward(MakeDirectional({ 0.f, 0.f, -1.f }), seen);
  EXPECT_FALSE(Meet(toward, MakePoint(farAside)));
  EXPECT_FALSE(Meet(toward, MakePoint(behind)));
  EXPECT_TRUE(Meet(toward, MakePoint(beyondTheLight)));
  CellMarks near(Bounds);
  near.MarkToward(MakePositional({ 1.f, 4.f, 14.f }), seen);
  EXPECT_TRUE(Meet(near, MakePoint({ 1.f, 4.f, 13.f })));
  EXPECT_FALSE(Meet(near, MakePoint(beyondTheLight)));
  Light sun = MakeDirectional({ 0.f, 0.f, -1.f });
  sun.AngularRadius = 0.1f;
  CellMarks cone(Bounds);
  cone.MarkToward(sun, seen);
  EXPECT_TRUE(Meet(cone, MakePoint({ 1.7f, 4.f, 16.f })));
  EXPECT_FALSE(Meet(cone, MakePoint({ 3.f, 4.f, 16.f })));
  Light bulb = MakePositional({ 1.f, 4.f, 14.f });
  bulb.Radius = 2.f; // not far, so that a box is marked
  CellMarks wide(Bounds);
  wide.MarkToward(bulb, seen);
  EXPECT_TRUE(Meet(wide, MakePoint({ 2.9f, 4.f, 14.f })));
  EXPECT_FALSE(Meet(wide, MakePoint({ 4.f, 4.f, 14.f })));
  CellMarks inside(Bounds);
  inside.MarkToward(MakePositional({ 1.125f, 4.125f, 9.125f }), seen); // the center of a cell
  EXPECT_TRUE(Meet(inside, MakePoint({ 1.f, 4.f, 9.f })));
  EXPECT_FALSE(Meet(inside, MakePoint({ 1.f, 4.f, 10.f })));
}

TEST(CellMarks, MarkAllForLightsAtNoFinitePlace)
{
  constexpr float Infinity = std::numeric_limits<float>::infinity();
  constexpr float NaN = std::numeric_limits<float>::quiet_NaN();
  for (const Light& light : { MakeDirectional(glm::vec3(0.f)), MakeDirectional({ 1.f, NaN, 0.f }),
         MakePositional({ Infinity, 0.f, 0.f }), MakePositional({ 0.f, -Infinity, Infinity }),
         MakePositional({ 1.f, 4.f, NaN }) })
  {
    CellMarks seen(Bounds);
    seen.Mark(MakePoint({ 1.f, 4.f, 9.f }));
    CellMarks needed(Bounds);
    needed.MarkToward(light, seen);
    Numbers numbers;
    for (int i = 0; i < 1000; ++i)
    {
      ASSERT_TRUE(Meet(needed, MakePoint(numbers.GetPoint(Bounds))));
    }
  }
}

TEST(CellMarks, TakeNotANumberAsTheBounds)
{
  const glm::vec3 nowhere(std::numeric_limits<float>::quiet_NaN());
  CellMarks marks(Bounds);
  marks.Mark({ nowhere, nowhere });
  EXPECT_TRUE(Meet(marks, MakePoint(Bounds.Low)));
  EXPECT_TRUE(Meet(marks, MakePoint(Bounds.High)));
  EXPECT_TRUE(Meet(marks, { nowhere, nowhere }));
}

TEST(CellMarks, MeetTheSameAsAllCellsOfBoxes)
{
  constexpr float Cell = 0.25f;
  Numbers numbers;
  for (const float size : { 2.f, 5.f, 16.f })
  {
    int met = 0;
    constexpr int Count = 3000;
    for (int i = 0; i < Count; ++i)
    {
      const AxisAlignedBox marked = numbers.GetBox(size);
      const AxisAlignedBox other = numbers.GetBox(size);
      CellMarks marks(Bounds);
      marks.Mark(marked);
      CellMarks copy(Bounds);
      copy.Add(marks.Write());
      EXPECT_EQ(Meet(copy, other), Meet(marks, other));
      const glm::vec3 gap = glm::max(marked.Low - other.High, other.Low - marked.High);
      const float distance = std::max({ gap.x, gap.y, gap.z });
      met += Meet(marks, other);
      EXPECT_TRUE(Meet(marks, other) || distance > 0.f);
      EXPECT_FALSE(Meet(marks, other) && distance > 1.3f * Cell);
    }
    EXPECT_GT(met, 0);
    EXPECT_LT(met, Count);
  }
}

TEST(RankCells, AreTheMarksOfAllRanks)
{
  Numbers numbers;
  for (const std::size_t ranks : { 1, 7, 64, 130 })
  {
    std::vector<CellMarks> marks(ranks, CellMarks(Bounds));
    std::vector<std::string> written;
    for (CellMarks& each : marks)
    {
      each.Mark(numbers.GetBox(3.f));
      written.push_back(each.Write());
    }
    const penumbra::RankCells cells(Bounds, written);
    for (const float size : { 0.f, 1.f, 16.f })
    {
      for (int i = 0; i < 200; ++i)
      {
        const AxisAlignedBox box = numbers.GetBox(size);
        std::vector<std::size_t> expected;
        for (std::size_t rank = 0; rank < ranks; ++rank)
        {
          if (Meet(marks[rank], box))
          {
            expected.push_back(rank);
          }
        }
        std::vector<std::size_t> found;
        cells.VisitRanks(box, [&](std::size_t rank) { found.push_back(rank); });
        ASSERT_EQ(found, expected);
      }
    }
  }
}
