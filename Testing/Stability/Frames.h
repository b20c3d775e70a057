// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the scenarios share: pictures as frames, by the ray caster and by OpenGL.
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

/// The green of the ray caster's picture, on one thread unless `choose` says otherwise.
Frame ByRays(vtkRenderer* renderer, int width, int height, const Choice& choose = {});

/// The green of OpenGL's, with so many samples a pixel.
Frame ByOpenGL(vtkRenderer* renderer, int width, int height, int samples = 0);

/// The output of a source.
vtkSmartPointer<vtkPolyData> DataOf(vtkAlgorithm* source);

/// Every position moved by a function.
vtkSmartPointer<vtkPolyData> Deformed(
  vtkPolyData* mesh, const std::function<glm::dvec3(glm::dvec3)>& place);

/// A picture of |values| times `gain`, to show errors.
Frame Amplified(const Frame& frame, double gain);

}
#endif
