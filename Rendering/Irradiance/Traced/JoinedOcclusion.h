// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Ambient occlusion of the surface points of an image to a tolerance. Few rays start at each point and are
// joined with those of its neighbors by the regression of Filters/RayCasting/Light. Further rounds add rays
// to the tiles of 16x16 pixels whose estimated error is too large. The work can be interrupted: its result
// after a round depends neither on interruptions nor on the number of threads.
#ifndef penumbra_JoinedOcclusion_h
#define penumbra_JoinedOcclusion_h

#include "Execution/WorkLimit.h"
#include "Light/LightRays.h"
#include "Light/RayGrowth.h"
#include "Light/SiteGrid.h"
#include "SurfaceFromDepth.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

class JoinedOcclusion
{
public:
  /// `points`: row by row, `width` in each. `radius` is in scene units. `rays` must outlive this object.
  JoinedOcclusion(const std::vector<SurfacePoint>& points, int width, const RayScene& rays,
    float radius, double tolerance);

  /// Traces rays until the image is complete or `limit` is reached; at least those of one tile. Returns
  /// true if the image has changed.
  bool Continue(WorkLimit* limit);

  /// Returns true if the tolerance is met, or if no pixel may get more rays.
  bool IsComplete() const { return this->Complete; }

  /// Fills `means` with the occlusion of the points: 0 open, 1 blocked. Requires a finished round.
  void CopyTo(std::vector<float>& means) const;

  /// Estimated RMSE of the worst tile, and of the whole image.
  double GetLargestError() const { return this->LargestError; }
  double GetMeanError() const { return this->MeanError; }

  long long GetNumberOfRays() const { return this->NumberOfRays; }

private:
  bool TraceRound(WorkLimit* limit);
  long long TraceTile(int tile);
  long long TraceBlock(glm::ivec2 first);
  void Join();
  bool StartRound();
  PixelError ErrorAt(int x, int y) const;
  glm::ivec2 FirstOfTile(int tile) const;

  OcclusionRays Rays;
  double Tolerance;
  glm::ivec2 Size;
  SiteGrid<1> Grid;
  int Round = 0;          ///< number of finished rounds
  std::vector<int> Tiles; ///< that get rays in this round
  std::vector<char> Done; ///< flags of these tiles
  long long NumberOfRays = 0;
  double LargestError = 0.0;
  double MeanError = 0.0;
  bool Complete = false;
};

}
#endif
