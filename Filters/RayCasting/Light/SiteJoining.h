// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Joins the values of neighboring sites by regression in windows that grow from
// level to level.
#ifndef penumbra_SiteJoining_h
#define penumbra_SiteJoining_h

#include "SiteGrid.h"
#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro

#include <memory>
#include <vector>

namespace penumbra
{

/// Largest distance, in pixels, of the sites that a joined estimate depends on.
int GetJoiningReach();

/// Keeps what joined estimates are computed from, so that few changes take little time.
template <int N>
class VTKPENUMBRAFILTERSRAYCASTING_EXPORT SiteJoining
{
public:
  /// `grid` must outlive this object, and keep the number of sites of all pixels.
  explicit SiteJoining(SiteGrid<N>& grid);
  ~SiteJoining();

  /// Computes the joined estimates of all sites, the first time.
  void Start();

  /// Computes the estimates that change with the sites of the tiles with these indices. The result has the same bits
  /// as that of Start(). Returns the tiles that have such estimates.
  std::vector<int> Update(const std::vector<int>& tiles);

private:
  class Levels;
  std::unique_ptr<Levels> State;
};

/// Computes the joined estimates of all sites.
template <int N>
VTKPENUMBRAFILTERSRAYCASTING_EXPORT void JoinSites(SiteGrid<N>& grid);

/// Returns the joined estimate of a site, which may exceed the range of values.
template <int N>
typename LightTerms<N>::Value EvaluateSite(const SiteGrid<N>& grid, const LightSite<N>& site)
{
  const SitePatch<N>& patch = grid.Patches[site.Patch];
  const LightFeatures at(site.Position, site.Normal);
  const float rays = static_cast<float>(site.Rays[0]) + static_cast<float>(site.Rays[1]);
  typename LightTerms<N>::Value value =
    patch.Value + patch.AloneWeight * (site.Sums[0] + site.Sums[1]) / rays;
  for (int k = 0; k < LightFeatures::Count; ++k)
  {
    value += patch.Slopes[k] * (at.At[k] - patch.Mean.At[k]);
  }
  return value;
}

} // namespace penumbra
#endif
