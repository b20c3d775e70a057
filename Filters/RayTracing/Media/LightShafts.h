// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Light that a medium scatters towards the eye, shadows in it included: single scattering, eq. 1 and
// 2 of [Shafts] with true shadow rays. The ray is not marched evenly: its steps scatter equal shares
// of light, borders of shadow between two steps are bisected, and what lies between borders is
// summed in closed form.
#ifndef penumbra_LightShafts_h
#define penumbra_LightShafts_h

#include "InScatteringDistribution.h"
#include "Medium.h"
#include "Shading/Shading.h"
#include "ShadowVolumes.h"

#include <vector>

namespace penumbra
{

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT LightShafts
{
public:
  struct MarchQuality
  {
    double Tolerance; ///< the error accepted in a colour
    int Steps; ///< shadow rays for each light along a ray, beside those that find borders; 0: as
               ///< many as Tolerance needs
  };

  /// Lights that cast no shadow (headlights) make no shafts. `shading` must outlive this object.
  LightShafts(const Shading& shading, const Medium& medium, MarchQuality effort);

  /// What the medium adds to a part of a ray, and leaves of what is behind.
  struct InScattering
  {
    glm::vec3 Light{ 0.f };
    float Transmittance = 1.f;
    float Error = 0.f; ///< believed, of Light
  };

  /// Between the distances `from` and `to` of `ray`, which may be infinite. Only the share `weight`
  /// of the result reaches the eye: less of it, less work.
  InScattering Along(
    const Ray& ray, double from, double to, float weight, long long& shadowRays) const;

  /// No light makes shafts.
  bool IsEmpty() const { return this->Lights.empty(); }

private:
  /// One light along one ray. Places are shares of what the whole ray scatters, were it lit.
  struct RayMarch
  {
    const InScatteringDistribution& Profile;
    const Light& Source;
    glm::dvec3 Origin;
    glm::dvec3 Direction;
    double Importance;       ///< of the whole ray, in tolerances
    std::vector<float> Seen; ///< what of the light arrives at each step
    double Low;              ///< the steps lie between these places
    double High;
    double BoundaryTolerance; ///< borders are found to this share
    double Lit;               ///< found so far
    double LitError;          ///< believed error of Lit
    long long Rays;
  };

  void MarchIntervals(RayMarch& march, std::vector<RayInterval> spans) const;
  void SampleVisibility(RayMarch& march, int steps) const;
  void BisectSamples(RayMarch& march) const;
  double LitShare(RayMarch& march) const;
  static double PlaceOfStep(const RayMarch& march, int i, int steps);
  float Visible(RayMarch& march, double share) const;
  double IntegrateInterval(
    RayMarch& march, double low, float atLow, double high, float atHigh) const;

  const Shading& SurfaceShading;
  const Medium ScatteringMedium;
  const MarchQuality Quality;
  std::vector<Light> Lights;
  std::vector<ShadowVolumes> Regions; ///< of each light
};

}
#endif
