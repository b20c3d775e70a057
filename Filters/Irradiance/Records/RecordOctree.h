// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Octree with multiple references [IC]: records live in leaves, every leaf lists the spheres that
// touch it, a look-up walks down once.
#ifndef penumbra_RecordOctree_h
#define penumbra_RecordOctree_h

#include "RecordInterpolator.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

struct Scene;

class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT RecordOctree
{
public:
  /// A cube that holds most of what comes; records outside are found, only more slowly.
  void Initialize(glm::vec3 center, float halfSide);

  /// A cube as large as the scene.
  void InitializeFromScene(const Scene& scene);

  /// How much two normals may differ, in radians, below pi.
  void SetNormalAngle(float angle);
  float GetNormalAngle() const { return this->NormalAngle; }

  /// What the root of 1 - n.n_i is multiplied by for an angle (Record::Weight()).
  static float NormalFactorOf(float angle);

  void Insert(const Record& record);

  /// Keep a record's radius from reaching further than that of those in whose spheres it lies beyond their
  /// distance, and theirs from reaching further than its own [Krivanek et al., neighbour clamping], then
  /// insert it. None gets smaller than so many pixels of its own, which `Lean` is.
  void InsertClamped(Record record, float leastPixels);

  /// Blends the records that serve.
  InterpolationResult LookUp(const ShadingPoint& place) const;

  /// The greatest weight of any record at `place`, whether it serves or not.
  float MaximumWeightAt(const ShadingPoint& place) const;

  /// The record that was made exactly at `place`, or null.
  const Record* FindAt(const ShadingPoint& place) const;

  const std::vector<Record>& GetRecords() const { return this->Records; }
  std::size_t GetBytes() const;
  void Clear();

private:
  /// Names a record, and holds what tells most of them to be out of reach: records themselves lie
  /// scattered in memory.
  struct Reference
  {
    glm::vec3 Position;
    float SquaredRadius; ///< when it was inserted: neighbours may have made it smaller
    std::uint32_t Index;
  };
  struct Node
  {
    std::int32_t FirstChild = -1; ///< of eight; -1: a leaf
    std::vector<Reference> References;
  };

  void InsertInto(std::size_t node, glm::vec3 center, float half, const Reference& reference);
  void Split(std::size_t node, glm::vec3 center, float half);
  const Node& LeafAt(glm::vec3 position) const;

  /// Calls `work` with each record of whose sphere `position` lies inside.
  template <typename Work>
  void ForEachAround(glm::vec3 position, const Work& work) const;

  std::vector<Record> Records;
  std::vector<Node> Nodes{ Node() };
  glm::vec3 Center{ 0.f };
  float Half = 1.f;
  float NormalAngle = .1572f; ///< [IC]'s 9.0 degrees
  float NormalFactor = 9.0124f;
};

}
#endif
