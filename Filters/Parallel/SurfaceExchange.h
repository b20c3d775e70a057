// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The exchange of parts of surfaces between ranks, and what it has cost.
#ifndef penumbra_SurfaceExchange_h
#define penumbra_SurfaceExchange_h

#include "SceneUnion.h"

#include <functional>
#include <string>
#include <vector>

class vtkFieldData;

namespace penumbra
{

/// What the ranks of a parallel program have exchanged for an image or for baking.
struct ExchangeCounts
{
  long long SceneBytes = 0;      ///< of surfaces, received by this rank
  long long WholeBytes = 0;      ///< of all surfaces of all ranks
  long long Primitives = 0;      ///< that this rank has after the exchange
  long long WholePrimitives = 0; ///< of all ranks
  long long PixelBytes = 0;      ///< of parts of the image, received by this rank
  long long Rays = 0;            ///< traced by this rank
};

/// Counts the surfaces of all ranks. Collective.
void CountWhole(const Scene& scene, const std::vector<UnitedSurface>& united, RankGroup& ranks,
  ExchangeCounts& counts);

/// Sends the message make(r) to rank r. Returns the messages for this rank, by sender. Collective.
std::vector<std::string> ExchangeSurfaces(
  const std::function<std::string(int)>& make, RankGroup& ranks, ExchangeCounts& counts);

/// Counts the primitives that this rank has after the exchange.
void CountPrimitives(const Scene& scene, ExchangeCounts& counts);

/// Adds the statistics `Exchange/SceneBytes`, `WholeBytes`, `Primitives` and `WholePrimitives`.
void AddStatistics(const ExchangeCounts& counts, vtkFieldData* fields);

}
#endif
