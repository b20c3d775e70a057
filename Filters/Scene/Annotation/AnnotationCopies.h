// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Copies 2-D props, so that the copies can render into an overlay and the originals do not change.
#ifndef penumbra_AnnotationCopies_h
#define penumbra_AnnotationCopies_h

#include "vtkSmartPointer.h"

class vtkCoordinate;
class vtkProp;

namespace penumbra
{

/// Copies the value and the systems of a coordinate.
void CopyCoordinate(vtkCoordinate* from, vtkCoordinate* to);

/// Returns a copy of a 2-D prop with its settings, or null if its class or its mapper is not
/// supported. Call it while an OverlayRecorder exists.
vtkSmartPointer<vtkProp> CopyAnnotation(vtkProp* prop);

/// Returns true if `prop` is the representation of a 2-D widget that CopyAnnotation() may copy.
bool IsOverlayWidget(vtkProp* prop);

}
#endif
