// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// How a renderer looks at its scene: camera, lights, background.
#ifndef penumbra_SceneExtractionView_h
#define penumbra_SceneExtractionView_h

#include "SceneExtraction.h"

class vtkRenderer;

namespace penumbra
{

/// Sets the Origin, Scale and Eye of `scene` from the renderer's camera, or resets the view to
/// `bounds` where the renderer has no camera yet (as VTK would).
void ExtractCamera(
  vtkRenderer* renderer, const double bounds[6], const ExtractionOptions& options, Scene& scene);

/// Sets Origin, Scale and Eye so that all of `bounds` is seen from the front (from +z, y up).
void ResetCamera(const double bounds[6], const ExtractionOptions& options, Scene& scene);

/// The lights that are on; VTK's automatic headlight where none is.
void ExtractLights(vtkRenderer* renderer, Scene& scene);

/// A white light along the view axis.
Light MakeHeadlight(const Scene& scene);

void ExtractBackground(vtkRenderer* renderer, const ExtractionOptions& options, Scene& scene);

}
#endif
