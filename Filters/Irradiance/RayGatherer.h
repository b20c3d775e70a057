// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Gathers by rays over Embree.
#ifndef penumbra_RayGatherer_h
#define penumbra_RayGatherer_h

#include "Gatherer.h"
#include "vtkPenumbraFiltersIrradianceModule.h" // for export macro, which tests need

namespace penumbra
{

class RayScene;

/// Occlusion: radiance is 1 where something lies within reach, 0 elsewhere. Lines and points do not
/// block.
class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT OcclusionGatherer : public Gatherer
{
public:
  /// `scene` must outlive this object; `reach` in scene units.
  OcclusionGatherer(const RayScene& scene, float reach);

  void Gather(glm::vec3 point, glm::vec3 normal, const std::vector<glm::vec3>& directions,
    std::vector<Sight>& sights) const override;
  float GetReach() const override { return this->Reach; }

private:
  const RayScene& Rays;
  float Reach;
};

}
#endif
