// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"
#include "BruteForce/PathTracer.h"
#include "Room.h"
#include "Scenes/Solids.h"
#include "Surface.h"

#include <cmath>

namespace penumbra
{
namespace
{

constexpr int Size = 128;
constexpr int ReferenceStep = 8;
constexpr int Paths = 16384;
constexpr double MeanTolerance = .0034; ///< of irradiance over pi, about 1.7 % of its mean

/// Divides a panel into `columns` x `rows` panels.
std::vector<Panel> Divide(const Panel& panel, int columns, int rows)
{
  std::vector<Panel> parts;
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      Panel part = panel;
      part.Side = panel.Side / static_cast<double>(columns);
      part.Other = panel.Other / static_cast<double>(rows);
      part.Corner += static_cast<double>(i) * part.Side + static_cast<double>(j) * part.Other;
      parts.push_back(part);
    }
  }
  return parts;
}

/// Returns the room without its panel, and the panel.
std::vector<Panel> MakeRoom(Panel& emitter)
{
  std::vector<Panel> panels = CornellLikeBox();
  std::vector<Panel> others;
  for (const Panel& panel : panels)
  {
    if (panel.Emission.x > 0.0)
    {
      emitter = panel;
    }
    else
    {
      others.push_back(panel);
    }
  }
  return others;
}

/// Returns the RMSE of the cache over the root mean square of the irradiance.
double MeasureRoom(ResultTable& table, const std::string& name, std::vector<Panel> room,
  const Panel& emitter, int columns, int rows, double reference)
{
  PathTracer truth{ room, .5, 5, glm::dvec3(0.0) };
  truth.Panels.push_back(emitter);
  for (const Panel& part : Divide(emitter, columns, rows))
  {
    room.push_back(part);
  }
  Scene scene;
  AddSurfaces(scene, room);
  LookAt(scene, { .51, -1.3, .47 }, { .5, 0.0, .5 }, 41.0, Size, Size);
  const RayScene rays(scene, 1);
  IlluminationSettings settings;
  settings.Albedo = static_cast<float>(truth.Albedo);
  settings.Bounces = truth.Bounces;
  const std::vector<ImagePoint> points = FindImagePoints(rays, 1);
  const std::vector<ImagePoint> queried = FindImagePoints(rays, ReferenceStep);
  CacheCost cost;
  const std::vector<glm::dvec3> found =
    AskCache(Illumination(rays, settings), MeanTolerance, points, queried, cost);
  double squares = 0.0;
  double values = 0.0;
  for (std::size_t i = 0; i < queried.size(); ++i)
  {
    const glm::dvec3 exact =
      truth.Irradiance(queried[i].Position, queried[i].Normal, Paths, i) / std::acos(-1.0);
    const glm::dvec3 error = found[i] - exact;
    squares += glm::dot(error, error);
    values += glm::dot(exact, exact);
  }
  const double rmse = std::sqrt(squares / values);
  const std::string remark = Brief(cost.Seconds) + " s, " + Brief(cost.Records) + " records, " +
    Brief(cost.Rays * 1e-6) + " M rays";
  table.Add(name, "RMSE over root mean square", rmse, TargetKind::None, 0.0, remark);
  if (reference > 0.0)
  {
    table.Add(name, "RMSE over that with a panel of 2 triangles", rmse / reference,
      TargetKind::AtMost, 1.2);
  }
  return rmse;
}

}

void MeasureEmitters(LightBenchmark& benchmark)
{
  Panel panel;
  const std::vector<Panel> room = MakeRoom(panel);
  ResultTable& table = benchmark.Results;
  const double reference = MeasureRoom(table, "room, panel of 2 triangles", room, panel, 1, 1, 0.0);
  MeasureRoom(table, "room, panel of 2,000 triangles", room, panel, 40, 25, reference);
  // The walls have the area 1. The power stays the same. The emitter hangs lower: the gap above the panel
  // would make the reference noisy.
  Panel emitter = panel;
  const double area = glm::length(glm::cross(panel.Side, panel.Other));
  emitter.Side = { .01, 0.0, 0.0 };
  emitter.Other = { 0.0, .01, 0.0 };
  emitter.Corner += .5 * (panel.Side + panel.Other - emitter.Side - emitter.Other);
  emitter.Corner.z = .9;
  emitter.Emission = panel.Emission * (area / 1e-4);
  MeasureRoom(table, "room, emitter of 1e-4 of a wall", room, emitter, 1, 1, reference);
}

}
