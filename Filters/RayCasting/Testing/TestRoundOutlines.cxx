// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Coverage of the pixels that the outline of a sphere or tube crosses, against supersampled closed
// forms.
#include "RoundScene.h"

#include "vtkFloatArray.h"
#include "vtkLookupTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <set>

using namespace penumbra_testing;

namespace
{

/// Returns true if the ray from the origin passes a segment at a distance below the radius: the
/// distance of two lines, and of the end points, written without the ray caster's formulas.
bool HitsTube(glm::dvec3 direction, glm::dvec3 a, glm::dvec3 b, double radius)
{
  const glm::dvec3 d = b - a;
  const double dd = glm::dot(d, d);
  const double along = glm::dot(d, direction);
  const double denominator = dd - along * along;
  double u =
    denominator > 0.0 ? (glm::dot(a, direction) * along - glm::dot(a, d)) / denominator : 0.0;
  u = glm::clamp(u, 0.0, 1.0);
  const glm::dvec3 p = a + u * d;
  const double t = glm::dot(p, direction);
  return t > 0.0 && glm::distance(p, t * direction) < radius;
}

}

TEST(RoundShapes, CoversOutlinesOfSpheresExactly)
{
  RoundScene scene(MakeCells(FiveCenters, {}));
  scene.Caster->SetPointRadius(0.6);
  const std::vector<double> image = scene.RenderRed();
  const double error = ComputeEdgeError(image, [](glm::dvec3 direction) {
    return std::any_of(FiveCenters.begin(), FiveCenters.end(),
      [&](glm::dvec3 c) { return HitsTube(direction, c, c, 0.6); });
  });
  RecordProperty("RMSE", std::to_string(error));
  EXPECT_LT(error, 1e-4);
  EXPECT_LT(scene.Statistic("Rays/PerPixel"), 1.05);
}

TEST(RoundShapes, CoversOutlinesBetweenScalarColorsExactly)
{
  // Spheres that cover each other partly, colored by a texture: each edge pixel is the sum of colors
  // times visible areas.
  std::vector<glm::dvec3> centers;
  for (int i = 0; i < 12; ++i)
  {
    centers.emplace_back(0.35 * (i % 4) - 0.5, 0.4 * (i / 4) - 0.4, -5.0 - 0.7 * (i * 5 % 12));
  }
  constexpr double Radius = 0.3;
  vtkSmartPointer<vtkPolyData> points = MakeCells(centers, {});
  vtkNew<vtkFloatArray> scalars;
  for (std::size_t i = 0; i < centers.size(); ++i)
  {
    scalars->InsertNextValue(static_cast<float>(i) / static_cast<float>(centers.size() - 1));
  }
  points->GetPointData()->SetScalars(scalars);
  RoundScene scene(points);
  vtkNew<vtkLookupTable> grays;
  grays->SetHueRange(0.0, 0.0);
  grays->SetSaturationRange(0.0, 0.0);
  grays->SetValueRange(0.1, 1.0);
  grays->SetRampToLinear();
  scene.Actor->GetMapper()->SetLookupTable(grays);
  scene.Actor->GetMapper()->InterpolateScalarsBeforeMappingOn();
  scene.Caster->SetPointRadius(Radius);
  const std::vector<double> image = scene.RenderRed();
  EXPECT_LT(scene.Statistic("Rays/PerPixel"), 1.05);
  EXPECT_EQ(scene.Statistic("Pixels/Uniform"), 0.0);

  const auto findNearest = [&](glm::dvec3 direction) {
    int nearest = -1;
    double distance = 1e9;
    for (std::size_t i = 0; i < centers.size(); ++i)
    {
      const double along = glm::dot(centers[i], direction);
      const double across = glm::length(centers[i] - along * direction);
      const double t = along - std::sqrt(std::max(Radius * Radius - across * across, 0.0));
      if (across < Radius && t < distance)
      {
        nearest = static_cast<int>(i);
        distance = t;
      }
    }
    return nearest;
  };
  constexpr int Width = 2 * Side + 1; // of the grid of corners, centers and middles of sides
  std::vector<int> grid;
  for (int i = 0; i < Width * Width; ++i)
  {
    grid.push_back(findNearest(Direction(0.5 * (i % Width), 0.5 * (i / Width))));
  }
  // The spheres at the corners, the middles of the sides, and the center of a pixel.
  const auto findInPixel = [&](int x, int y) {
    std::set<int> found;
    for (int i = 0; i < 9; ++i)
    {
      found.insert(grid[(2 * y + i / 3) * Width + 2 * x + i % 3]);
    }
    return found;
  };
  std::map<int, double> colors; // of pixels inside the spheres
  std::vector<int> edges;
  for (int i = 0; i < Side * Side; ++i)
  {
    const std::set<int> found = findInPixel(i % Side, i / Side);
    if (found.size() > 1)
    {
      edges.push_back(i);
      continue;
    }
    const int sphere = *found.begin();
    const double expected = sphere < 0 ? 0.0 : 0.1 + 0.9 * scalars->GetValue(sphere);
    ASSERT_NEAR(image[i], expected, 0.01) << i;
    colors[sphere] = image[i];
  }
  ASSERT_GE(colors.size(), 12u); // one sphere is hidden
  double squares = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < edges.size(); k += 5)
  {
    const int x = edges[k] % Side;
    const int y = edges[k] / Side;
    double expected = 0.0;
    for (const int i : findInPixel(x, y))
    {
      expected += colors[i] *
        ComputeCoverage(
          x, y, [&](glm::dvec3 direction) { return findNearest(direction) == i; }, 256);
    }
    squares += std::pow(image[edges[k]] - expected, 2.0);
    ++count;
  }
  const double error = std::sqrt(squares / count);
  RecordProperty("RMSE", std::to_string(error));
  EXPECT_LT(error, 1e-4);
}

TEST(RoundShapes, CoversOutlinesOfTubesExactly)
{
  const std::vector<glm::dvec3> points = { { -1.5, -1.0, -5.0 }, { -0.3, 1.0, -7.0 },
    { 0.4, -0.8, -6.0 }, { 1.6, 0.9, -5.5 } };
  RoundScene scene(MakeCells(points, { { 0, 1, 2, 3 } }));
  scene.Caster->SetLineRadius(0.2);
  const std::vector<double> image = scene.RenderRed();
  const double error = ComputeEdgeError(image, [&](glm::dvec3 direction) {
    bool hit = false;
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
    {
      hit = hit || HitsTube(direction, points[i], points[i + 1], 0.2);
    }
    return hit;
  });
  RecordProperty("RMSE", std::to_string(error));
  EXPECT_LT(error, 1e-4);
  EXPECT_LT(scene.Statistic("Rays/PerPixel"), 1.05);
}

TEST(RoundShapes, MissesNoSphereBelowAPixel)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<glm::dvec3> centers;
  for (int i = 0; i < 2000; ++i)
  {
    centers.emplace_back(
      2.0 * uniform(random), 2.0 * uniform(random), -6.0 + 0.1 * uniform(random));
  }
  RoundScene scene(MakeCells(centers, {}));
  const double radius = 0.004; // a quarter of a pixel
  scene.Caster->SetPointRadius(radius);
  const std::vector<double> image = scene.RenderRed();
  double sum = 0.0;
  for (const double red : image)
  {
    sum += red;
  }
  // Overlaps of two spheres reduce the sum by less than 0.1 %.
  double expected = 0.0;
  const double focal = 0.5 * Side / std::tan(0.5 * ViewAngle * std::acos(-1.0) / 180.0);
  for (const glm::dvec3& c : centers)
  {
    // Area of the ellipse to which a sphere projects.
    const double z = -c.z;
    const double square = z * z - radius * radius;
    const double b = focal * radius / std::sqrt(square);
    const double a = focal * radius * std::sqrt(glm::dot(c, c) - radius * radius) / square;
    expected += std::acos(-1.0) * a * b;
    const int x = static_cast<int>(0.5 * Side + focal * c.x / z);
    const int y = static_cast<int>(0.5 * Side + focal * c.y / z);
    ASSERT_GT(image[y * Side + x], 0.0) << c.x << " " << c.y;
  }
  EXPECT_NEAR(sum, expected, 0.004 * expected);
}

TEST(RoundShapes, CoverOutlinesFarFromTheOrigin)
{
  const glm::dvec3 far(3e6, -2e6, 1e6);
  std::vector<glm::dvec3> centers = FiveCenters;
  for (glm::dvec3& c : centers)
  {
    c = far + c;
  }
  RoundScene near(MakeCells(FiveCenters, {}));
  RoundScene distant(MakeCells(centers, {}));
  vtkCamera* camera = distant.Renderer->GetActiveCamera();
  camera->SetPosition(far.x, far.y, far.z);
  camera->SetFocalPoint(far.x, far.y, far.z - 1.0);
  near.Caster->SetPointRadius(0.6);
  distant.Caster->SetPointRadius(0.6);
  const std::vector<double> expected = near.RenderRed();
  const std::vector<double> image = distant.RenderRed();
  for (std::size_t i = 0; i < image.size(); ++i)
  {
    ASSERT_NEAR(image[i], expected[i], 1e-3) << i;
  }
}

TEST(RoundShapes, CoverTheHorizonOfAHugeSphere)
{
  // The camera is 1 above a sphere of radius 1e5; the horizon is at elevation -asin(1e5 / (1e5 + 1)).
  const double radius = 1e5;
  RoundScene scene(MakeCells({ { 0.0, -radius - 1.0, 0.0 } }, {}));
  scene.Caster->SetPointRadius(radius);
  scene.Renderer->GetActiveCamera()->SetClippingRange(0.01, 1e4);
  const std::vector<double> image = scene.RenderRed();
  const double elevation = -std::acos(radius / (radius + 1.0));
  const double focal = 0.5 * Side / std::tan(0.5 * ViewAngle * std::acos(-1.0) / 180.0);
  double height = 0.0;
  for (int y = 0; y < Side; ++y)
  {
    height += image[y * Side + Side / 2];
  }
  EXPECT_NEAR(height, 0.5 * Side + focal * std::tan(elevation), 0.01);
}
