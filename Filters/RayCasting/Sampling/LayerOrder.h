// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Selects the hits along a ray that VTK draws, where its order of drawing matters: behind actors
// with ForceOpaque, and behind surfaces that hide lines.
#ifndef penumbra_LayerOrder_h
#define penumbra_LayerOrder_h

#include "PrimitiveId.h"
#include "Scene.h"
#include "Surface.h"

#include <tuple>
#include <vector>

namespace penumbra
{

/// State of one ray. Hits are passed front to back.
class LayerOrder
{
public:
  /// How VTK draws a surface.
  enum class Kinds
  {
    Opaque,
    ForcedOpaque, ///< with Surface::ForceOpaque
    HiddenLines,  ///< with Surface::HasHiddenLines
    LineMask,     ///< with Surface::HidesLines
    Translucent   ///< drawn after all others
  };

  /// Returns the kind of each surface of a scene; empty if all surfaces are opaque or translucent.
  static std::vector<Kinds> FindKinds(const Scene& scene);

  /// Returns true if VTK draws the hit of a surface of `kind`.
  bool IsDrawn(Kinds kind, PrimitiveId hit);

private:
  bool IsBehindMask = false;
  bool IsBehindForced = false;
  PrimitiveId Last{}; ///< the last hit of a surface with ForceOpaque that is drawn
};

inline std::vector<LayerOrder::Kinds> LayerOrder::FindKinds(const Scene& scene)
{
  std::vector<Kinds> kinds;
  bool isOrdered = false;
  for (const Surface& surface : scene.Surfaces)
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
inline bool LayerOrder::IsDrawn(Kinds kind, PrimitiveId hit)
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
#endif
