// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Traces one camera ray and composites its layers front to back, down to the first opaque one.
#ifndef penumbra_CameraRayTracer_h
#define penumbra_CameraRayTracer_h

#include "Camera.h"
#include "LayerLighting.h"
#include "LayerOrder.h"
#include "Media/LightShafts.h"
#include "PrimitiveId.h"
#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro, which tests need

#include <cstdint>
#include <limits>
#include <vector>

namespace penumbra
{

/// Color and first hit of one camera ray.
struct Sample
{
  glm::vec4 Color{ 0.f }; ///< premultiplied by alpha, background included
  Hit FirstHit;
  float OpaqueDepth =
    std::numeric_limits<float>::infinity(); ///< distance of the first opaque surface
  float Error = 0.f;                        ///< estimated error of in-scattered light and layers
  float Noise = 0.f;                        ///< standard error of the color in penumbrae
  std::uint32_t LitBy = 0;                  ///< lights with a size that single rays reached
  std::uint32_t ShadowedFrom = 0;           ///< lights with a size that single rays did not reach
};

/// Color of a triangle that is a layer of the image.
struct LayerColor
{
  PrimitiveId Id;
  glm::vec4 Color; ///< not premultiplied, and opacity
  float Slope;     ///< see EdgeBlending
};

/// A layer of a camera ray on which ambient occlusion or indirect light act.
struct LitLayer
{
  Hit Where;
  glm::vec3 Position{ 0.f };    ///< scene coordinates
  glm::vec3 Normal{ 0.f };      ///< shading normal (unit) on the side of the camera
  glm::vec3 Geometric{ 0.f };   ///< normal of the surface (unit) on the same side
  glm::vec3 Color{ 0.f };       ///< part of the color of the ray that complete occlusion removes
  glm::vec3 Reflectance{ 0.f }; ///< color that indirect light adds to the ray: 1 on a white surface
};

/// Returns true if colors of the surface come from textures.
bool HasTextures(const Surface& surface);

/// Computes the color of image points. All methods but the setters may be called from any thread.
class VTKPENUMBRAFILTERSRAYCASTING_EXPORT CameraRayTracer
{
public:
  static constexpr int PacketSize = 16;
  /// Accumulated alpha above which layers behind are ignored.
  static const float OpaqueAlpha;

  CameraRayTracer(const RayScene& rays, const Shading& shading, const Camera& camera);

  /// Returns the color along the ray through image point p. The caller counts the camera ray
  /// itself. `toleranceScale` multiplies the tolerances of occlusion and irradiance; it is larger
  /// than 1 for a sample that is averaged with others. `penumbrae` are the lights with a size whose
  /// visible fraction is estimated, see PenumbraSampling; one ray is traced toward each other
  /// light. `neighbors`, one for each light, predict the penumbrae; null: independent estimates.
  Sample TraceSample(glm::dvec2 p, RayCounts& counts, double toleranceScale = 1.0,
    std::uint32_t penumbrae = 0, std::vector<PenumbraNeighbors>* neighbors = nullptr) const;

  /// TraceSample() for a point at which `triangle` is known to be visible; null: the background.
  Sample ShadeSample(glm::dvec2 p, const PrimitiveId* triangle, RayCounts& counts,
    double toleranceScale = 1.0) const;

  /// Returns the color of a triangle at a point at which it is a layer, without the texture of the actor, without what
  /// is behind it and without the occlusion and the irradiance of providers.
  LayerColor ShadeLayer(glm::dvec2 p, PrimitiveId triangle, RayCounts& counts) const;

  /// TraceSample() for PacketSize points. Points whose bit in `active` is not set are skipped.
  void TracePacket(const glm::dvec2* points, unsigned int active, Sample* samples,
    RayCounts& counts, double toleranceScale = 1.0, std::uint32_t penumbrae = 0,
    std::vector<PenumbraNeighbors>* neighbors = nullptr) const;

  /// TracePacket() without the occlusion and the irradiance of providers, and without the light that a
  /// medium scatters toward the camera. Stores the layers of each point on which light acts, front to back,
  /// in `layers`. Points whose bit in `shaded` is not set may get no colors.
  void TraceLayers(const glm::dvec2* points, unsigned int active, unsigned int shaded,
    Sample* samples, std::vector<LitLayer>* layers, RayCounts& counts) const;

  /// Returns the first hit without shading it.
  Hit TraceFirstHit(glm::dvec2 p) const { return this->Rays.Intersect(this->MakeRay(p)); }

  /// Multiplies colors by 1 - `strength` * occlusion. `provider` computes the occlusion and has been prepared by
  /// Begin() with the same `tolerance`. A negative strength selects 1, or less on surfaces with scalars. Null: none.
  void SetOcclusion(
    const vtkPenumbraIrradianceProvider* provider, double strength, double tolerance);

  /// Sets the strength of occlusion for TraceLayers() alone. If `occlusion` is off, it finds the layers that
  /// reflect light; otherwise also those without lighting.
  void SetLayerLight(bool occlusion, double strength)
  {
    this->FindsUnlitLayers = occlusion;
    this->Lighting.OcclusionStrength = static_cast<float>(strength);
  }

  /// Adds reflected irradiance. `provider` computes the irradiance and has been prepared by BeginIrradiance() with the
  /// same `tolerance`. Surfaces reflect `albedo` times their color. Null: no indirect light.
  void SetIndirectLight(
    const vtkPenumbraIrradianceProvider* provider, float albedo, double tolerance);

  /// Returns true if every sample queries an irradiance provider, which makes samples expensive.
  bool UsesIrradianceProvider() const
  {
    return this->Lighting.OcclusionProvider || this->Lighting.IrradianceProvider;
  }

  /// Sets the accepted standard error of a color in the penumbra of a light with a size.
  void SetPenumbraTolerance(double tolerance) { this->PenumbraTolerance = tolerance; }

  /// Sets the light shafts of a participating medium; `shafts` must outlive this object. Null: no medium.
  void SetShafts(const LightShafts* shafts) { this->Shafts = shafts; }
  bool HasShafts() const { return this->Shafts != nullptr; }

  /// Returns true if SetOcclusion() has set a provider.
  bool HasOcclusion() const { return this->Lighting.OcclusionProvider != nullptr; }

  /// Returns the ambient occlusion at a hit, in [0, 1]. SetOcclusion() must have set a provider.
  float ComputeOcclusion(
    const Ray& ray, const Hit& hit, const ShadedHit& shaded, RayCounts& counts) const;

  Ray MakeRay(glm::dvec2 p) const;

  /// Returns the background at image point p, premultiplied by alpha.
  glm::vec4 GetBackground(const glm::dvec2& p) const;

  /// Returns true if the background is an image, which is not linear inside a pixel.
  bool HasBackgroundImage() const;

  /// Returns true if the order in which VTK draws surfaces decides which are layers of a ray.
  bool HasLayerOrder() const { return !this->Kinds.empty(); }

  /// Returns true if VTK draws the next triangle of a ray. HasLayerOrder() must be true.
  bool IsDrawn(PrimitiveId triangle, LayerOrder& order) const
  {
    return order.IsDrawn(this->Kinds[triangle.Surface], triangle);
  }

  const Shading& GetShading() const { return this->SurfaceShading; }
  const Scene& GetScene() const { return this->Rays.GetScene(); }
  const Camera& GetCamera() const { return this->ViewCamera; }
  const RayScene& GetRays() const { return this->Rays; }
  bool HasTranslucentSurfaces() const { return this->Translucent; }
  bool HasTextures() const { return this->Textured; }
  /// Returns true if surfaces behind translucent ones may have textures.
  bool HasTexturesBehind() const { return this->Translucent && this->Textured; }

private:
  /// Adds a segment of the medium, with the light that it scatters if `scatters`.
  void AddMedium(const Ray& ray, double from, double to, bool scatters, Sample& sample,
    glm::vec3& tint, RayCounts& counts) const;
  void CompositeLayers(const glm::dvec2& p, const Ray& ray, Sample& sample, RayCounts& counts,
    double toleranceScale, std::uint32_t penumbrae, std::vector<PenumbraNeighbors>* neighbors,
    std::vector<LitLayer>* layers = nullptr) const;
  /// Traces the first hits of a packet.
  void TraceHits(const glm::dvec2* points, unsigned int active, Ray* rays, Hit* hits) const;
  /// Returns true if TraceLayers() finds the layers of a surface.
  bool IsLitLayer(const Surface& surface) const;
  /// `normal`: of the surface, on the side of the camera.
  LitLayer MakeLitLayer(const Ray& ray, const Hit& hit, glm::dvec3 normal) const;

  const RayScene& Rays;
  const Shading& SurfaceShading;
  const Camera& ViewCamera;
  bool Translucent = false; ///< at least one surface is translucent
  bool Textured = false;    ///< at least one surface has a texture
  /// Order in which VTK draws each surface; empty if the distance alone decides.
  std::vector<LayerOrder::Kinds> Kinds;
  LayerLightingSettings Lighting;
  bool FindsUnlitLayers = true;
  const LightShafts* Shafts = nullptr;
  double PenumbraTolerance = 0.0;
};

}
#endif
