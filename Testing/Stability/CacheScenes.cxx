// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CacheScenes.h"

#include "Embree/RayScene.h"
#include "Scenes/Solids.h"
#include "Surface.h"

#include "vtkNew.h"
#include "vtkPenumbraBruteForceIrradiance.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

double Ask(const vtkPenumbraIrradianceProvider* provider, glm::dvec3 position, glm::dvec3 normal)
{
  return provider->Occlusion(&position.x, &normal.x).Value;
}

Frame RenderFrame(const RayScene& rays, const PointEvaluator& evaluate,
  const PointEvaluator& reference, double& error)
{
  const Scene& scene = rays.GetScene();
  const int side = scene.ViewCamera.Width / 2;
  Frame image{ side, side, std::vector<double>(side * side, 1.0) };
  double squares = 0.0;
  double count = 0.0;
  for (int i = 0; i < side * side; ++i)
  {
    Ray ray;
    ray.Direction = scene.ViewCamera.RayDirection({ 2 * (i % side) + 1.0, 2 * (i / side) + 1.0 });
    const Hit hit = rays.Intersect(ray);
    if (!hit.IsHit())
    {
      continue;
    }
    const Surface& surface = scene.Surfaces[hit.Surface];
    const glm::uvec3 triangle = surface.Triangles[hit.Primitive];
    const glm::dvec3 a = surface.Positions[triangle.x];
    glm::dvec3 normal = glm::normalize(glm::cross(glm::dvec3(surface.Positions[triangle.y]) - a,
      glm::dvec3(surface.Positions[triangle.z]) - a));
    normal *= glm::dot(normal, glm::dvec3(ray.Direction)) > 0.0 ? -1.0 : 1.0;
    const glm::dvec3 position = double(hit.Distance) * glm::dvec3(ray.Direction) + scene.Origin;
    const double value = evaluate(position, normal);
    image.Values[i] = 1.0 - value;
    squares += std::pow(value - reference(position, normal), 2.0);
    count += 1.0;
  }
  error = std::sqrt(squares / count);
  return image;
}

Frame RenderFrame(const RayScene& rays, const vtkPenumbraIrradianceProvider* provider,
  const PointEvaluator& reference, double& error)
{
  return RenderFrame(
    rays,
    [provider](glm::dvec3 position, glm::dvec3 normal) { return Ask(provider, position, normal); },
    reference, error);
}

Frame RenderFrame(const RayScene& rays, const vtkPenumbraIrradianceProvider* provider)
{
  double ignored = 0.0;
  return RenderFrame(
    rays, provider, [](glm::dvec3, glm::dvec3) { return 0.0; }, ignored);
}

void ArrangeContact(Scene& scene, double height, int size)
{
  AddFloor(scene, 1000.f);
  AddSphere(scene, { 0.0, 0.0, height }, 1.0, 100);
  LookAt(scene, { 0.0, -7.0, 4.0 }, { 0.0, 0.0, .6 }, 45.0, size, size);
}

void ArrangeTwoRooms(Scene& scene)
{
  AddFloor(scene, 4.f);
  AddRectangle(scene, { 0.f, -4.f, 0.f }, { 0.f, 8.f, 0.f }, { 0.f, 0.f, 4.f });
  AddRectangle(scene, { -4.f, -4.f, .5f }, { 4.f, 0.f, 0.f }, { 0.f, 8.f, 0.f });
  LookAt(scene, { 1.0, -9.0, 5.0 }, { 0.0, 0.0, 0.0 }, 40.0, 128, 128);
}

double WorstBesideWall(const RayScene& rays, const vtkPenumbraIrradianceProvider* provider)
{
  vtkNew<vtkPenumbraBruteForceIrradiance> reference;
  reference->Begin(rays, Infinity, .01);
  double worst = 0.0;
  for (int i = 1; i < 60; ++i)
  {
    for (const double side : { -1.0, 1.0 })
    {
      const glm::dvec3 position(side * .01 * i, -3.2, 0.0);
      const glm::dvec3 up(0.0, 0.0, 1.0);
      worst = std::max(worst, std::abs(Ask(provider, position, up) - Ask(reference, position, up)));
    }
  }
  return worst;
}

}
