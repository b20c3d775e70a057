// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraDistributedRayCaster
 * @brief   A ray-cast picture of data that is spread over ranks: each draws a part of the picture.
 *
 * The surfaces of all ranks go to all ranks: a ray may meet any of them. Then each draws the extent that
 * it is asked for, in ParaView an even share of the picture. The pixels are those that one rank draws of
 * the same surfaces in the same order, bit by bit. On one rank it is its superclass.
 *
 * Every rank has to execute it. All triangles have to fit into the memory of each.
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
