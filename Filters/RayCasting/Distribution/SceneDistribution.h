// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the ray caster asks of the other ranks of a parallel program, each of which has a part of the
// scene and renders a part of the image. Filters/Parallel implements it. All functions are collective:
// every rank calls them in the same order.
#ifndef penumbra_SceneDistribution_h
#define penumbra_SceneDistribution_h

#include "Image/ImageRenderer.h"

#include "vtkSmartPointer.h"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

class vtkImageData;

namespace penumbra
{

struct Scene;

/// Thrown on all ranks if one of them fails, with its message.
class RankFailure : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Names and values of settings that all ranks must agree on.
using SettingList = std::vector<std::pair<std::string, std::string>>;

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

  /// Throws RankFailure, with the name of the first setting that differs between ranks, if there is one.
  virtual void Compare(const SettingList& settings) = 0;

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

  virtual bool IsFirst() const = 0;

  /// Tells the other ranks that this one has failed. Returns the message of the first one that has.
  virtual std::string Fail(const std::string& message) = 0;
};

}
#endif
