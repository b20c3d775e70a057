// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraDistributedIrradianceFilter
 * @brief   Bakes onto data that is spread over ranks: each bakes its own piece, and sees the others'.
 *
 * Before a rank bakes its piece, the polygons of other ranks that can block it come to it: for ambient
 * occlusion those within Radius of the piece's bounds, for irradiance all. They block and throw light
 * back, but get no values there. The default of Radius is a tenth of the diagonal of the bounds of all
 * pieces. On one rank it is its superclass.
 *
 * Every rank has to execute it, also one without data.
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
