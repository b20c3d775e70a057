// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// From a traced scene to the pixels of a picture's part: corners, edges, then tiles in parallel.
#ifndef penumbra_Picture_h
#define penumbra_Picture_h

#include "Batches.h"
#include "PixelIntegrator.h"

#include <vector>

namespace penumbra
{

struct PictureSettings
{
  IntegrationSettings Integration;
  bool Packets = true; ///< corner rays 16 at a time
};

/// The pixels [Low, High), row by row from the bottom.
struct Picture
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
 * Fills picture.Low to High, which must lie in the camera's picture. Pixels do not depend on the part
 * asked for nor on the number of threads. False when `progress` stopped it.
 */
bool RenderPicture(const Sampler& sampler, const PictureSettings& settings,
  const ProgressCallback& progress, Picture& picture);

}
#endif
