// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// vtkSSAOPass as applications set it up, for comparison.
#ifndef penumbra_VTKSSAOPass_h
#define penumbra_VTKSSAOPass_h

#include "vtkSmartPointer.h"

class vtkSSAOPass;

namespace penumbra
{

/// Returns vtkSSAOPass over lights and opaque geometry, with blur. `radius` is in world units.
vtkSmartPointer<vtkSSAOPass> NewVTKSSAOPass(double radius, unsigned int samples);

}
#endif
