// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraDistributedIrradianceFilter
 * @brief   Bakes data distributed over ranks; the data of all ranks act as occluders.
 *
 * Before a rank bakes its piece, it receives the polygons of other ranks that can occlude the
 * piece: for ambient occlusion, those within Radius of the piece's bounds; for irradiance and
 * direct light, all. These polygons block and reflect light, but no values are computed on them.
 * The default of Radius is 0.1 times the diagonal of the bounds of all pieces. On a single rank,
 * the filter is equivalent to its superclass.
 *
 * Every rank must execute the filter, including ranks without data.
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
};

#endif
