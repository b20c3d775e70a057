// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Gatherer.h"

#include "HemisphereGrid.h"

namespace penumbra
{

Gatherer::~Gatherer() = default;

long long Gatherer::SampleHemisphere(glm::vec3 point, const TangentFrame& frame,
  const HemisphereGrid& grid, std::uint32_t seed, std::vector<glm::vec3>& directions,
  std::vector<HemisphereSample>& samples) const
{
  grid.JitterDirections(seed, directions);
  std::vector<glm::vec3> inScene;
  inScene.reserve(directions.size());
  for (const glm::vec3& direction : directions)
  {
    inScene.push_back(frame.Axes * direction);
  }
  return this->Gather(point, frame.GetNormals(), inScene, samples);
}

}
