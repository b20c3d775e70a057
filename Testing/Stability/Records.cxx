// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What records of the cache must know beside a value and a radius: each row as it is, and by the same
// records with one array of them altered. Then light of more than one reflection.
#include "CacheScenes.h"
#include "Scenario.h"

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

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

constexpr double Pi = 3.14159265358979323846;

using Cache = vtkPenumbraIrradianceCache;

/// A cache of the scene; broken: it begins with its own records, one array of them filled with a number.
vtkSmartPointer<Cache> Records(
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
  vtkDataArray* numbers = records->GetPointData()->GetArray(array);
  for (int component = 0; component < numbers->GetNumberOfComponents(); ++component)
  {
    numbers->FillComponent(component, value);
  }
  auto altered = vtkSmartPointer<Cache>::New();
  altered->SetInitialRecords(records);
  altered->Begin(rays, Infinity, tolerance);
  return altered;
}

/// The floor under a sphere that touches it.
ScenarioResult Gradients(Variant variant)
{
  Scene scene;
  ArrangeContact(scene, 1.0, 256);
  const RayScene rays(scene, 1);
  const auto cache = Records(rays, variant, "TranslationGradient", 0.0, .02);
  ScenarioResult outcome{ 0.0, {} };
  outcome.Picture = Picture(
    rays, cache,
    [](glm::dvec3 position, glm::dvec3 normal) {
      return normal.z > .99999 && position.z < 1e-3
        ? std::pow(1.0 + position.x * position.x + position.y * position.y, -1.5)
        : .5 * (1.0 - normal.z);
    },
    outcome.Value);
  return outcome;
}

/// Records at a sphere's normals weigh 1 where they lie; broken: by the formula as it is printed, whose
/// root is of less than 0 where 1 - n.n rounds down.
ScenarioResult WeightWhereItLies(Variant variant)
{
  constexpr float normalFactor = 9.0124f;
  Frame picture{ 64, 64, {} };
  for (int i = 0; i < 64 * 64; ++i)
  {
    const float angle = .1f * static_cast<float>(i % 64);
    const float height = static_cast<float>(i / 64) / 32.f - 1.f;
    Record record;
    record.Normal = glm::normalize(glm::vec3(
      std::sqrt(1.f - height * height) * glm::vec2(std::cos(angle), std::sin(angle)), height));
    record.Radius = 1.f;
    record.Gathered.Clearance.fill(1.f);
    picture.Values.push_back(variant == Variant::Ablated
        ? 1.f - normalFactor * std::sqrt(1.f - glm::dot(record.Normal, record.Normal))
        : record.Weight(record, normalFactor));
  }
  const std::vector<double> ones(picture.Values.size(), 1.0);
  return { LargestDifference(picture.Values, ones), picture };
}

/// A board close above a floor: its records look the same way as the floor below it.
ScenarioResult UnderABoard(Variant variant)
{
  Scene scene;
  AddFloor(scene, 4.f);
  AddBox(scene, { -1.f, -1.f, .15f }, { 1.f, 1.f, .2f });
  LookAt(scene, { 0.0, -6.0, 1.2 }, { 0.0, -.6, .1 }, 30.0, 128, 128);
  const RayScene rays(scene, 1);
  const auto cache = Records(rays, variant, "Lean", 100.0, .01);
  vtkNew<vtkPenumbraBruteForceIrradiance> truth;
  truth->Begin(rays, Infinity, .01);
  double worst = 0.0;
  for (int i = 0; i < 60; ++i)
  {
    for (const glm::dvec3 place :
      { glm::dvec3(.03 * i - .9, -.95, 0.0), glm::dvec3(.03 * i - .9, -.9, .2) })
    {
      const glm::dvec3 up(0.0, 0.0, 1.0);
      worst = std::max(worst, std::abs(Ask(cache, place, up) - Ask(truth, place, up)));
    }
  }
  return { worst, Picture(rays, cache) };
}

ScenarioResult ThroughASheet(Variant variant)
{
  Scene scene;
  ArrangeTwoRooms(scene);
  const RayScene rays(scene, 1);
  const auto cache = Records(rays, variant, "Clearance", 100.0, .01);
  return { WorstBesideWall(rays, cache), Picture(rays, cache) };
}

/// Within a closed box whose walls shine and throw a quarter back, light is passed on for ever.
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
  ScenarioResult outcome{ 0.0, {} };
  outcome.Picture = Picture(
    rays,
    [&](glm::dvec3 position, glm::dvec3 normal) {
      return cache->Irradiance(&position.x, &normal.x, .01).Value[0] / Pi;
    },
    [](glm::dvec3, glm::dvec3) { return .5; }, outcome.Value);
  return outcome;
}

}

std::vector<Scenario> RecordScenarios()
{
  return {
    { "RecordGradients", "a sphere on a floor against the closed form", "still", Metric::Bias, .01,
      "gradients of records: 0", "[IC] no gradients", "", Gradients },
    { "RecordsUnderABoard", "a board close above a floor", "still", Metric::Leak, .05,
      "how far off its surface a record serves: everywhere", "[IC] records in front of a surface",
      "", UnderABoard },
    { "RecordsThroughASheet", "a dark room and a bright one, a sheet between", "still",
      Metric::Leak, .05, "how far the way from a record is clear: everywhere",
      "[IC] records leak through thin walls", "", ThroughASheet },
    { "RecordWeights", "records of 4096 directions, asked for where they lie", "still",
      Metric::MaximumDifference, .01, "1 - n.n kept from falling below 0: as printed",
      "[IC] the weight's root of less than 0", "", WeightWhereItLies },
    { "LightOfManyReflections",
      "a closed box that shines and throws a quarter back, against the closed form", "still",
      Metric::Bias, .01, "reflections before the last: none", "[IC] one reflection", "", Furnace },
  };
}

}
