// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Cells of a plane for surfaces of many overlapping triangles in one plane, such as a polygon that
// intersects itself. All triangles that a ray hits are equally far, so that boxes cannot exclude
// any: a ray tests a number of triangles proportional to that of the surface. A rectangular cell
// lists the triangles that overlap it only up to the first one that covers it.
#ifndef penumbra_PlanarCells_h
#define penumbra_PlanarCells_h

#include "AxisAlignedBox.h"
#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro, which tests need

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace penumbra
{

struct Surface;

struct BoxOverlap;

/// Returns true if all triangles of a surface are in one plane, up to rounding errors.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT bool IsPlanar(const Surface& surface);

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT PlanarCells
{
public:
  /// Returns the cells if all triangles of the surface are in one plane and overlap so much that
  /// cells are worth their time, otherwise null. `overlap` is that of the surface. Surfaces with
  /// culled sides, lines and points have no cells.
  static std::shared_ptr<const PlanarCells> MakeIfUseful(
    const Surface& surface, const BoxOverlap& overlap);

  std::size_t GetNumberOfCells() const { return this->Boxes.size(); }

  /// Returns the box of a cell, enlarged by rounding errors.
  const AxisAlignedBox& GetBox(std::size_t cell) const { return this->Boxes[cell]; }

  /// Calls visit(triangle) for the triangles that overlap a cell, those in front first, until one
  /// covers it or `visit` returns true. The one with the lowest index is in front, or, if triangles
  /// have colors, the one with the highest index, which VTK draws last.
  template <typename Visit>
  void VisitTriangles(std::size_t cell, Visit visit) const
  {
    for (std::uint32_t i = this->Firsts[cell]; i < this->Firsts[cell + 1]; ++i)
    {
      if (visit(this->Triangles[i]))
      {
        return;
      }
    }
  }

private:
  friend class PlanarCellBuilder;

  std::vector<AxisAlignedBox> Boxes;
  std::vector<std::uint32_t> Firsts{ 0 }; ///< indices into Triangles, per cell, and their number
  std::vector<std::uint32_t> Triangles;   ///< grouped by cells
};

}
#endif
