// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What one ray through the picture sees: all layers down to the first opaque one, composed.
#ifndef penumbra_CameraRayTracer_h
#define penumbra_CameraRayTracer_h

#include "Media/LightShafts.h"

#include <cstdint>
#include <limits>

class vtkPenumbraIrradianceProvider;

namespace penumbra
{

/// Rays by purpose.
struct RayCounts
{
  long long Primary = 0;    ///< through pixel corners, or all of uniform sampling
  long long Refinement = 0; ///< inside pixels
  long long Auxiliary = 0;  ///< through pixel centres, for the geometry arrays
  long long Shadow = 0;
  long long Shaft = 0;     ///< to lights, from the medium
  long long Occlusion = 0; ///< asked for by the irradiance source
  long long Indirect = 0;  ///< asked for by it, for light

  long long InPicture() const { return this->Primary + this->Refinement; }
  RayCounts& operator+=(const RayCounts& other);
};

struct Sample
{
  glm::vec4 Color{ 0.f }; ///< premultiplied by alpha, background included
  Hit FirstHit;
  float OpaqueDepth = std::numeric_limits<float>::infinity(); ///< of the first opaque surface
  float Error = 0.f;                                          ///< believed, of what the medium adds
};

class CameraRayTracer
{
public:
  static constexpr int PacketSize = 16;

  CameraRayTracer(const RayScene& rays, const Shading& shading, const Camera& camera);

  /// What the ray through picture point p sees. Does not count that ray itself. `slack`: occlusion may
  /// err by so many times the tolerance, because the sample will be averaged with others.
  Sample TraceSample(glm::dvec2 p, RayCounts& counts, double slack = 1.0) const;

  /// The same for PacketSize points at once; points without a set bit in `active` are left out.
  void TracePacket(const glm::dvec2* points, unsigned int active, Sample* samples,
    RayCounts& counts, double slack = 1.0) const;

  /// The first hit alone.
  Hit FirstHit(glm::dvec2 p) const { return this->Rays.Intersect(this->MakeRay(p)); }

  /// Asks `source` (after its Begin()) for the blocked share of the sky wherever colour is wanted and
  /// darkens by `strength`; a negative strength: 1, or less on surfaces coloured by data. `tolerance`:
  /// what Begin() was told.
  void SetOcclusion(const vtkPenumbraIrradianceProvider* source, double strength, double tolerance);

  /// Asks `source` (after its BeginIrradiance()) for the light that arrives, to the error `tolerance`,
  /// and adds what of it surfaces of `albedo` times their colour throw back. Null: none.
  void SetIndirectLight(
    const vtkPenumbraIrradianceProvider* source, float albedo, double tolerance);

  /// Is a source asked about every sample? Such samples are dear.
  bool UsesIrradianceSource() const { return this->OcclusionSource || this->IrradianceSource; }

  /// Draws a medium around everything; `shafts` must outlive this object. Null: none.
  void SetShafts(const LightShafts* shafts) { this->Shafts = shafts; }
  bool HasShafts() const { return this->Shafts != nullptr; }

  /// The blocked share of the sky at a hit.
  float Occlusion(const Ray& ray, const Hit& hit, const ShadedHit& seen, RayCounts& counts,
    double slack = 1.0) const;

  Ray MakeRay(glm::dvec2 p) const;

  /// Background at p, premultiplied.
  glm::vec4 Background(glm::dvec2 p) const;

  const Shading& GetShading() const { return this->Shades; }
  const Scene& GetScene() const { return this->Rays.GetScene(); }
  bool IsTransparent() const { return this->Transparent; }

private:
  void AddMedium(const Ray& ray, double from, double to, Sample& sample, RayCounts& counts) const;
  glm::vec3 Indirect(
    const Ray& ray, const Hit& hit, const ShadedHit& seen, RayCounts& counts, double slack) const;
  void CompositeLayers(
    glm::dvec2 p, const Ray& ray, Sample& sample, RayCounts& counts, double slack) const;

  const RayScene& Rays;
  const Shading& Shades;
  const Camera& Eye;
  bool Transparent = false; ///< some surface lets light through
  const vtkPenumbraIrradianceProvider* OcclusionSource = nullptr;
  float OcclusionStrength = 1.f;
  double OcclusionTolerance = 0.0;
  const vtkPenumbraIrradianceProvider* IrradianceSource = nullptr;
  float Albedo = 0.f;
  double IrradianceTolerance = 0.0;
  const LightShafts* Shafts = nullptr;
};

}
#endif
