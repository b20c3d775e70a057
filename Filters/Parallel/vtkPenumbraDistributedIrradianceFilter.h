// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraDistributedIrradianceFilter
 * @brief   Bakes data distributed over ranks; the data of all ranks act as occluders.
 *
 * The values are those of one rank with the pieces of both inputs, appended in the order of the ranks: the same
 * bits with BRUTE_FORCE and for direct light, otherwise within the tolerance. Before a rank bakes its piece, it
 * receives the triangles, spheres and tubes of other ranks that rays from the piece may meet, with their opacity:
 * for ambient occlusion, those within Radius of the bounds of the piece; for direct light, those between the piece
 * and the lights; for irradiance, and if Radius is that of the scene, all. One warning says how many bytes these
 * are. The default of Radius is 0.1 times the diagonal of the bounds of all pieces.
 *
 * The estimated error and the statistics are those of the piece, and of the exchange: `Exchange/SceneBytes`
 * (received), `Exchange/WholeBytes` (of all surfaces), `Exchange/Primitives` (after the exchange) and
 * `Exchange/WholePrimitives`. Warnings about the data are those of the superclass, with the numbers of all ranks, on
 * the first one.
 *
 * Every rank must execute the filter, with the same settings, including ranks without data. If they differ, or if
 * one rank fails or is aborted, all ranks end with its message. On a single rank, the filter is
 * equivalent to its superclass.
 */
#ifndef vtkPenumbraDistributedIrradianceFilter_h
#define vtkPenumbraDistributedIrradianceFilter_h

#include "vtkPenumbraFiltersParallelModule.h" // for export macro
#include "vtkPenumbraIrradianceFilter.h"

class VTKPENUMBRAFILTERSPARALLEL_EXPORT vtkPenumbraDistributedIrradianceFilter
  : public vtkPenumbraIrradianceFilter
{
public:
  static vtkPenumbraDistributedIrradianceFilter* New();
  vtkTypeMacro(vtkPenumbraDistributedIrradianceFilter, vtkPenumbraIrradianceFilter);

protected:
  vtkPenumbraDistributedIrradianceFilter() = default;
  ~vtkPenumbraDistributedIrradianceFilter() override = default;

  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkPenumbraDistributedIrradianceFilter(const vtkPenumbraDistributedIrradianceFilter&) = delete;
  void operator=(const vtkPenumbraDistributedIrradianceFilter&) = delete;

  bool HasWarned = false; ///< that all surfaces are gathered
};

#endif
