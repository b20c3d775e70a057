// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Fixtures of all scenarios: images rendered by the ray caster and by OpenGL, and mesh helpers.
#ifndef penumbra_stability_Frames_h
#define penumbra_stability_Frames_h

#include "Metrics.h"

#include "vtkSmartPointer.h"

#include <functional>
#include <glm/glm.hpp>

class vtkAlgorithm;
class vtkPenumbraRayCaster;
class vtkPolyData;
class vtkRenderer;

namespace penumbra
{

using Choice = std::function<void(vtkPenumbraRayCaster*)>;

/// Returns the green channel of the ray caster's image. Renders on one thread unless `choose` sets
/// another number.
Frame ByRays(vtkRenderer* renderer, int width, int height, const Choice& choose = {});

/// Returns the green channel of an image by OpenGL, with the given number of samples per pixel.
Frame ByOpenGL(vtkRenderer* renderer, int width, int height, int samples = 0);

/// Updates a source and returns its output.
vtkSmartPointer<vtkPolyData> DataOf(vtkAlgorithm* source);

/// Returns a copy of a mesh with every position mapped by a function.
vtkSmartPointer<vtkPolyData> Deformed(
  vtkPolyData* mesh, const std::function<glm::dvec3(glm::dvec3)>& transform);

/// Returns the absolute values times `gain`, to make errors visible.
Frame Amplified(const Frame& frame, double gain);

}
#endif
