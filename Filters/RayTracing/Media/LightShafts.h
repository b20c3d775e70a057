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
    bool CameraLights = true; ///< if false, lights that move with the camera are ignored
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

  /// Returns the transmittance of the segment [from, to] of `ray`; `to` may be infinite.
  glm::vec3 ComputeTransmittance(const Ray& ray, double from, double to) const;

  /// Returns true if no light of the scene casts light shafts.
  bool IsEmpty() const { return this->Lights.empty(); }

  const SpectralMedium& GetMedium() const { return this->ScatteringMedium; }

private:
  using Point = SpectralDistribution::Point;

  /// Part of a ray in the medium, between two distances along a unit direction.
  struct Segment
  {
    glm::dvec3 Origin;
    glm::dvec3 Direction;
    double Near;
    double Far;
    glm::vec3 Transmittance{ 1.f };
    bool IsEmpty;

    Segment(const SpectralMedium& medium, const Ray& ray, double from, double to);
  };

  /// Point of a march, and the visibility of the light there.
  struct Step
  {
    Point At;
    float Visibility;
  };

  /// Ray march for one light, through one interval after the other.
  struct RayMarch
  {
    const SpectralDistribution& Profile;
    const Light& Source;
    glm::dvec3 Origin;
    glm::dvec3 Direction;
    double Importance; ///< in-scattered light of the whole unshadowed ray, in tolerances
    Point Low;         ///< begin of the interval
    Point High;        ///< end of the interval
    std::vector<Step> Steps;
    double BoundaryTolerance; ///< shadow boundaries are bisected down to this interval of the CDF
    glm::dvec3 Lit;           ///< lit fraction of the ray so far, per channel
    double LitError;          ///< estimated error of Lit
    long long Rays;

    double Size() const { return this->High.CDF - this->Low.CDF; }
  };

  void MarchIntervals(RayMarch& march, const std::vector<RayInterval>& intervals) const;
  void MarchInterval(RayMarch& march, double wantedSteps) const;
  void SampleVisibility(RayMarch& march, int steps) const;
  void BisectSamples(RayMarch& march) const;
  glm::dvec3 IntegrateVisibility(RayMarch& march) const;
  static double EstimateMissedLight(const std::vector<Step>& steps);
  Step TraceVisibility(RayMarch& march, const Point& point) const;
  glm::dvec3 IntegrateBetween(RayMarch& march, const Step& low, const Step& high) const;

  const Shading& SurfaceShading;
  const SpectralMedium ScatteringMedium;
  const MarchQuality Quality;
  std::vector<Light> Lights;
  std::vector<ShadowVolumes> Shadows; ///< per light
};

}
#endif
