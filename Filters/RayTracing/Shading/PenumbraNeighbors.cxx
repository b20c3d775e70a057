// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PenumbraNeighbors.h"

#include "RayTracingConstants.h"

#include <cmath>

namespace penumbra
{

namespace
{

constexpr float FullTurn = 6.2831853f;

}

void PenumbraNeighbors::Add(const PenumbraArc& arc)
{
  this->Entries.push_back({ this->Position, arc });
}

void PenumbraNeighbors::BeginNextPass()
{
  const bool isComplex = this->Complex;
  *this = PenumbraNeighbors();
  this->Complex = isComplex;
}

bool PenumbraNeighbors::Predict(PenumbraArc& arc) const
{
  if (this->Entries.empty())
  {
    return false;
  }
  const auto count = static_cast<float>(this->Entries.size());
  const float origin = this->Entries.back().Arc.Axis;
  const auto values = [origin](const PenumbraArc& from) {
    return glm::vec3(std::remainder(from.Axis - origin, FullTurn), from.Distance, from.Curvature);
  };
  glm::vec2 center(0.f);
  glm::vec3 mean(0.f);
  for (const Entry& entry : this->Entries)
  {
    center += entry.Position / count;
    mean += values(entry.Arc) / count;
  }
  glm::mat2 moments(GradientRegularization);
  glm::vec3 alongX(0.f);
  glm::vec3 alongY(0.f);
  for (const Entry& entry : this->Entries)
  {
    const glm::vec2 offset = entry.Position - center;
    moments += glm::outerProduct(offset, offset);
    const glm::vec3 deviation = values(entry.Arc) - mean;
    alongX += offset.x * deviation;
    alongY += offset.y * deviation;
  }
  const glm::vec2 weights = glm::inverse(moments) * (this->Position - center);
  const glm::vec3 predicted = mean + weights.x * alongX + weights.y * alongY;
  arc = { origin + predicted.x, predicted.y, mean.z };
  return true;
}

}
