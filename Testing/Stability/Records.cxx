// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Records of the irradiance cache need more than a value and a radius. Each row is measured with
// the records as they are, and with one of their arrays altered. Also: light of several bounces.
#include "CacheScenes.h"
#include "Scenario.h"
#include "Surface.h"

#include "BruteForce/PathTracer.h"
#include "Embree/RayScene.h"
#include "Records/Record.h"
#include "Scenes/Solids.h"
#include "Shading/Illumination.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPenumbraIrradianceCache.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

constexpr double Pi = glm::pi<double>();

using Cache = vtkPenumbraIrradianceCache;

/// Returns a cache of the scene. Ablated: it starts with the same records, one array of which is
/// filled with `value`.
vtkSmartPointer<Cache> BuildCache(
  const RayScene& rays, Variant variant, const char* array, double value, double tolerance)
{
  auto cache = vtkSmartPointer<Cache>::New();
  cache->Begin(rays, Infinity, tolerance);
  if (variant != Variant::Ablated)
  {
    return cache;
  }
  vtkNew<vtkPolyData> records;
  cache->GetRecords(records);
  vtkDataArray* values = records->GetPointData()->GetArray(array);
  for (int component = 0; component < values->GetNumberOfComponents(); ++component)
  {
    values->FillComponent(component, value);
  }
  auto altered = vtkSmartPointer<Cache>::New();
  altered->SetInitialRecords(records);
  altered->Begin(rays, Infinity, tolerance);
  return altered;
}

/// Bias of occlusion on a floor under a sphere that touches it.
ScenarioResult Gradients(Variant variant)
{
  Scene scene;
  ArrangeContact(scene, 1.0, 256);
  const RayScene rays(scene, 1);
  const auto cache = BuildCache(rays, variant, "TranslationGradient", 0.0, .02);
  ScenarioResult result{ 0.0, {} };
  result.Image = RenderFrame(
    rays, cache,
    [](glm::dvec3 position, glm::dvec3 normal) {
      return normal.z > .99999 && position.z < 1e-3
        ? std::pow(1.0 + position.x * position.x + position.y * position.y, -1.5)
        : .5 * (1.0 - normal.z);
    },
    result.Value);
  return result;
}

/// The weight of a record at its own position is 1. Ablated: the formula as printed, which takes
/// the square root of a negative number if n.n rounds to more than 1.
ScenarioResult WeightWhereItLies(Variant variant)
{
  constexpr float normalFactor = 9.0124f;
  Frame image{ 64, 64, {} };
  for (int i = 0; i < 64 * 64; ++i)
  {
    const float angle = .1f * static_cast<float>(i % 64);
    const float height = static_cast<float>(i / 64) / 32.f - 1.f;
    Record record;
    record.Normal = glm::normalize(glm::vec3(
      std::sqrt(1.f - height * height) * glm::vec2(std::cos(angle), std::sin(angle)), height));
    record.Radius = 1.f;
    record.Gathered.Clearance.fill(1.f);
    image.Values.push_back(variant == Variant::Ablated
        ? 1.f - normalFactor * std::sqrt(1.f - glm::dot(record.Normal, record.Normal))
        : record.Weight(record, normalFactor));
  }
  const std::vector<double> ones(image.Values.size(), 1.0);
  return { LargestDifference(image.Values, ones), image };
}

/// A board close above a floor, whose records have the same normal as those of the floor.
ScenarioResult UnderABoard(Variant variant)
{
  Scene scene;
  AddFloor(scene, 4.f);
  AddBox(scene, { -1.f, -1.f, .15f }, { 1.f, 1.f, .2f });
  LookAt(scene, { 0.0, -6.0, 1.2 }, { 0.0, -.6, .1 }, 30.0, 128, 128);
  const RayScene rays(scene, 1);
  const auto cache = BuildCache(rays, variant, "Lean", 100.0, .01);
  vtkNew<vtkPenumbraBruteForceIrradiance> reference;
  reference->Begin(rays, Infinity, .01);
  double worst = 0.0;
  for (int i = 0; i < 60; ++i)
  {
    for (const glm::dvec3 position :
      { glm::dvec3(.03 * i - .9, -.95, 0.0), glm::dvec3(.03 * i - .9, -.9, .2) })
    {
      const glm::dvec3 up(0.0, 0.0, 1.0);
      worst = std::max(worst, std::abs(Ask(cache, position, up) - Ask(reference, position, up)));
    }
  }
  return { worst, RenderFrame(rays, cache) };
}

ScenarioResult ThroughASheet(Variant variant)
{
  Scene scene;
  ArrangeTwoRooms(scene);
  const RayScene rays(scene, 1);
  const auto cache = BuildCache(rays, variant, "Clearance", 100.0, .01);
  return { WorstBesideWall(rays, cache), RenderFrame(rays, cache) };
}

/// Inside a closed box whose walls emit light and reflect a quarter of it, against the infinite sum
/// of bounces.
ScenarioResult Furnace(Variant variant)
{
  std::vector<Panel> panels;
  AddPanels(panels, glm::dvec3(-1.0), glm::dvec3(1.0), glm::dvec3(1.0));
  for (Panel& panel : panels)
  {
    panel.Emission = glm::dvec3(.375);
  }
  Scene scene;
  AddSurfaces(scene, panels);
  LookAt(scene, { -.6, -.7, .2 }, { 0.0, 0.0, 0.0 }, 60.0, 64, 64);
  const RayScene rays(scene, 1);
  IlluminationSettings settings;
  settings.Albedo = .25f;
  settings.Bounces = variant == Variant::Ablated ? 1 : 4;
  const Illumination light(rays, settings);
  vtkNew<Cache> cache;
  cache->BeginIrradiance(light, .01);
  ScenarioResult result{ 0.0, {} };
  result.Image = RenderFrame(
    rays,
    [&](glm::dvec3 position, glm::dvec3 normal) {
      return cache->Irradiance(&position.x, &normal.x, .01).Value[0] / Pi;
    },
    [](glm::dvec3, glm::dvec3) { return .5; }, result.Value);
  return result;
}

}

std::vector<Scenario> RecordScenarios()
{
  return {
    { "RecordGradients", "a sphere on a floor against the closed form", "still", Metric::Bias, .01,
      "gradients of records: 0", "[IC] no gradients", "", Gradients },
    { "RecordsUnderABoard", "a board close above a floor", "still", Metric::Leak, .05,
      "maximum distance of a record from its tangent plane: unlimited",
      "[IC] records in front of a surface", "", UnderABoard },
    { "RecordsThroughASheet", "a dark and a bright room, separated by a sheet", "still",
      Metric::Leak, .05, "clear distance around a record: unlimited",
      "[IC] records leak through thin walls", "", ThroughASheet },
    { "RecordWeights", "weights of records with 4096 normals at their own positions", "still",
      Metric::MaximumDifference, .01, "clamping 1 - n.n to 0: as printed",
      "[IC] square root of a negative number in the weight", "", WeightWhereItLies },
    { "LightOfManyReflections",
      "a closed box that emits light and reflects a quarter of it, against the closed form",
      "still", Metric::Bias, .01, "bounces before the last: none", "[IC] one bounce", "", Furnace },
  };
}

}
