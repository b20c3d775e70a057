// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Extracts the camera, the lights and the background of a renderer.
#ifndef penumbra_SceneExtractionView_h
#define penumbra_SceneExtractionView_h

#include "Light.h"
#include "SceneExtraction.h"
#include "Tessellation/SceneExtractionItem.h"

#include <string>
#include <vector>

class vtkRenderer;

namespace penumbra
{

/// Returns the shear, mirroring and non-uniform scale of the view transform of the renderer's camera,
/// as a transform of world coordinates that precedes a rigid camera. Identity if there is none.
glm::dmat4 FindViewDistortion(vtkRenderer* renderer);

/// Transforms items and bounds by a view distortion.
void ApplyViewDistortion(const glm::dmat4& distortion, std::vector<DrawItem>& items,
  double bounds[6], std::vector<std::string>& warnings);

/// Sets Origin, Scale and ViewCamera of `scene` from the renderer's camera. If the renderer has no
/// camera yet, the view is reset to `bounds`, as VTK would do. `bounds` are distorted.
void ExtractCamera(vtkRenderer* renderer, const double bounds[6], const ExtractionOptions& options,
  const glm::dmat4& distortion, Scene& scene);

/// Returns the near and far plane of the renderer's camera in world coordinates, as
/// DrawItem::ClippingPlanes. Empty if `bounds` lies between them. A near plane closer than 1e-6 of
/// the far plane, which VTK never sets by itself, does not clip.
std::vector<glm::dvec4> FindClippingRange(
  vtkRenderer* renderer, const double bounds[6], const glm::dmat4& distortion);

/// Sets Origin, Scale and ViewCamera so that `bounds` is fully visible from +z, with y up.
void ResetCamera(const double bounds[6], const ExtractionOptions& options, Scene& scene);

/// Adds the lights that are on. If there are none, adds VTK's automatic headlight.
void ExtractLights(vtkRenderer* renderer, const ExtractionOptions& options,
  const glm::dmat4& distortion, Scene& scene);

/// Returns a white light along the view axis.
Light MakeHeadlight(const Scene& scene);

/// Sets BackgroundColors of `scene`, if options.Background is on.
void ExtractBackground(vtkRenderer* renderer, const ExtractionOptions& options, Scene& scene);

}
#endif
