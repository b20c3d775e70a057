// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraIrradianceSource
 * @brief   Who answers: how much of the sky does a point see?
 *
 * Shading asks a source for the blocked share of the sky above points. The default source is
 * brute force; caches are others.
 */
#ifndef vtkPenumbraIrradianceSource_h
#define vtkPenumbraIrradianceSource_h

#include "vtkObject.h"
#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro

class VTKPENUMBRAFILTERSRAYCASTING_EXPORT vtkPenumbraIrradianceSource : public vtkObject
{
public:
  vtkAbstractTypeMacro(vtkPenumbraIrradianceSource, vtkObject);

protected:
  vtkPenumbraIrradianceSource() = default;
  ~vtkPenumbraIrradianceSource() override = default;

private:
  vtkPenumbraIrradianceSource(const vtkPenumbraIrradianceSource&) = delete;
  void operator=(const vtkPenumbraIrradianceSource&) = delete;
};

#endif
