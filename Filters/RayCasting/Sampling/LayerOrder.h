// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Selects the hits along a ray that VTK draws, where its order of drawing matters: behind actors
// with ForceOpaque, and behind surfaces that hide lines.
#ifndef penumbra_LayerOrder_h
#define penumbra_LayerOrder_h

#include "PrimitiveId.h"
#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro, which benchmarks need

#include <vector>

namespace penumbra
{

struct Surface;

/// State of one ray. Hits are passed front to back.
class VTKPENUMBRAFILTERSRAYCASTING_EXPORT LayerOrder
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
  static std::vector<Kinds> FindKinds(const std::vector<Surface>& surfaces);

  /// Returns true if VTK draws the hit of a surface of `kind`.
  bool IsDrawn(Kinds kind, PrimitiveId hit);

private:
  bool IsBehindMask = false;
  bool IsBehindForced = false;
  PrimitiveId Last{}; ///< the last hit of a surface with ForceOpaque that is drawn
};

}
#endif
