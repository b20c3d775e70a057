// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Light tree: samples directions from a point toward emissive triangles and spheres. Emitters are
// selected by power over squared distance (Conty Estevez and Kulla, Importance Sampling of Many
// Lights with Adaptive Tree Splitting, 2018, without their bounds of orientation), triangles are
// sampled by area, spheres by the solid angle of their cone.
#ifndef penumbra_EmitterTree_h
#define penumbra_EmitterTree_h

#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro, which tests need

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace penumbra
{

/// An emissive triangle or sphere.
struct Emitter
{
  std::array<glm::vec3, 3> Corners; ///< of a sphere: its center in all three
  float Radius = 0.f;               ///< 0: a triangle
  float Strength = 0.f;             ///< largest channel of its radiance; emits from both sides
  glm::vec3 Color{ 1.f };           ///< its radiance, relative to Strength
  std::uint32_t Surface = 0;        ///< index into Scene::Surfaces
  std::uint32_t Primitive = 0;
  float Extent = 0.f; ///< largest coordinate of the corners, set by EmitterTree

  /// Returns the area, of a triangle that of one side.
  float ComputeArea() const;
};

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT EmitterTree
{
public:
  EmitterTree() = default;
  /// Emitters without area or strength are never sampled.
  explicit EmitterTree(std::vector<Emitter> emitters);

  bool IsEmpty() const { return this->Nodes.empty(); }
  /// Returns true if the only emitter is a sphere.
  bool IsSphere() const { return this->Nodes.size() == 1 && this->Emitters[0].Radius > 0.f; }

  /// Direction toward a point of an emitter.
  struct Sample
  {
    const Emitter* Target = nullptr;
    glm::vec3 Direction{ 0.f }; ///< unit vector
    float Distance = 0.f;
    float Density = 0.f; ///< probability per solid angle of a direction toward this emitter
    /// Distance, a little shorter, up to which a ray does not hit the triangle itself, despite rounding; 0 if that is
    /// uncertain: of spheres, at grazing angles, and far from the emitter.
    float ClearDistance = 0.f;
  };

  /// Maps `u` in [0, 1)^2 to a direction from `point` into the hemisphere about `normal` (unit).
  /// Returns a density of 0 if no emitter can be sampled from there, or if the direction is below
  /// the hemisphere.
  Sample SampleDirection(glm::vec3 point, glm::vec3 normal, glm::vec2 u) const;

  /// Returns the density with which SampleDirection() returns the unit vector `direction` for the
  /// emitter of a primitive that a ray hits at `distance`. Returns 0 if the primitive is not an
  /// emitter of the tree.
  float ComputeDensity(glm::vec3 point, glm::vec3 normal, glm::vec3 direction, float distance,
    std::uint32_t surface, std::uint32_t primitive) const;

private:
  struct Node
  {
    glm::vec3 Center{ 0.f }; ///< of the bounding box
    float Radius = 0.f;      ///< half the diagonal of the bounding box
    float Power = 0.f;       ///< sum of radiance times area
    std::uint32_t Parent = 0;
    std::uint32_t Second = 0;       ///< index of the second child; the first follows the node
    std::uint32_t EmitterIndex = 0; ///< of a leaf
    int Coordinate = 0;             ///< of a sample, chooses the child
    bool IsParallelogram = false;   ///< its children are the halves of one
    bool DividesColors = false;     ///< the emitters of its children differ in color
    bool IsLeaf() const { return this->Second == 0; }
  };

  std::uint32_t Build(std::size_t begin, std::size_t end, std::uint32_t parent, bool dividesColors);
  std::size_t SplitByColor(std::size_t begin, std::size_t end);
  std::size_t SplitByPlace(std::size_t begin, std::size_t end, int axis);
  static float ComputeImportance(const Node& node, glm::vec3 point, glm::vec3 normal);
  /// Returns the probability of the first child of an inner node; negative if it has no importance.
  float ComputeFirstProbability(std::uint32_t node, glm::vec3 point, glm::vec3 normal) const;

  std::vector<Emitter> Emitters;
  int MainAxis = 0;                  ///< of the first split
  std::vector<Node> Nodes;           ///< depth first
  std::vector<std::uint32_t> Leaves; ///< node of each emitter
  /// Index of the emitter of each primitive, by surface; empty for surfaces that do not emit.
  std::vector<std::vector<std::uint32_t>> Index;
};

}
#endif
