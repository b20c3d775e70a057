// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Octree with multiple references [IC]: every leaf lists all records whose spheres overlap it, so
// that a lookup visits a single leaf.
#ifndef penumbra_RecordOctree_h
#define penumbra_RecordOctree_h

#include "RecordInterpolator.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

struct Surface;

class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT RecordOctree
{
public:
  /// Clears the octree and sets its root cube. Records outside of the cube are found, but more
  /// slowly.
  void Initialize(glm::vec3 center, float halfSide);

  /// Clears the octree and sets its root cube to the bounds of the scene.
  void InitializeFromSurfaces(const std::vector<Surface>& surfaces);

  /// Sets the maximum angle between two normals in radians, in (0, pi).
  void SetNormalAngle(float angle);
  float GetNormalAngle() const { return this->NormalAngle; }

  /// Returns the `normalFactor` of Record::Weight() for a maximum angle between normals in radians.
  static float ComputeNormalFactor(float angle);

  void Insert(const Record& record);

  /// Inserts a record with neighbor clamping [Krivanek et al.]: among the records whose spheres
  /// contain it, no radius exceeds another by more than the distance of the two. If `clampReached`
  /// is true, the records within its own sphere limit its radius, too. Radii are not reduced below
  /// `minimumPixels` times MaximumPlaneDistance, the size of a pixel at the record.
  void InsertClamped(Record record, float minimumPixels, bool clampReached = false);

  /// Interpolates between the valid records around `point`. Finds nothing if an invalid record has
  /// the largest weight: the mean changes too fast there.
  InterpolationResult LookUp(const ShadingPoint& point) const;

  /// Returns the maximum weight of a record at `point`, including invalid records.
  float MaximumWeightAt(const ShadingPoint& point) const;

  /// Returns the record at exactly `point`, or null.
  const Record* FindAt(const ShadingPoint& point) const;

  const std::vector<Record>& GetRecords() const { return this->Records; }
  std::size_t GetBytes() const;
  void Clear();

private:
  /// Reference to a record with a copy of its sphere, which rejects most records without a memory
  /// access.
  struct Reference
  {
    glm::vec3 Position;
    float SquaredRadius; ///< at insertion; neighbor clamping may have reduced the radius since
    std::uint32_t Index;
  };
  struct Node
  {
    std::int32_t FirstChild = -1; ///< first of eight consecutive children; -1 for a leaf
    std::vector<Reference> References;
  };

  void InsertInto(std::size_t node, glm::vec3 center, float half, const Reference& reference);
  void Split(std::size_t node, glm::vec3 center, float half);
  const Node& LeafAt(glm::vec3 position) const;

  /// Appends the records whose positions are within `radius` of `center` and in the node of the cube
  /// around `cubeCenter`.
  void FindWithin(glm::vec3 center, float radius, std::size_t node, glm::vec3 cubeCenter,
    float half, std::vector<std::uint32_t>& found) const;

  /// Calls `work` with each record whose sphere contains `position`.
  template <typename Work>
  void ForEachAround(glm::vec3 position, const Work& work) const;

  std::vector<Record> Records;
  std::vector<Node> Nodes{ Node() };
  glm::vec3 Center{ 0.f };
  float Half = 1.f;
  float NormalAngle = .1572f; ///< radians; the 9.0 degrees of [IC]
  float NormalFactor = 9.0124f;
};

}
#endif
