// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Text of 2-D props: parts that draw into an overlay and describe their text as shapes.
#ifndef penumbra_OverlayText_h
#define penumbra_OverlayText_h

#include <glm/glm.hpp>

class vtkObject;

namespace penumbra
{

class OverlayRecorder;

/// Returns a vtkTextActor whose text `recorder` draws, or null if `recorder` is null.
vtkObject* MakeTextActor(OverlayRecorder* recorder);

/// Returns a vtkTextMapper whose text `recorder` draws, or null if `recorder` is null.
vtkObject* MakeTextMapper(OverlayRecorder* recorder);

/// Adds shapes for the text of `recorder`, whose image has its lower left corner at `corner`.
void DescribeText(glm::dvec2 corner, OverlayRecorder& recorder);

}
#endif
