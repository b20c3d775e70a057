// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Light that a medium scatters toward the camera, with shadows: single scattering [Shafts eq. 1
// and 2] with traced shadow rays. Steps along the ray are not equidistant: each step scatters the
// same amount of light. Shadow boundaries between two steps are found by bisection, and the light
// between boundaries is integrated in closed form.
#ifndef penumbra_LightShafts_h
#define penumbra_LightShafts_h

#include "Medium.h"
#include "Shading/Shading.h"
#include "ShadowVolumes.h"
#include "SpectralDistribution.h"

#include <vector>

namespace penumbra
{

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT LightShafts
{
public:
  struct MarchQuality
  {
    double Tolerance; ///< accepted error of a color channel
    int Steps;        ///< shadow rays per light and ray, not counting bisection; 0: from Tolerance
  };

  /// Lights that cast no shadows, such as headlights, are ignored. `shading` must outlive this
  /// object.
  LightShafts(const Shading& shading, const SpectralMedium& medium, MarchQuality quality);

  /// In-scattered light along a ray segment, and the transmittance of the segment.
  struct InScattering
  {
    glm::vec3 Light{ 0.f };
    glm::vec3 Transmittance{ 1.f };
    float Error = 0.f; ///< estimated error of Light
  };

  /// Integrates the segment [from, to] of `ray`; `to` may be infinite. `weight` is the fraction of
  /// the result that reaches the camera; smaller weights need fewer steps. Adds the number of
  /// shadow rays traced to `shadowRays`.
  InScattering Along(
    const Ray& ray, double from, double to, float weight, long long& shadowRays) const;

  /// Returns true if no light of the scene casts light shafts.
  bool IsEmpty() const { return this->Lights.empty(); }

  const SpectralMedium& GetMedium() const { return this->ScatteringMedium; }

private:
  /// Ray march for one light. Positions are values of the CDF of the in-scattered light of the
  /// whole ray, in [0, 1].
  struct RayMarch
  {
    const SpectralDistribution& Profile;
    const Light& Source;
    glm::dvec3 Origin;
    glm::dvec3 Direction;
    double Importance; ///< in-scattered light of the whole unshadowed ray, in tolerances
    std::vector<float> Visibility; ///< of the light at each step
    double Low;                    ///< position of the first step
    double High;                   ///< position of the last step
    double BoundaryTolerance;      ///< shadow boundaries are bisected down to this interval
    glm::dvec3 Lit;                ///< lit fraction of the ray so far, per channel
    double LitError;               ///< estimated error of Lit
    long long Rays;
  };

  void MarchIntervals(RayMarch& march, std::vector<RayInterval> intervals) const;
  void SampleVisibility(RayMarch& march, int steps) const;
  void BisectSamples(RayMarch& march) const;
  glm::dvec3 IntegrateVisibility(RayMarch& march) const;
  static double ComputeStepPosition(const RayMarch& march, int i, int steps);
  float TraceVisibility(RayMarch& march, double position) const;
  glm::dvec3 IntegrateInterval(
    RayMarch& march, double low, float atLow, double high, float atHigh) const;

  const Shading& SurfaceShading;
  const SpectralMedium ScatteringMedium;
  const MarchQuality Quality;
  std::vector<Light> Lights;
  std::vector<ShadowVolumes> Shadows; ///< per light
};

}
#endif
