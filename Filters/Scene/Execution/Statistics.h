// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// How algorithms tell what they did.
#ifndef penumbra_Statistics_h
#define penumbra_Statistics_h

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"

#include <string>

namespace penumbra
{

/// One number under a name of the field data.
inline void AddStatistic(vtkFieldData* statistics, const std::string& name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->InsertNextValue(value);
  statistics->AddArray(array);
}

}
#endif
