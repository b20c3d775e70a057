// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes with closed-form occlusion, over all pixels that show their floor.
#include "Benchmark.h"
#include "Surface.h"

#include "Embree/RayScene.h"
#include "Scenes/Solids.h"

#include "vtkNew.h"
#include "vtkPenumbraIrradianceCache.h"

#include <glm/gtc/constants.hpp>

#include <cmath>
#include <functional>
#include <limits>

namespace penumbra
{
namespace
{

constexpr int Size = 256;
constexpr double Tolerance = .005;
constexpr double Pi = glm::pi<double>();
constexpr float Far = 1000.f;

using Truth = std::function<double(glm::dvec3)>;

/// RMSE over the visible part of the first surface, which lies in z = 0.
double ErrorOnFloor(Scene& scene, glm::dvec3 eye, glm::dvec3 target, const Truth& truth)
{
  LookAt(scene, eye, target, 45.0, Size, Size);
  const RayScene rays(scene, 1);
  vtkNew<vtkPenumbraIrradianceCache> cache;
  cache->SetTolerance(Tolerance);
  cache->Begin(rays, std::numeric_limits<double>::infinity(), 2.0 * Tolerance);
  const double up[3] = { 0.0, 0.0, 1.0 };
  double square = 0.0;
  double count = 0.0;
  for (int pixel = 0; pixel < Size * Size; ++pixel)
  {
    Ray ray;
    ray.Direction = scene.ViewCamera.RayDirection({ pixel % Size + .5, pixel / Size + .5 });
    const Hit hit = rays.Intersect(ray);
    if (hit.IsHit() && hit.Surface == 0)
    {
      const glm::dvec3 at = double(hit.Distance) * glm::dvec3(ray.Direction) + scene.Origin;
      square += std::pow(cache->Occlusion(&at.x, up).Value - truth(at), 2.0);
      count += 1.0;
    }
  }
  return std::sqrt(square / count);
}

/// Occlusion by a wall of infinite width, of height h at distance d.
double BehindWall(double d, double h)
{
  return .5 * (1.0 - d / std::hypot(d, h));
}

/// Occlusion by a rectangle a x b at height 1 for the point below one of its corners.
double UnderCorner(double a, double b)
{
  const double u = std::hypot(1.0, a);
  const double v = std::hypot(1.0, b);
  return (a / u * std::atan(b / u) + b / v * std::atan(a / v)) / (2.0 * Pi);
}

}

void MeasureForms(IrradianceBenchmark& benchmark)
{
  const auto add = [&](const char* what, double error, double bar) {
    benchmark.Results.Add("closed forms, tolerance .005", what, error, TargetKind::AtMost, bar,
      error > bar ? "brute force: 0.001" : "");
  };
  Scene open;
  AddFloor(open, Far);
  add("RMSE on an open plane",
    ErrorOnFloor(open, { 0, -4, 3 }, { 0, 0, 0 }, [](glm::dvec3) { return 0.0; }), 0.0);
  Scene box;
  AddFloor(box, 1.f);
  AddBox(box, { -1, -1, -.001f }, { 1, 1, 2 });
  add("RMSE in a closed box",
    ErrorOnFloor(box, { 0, -.5, 1 }, { 0, .3, 0 }, [](glm::dvec3) { return 1.0; }), 0.0);
  Scene wall;
  AddFloor(wall, Far);
  AddRectangle(wall, { -Far, 0, 0 }, { 2 * Far, 0, 0 }, { 0, 0, 1 });
  add("RMSE before a wall, 1/2 at its foot",
    ErrorOnFloor(wall, { 0, -4, 3 }, { 0, -.5, 0 },
      [](glm::dvec3 at) { return BehindWall(std::abs(at.y), 1.0); }),
    Tolerance);
  Scene corner; // both walls are so high that their upper edges do not matter close to them
  AddFloor(corner, Far);
  AddRectangle(corner, { -Far, 0, 0 }, { 2 * Far, 0, 0 }, { 0, 0, Far });
  AddRectangle(corner, { 0, -Far, 0 }, { 0, 2 * Far, 0 }, { 0, 0, Far });
  add("RMSE in the corner of two walls, 3/4",
    ErrorOnFloor(corner, { -.3, -.4, .5 }, { -.1, -.1, 0 }, [](glm::dvec3) { return .75; }),
    Tolerance);
  Scene rectangle;
  AddFloor(rectangle, Far);
  AddRectangle(rectangle, { -1, -.5, 1 }, { 2, 0, 0 }, { 0, 1, 0 });
  add("RMSE under a rectangle",
    ErrorOnFloor(rectangle, { 0, -4, .9 }, { 0, 0, 0 },
      [](glm::dvec3 at) {
        return UnderCorner(at.x + 1.0, at.y + .5) - UnderCorner(at.x - 1.0, at.y + .5) -
          UnderCorner(at.x + 1.0, at.y - .5) + UnderCorner(at.x - 1.0, at.y - .5);
      }),
    Tolerance);
  Scene disc;
  AddFloor(disc, Far);
  AddDisc(disc, .8f, 1.f);
  add("RMSE under a disc",
    ErrorOnFloor(disc, { 0, -4, .9 }, { 0, 0, 0 },
      [](glm::dvec3 at) {
        // Between parallel planes: 1/2 (1 - (1 + d^2 - r^2) / sqrt((1 + d^2 + r^2)^2 - 4 d^2 r^2)).
        const double d = at.x * at.x + at.y * at.y;
        const double r = .8 * .8;
        return .5 * (1.0 - (1.0 + d - r) / std::sqrt((1.0 + d + r) * (1.0 + d + r) - 4.0 * d * r));
      }),
    Tolerance);
}

}
