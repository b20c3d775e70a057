// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// From a traced scene to the pixels of a picture's part: corners, edges, then tiles in parallel.
#ifndef penumbra_ImageRegion_h
#define penumbra_ImageRegion_h

#include "Coverage/MeshEdges.h"
#include "Coverage/PixelIntegrator.h"
#include "Execution/ParallelFor.h"

#include <vector>

namespace penumbra
{

struct RenderSettings
{
  IntegrationSettings Integration;
  bool Packets = true; ///< corner rays 16 at a time
};

/// The edges of a scene's meshes where its picture may change. Finding them takes longer than drawing
/// a small part, so they are found once for all parts.
struct SceneEdges
{
  std::vector<std::vector<MeshEdge>> OfSurfaces;
  std::vector<char> Dense; ///< per surface: its triangles are too small for edges to be looked at
};

/// Throws Stopped when `progress` asks to stop.
SceneEdges FindSceneEdges(
  const Scene& scene, const RenderSettings& settings, const ProgressCallback& progress = {});

/// The pixels [Low, High), row by row from the bottom.
struct ImageRegion
{
  glm::ivec2 Low{ 0 };
  glm::ivec2 High{ 0 };
  std::vector<glm::vec4> Colors; ///< straight alpha
  std::vector<float> Errors;
  std::vector<float> RayShares; ///< rays traced for each pixel
  RayCounts Rays;
  PixelCounts Pixels;
  long long Edges = 0; ///< projected edges that were borders

  std::size_t Index(int x, int y) const
  {
    return static_cast<std::size_t>(y - this->Low.y) * (this->High.x - this->Low.x) +
      (x - this->Low.x);
  }
};

/**
 * Fills part.Low to High, which must lie in the camera's picture. Pixels do not depend on the part
 * asked for nor on the number of threads. False when `progress` stopped it.
 */
bool RenderRegion(const CameraRayTracer& sampler, const SceneEdges& meshes,
  const RenderSettings& settings, const ProgressCallback& progress, ImageRegion& part);

}
#endif
