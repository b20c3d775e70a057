// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Does a data set agree with itself? A file can promise points that it does not hold.
#ifndef penumbra_DataSetValidation_h
#define penumbra_DataSetValidation_h

#include <string>

class vtkDataSet;

namespace penumbra
{

/// What is wrong with `data`: an index out of range, a cell with too few corners, an array that is
/// too short. Nothing when it is sound.
std::string FindInconsistency(vtkDataSet* data);

}
#endif
