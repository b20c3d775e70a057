// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the rays of an image need: the scene, its light and its tolerances, from plain settings.
#ifndef penumbra_RenderJob_h
#define penumbra_RenderJob_h

#include "Execution/WorkLimit.h"
#include "Image/ImageRenderer.h"
#include "Media/LightShafts.h"
#include "Sampling/CameraRayTracer.h"
#include "Shading/Illumination.h"
#include "Shading/Shading.h"

#include "vtkPenumbraRayCasterConstants.h"

#include <glm/glm.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>

class vtkImageData;
class vtkPenumbraIrradianceProvider;
class vtkPenumbraMedium;

namespace penumbra
{

class RankAgreement;

/// Settings of an image, which the ray caster documents.
struct JobSettings
{
  RayCasterConstants Constants;
  double Tolerance = 0.0;
  double LightTolerance = 0.0;
  bool Shadows = false;
  bool HasOcclusion = false;       ///< multiplies the colors
  bool HasOcclusionArray = false;  ///< among the geometry arrays
  double OcclusionRadius = 0.0;    ///< world units; 0: from the bounds
  double OcclusionStrength = -1.0; ///< negative: depends on the surface
  int OcclusionFalloff = 0;
  bool HasIndirectLight = false; ///< with an albedo above 0
  IlluminationSettings Light;    ///< of the indirect light
  bool HasGeometryArrays = false;
  vtkPenumbraIrradianceProvider* Provider = nullptr;
  vtkPenumbraMedium* Medium = nullptr; ///< null: none
  RankAgreement* Ranks = nullptr;      ///< that render the image together; null: this one alone
  /// Returns true if this rank renders a pixel; set if there are several ranks.
  std::function<bool(glm::ivec2)> RendersPixel;

  /// Returns true if the provider is asked for light, or says that pixels are joined.
  bool UsesProvider() const
  {
    return this->HasOcclusion || this->HasIndirectLight || this->HasOcclusionArray;
  }
};

/// Settings of the regions of an image, without what depends on the provider.
RenderSettings MakeRenderSettings(const JobSettings& settings);

class RenderJob
{
public:
  /// Receives a warning or an empty text, and whether the same text is reported only once.
  using WarningFunction = std::function<void(const std::string& warning, bool once)>;

  /// `scene`, `rays`, the provider and the medium must outlive this object.
  RenderJob(const Scene& scene, const RayScene& rays, const JobSettings& settings);

  /// Prepares the light. Returns false if `progress` requested a stop. `warn` receives warnings.
  bool Begin(const ProgressCallback& progress, const WarningFunction& warn);

  /// Lets `limit` (null: none) end the work on the image early; if `endsTiles`, also within tiles.
  void SetLimit(std::unique_ptr<WorkLimit> limit, bool endsTiles);
  WorkLimit* GetLimit() const { return this->Limit.get(); }
  /// Returns true if the limit ended the work.
  bool IsEnded() const { return this->Limit && this->Limit->HasEndedWork(); }

  /// Lights further samples of GetTracer() one by one, not as parts of the image.
  void LightSamplesAlone();

  /// Adds the geometry arrays to an image, if there are any. Returns false if `progress` requested a
  /// stop.
  bool AddArrays(const ProgressCallback& progress, vtkImageData* image, RayCounts& rays);

  const CameraRayTracer& GetTracer() const { return this->Tracer; }
  /// Settings of the regions.
  RenderSettings& GetRenderSettings() { return this->Settings; }
  const JobSettings& GetSettings() const { return this->Wanted; }
  /// Accepted errors, with those of light effects.
  const IntegrationSettings& GetLimits() const { return this->Limits; }

private:
  double GetSampleTolerance() const;
  double GetSampleIrradianceTolerance() const;
  double GetEffectTolerance() const;
  double GetOcclusionRadius() const;
  bool BeginProvider(const ProgressCallback& progress, const WarningFunction& warn);
  void UseProvider();
  void JoinPixels();
  void AddMedium(const WarningFunction& warn);
  void WarnOfMissingLight(const WarningFunction& warn);

  const Scene& SceneData;
  const RayScene& Rays;
  JobSettings Wanted;
  std::shared_ptr<const Illumination> Light; ///< null: no indirect light
  Shading Lit;
  CameraRayTracer Tracer;
  std::optional<LightShafts> Shafts;
  RenderSettings Settings;
  IntegrationSettings Limits;
  std::unique_ptr<WorkLimit> Limit;
  bool Joins = false; ///< light is estimated for all pixels together
};

}
#endif
