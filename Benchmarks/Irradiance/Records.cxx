// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"

#include "Records/RecordOctree.h"
#include "Shading/HemisphereSampling.h"

#include <limits>

namespace penumbra
{

void MeasureRecords(IrradianceBenchmark& benchmark)
{
  constexpr int Count = 1000000;
  constexpr int Questions = 1000000;
  // Records on a plane; each point is within the radius of about three.
  const float radius = std::sqrt(3.f * 4.f / (3.14159f * Count));
  std::uint32_t state = 1;
  const auto random = [&state]() {
    return glm::vec3(2.f * NextFloat(state) - 1.f, 2.f * NextFloat(state) - 1.f, 0.f);
  };
  RecordOctree tree;
  tree.Initialize(glm::vec3(0.f), 1.f);
  for (int i = 0; i < Count; ++i)
  {
    Record record;
    record.Position = random();
    record.Radius = radius * (.5f + NextFloat(state));
    record.MaximumPlaneDistance = radius;
    record.Gathered.Clearance.fill(std::numeric_limits<float>::infinity());
    record.Gathered.Mean = glm::vec3(.5f);
    tree.Insert(record);
  }
  const double start = FrameSeconds();
  int found = 0;
  for (int i = 0; i < Questions; ++i)
  {
    ShadingPoint place;
    place.Position = random();
    found += tree.LookUp(place).Found() ? 1 : 0;
  }
  const double micro = 1e6 * (FrameSeconds() - start) / Questions;
  ResultTable& table = benchmark.Results;
  table.Add("1 million records", "microseconds a look-up", micro, TargetKind::AtMost, 2.0,
    std::to_string(100 * found / Questions) + " % interpolated");
  table.Add("1 million records", "memory, MB", static_cast<double>(tree.GetBytes()) * 1e-6,
    TargetKind::None, 0.0, std::to_string(sizeof(Record)) + " bytes per record");
}

}
