// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the ray caster asks of the other ranks of a parallel program, each of which has a part of the
// scene and renders a part of the image. Filters/Parallel implements it. All functions are collective:
// every rank calls them in the same order.
#ifndef penumbra_SceneDistribution_h
#define penumbra_SceneDistribution_h

#include "Execution/RankAgreement.h"
#include "Image/ImageRenderer.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkImageData;

namespace penumbra
{

struct Scene;

class SceneDistribution
{
public:
  /// Rays that a part of the image needs in addition to camera rays.
  enum class LightRays
  {
    None,
    ToLights, ///< from visible points to lights without a size
    All
  };

  virtual ~SceneDistribution() = default;

  /// Returns what the ranks find out together for any purpose.
  virtual RankAgreement& GetRanks() = 0;

  /// Enlarges the bounds and the radius to those of all ranks, see ExtractionOptions::UniteExtent.
  virtual void UniteExtent(double bounds[6], double& radius) = 0;

  /// Replaces the surfaces of this rank by those that its part of the image needs, for camera rays and
  /// for `lightRays`. The scenes of all ranks have the same surfaces, parts of them (Surface::Whole).
  virtual void Exchange(Scene& scene, LightRays lightRays) = 0;

  /// Returns the parts of the image that this rank renders. Those of all ranks divide the image.
  virtual const std::vector<RegionBounds>& GetRegions() const = 0;

  /// Gathers the parts of the image on the first rank, where `image` has the whole extent afterwards,
  /// and sets `totals` to the sums of all ranks.
  virtual void Compose(const std::vector<vtkSmartPointer<vtkImageData>>& parts, vtkImageData* image,
    ImageTotals& totals) = 0;

  /// Sends each rank the part of the first rank's `image`, with its field data, that `extent` requests.
  virtual void Deliver(const int extent[6], vtkImageData* image) = 0;
};

}
#endif
