// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Gathers by rasterizing the scene into a hemicube around a point [IC], instead of tracing rays.
// Each grid cell averages the surfaces in its texels by their weights. Each surface in a cell is
// shaded once, at one texel, by the gatherer that traces rays.
#ifndef penumbra_CubeMapGatherer_h
#define penumbra_CubeMapGatherer_h

#include "Gathering/RayGatherer.h"
#include "HemicubeRenderer.h"

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace penumbra
{

/// Counts over all cube maps of a gatherer.
struct CubeMapCounts
{
  std::atomic<long long> CubeMaps{ 0 };
  std::atomic<long long> Triangles{ 0 };
};

class CubeMapGatherer : public Gatherer
{
public:
  /// `rays` shades the hits and must outlive this object. `side`: width of a cube face in texels,
  /// even. Throws std::runtime_error if OpenGL is not available or if the scene has too many
  /// triangles.
  CubeMapGatherer(const RayGatherer& rays, int side, std::shared_ptr<CubeMapCounts> counts);

  void SampleEmitters(glm::vec3 point, std::vector<EmitterSample>& emitters) const override;

  /// Traces rays in the given directions.
  long long Gather(glm::vec3 point, const SurfaceNormals& normals,
    const std::vector<glm::vec3>& directions,
    std::vector<HemisphereSample>& samples) const override;

  long long SampleHemisphere(glm::vec3 point, const TangentFrame& frame, const HemisphereGrid& grid,
    std::uint32_t seed, std::vector<glm::vec3>& directions,
    std::vector<HemisphereSample>& samples) const override;
  bool SamplesGridAtOnce() const override { return true; }
  DistanceFalloff GetFalloff() const override { return this->Rays.GetFalloff(); }

private:
  const Hemicube::Cells& FindCells(const HemisphereGrid& grid) const;

  const RayGatherer& Rays;
  Hemicube Cube;
  TriangleClusters Clusters;
  std::unique_ptr<HemicubeRenderer> Renderer;
  std::shared_ptr<CubeMapCounts> Counts;
  mutable std::mutex Mutex;
  mutable std::map<int, Hemicube::Cells> Cells; ///< by the side of the grid, guarded by Mutex
};

}
#endif
