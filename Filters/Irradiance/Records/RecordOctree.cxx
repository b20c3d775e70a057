// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RecordOctree.h"

#include "AxisAlignedBox.h"
#include "Gathering/IrradianceConstants.h"
#include "SceneBounds.h"
#include "Surface.h"

#include <algorithm>

namespace penumbra
{
namespace
{

/// Returns the index of the child around `center` that contains `position`, one bit per axis.
int FindOctant(glm::vec3 position, glm::vec3 center)
{
  return (position.x >= center.x ? 1 : 0) + (position.y >= center.y ? 2 : 0) +
    (position.z >= center.z ? 4 : 0);
}

glm::vec3 ComputeChildCenter(int octant, glm::vec3 center, float half)
{
  const float step = .5f * half;
  return center +
    glm::vec3(octant & 1 ? step : -step, octant & 2 ? step : -step, octant & 4 ? step : -step);
}

/// Returns true if the bounding box of the sphere overlaps the octant, which has no outer bounds.
bool OverlapsOctant(glm::vec3 position, float radius, int octant, glm::vec3 center)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const float d = position[axis] - center[axis];
    if (octant >> axis & 1 ? d + radius < 0.f : d - radius > 0.f)
    {
      return false;
    }
  }
  return true;
}

constexpr int PrefetchBatchSize = 32;

/// Prefetches a record, so that memory latency overlaps with the processing of others.
void Prefetch(const Record& record)
{
#ifdef __GNUC__
  constexpr std::size_t Line = 64;
  const char* bytes = reinterpret_cast<const char*>(&record);
  for (std::size_t at = 0; at < sizeof record; at += Line)
  {
    __builtin_prefetch(bytes + at);
  }
#endif
}

}

void RecordOctree::Initialize(glm::vec3 center, float halfSide)
{
  this->Clear();
  this->Half = RootGrowth * std::max(halfSide, 1e-30f);
  this->Center = center + RootShift * this->Half;
}

void RecordOctree::InitializeFromSurfaces(const std::vector<Surface>& surfaces)
{
  AxisAlignedBox box;
  for (const Surface& surface : surfaces)
  {
    if (surface.Instances)
    {
      box.Add(ComputeInstanceBounds(surface));
      continue;
    }
    for (std::size_t i = 0; i < surface.Positions.size(); ++i)
    {
      box.Add(surface.Positions[i] - surface.GetRadius(i));
      box.Add(surface.Positions[i] + surface.GetRadius(i));
    }
  }
  const glm::vec3 size = glm::max(box.High - box.Low, glm::vec3(0.f));
  this->Initialize(box.IsEmpty() ? glm::vec3(0.f) : .5f * (box.Low + box.High),
    .5f * std::max({ size.x, size.y, size.z }));
}

void RecordOctree::SetNormalAngle(float angle)
{
  this->NormalAngle = angle;
  this->NormalFactor = ComputeNormalFactor(angle);
}

float RecordOctree::ComputeNormalFactor(float angle)
{
  return 1.f / std::sqrt(1.f - std::cos(angle));
}

void RecordOctree::Clear()
{
  this->Records.clear();
  this->Nodes.assign(1, Node());
}

void RecordOctree::Insert(const Record& record)
{
  const auto index = static_cast<std::uint32_t>(this->Records.size());
  this->Records.push_back(record);
  this->InsertInto(0, this->Center, this->Half,
    Reference{ record.Position, record.Radius * record.Radius, index });
}

void RecordOctree::FindWithin(glm::vec3 center, float radius, std::size_t node,
  glm::vec3 cubeCenter, float half, std::vector<std::uint32_t>& found) const
{
  if (this->Nodes[node].FirstChild >= 0)
  {
    const auto children = static_cast<std::size_t>(this->Nodes[node].FirstChild);
    for (int octant = 0; octant < 8; ++octant)
    {
      if (OverlapsOctant(center, radius, octant, cubeCenter))
      {
        this->FindWithin(center, radius, children + octant,
          ComputeChildCenter(octant, cubeCenter, half), .5f * half, found);
      }
    }
    return;
  }
  for (const Reference& reference : this->Nodes[node].References)
  {
    const glm::vec3 d = reference.Position - center;
    if (glm::dot(d, d) < radius * radius)
    {
      found.push_back(reference.Index);
    }
  }
}

void RecordOctree::InsertClamped(Record record, float minimumPixels, bool clampReached)
{
  std::vector<Record*> neighbors;
  const auto isNeighbor = [&record](const Record& other) {
    return other.IsValid && glm::dot(other.Normal, record.Normal) > .5f;
  };
  this->ForEachAround(record.Position, [&](const Record& other) {
    if (isNeighbor(other))
    {
      neighbors.push_back(&this->Records[&other - this->Records.data()]);
    }
  });
  const auto clamp = [minimumPixels](Record& one, const Record& other) {
    const float distance = glm::distance(one.Position, other.Position);
    const float minimum = minimumPixels * one.MaximumPlaneDistance;
    one.Radius = std::min(one.Radius, std::max(other.Radius + distance, minimum));
  };
  for (const Record* other : neighbors)
  {
    clamp(record, *other);
  }
  if (clampReached)
  {
    std::vector<std::uint32_t> reached; // may contain a record several times
    this->FindWithin(record.Position, record.Radius, 0, this->Center, this->Half, reached);
    for (const std::uint32_t index : reached)
    {
      if (isNeighbor(this->Records[index]))
      {
        clamp(record, this->Records[index]);
      }
    }
  }
  for (Record* other : neighbors)
  {
    if (record.IsValid)
    {
      clamp(*other, record);
    }
  }
  this->Insert(record);
}

void RecordOctree::InsertInto(
  std::size_t node, glm::vec3 center, float half, const Reference& reference)
{
  if (this->Nodes[node].FirstChild >= 0)
  {
    const auto children = static_cast<std::size_t>(this->Nodes[node].FirstChild);
    const float radius = std::sqrt(reference.SquaredRadius);
    for (int octant = 0; octant < 8; ++octant)
    {
      if (OverlapsOctant(reference.Position, radius, octant, center))
      {
        this->InsertInto(
          children + octant, ComputeChildCenter(octant, center, half), .5f * half, reference);
      }
    }
    return;
  }
  this->Nodes[node].References.push_back(reference);
  if (this->Nodes[node].References.size() > MaximumReferences)
  {
    this->Split(node, center, half);
  }
}

void RecordOctree::Split(std::size_t node, glm::vec3 center, float half)
{
  float radii = 0.f;
  for (const Reference& reference : this->Nodes[node].References)
  {
    radii += std::sqrt(reference.SquaredRadius);
  }
  const auto count = static_cast<float>(this->Nodes[node].References.size());
  if (half * count < MinimumHalfSide * radii || half < MinimumNodeSize * this->Half)
  {
    return;
  }
  const std::vector<Reference> references = std::move(this->Nodes[node].References);
  this->Nodes[node].References.clear();
  const std::size_t children = this->Nodes.size();
  this->Nodes[node].FirstChild = static_cast<std::int32_t>(children);
  this->Nodes.resize(children + 8);
  for (const Reference& reference : references)
  {
    this->InsertInto(node, center, half, reference);
  }
}

template <typename Work>
void RecordOctree::ForEachAround(glm::vec3 position, const Work& work) const
{
  // Prefetch a batch of records before reading the first one.
  const Record* nearby[PrefetchBatchSize];
  int count = 0;
  for (const Reference& reference : this->LeafAt(position).References)
  {
    const glm::vec3 d = position - reference.Position;
    if (!(glm::dot(d, d) < reference.SquaredRadius))
    {
      continue;
    }
    if (count == PrefetchBatchSize)
    {
      std::for_each(nearby, nearby + count, [&](const Record* record) { work(*record); });
      count = 0;
    }
    const Record& record = this->Records[reference.Index];
    Prefetch(record);
    nearby[count++] = &record;
  }
  std::for_each(nearby, nearby + count, [&](const Record* record) { work(*record); });
}

const RecordOctree::Node& RecordOctree::LeafAt(glm::vec3 position) const
{
  std::size_t node = 0;
  glm::vec3 center = this->Center;
  float half = this->Half;
  while (this->Nodes[node].FirstChild >= 0)
  {
    const int octant = FindOctant(position, center);
    node = static_cast<std::size_t>(this->Nodes[node].FirstChild) + octant;
    center = ComputeChildCenter(octant, center, half);
    half *= .5f;
  }
  return this->Nodes[node];
}

InterpolationResult RecordOctree::LookUp(const ShadingPoint& point) const
{
  RecordInterpolator interpolator;
  float invalidWeight = 0.f;
  this->ForEachAround(point.Position, [&](const Record& record) {
    const float weight = record.Weight(point, this->NormalFactor);
    if (!record.IsValid)
    {
      invalidWeight = std::max(invalidWeight, weight);
    }
    else if (weight > 0.f)
    {
      interpolator.Add(record, point, weight);
    }
  });
  InterpolationResult result = interpolator.Result();
  if (result.MaximumWeight < invalidWeight)
  {
    result = InterpolationResult();
    result.IsInvalid = true;
  }
  return result;
}

float RecordOctree::MaximumWeightAt(const ShadingPoint& point) const
{
  float maximum = 0.f;
  this->ForEachAround(point.Position, [&](const Record& record) {
    maximum = std::max(maximum, record.Weight(point, this->NormalFactor));
  });
  return maximum;
}

const Record* RecordOctree::FindAt(const ShadingPoint& point) const
{
  const Record* found = nullptr;
  this->ForEachAround(point.Position, [&](const Record& record) {
    if (!found && record.Position == point.Position && record.Normal == point.Normal)
    {
      found = &record;
    }
  });
  return found;
}

std::size_t RecordOctree::GetBytes() const
{
  std::size_t bytes =
    this->Records.capacity() * sizeof(Record) + this->Nodes.capacity() * sizeof(Node);
  for (const Node& node : this->Nodes)
  {
    bytes += node.References.capacity() * sizeof(Reference);
  }
  return bytes;
}

}
