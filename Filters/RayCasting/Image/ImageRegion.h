// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Renders a rectangular region of the image: corner rays, projected edges, then tiles in parallel.
#ifndef penumbra_ImageRegion_h
#define penumbra_ImageRegion_h

#include "Edges/MeshEdges.h"
#include "Execution/ParallelFor.h"
#include "Light/LightRays.h"
#include "Pixels/IntegrationSettings.h"
#include "Pixels/TileGeometry.h"
#include "Sampling/CameraRayTracer.h"
#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro, which tests need

#include <functional>
#include <memory>
#include <vector>

namespace penumbra
{

struct SurfaceChange;

/// Settings that are the same for all regions of an image.
struct RenderSettings
{
  IntegrationSettings Integration;
  std::shared_ptr<const LightEffects> Light; ///< null: none beside that of the camera ray tracer
  bool KeepsOcclusion = false; ///< if on, the region stores the mean occlusion of each pixel
  bool UsePackets = true;      ///< If on, trace corner rays in packets of 16.
  WorkLimit* Limit = nullptr;  ///< ends the work on a region early; null: none

  /// Called before the edges of the scene are used, unless it is empty.
  std::function<void()> UpdateEdges;

  /// Returns true if light effects add an error of their own.
  bool HasLightErrors() const { return this->Integration.LightTolerance > 0.0 || this->Light; }
};

/// Mesh edges of a scene at which the image may be discontinuous. They are computed once for all
/// regions, because this takes longer than rendering a small region.
struct SceneEdges
{
  std::vector<std::vector<MeshEdge>> EdgesBySurface;
  SurfaceFlags Flags;
};

/// Finds the edges of all surfaces. Throws Stopped if `progress` requests a stop.
VTKPENUMBRAFILTERSRAYCASTING_EXPORT SceneEdges FindSceneEdges(
  const Scene& scene, const RenderSettings& settings, const ProgressCallback& progress = {});

/// Finds the edges again that depend on the camera of `scene`, after it has moved, and those of the
/// surfaces that were replaced. `edges` are those of the former scene with the same settings. Throws
/// Stopped if `progress` requests a stop.
void UpdateSceneEdges(const Scene& scene, const RenderSettings& settings,
  const std::vector<SurfaceChange>& changes, const ProgressCallback& progress, SceneEdges& edges);

/// The pixels [Low, High) of the image with their results, row by row from the bottom.
struct ImageRegion
{
  glm::ivec2 Low{ 0 };
  glm::ivec2 High{ 0 };
  std::vector<glm::vec4> Colors;   ///< not premultiplied by alpha
  std::vector<float> Errors;       ///< estimated RMS error per pixel
  std::vector<float> LightErrors;  ///< part that light effects cause; empty without them
  std::vector<float> Occlusions;   ///< mean of the surfaces in each pixel; may be empty
  std::vector<float> RaysPerPixel; ///< refinement rays; uniform sampling: all rays
  RayCounts Rays;
  PixelCounts Pixels;
  long long Unfinished = 0; ///< number of pixels whose work the limit ended
  long long Edges = 0;      ///< number of projected edges

  std::size_t Index(int x, int y) const
  {
    return static_cast<std::size_t>(y - this->Low.y) * (this->High.x - this->Low.x) +
      (x - this->Low.x);
  }
};

/**
 * Renders the pixels [region.Low, region.High), which must lie in the image of the camera. The
 * colors do not depend on the region or on the number of threads, unless a limit ends the work. Returns
 * false if `progress` requested a stop.
 */
VTKPENUMBRAFILTERSRAYCASTING_EXPORT bool RenderRegion(const CameraRayTracer& tracer,
  const SceneEdges& sceneEdges, const RenderSettings& settings, const ProgressCallback& progress,
  ImageRegion& region);

}
#endif
