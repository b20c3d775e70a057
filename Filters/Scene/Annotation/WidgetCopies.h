// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Copies of the representations of 2-D widgets, which draw into an overlay instead of a window.
#ifndef penumbra_WidgetCopies_h
#define penumbra_WidgetCopies_h

#include "vtkSmartPointer.h"

class vtkProp;

namespace penumbra
{

/// Returns true if CopyWidget() may copy `prop`.
bool IsOverlayWidget(vtkProp* prop);

/// Returns a copy of the representation of a slider, button or logo that the current OverlayRecorder
/// draws, or null if `prop` is another one.
vtkSmartPointer<vtkProp> CopyWidget(vtkProp* prop);

}
#endif
