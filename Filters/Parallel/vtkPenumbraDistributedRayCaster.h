// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraDistributedRayCaster
 * @brief   Ray caster for data distributed over ranks; each rank renders a part of the image.
 *
 * The filter gathers the surfaces of all ranks on every rank, because a ray may hit any of them.
 * Each rank then renders its update extent; in ParaView, the extents divide the image evenly. The
 * pixels have the same bits as an image of the same surfaces, in the same order, rendered on a
 * single rank. On a single rank, the filter is equivalent to its superclass.
 *
 * Every rank must execute the filter. The triangles of all ranks must fit into the memory of each
 * rank.
 */
#ifndef vtkPenumbraDistributedRayCaster_h
#define vtkPenumbraDistributedRayCaster_h

#include "vtkPenumbraFiltersParallelModule.h" // for export macro
#include "vtkPenumbraRayCaster.h"

class VTKPENUMBRAFILTERSPARALLEL_EXPORT vtkPenumbraDistributedRayCaster
  : public vtkPenumbraRayCaster
{
public:
  static vtkPenumbraDistributedRayCaster* New();
  vtkTypeMacro(vtkPenumbraDistributedRayCaster, vtkPenumbraRayCaster);

protected:
  vtkPenumbraDistributedRayCaster() = default;
  ~vtkPenumbraDistributedRayCaster() override = default;

  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkPenumbraDistributedRayCaster(const vtkPenumbraDistributedRayCaster&) = delete;
  void operator=(const vtkPenumbraDistributedRayCaster&) = delete;
};

#endif
