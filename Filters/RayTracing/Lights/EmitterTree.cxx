// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EmitterTree.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{
namespace
{

constexpr float Pi = glm::pi<float>();
constexpr std::uint32_t NoEmitter = std::numeric_limits<std::uint32_t>::max();
constexpr float BelowOne = 0x1.fffffep-1f;

/// Largest distance of a corner of a parallelogram from where the others lead to expect it, relative to its diagonal.
constexpr float ParallelogramTolerance = 1e-5f;

/// Number of different colors of emitters up to which samples are stratified by them.
constexpr std::size_t MaximumColors = 3;
/// Difference of a channel up to which emitters have one color.
constexpr float ColorTolerance = 1.f / 16.f;
/// Probabilities of colors are multiples of 1 / FirstEmitterRays, and none is 0 above the horizon. Each eighth of a
/// coordinate has one of the first eight samples: of two colors, both have their part of these.
constexpr float ColorProbabilities = 8.f;

/// Rounding errors of a ray toward a sampled point, along the ray, relative to coordinates and distance, at up to a
/// cosine to the triangle. Single precision has 6e-8: the plane is met up to 20 times that beside the point. The
/// sum is below CoincidentSurfaces::DepthTolerance(), 6.1e-5 of the coordinates, up to the largest distance.
constexpr float ClearMargin = 1e-5f;
constexpr float MinimumClearCosine = 0.125f;
constexpr float MaximumClearDistance = 4.f;

bool HaveOneColor(glm::vec3 a, glm::vec3 b)
{
  return glm::all(glm::lessThanEqual(glm::abs(a - b), glm::vec3(ColorTolerance)));
}

bool HasFewColors(const std::vector<Emitter>& emitters)
{
  std::vector<glm::vec3> colors;
  for (const Emitter& emitter : emitters)
  {
    const bool isKnown = std::any_of(colors.begin(), colors.end(),
      [&emitter](glm::vec3 color) { return HaveOneColor(emitter.Color, color); });
    if (!isKnown)
    {
      colors.push_back(emitter.Color);
    }
    if (colors.size() > MaximumColors)
    {
      return false;
    }
  }
  return true;
}

/// Returns the probability per solid angle of a point that is uniform on a triangle.
float TriangleDensity(const Emitter& emitter, glm::vec3 direction, float distance)
{
  const glm::vec3 normal =
    glm::cross(emitter.Corners[1] - emitter.Corners[0], emitter.Corners[2] - emitter.Corners[0]);
  const float projected = .5f * std::abs(glm::dot(normal, direction));
  return projected > 0.f ? distance * distance / projected : 0.f;
}

/// Returns Sample::ClearDistance of a point on a triangle.
float ComputeClearDistance(const Emitter& emitter, glm::vec3 direction, float distance)
{
  const glm::vec3 normal =
    glm::cross(emitter.Corners[1] - emitter.Corners[0], emitter.Corners[2] - emitter.Corners[0]);
  const float along = glm::dot(normal, direction);
  constexpr float SquaredCosine = MinimumClearCosine * MinimumClearCosine;
  const bool isClear = along * along >= SquaredCosine * glm::dot(normal, normal) &&
    distance <= MaximumClearDistance * emitter.Extent;
  return isClear ? std::max(distance - ClearMargin * (distance + emitter.Extent), 0.f) : 0.f;
}

/// Returns 1 minus the cosine of half the angle of the cone of a sphere; 0 from inside.
float ConeHeight(const Emitter& emitter, glm::vec3 point)
{
  const glm::vec3 to = emitter.Corners[0] - point;
  const float sine2 = emitter.Radius * emitter.Radius / glm::dot(to, to);
  return sine2 < 1.f ? sine2 / (1.f + std::sqrt(1.f - sine2)) : 0.f;
}

glm::vec3 SampleTriangle(const Emitter& emitter, glm::vec2 u)
{
  const float root = std::sqrt(u.x);
  return (1.f - root) * emitter.Corners[0] + root * (1.f - u.y) * emitter.Corners[1] +
    root * u.y * emitter.Corners[2];
}

/// Returns true if two triangles are the halves of a parallelogram. Reorders their corners: the first one of
/// each is not common, the others have opposite orders.
bool FormParallelogram(Emitter& first, Emitter& second)
{
  const auto rotate = [](Emitter& emitter) {
    std::rotate(emitter.Corners.begin(), emitter.Corners.begin() + 1, emitter.Corners.end());
  };
  for (int i = 0; i < 9 && first.Radius == 0.f && second.Radius == 0.f; ++i)
  {
    if (first.Corners[1] == second.Corners[1] && first.Corners[2] == second.Corners[2])
    {
      std::swap(second.Corners[1], second.Corners[2]);
    }
    if (first.Corners[1] == second.Corners[2] && first.Corners[2] == second.Corners[1])
    {
      const glm::vec3 gap =
        first.Corners[0] + second.Corners[0] - first.Corners[1] - first.Corners[2];
      return glm::length(gap) <=
        ParallelogramTolerance * glm::length(first.Corners[1] - first.Corners[2]);
    }
    rotate(second);
    if (i % 3 == 2)
    {
      rotate(first);
    }
  }
  return false;
}

/// Returns the point of a half of a parallelogram at coordinates with a sum of at most 1.
glm::vec3 SampleParallelogram(const Emitter& emitter, glm::vec2 u)
{
  return emitter.Corners[0] + u.x * (emitter.Corners[1] - emitter.Corners[0]) +
    u.y * (emitter.Corners[2] - emitter.Corners[0]);
}

/// Returns a direction in the cone of a sphere, of which 1 - cosine is `height`.
glm::vec3 SampleCone(glm::vec3 axis, float height, glm::vec2 u)
{
  const float below = u.x * height;
  const float sine = std::sqrt(below * (2.f - below));
  const glm::vec3 other =
    std::abs(axis.x) < .5f ? glm::vec3(1.f, 0.f, 0.f) : glm::vec3(0.f, 1.f, 0.f);
  const glm::vec3 tangent = glm::normalize(glm::cross(axis, other));
  const float angle = 2.f * Pi * u.y;
  return glm::normalize((1.f - below) * axis +
    sine * (std::cos(angle) * tangent + std::sin(angle) * glm::cross(axis, tangent)));
}

}

float Emitter::ComputeArea() const
{
  return this->Radius > 0.f ? 4.f * Pi * this->Radius * this->Radius
                            : .5f *
      glm::length(
        glm::cross(this->Corners[1] - this->Corners[0], this->Corners[2] - this->Corners[0]));
}

EmitterTree::EmitterTree(std::vector<Emitter> emitters)
  : Emitters(std::move(emitters))
{
  const auto end =
    std::remove_if(this->Emitters.begin(), this->Emitters.end(), [](const Emitter& emitter) {
      const float power = emitter.Strength * emitter.ComputeArea();
      return !(power > 0.f && power <= std::numeric_limits<float>::max());
    });
  this->Emitters.erase(end, this->Emitters.end());
  if (this->Emitters.empty())
  {
    return;
  }
  this->Nodes.reserve(2 * this->Emitters.size());
  this->Leaves.resize(this->Emitters.size());
  this->Build(0, this->Emitters.size(), 0, HasFewColors(this->Emitters));
  for (std::uint32_t i = 0; i < this->Emitters.size(); ++i)
  {
    Emitter& emitter = this->Emitters[i];
    for (const glm::vec3 corner : emitter.Corners)
    {
      emitter.Extent =
        std::max({ emitter.Extent, std::abs(corner.x), std::abs(corner.y), std::abs(corner.z) });
    }
    if (this->Index.size() <= emitter.Surface)
    {
      this->Index.resize(emitter.Surface + std::size_t(1));
    }
    std::vector<std::uint32_t>& primitives = this->Index[emitter.Surface];
    if (primitives.size() <= emitter.Primitive)
    {
      primitives.resize(emitter.Primitive + std::size_t(1), NoEmitter);
    }
    primitives[emitter.Primitive] = i;
  }
}

// Moves the emitters with the color of the first one to the front. Returns the end of these.
std::size_t EmitterTree::SplitByColor(std::size_t begin, std::size_t end)
{
  const auto first = this->Emitters.begin();
  const glm::vec3 color =
    this->Emitters[begin].Color; // that of its emitter also if it is not a number
  const auto middle = std::stable_partition(first + static_cast<std::ptrdiff_t>(begin) + 1,
    first + static_cast<std::ptrdiff_t>(end),
    [color](const Emitter& emitter) { return HaveOneColor(emitter.Color, color); });
  return static_cast<std::size_t>(middle - first);
}

// Splits at the median along an axis. Returns the beginning of the second half.
std::size_t EmitterTree::SplitByPlace(std::size_t begin, std::size_t end, int axis)
{
  const auto key = [axis](const Emitter& emitter) {
    return std::make_pair(
      emitter.Corners[0][axis] + emitter.Corners[1][axis] + emitter.Corners[2][axis],
      std::make_pair(emitter.Surface, emitter.Primitive));
  };
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [this](std::size_t i) {
    return this->Emitters.begin() + static_cast<std::ptrdiff_t>(i);
  };
  std::nth_element(at(begin), at(middle), at(end),
    [&key](const Emitter& a, const Emitter& b) { return key(a) < key(b); });
  return middle;
}

// Splits by colors, if there are few, then at the median of the longest axis of the bounds. One coordinate of the
// sample chooses along the longest axis of all emitters, the other one along the others: neighboring emitters are as
// stratified as one of their whole area.
std::uint32_t EmitterTree::Build(
  std::size_t begin, std::size_t end, std::uint32_t parent, bool dividesColors)
{
  const auto index = static_cast<std::uint32_t>(this->Nodes.size());
  this->Nodes.emplace_back();
  glm::vec3 low(std::numeric_limits<float>::max());
  glm::vec3 high(-std::numeric_limits<float>::max());
  Node node;
  node.Parent = parent;
  for (std::size_t i = begin; i < end; ++i)
  {
    const Emitter& emitter = this->Emitters[i];
    for (const glm::vec3 corner : emitter.Corners)
    {
      low = glm::min(low, corner - emitter.Radius);
      high = glm::max(high, corner + emitter.Radius);
    }
  }
  node.Center = .5f * (low + high);
  node.Radius = .5f * glm::length(high - low);
  if (end - begin == 1)
  {
    node.EmitterIndex = static_cast<std::uint32_t>(begin);
    node.Power = this->Emitters[begin].Strength * this->Emitters[begin].ComputeArea();
    this->Leaves[begin] = index;
  }
  else
  {
    const glm::vec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    this->MainAxis = index == 0 ? axis : this->MainAxis;
    node.Coordinate = axis == this->MainAxis ? 0 : 1;
    const std::size_t sameColor = dividesColors ? this->SplitByColor(begin, end) : end;
    node.DividesColors = sameColor < end;
    const std::size_t middle =
      node.DividesColors ? sameColor : this->SplitByPlace(begin, end, axis);
    const std::uint32_t first = this->Build(begin, middle, index, false);
    node.Second = this->Build(middle, end, index, node.DividesColors);
    node.Power = this->Nodes[first].Power + this->Nodes[node.Second].Power;
    node.IsParallelogram = end - begin == 2 && !node.DividesColors &&
      this->Emitters[begin].Strength == this->Emitters[begin + 1].Strength &&
      FormParallelogram(this->Emitters[begin], this->Emitters[begin + 1]);
  }
  this->Nodes[index] = node;
  return index;
}

float EmitterTree::ComputeImportance(const Node& node, glm::vec3 point, glm::vec3 normal)
{
  const glm::vec3 to = node.Center - point;
  if (glm::dot(to, normal) + node.Radius <= 0.f)
  {
    return 0.f; // below the hemisphere
  }
  return node.Power / std::max(glm::dot(to, to), node.Radius * node.Radius);
}

float EmitterTree::ComputeFirstProbability(
  std::uint32_t node, glm::vec3 point, glm::vec3 normal) const
{
  if (this->Nodes[node].IsParallelogram)
  {
    return .5f;
  }
  const float first = ComputeImportance(this->Nodes[node + 1], point, normal);
  const float second = ComputeImportance(this->Nodes[this->Nodes[node].Second], point, normal);
  if (!(first + second > 0.f))
  {
    return -1.f;
  }
  const float probability = first / (first + second);
  return this->Nodes[node].DividesColors && first > 0.f && second > 0.f
    ? glm::clamp(std::round(ColorProbabilities * probability), 1.f, ColorProbabilities - 1.f) /
      ColorProbabilities
    : probability;
}

EmitterTree::Sample EmitterTree::SampleDirection(
  glm::vec3 point, glm::vec3 normal, glm::vec2 u) const
{
  Sample sample;
  if (this->IsEmpty())
  {
    return sample;
  }
  std::uint32_t node = 0;
  float probability = 1.f;
  bool isInParallelogram = false;
  while (!this->Nodes[node].IsLeaf())
  {
    const float first = this->ComputeFirstProbability(node, point, normal);
    if (first < 0.f)
    {
      return sample;
    }
    if (this->Nodes[node].IsParallelogram)
    {
      // The first half has the corner (0, 0), the second one the opposite corner.
      probability *= .5f;
      node = node + 1;
      if (u.x + u.y > 1.f)
      {
        u = 1.f - u;
        node = node + 1;
      }
      isInParallelogram = true;
      break;
    }
    float& coordinate = u[this->Nodes[node].Coordinate];
    const bool isFirst = coordinate < first;
    coordinate =
      std::min(isFirst ? coordinate / first : (coordinate - first) / (1.f - first), BelowOne);
    probability *= isFirst ? first : 1.f - first;
    node = isFirst ? node + 1 : this->Nodes[node].Second;
  }
  const Emitter& emitter = this->Emitters[this->Nodes[node].EmitterIndex];
  float density = 0.f;
  if (emitter.Radius > 0.f)
  {
    const float height = ConeHeight(emitter, point);
    const glm::vec3 to = emitter.Corners[0] - point;
    if (height > 0.f)
    {
      sample.Direction = SampleCone(glm::normalize(to), height, u);
      const float along = glm::dot(to, sample.Direction);
      const float chord2 = emitter.Radius * emitter.Radius - (glm::dot(to, to) - along * along);
      sample.Distance = along - std::sqrt(std::max(chord2, 0.f));
      density = 1.f / (2.f * Pi * height);
    }
  }
  else
  {
    const glm::vec3 to =
      (isInParallelogram ? SampleParallelogram(emitter, u) : SampleTriangle(emitter, u)) - point;
    sample.Distance = glm::length(to);
    if (sample.Distance > 0.f)
    {
      sample.Direction = to / sample.Distance;
      density = TriangleDensity(emitter, sample.Direction, sample.Distance);
      sample.ClearDistance = ComputeClearDistance(emitter, sample.Direction, sample.Distance);
    }
  }
  if (density > 0.f && glm::dot(sample.Direction, normal) > 0.f)
  {
    sample.Target = &emitter;
    sample.Density = probability * density;
  }
  return sample;
}

float EmitterTree::ComputeDensity(glm::vec3 point, glm::vec3 normal, glm::vec3 direction,
  float distance, std::uint32_t surface, std::uint32_t primitive) const
{
  if (surface >= this->Index.size() || primitive >= this->Index[surface].size() ||
    this->Index[surface][primitive] == NoEmitter)
  {
    return 0.f;
  }
  const std::uint32_t index = this->Index[surface][primitive];
  const Emitter& emitter = this->Emitters[index];
  float density = 0.f;
  if (emitter.Radius > 0.f)
  {
    const float height = ConeHeight(emitter, point);
    density = height > 0.f ? 1.f / (2.f * Pi * height) : 0.f;
  }
  else
  {
    density = TriangleDensity(emitter, direction, distance);
  }
  for (std::uint32_t node = this->Leaves[index]; node != 0 && density > 0.f;)
  {
    const std::uint32_t parent = this->Nodes[node].Parent;
    const float first = this->ComputeFirstProbability(parent, point, normal);
    density *= first < 0.f ? 0.f : node == parent + 1 ? first : 1.f - first;
    node = parent;
  }
  return density;
}

}
