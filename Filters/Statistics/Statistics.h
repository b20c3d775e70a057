// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Statistics of filters and passes, stored as field data.
#ifndef penumbra_Statistics_h
#define penumbra_Statistics_h

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"

#include <string>

namespace penumbra
{

/// Adds the array `name` with the single value `value`. An array of the same name is replaced.
inline void AddStatistic(vtkFieldData* statistics, const std::string& name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->InsertNextValue(value);
  statistics->AddArray(array);
}

}
#endif
