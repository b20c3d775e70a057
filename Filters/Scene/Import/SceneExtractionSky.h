// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Extracts vtkSkybox as a background.
#ifndef penumbra_SceneExtractionSky_h
#define penumbra_SceneExtractionSky_h

class vtkProp;
class vtkRenderer;

namespace penumbra
{

struct Scene;

/// Returns true if ExtractSky() draws this prop: a vtkSkybox with cube or sphere projection and a
/// texture of that kind.
bool IsSky(vtkProp* prop);

/// Sets the sky of scene.BackgroundColors to the last visible skybox of `renderer`, if any. The
/// camera of `scene` must be set.
void ExtractSky(vtkRenderer* renderer, Scene& scene);

/// Sets the light of the environment texture if `renderer` uses image-based lighting. Keeps that of
/// `scene` if nothing has changed.
void ExtractEnvironmentLight(vtkRenderer* renderer, Scene& scene);

}
#endif
