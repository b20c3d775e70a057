// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraImageComparison.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkPenumbraImageComparison);
