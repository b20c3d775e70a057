// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Statistics that the passes report as field data.
#ifndef penumbra_PassStatistics_h
#define penumbra_PassStatistics_h

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"

namespace penumbra
{

/// Adds an array with one value to the field data.
inline void AddStatistic(vtkFieldData* statistics, const char* name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  statistics->AddArray(array);
}

}
#endif
