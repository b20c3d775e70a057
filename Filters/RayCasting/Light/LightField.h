// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Ambient occlusion and indirect light of the pixels of an image, estimated for all of them together.
#ifndef penumbra_LightField_h
#define penumbra_LightField_h

#include "Execution/ParallelFor.h"
#include "Execution/WorkLimit.h"
#include "LightRays.h"
#include "Sampling/SampleLight.h"

#include <memory>

namespace penumbra
{

class CameraRayTracer;

class LightField : public SampleLight
{
public:
  /// Prepares the estimate of the light in the pixels [low, high) of the image to the tolerance of
  /// `effects`, the RMSE of a tile. The estimates depend neither on `low` and `high` nor on the number of
  /// threads. The arguments must outlive the result.
  static std::unique_ptr<LightField> Make(
    const CameraRayTracer& tracer, const LightEffects& effects, glm::ivec2 low, glm::ivec2 high);

  /// Finds the visible surfaces with few rays each, the first round. Returns false if `limit` (null:
  /// none) ended it; the next call continues. `progress` receives fractions in [from, to]. Adds the rays
  /// to `counts`. Throws Stopped if `progress` requests a stop.
  virtual bool FindSites(WorkLimit* limit, double from, double to, const ProgressCallback& progress,
    RayCounts& counts) = 0;

  /// Adds rays in further rounds until the tolerance is met; as FindSites(), which must have finished.
  virtual bool AddRounds(WorkLimit* limit, double from, double to, const ProgressCallback& progress,
    RayCounts& counts) = 0;

  /// Returns true if FindSites() has finished. The results are available from then on.
  virtual bool HasSites() const = 0;

  /// Maps the color c of a pixel without occlusion, under uniform light, to Factor * c + Offset. The default
  /// one where samples are lit one by one.
  struct Change
  {
    glm::vec3 Factor{ 1.f };
    glm::vec3 Offset{ 0.f };
    float Error = 0.f;   ///< estimated standard error of the color
    float Scatter = 0.f; ///< of its square, as in PixelError
  };
  virtual Change At(int x, int y) const = 0;

  /// Returns the mean occlusion of the surfaces in a pixel, in [0, 1], if the light includes it.
  virtual float GetMeanOcclusion(int x, int y) const = 0;
};

}
#endif
