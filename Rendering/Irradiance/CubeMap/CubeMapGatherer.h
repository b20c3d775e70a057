// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Gathers by rasterising what a point sees into half a cube [IC], instead of tracing rays. Cells hold
// what their texels show by shares; what a surface means that fills part of a cell is asked at one place,
// of the gatherer by rays, which shades it.
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

/// Of all cube maps.
struct CubeMapCounts
{
  std::atomic<long long> Pictures{ 0 };
  std::atomic<long long> Triangles{ 0 };
};

class CubeMapGatherer : public Gatherer
{
public:
  /// `side`: of a cube's face in texels, even. Throws std::runtime_error without OpenGL, or when the
  /// scene has too many triangles. `seen` must outlive this object.
  CubeMapGatherer(const RayGatherer& seen, int side, std::shared_ptr<CubeMapCounts> counts);

  void SampleEmitters(glm::vec3 point, std::vector<EmitterSample>& beams) const override;

  /// Single directions are looked at by rays.
  long long Gather(glm::vec3 point, glm::vec3 normal, const std::vector<glm::vec3>& directions,
    std::vector<HemisphereSample>& sights) const override;

  long long SampleHemisphere(glm::vec3 point, const glm::mat3& frame, const HemisphereGrid& grid,
    std::uint32_t seed, std::vector<glm::vec3>& directions,
    std::vector<HemisphereSample>& sights) const override;
  bool SamplesGridAtOnce() const override { return true; }
  DistanceFalloff GetFalloff() const override { return this->Seen.GetFalloff(); }

private:
  const Hemicube::Cells& CellsOf(const HemisphereGrid& grid) const;

  const RayGatherer& Seen;
  Hemicube Cube;
  TriangleClusters Bundles;
  std::unique_ptr<HemicubeRenderer> Picture;
  std::shared_ptr<CubeMapCounts> Counts;
  mutable std::mutex Mutex;
  mutable std::map<int, Hemicube::Cells> Cells; ///< by the side of the grid, guarded by Mutex
};

}
#endif
