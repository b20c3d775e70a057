// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Ambient occlusion and indirect light of the translucent layers along one camera ray, with a number
// of estimates that does not grow with the number of layers.
#ifndef penumbra_LayerLighting_h
#define penumbra_LayerLighting_h

#include "RayCounts.h"
#include "Shading/Shading.h"

class vtkPenumbraIrradianceProvider;

namespace penumbra
{

struct Surface;

/// Providers and their settings, see CameraRayTracer.
struct LayerLightingSettings
{
  const vtkPenumbraIrradianceProvider* OcclusionProvider = nullptr;
  float OcclusionStrength = 1.f;
  double OcclusionTolerance = 0.0;
  const vtkPenumbraIrradianceProvider* IrradianceProvider = nullptr;
  float Albedo = 0.f;
  double IrradianceTolerance = 0.0;

  /// Returns the strength of occlusion on a surface.
  float GetStrength(const Surface& surface) const;
};

/// Lights the layers of one camera ray from front to back. The tolerance of a layer of weight w, its
/// fraction of the color, is 1 / sqrt(w) of that of an opaque surface, so that the squared errors of
/// all layers add up to that of one surface. Layers whose weights add up to less than a limit share
/// the mean of the estimates in front and behind. The limit is half of the tolerance for the first
/// estimates and then grows, which ends the work of a deep stack.
class LayerLighting
{
public:
  /// `settings` and `rays` must outlive this object. `toleranceScale`: see CameraRayTracer.
  LayerLighting(const LayerLightingSettings& settings, const RayScene& rays, double toleranceScale);

  /// Returns the occlusion at a hit, in [0, 1], for a layer of weight `weight`.
  float EstimateOcclusion(
    const Ray& ray, const Hit& hit, const ShadedHit& shaded, RayCounts& counts, double weight);

  /// Lights the color `c` of a layer of weight `weight` in (0, 1], or, if it has no estimate of its
  /// own, adds it to the layers that the next call completes. `color`: the layers in front, to which
  /// those completed are added. `tint`: factor on the color of the layer.
  void Apply(const Ray& ray, const Hit& hit, const ShadedHit& shaded, float weight,
    const glm::vec3& tint, glm::vec4& c, glm::vec4& color, RayCounts& counts);

  /// Completes the remaining layers. Returns the estimated error beyond the tolerance.
  float Finish(const Ray& ray, glm::vec4& color, RayCounts& counts);

private:
  /// Values at one layer.
  struct Estimate
  {
    float Occlusion = 0.f;
    glm::vec3 Irradiance{ 0.f };
  };

  glm::vec3 EstimateIrradiance(
    const Ray& ray, const Hit& hit, const ShadedHit& shaded, RayCounts& counts, double weight);
  Estimate MakeEstimate(const Ray& ray, const Hit& hit, const ShadedHit& shaded, double weight,
    bool light, RayCounts& counts);
  /// Returns the weight of layers whose light does not matter at the tolerance.
  double ComputeNegligibleWeight() const;
  void CompleteShared(const Estimate& next, glm::vec4& color);

  const LayerLightingSettings& Settings;
  const RayScene& Rays;
  double ToleranceScale;
  Estimate Last;
  int Estimates = 0;
  bool HasIrradiance = false; ///< of `Last`
  float SharedWeight = 0.f;   ///< of the layers that wait for the next estimate
  Hit SharedHit;              ///< of the last of them
  ShadedHit SharedShaded;
  glm::vec3 SharedColor{ 0.f };       ///< their color times strength and weight
  glm::vec3 SharedReflectance{ 0.f }; ///< their reflectance times weight
  double SquaredError = 0.0;          ///< of the estimates, weighted
  double SquaredTolerance = 0.0;      ///< accepted
  double SharingError = 0.0;          ///< squared, of layers without an estimate of their own
};

}
#endif
