// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraImageComparison
 * @brief   How far one picture is from another.
 */
#ifndef vtkPenumbraImageComparison_h
#define vtkPenumbraImageComparison_h

#include "vtkObject.h"
#include "vtkPenumbraTestingComparisonModule.h" // for export macro

class VTKPENUMBRATESTINGCOMPARISON_EXPORT vtkPenumbraImageComparison : public vtkObject
{
public:
  static vtkPenumbraImageComparison* New();
  vtkTypeMacro(vtkPenumbraImageComparison, vtkObject);

protected:
  vtkPenumbraImageComparison() = default;
  ~vtkPenumbraImageComparison() override = default;

private:
  vtkPenumbraImageComparison(const vtkPenumbraImageComparison&) = delete;
  void operator=(const vtkPenumbraImageComparison&) = delete;
};

#endif
