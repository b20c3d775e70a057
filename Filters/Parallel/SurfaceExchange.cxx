// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceExchange.h"

#include "Messages/RankGroup.h"
#include "Messages/SurfacePart.h"
#include "Scene.h"
#include "Statistics/Statistics.h"
#include "Surface.h"

namespace penumbra
{

void CountWhole(const Scene& scene, const std::vector<UnitedSurface>& united, RankGroup& ranks,
  ExchangeCounts& counts)
{
  std::vector<double> bytes(1, 0.0);
  for (const Surface& surface : scene.Surfaces)
  {
    bytes[0] += static_cast<double>(CountBytes(surface));
  }
  ranks.Sum(bytes);
  counts.WholeBytes = static_cast<long long>(bytes[0]);
  for (const UnitedSurface& surface : united)
  {
    counts.WholePrimitives += static_cast<long long>(surface.Count);
  }
}

std::vector<std::string> ExchangeSurfaces(
  const std::function<std::string(int)>& make, RankGroup& ranks, ExchangeCounts& counts)
{
  const long long before = ranks.GetReceivedBytes();
  std::vector<std::string> received = ranks.Exchange(make);
  counts.SceneBytes = ranks.GetReceivedBytes() - before;
  return received;
}

void CountPrimitives(const Scene& scene, ExchangeCounts& counts)
{
  for (const Surface& surface : scene.Surfaces)
  {
    counts.Primitives += static_cast<long long>(surface.GetNumberOfPrimitives());
  }
}

void AddStatistics(const ExchangeCounts& counts, vtkFieldData* fields)
{
  AddStatistic(fields, "Exchange/SceneBytes", counts.SceneBytes);
  AddStatistic(fields, "Exchange/WholeBytes", counts.WholeBytes);
  AddStatistic(fields, "Exchange/Primitives", counts.Primitives);
  AddStatistic(fields, "Exchange/WholePrimitives", counts.WholePrimitives);
}

}
