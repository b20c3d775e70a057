// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LayerOrder.h"

#include "Surface.h"

#include <tuple>

namespace penumbra
{

std::vector<LayerOrder::Kinds> LayerOrder::FindKinds(const std::vector<Surface>& surfaces)
{
  std::vector<Kinds> kinds;
  bool isOrdered = false;
  for (const Surface& surface : surfaces)
  {
    kinds.push_back(surface.HidesLines ? Kinds::LineMask
        : surface.ForceOpaque          ? Kinds::ForcedOpaque
        : surface.HasHiddenLines       ? Kinds::HiddenLines
        : surface.IsTranslucent()      ? Kinds::Translucent
                                       : Kinds::Opaque);
    isOrdered |= surface.HidesLines || surface.ForceOpaque;
  }
  return isOrdered ? kinds : std::vector<Kinds>();
}

// VTK draws opaque actors in their order, with the depth test. So of the hits behind one that is
// drawn, exactly those appear through it that are drawn before it and before all others in front.
bool LayerOrder::IsDrawn(Kinds kind, PrimitiveId hit)
{
  if (kind == Kinds::LineMask)
  {
    this->IsBehindMask = true;
    return false;
  }
  if (this->IsBehindMask && (kind == Kinds::HiddenLines || kind == Kinds::Translucent))
  {
    return false;
  }
  if (this->IsBehindForced &&
    (kind == Kinds::Translucent ||
      std::tie(hit.Surface, hit.Primitive) > std::tie(this->Last.Surface, this->Last.Primitive)))
  {
    return false;
  }
  if (kind == Kinds::ForcedOpaque)
  {
    this->IsBehindForced = true;
    this->Last = hit;
  }
  return true;
}

}
