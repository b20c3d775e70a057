// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// State of vtkPenumbraRayCaster while it renders an image of the prepared scene.
#ifndef penumbra_RayCasterExecution_h
#define penumbra_RayCasterExecution_h

#include "RayCasterInternals.h"

#include "Execution/WorkLimit.h"
#include "Image/GrowingImage.h"
#include "Media/LightShafts.h"
#include "Sampling/CameraRayTracer.h"
#include "Shading/Shading.h"
#include "ToleranceWarning.h"

#include "vtkImageData.h"

#include <memory>
#include <optional>

/// What the rays of an image need. It refers to the prepared scene.
struct vtkPenumbraRayCaster::Internals::Execution
{
  Execution(const PreparedScene& prepared, bool shadows)
    : Lit(*prepared.Rays, shadows),
      Tracer(*prepared.Rays, this->Lit, prepared.SceneData.ViewCamera)
  {
  }

  /// Returns true if a limit ended the work.
  bool IsEnded() const { return this->Limit && this->Limit->HasEndedWork(); }

  penumbra::Shading Lit;
  penumbra::CameraRayTracer Tracer;
  std::optional<penumbra::LightShafts> Shafts;
  penumbra::RenderSettings Settings;
  penumbra::IntegrationSettings Limits; ///< accepted errors, with those of light effects
  std::unique_ptr<penumbra::WorkLimit> Limit;
  bool Joins = false; ///< occlusion is estimated for all pixels together
  bool UsesProvider = false;
};

/// An image that several calls of RenderFor() continue.
struct vtkPenumbraRayCaster::Internals::GrowingState
{
  std::unique_ptr<Execution> Job;
  std::unique_ptr<penumbra::GrowingImage> Image; ///< null if it is complete
  vtkSmartPointer<vtkImageData> Final;           ///< the complete image
  vtkMTimeType SceneTime = 0;
};

#endif
