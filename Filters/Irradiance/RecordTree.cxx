// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RecordTree.h"

namespace penumbra
{
namespace
{

/// A leaf with more is split, unless its records are larger than itself.
constexpr std::size_t ReferencesOfALeaf = 12;

/// Which of a node's eight children around `center` holds `position`: one bit an axis.
int Octant(glm::vec3 position, glm::vec3 center)
{
  return (position.x >= center.x ? 1 : 0) + (position.y >= center.y ? 2 : 0) +
    (position.z >= center.z ? 4 : 0);
}

glm::vec3 CenterOf(int octant, glm::vec3 center, float half)
{
  const float step = .5f * half;
  return center +
    glm::vec3(octant & 1 ? step : -step, octant & 2 ? step : -step, octant & 4 ? step : -step);
}

/// Does the sphere's box reach into the octant? The outermost octants have no outer ends.
bool Reaches(const Record& record, int octant, glm::vec3 center)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const float d = record.Position[axis] - center[axis];
    if (octant >> axis & 1 ? d + record.Radius < 0.f : d - record.Radius > 0.f)
    {
      return false;
    }
  }
  return true;
}

/// |second derivative| times this and the square of the distance is what a record is believed to
/// err: half of it along the line of the greatest bend, less along others.
constexpr float BendShare = .25f;

}

void RecordTree::Initialize(glm::vec3 center, float halfSide)
{
  this->Clear();
  this->Center = center;
  this->Half = std::max(halfSide, 1e-30f);
}

void RecordTree::SetNormalAngle(float angle)
{
  this->NormalFactor = 1.f / std::sqrt(1.f - std::cos(angle));
}

void RecordTree::Clear()
{
  this->Records.clear();
  this->Nodes.assign(1, Node());
}

void RecordTree::Insert(const Record& record)
{
  this->Records.push_back(record);
  this->Add(static_cast<std::uint32_t>(this->Records.size() - 1));
}

void RecordTree::InsertClamped(Record record, float least)
{
  for (const std::uint32_t index : this->LeafAt(record.Position).References)
  {
    Record& other = this->Records[index];
    const float distance = glm::distance(other.Position, record.Position);
    if (other.Serves && distance < other.Radius && glm::dot(other.Normal, record.Normal) > .5f)
    {
      record.Radius = std::min(record.Radius, std::max(other.Radius + distance, least));
    }
  }
  this->Insert(record);
}

void RecordTree::Add(std::uint32_t record)
{
  this->AddBelow(0, this->Center, this->Half, record);
}

void RecordTree::AddBelow(std::size_t node, glm::vec3 center, float half, std::uint32_t record)
{
  if (this->Nodes[node].FirstChild >= 0)
  {
    const auto children = static_cast<std::size_t>(this->Nodes[node].FirstChild);
    for (int octant = 0; octant < 8; ++octant)
    {
      if (Reaches(this->Records[record], octant, center))
      {
        this->AddBelow(children + octant, CenterOf(octant, center, half), .5f * half, record);
      }
    }
    return;
  }
  this->Nodes[node].References.push_back(record);
  if (this->Nodes[node].References.size() > ReferencesOfALeaf)
  {
    this->Split(node, center, half);
  }
}

void RecordTree::Split(std::size_t node, glm::vec3 center, float half)
{
  float radii = 0.f;
  for (const std::uint32_t index : this->Nodes[node].References)
  {
    radii += this->Records[index].Radius;
  }
  if (half * static_cast<float>(this->Nodes[node].References.size()) < radii)
  {
    return;
  }
  const std::vector<std::uint32_t> references = std::move(this->Nodes[node].References);
  this->Nodes[node].References.clear();
  const std::size_t children = this->Nodes.size();
  this->Nodes[node].FirstChild = static_cast<std::int32_t>(children);
  this->Nodes.resize(children + 8);
  for (const std::uint32_t index : references)
  {
    this->AddBelow(node, center, half, index);
  }
}

const RecordTree::Node& RecordTree::LeafAt(glm::vec3 position) const
{
  std::size_t node = 0;
  glm::vec3 center = this->Center;
  float half = this->Half;
  while (this->Nodes[node].FirstChild >= 0)
  {
    const int octant = Octant(position, center);
    node = static_cast<std::size_t>(this->Nodes[node].FirstChild) + octant;
    center = CenterOf(octant, center, half);
    half *= .5f;
  }
  return this->Nodes[node];
}

Interpolated RecordTree::LookUp(const Place& place) const
{
  Interpolated result;
  float weights = 0.f;
  float noise = 0.f;
  float bias = 0.f;
  for (const std::uint32_t index : this->LeafAt(place.Position).References)
  {
    const Record& record = this->Records[index];
    const float weight = record.Serves ? record.Weight(place, this->NormalFactor) : 0.f;
    if (weight > 0.f)
    {
      const glm::vec3 d = place.Position - record.Position;
      weights += weight;
      result.Mean += weight * record.Expect(place);
      noise += weight * weight * record.Found.Error * record.Found.Error;
      bias += weight * BendShare * record.Found.Bend * glm::dot(d, d);
      result.Greatest = std::max(result.Greatest, weight);
    }
  }
  if (weights > 0.f)
  {
    result.Mean /= weights;
    bias /= weights;
    result.Error = std::sqrt(noise / (weights * weights) + bias * bias);
  }
  return result;
}

float RecordTree::Cover(const Place& place) const
{
  float greatest = 0.f;
  for (const std::uint32_t index : this->LeafAt(place.Position).References)
  {
    greatest = std::max(greatest, this->Records[index].Weight(place, this->NormalFactor));
  }
  return greatest;
}

const Record* RecordTree::FindAt(const Place& place) const
{
  for (const std::uint32_t index : this->LeafAt(place.Position).References)
  {
    const Record& record = this->Records[index];
    if (record.Position == place.Position && record.Normal == place.Normal)
    {
      return &record;
    }
  }
  return nullptr;
}

std::size_t RecordTree::GetBytes() const
{
  std::size_t bytes =
    this->Records.capacity() * sizeof(Record) + this->Nodes.capacity() * sizeof(Node);
  for (const Node& node : this->Nodes)
  {
    bytes += node.References.capacity() * sizeof(std::uint32_t);
  }
  return bytes;
}

}
