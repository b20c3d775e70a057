// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Copies mappers of labels, so that the copies can render into an overlay.
#ifndef penumbra_LabelCopies_h
#define penumbra_LabelCopies_h

#include "vtkSmartPointer.h"

class vtkMapper2D;

namespace penumbra
{

/// Returns a copy of a vtkLabeledDataMapper or vtkLabelPlacementMapper, or null for other mappers.
/// Call it while an OverlayRecorder exists.
vtkSmartPointer<vtkMapper2D> CopyLabelMapper(vtkMapper2D* mapper);

}
#endif
