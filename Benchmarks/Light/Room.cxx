// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Room.h"

#include "Benchmark.h"
#include "Surface.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPenumbraIrradianceCache.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <glm/gtc/constants.hpp>

namespace penumbra
{
namespace
{

constexpr double Pi = glm::pi<double>();
constexpr int ReferenceRays = 16384;

}

vtkSmartPointer<vtkRenderer> MakeRenderer(
  const std::vector<Panel>& panels, glm::dvec3 eye, glm::dvec3 target, double viewAngle)
{
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  vtkNew<vtkLight> dark; // without a light, surfaces would be drawn without lighting
  dark->SetIntensity(0.0);
  renderer->AddLight(dark);
  for (const Panel& panel : panels)
  {
    vtkNew<vtkPoints> points;
    for (const glm::dvec3& corner : { panel.Corner, panel.Corner + panel.Side,
           panel.Corner + panel.Side + panel.Other, panel.Corner + panel.Other })
    {
      points->InsertNextPoint(&corner.x);
    }
    vtkNew<vtkCellArray> cells;
    const vtkIdType corners[] = { 0, 1, 2, 3 };
    cells->InsertNextCell(4, corners);
    vtkNew<vtkPolyData> mesh;
    mesh->SetPoints(points);
    mesh->SetPolys(cells);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(mesh);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    vtkProperty* property = actor->GetProperty();
    property->SetInterpolationToFlat();
    property->SetAmbient(1.0);
    property->SetAmbientColor(panel.Emission.x, panel.Emission.y, panel.Emission.z);
    property->SetDiffuseColor(panel.Reflectance.x, panel.Reflectance.y, panel.Reflectance.z);
    renderer->AddActor(actor);
  }
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(eye.x, eye.y, eye.z);
  camera->SetFocalPoint(target.x, target.y, target.z);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetViewAngle(viewAngle);
  return renderer;
}

std::vector<ImagePoint> FindImagePoints(const RayScene& rays, int step)
{
  const Scene& scene = rays.GetScene();
  const Camera& camera = scene.ViewCamera;
  std::vector<ImagePoint> points;
  for (int y = step / 2; y < camera.Height; y += step)
  {
    for (int x = step / 2; x < camera.Width; x += step)
    {
      Ray ray;
      ray.Direction = camera.RayDirection({ x + .5, y + .5 });
      const Hit hit = rays.Intersect(ray);
      if (!hit.IsHit() || scene.Surfaces[hit.Surface].Front.AmbientColor.x > 0.f)
      {
        continue;
      }
      const glm::dvec3 direction(ray.Direction);
      glm::dvec3 geometric = glm::normalize(glm::dvec3(rays.GetNormal(ray, hit)));
      geometric = glm::dot(geometric, direction) > 0.0 ? -geometric : geometric;
      points.push_back({ { x, y }, double(hit.Distance) * direction / scene.Scale + scene.Origin,
        rays.GetSmoothNormal(hit, geometric), geometric, hit.Surface });
    }
  }
  return points;
}

bool ShowsOneSurface(const RayScene& rays, glm::ivec2 pixel)
{
  const Camera& camera = rays.GetScene().ViewCamera;
  std::uint32_t first = 0;
  for (int k = 0; k < 9; ++k)
  {
    Ray ray;
    const glm::dvec2 offset(k % 3 - 1, k / 3 - 1);
    ray.Direction = camera.RayDirection(glm::dvec2(pixel) + .5 + offset);
    const Hit hit = rays.Intersect(ray);
    first = k == 0 ? hit.Surface : first;
    if (!hit.IsHit() || hit.Surface != first)
    {
      return false;
    }
  }
  return true;
}

glm::dvec3 AskForMean(const vtkPenumbraIrradianceProvider* provider, const ImagePoint& point,
  double tolerance, long long& rays)
{
  const auto light =
    provider->Irradiance(&point.Position.x, &point.Normal.x, Pi * tolerance, &point.Geometric.x);
  rays += light.Rays;
  return glm::dvec3(light.Value[0], light.Value[1], light.Value[2]) / Pi;
}

std::vector<glm::dvec3> AskCache(const Illumination& light, double tolerance,
  const std::vector<ImagePoint>& points, const std::vector<ImagePoint>& queried, CacheCost& cost)
{
  vtkNew<vtkPenumbraIrradianceCache> cache;
  // As the ray caster calls it: the color of a pixel averages over several values.
  constexpr double ProviderToleranceFactor = 2.0;
  const double accepted = ProviderToleranceFactor * tolerance;
  const double start = Seconds();
  cache->BeginIrradiance(light, Pi * accepted);
  long long rays = 0;
  for (const ImagePoint& point : points)
  {
    AskForMean(cache, point, accepted, rays);
  }
  cost.Seconds = Seconds() - start;
  vtkNew<vtkFieldData> statistics;
  cache->Report(statistics);
  cost.Records = statistics->GetArray("Cache/Records")->GetComponent(0, 0);
  cost.Rays = statistics->GetArray("Rays/Gather")->GetComponent(0, 0) + static_cast<double>(rays);
  std::vector<glm::dvec3> means;
  for (const ImagePoint& point : queried)
  {
    means.push_back(AskForMean(cache, point, accepted, rays));
  }
  return means;
}

std::vector<glm::dvec3> FindReference(
  const Illumination& light, const std::vector<ImagePoint>& queried)
{
  vtkNew<vtkPenumbraBruteForceIrradiance> provider;
  provider->SetMinimumRays(ReferenceRays);
  provider->SetMaximumRays(ReferenceRays);
  provider->BeginIrradiance(light, 0.0);
  std::vector<glm::dvec3> means;
  long long rays = 0;
  for (const ImagePoint& point : queried)
  {
    means.push_back(AskForMean(provider, point, 1e-9, rays));
  }
  return means;
}

}
