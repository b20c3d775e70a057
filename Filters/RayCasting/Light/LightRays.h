// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The light that arrives along single rays, traced in packets: occlusion, or diffuse indirect light.
#ifndef penumbra_LightRays_h
#define penumbra_LightRays_h

#include "Embree/RayScene.h"
#include "LightSite.h"
#include "Shading/DistanceFalloff.h"
#include "Shading/HemisphereSampling.h"
#include "Shading/Illumination.h"
#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro, which tests need

#include <algorithm>
#include <memory>
#include <optional>

namespace penumbra
{

/// Occlusion along rays.
class VTKPENUMBRAFILTERSRAYCASTING_EXPORT OcclusionRays
{
public:
  static constexpr int PacketSize = 16;

  /// `rays` must outlive this object. `falloff` is in scene units. The mean of many rays is estimated
  /// to `tolerance`.
  OcclusionRays(const RayScene& rays, const DistanceFalloff& falloff, double tolerance);

  /// Returns the distance at which rays end, in scene units.
  float GetRadius() const { return this->Falloff.Radius; }

  /// Computes the occlusion along PacketSize rays, in [0, 1]; those with Near > Far are inactive. Adds the
  /// number of rays that were traced beyond the first hits to `additional`.
  void Trace(const Ray* rays, float* values, long long& additional) const;

private:
  const RayScene& Rays;
  DistanceFalloff Falloff;
  bool Translucent;
  float Cut; ///< transmittance at which rays end
};

/// Effects that are estimated for the pixels of an image together.
struct LightEffects
{
  std::optional<OcclusionRays> Occlusion;
  std::shared_ptr<const Illumination> Light; ///< null: no indirect light
  double Tolerance = 0.0;                    ///< of their sum, on a white surface
  bool HasShadows = false; ///< so that colors under uniform light do not tell the reflectance

  /// Indirect light of all surfaces with which the image is rendered first, see Shading::SetUniformLight().
  float GetUniformLight() const;

  /// Calls visit(N) with the number of values of the light, as a constant.
  template <typename Visit>
  auto Select(const Visit& visit) const
  {
    return !this->Light ? visit(std::integral_constant<int, 1>())
      : this->Occlusion ? visit(std::integral_constant<int, 4>())
                        : visit(std::integral_constant<int, 3>());
  }
};

/// Rays that are traced together. Those from Count on have Near > Far.
template <int N>
struct LightPacket
{
  static constexpr int Size = OcclusionRays::PacketSize;
  LightPacket() { std::fill(this->Weights, this->Weights + Size, 1.f); }

  Ray Rays[Size];
  LightReceiver Starts[Size]; ///< where they start, which only indirect light needs
  float Weights[Size];        ///< of what their directions contribute to their values
  typename LightTerms<N>::Value Values[Size];
  float Strengths[Size]; ///< largest of these contributions without weights
  int Count = 0;
};

/// Rays from surfaces, and their values as in LightSite.
template <int N>
class LightRays
{
public:
  static constexpr int PacketSize = OcclusionRays::PacketSize;
  using Value = typename LightTerms<N>::Value;

  /// `effects` must outlive this object.
  explicit LightRays(const LightEffects& effects)
    : Effects(effects)
  {
  }

  /// Returns a ray that starts above a surface, in the direction of its geometric normal.
  Ray StartRay(glm::vec3 position, const SurfaceNormals& normals) const
  {
    Ray ray = Illumination::SpawnRay(position, normals, normals.Geometric);
    if (!LightTerms<N>::HasRadiance)
    {
      ray.Far = this->Effects.Occlusion->GetRadius();
    }
    return ray;
  }

  /// Turns a ray to the direction of a point of the unit square, which the cosine weights.
  /// `frame`: FrameFromNormal() of the shading normal.
  static void Turn(Ray& ray, const SurfaceNormals& normals, const glm::mat3& frame, glm::vec2 at)
  {
    ray.Direction =
      normals.ReflectAbove(frame * DiskToHemisphere(SampleUniformDiskConcentric(at.x, at.y)));
  }

  /// StartRay() and Turn().
  Ray MakeRay(
    glm::vec3 position, const SurfaceNormals& normals, const glm::mat3& frame, glm::vec2 at) const
  {
    Ray ray = this->StartRay(position, normals);
    Turn(ray, normals, frame, at);
    return ray;
  }

  /// Returns the tolerance of the sum of the effects, on a white surface.
  double GetTolerance() const { return this->Effects.Tolerance; }

  /// Returns the squared range of values.
  Value GetSquaredRange() const;

  /// Computes the values and strengths of a packet. Adds the number of rays that were traced beyond the first hits to
  /// `additional`.
  void Trace(LightPacket<N>& packet, long long& additional) const;

private:
  void TraceRadiance(LightPacket<N>& packet, long long& additional) const;

  const LightEffects& Effects;
};

}
#endif
