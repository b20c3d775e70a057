// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes for comparing the ray caster with references: vtkRenderers built from shapes or meshes,
// the equivalent brute-force scene, and the result of the ray caster as plain arrays.
#ifndef penumbra_TestScene_h
#define penumbra_TestScene_h

#include "BruteForce/BruteForce.h"
#include "Shapes.h"

#include "vtkPenumbraRayCaster.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <vector>

class vtkActor;
class vtkPolyData;
class vtkRenderer;

namespace penumbra
{

/// Builds a mesh of triangle fans around the centers of the shapes.
vtkSmartPointer<vtkPolyData> MeshOf(const std::vector<Shape>& shapes);

/// Builds a bumpy sphere of diameter 1 with `sides` facets around; most of its silhouettes lie in
/// front of the sphere itself.
vtkSmartPointer<vtkPolyData> Burr(int sides = 48);

/// Creates an empty renderer with a black background.
vtkSmartPointer<vtkRenderer> NewRenderer();

/// Adds a mesh; without `lighting` it is rendered in plain white.
vtkActor* AddMesh(vtkRenderer* renderer, vtkPolyData* mesh, bool lighting);

/// Sets a parallel camera for which world x and y are pixel coordinates.
void LookAtImage(vtkRenderer* renderer, int width, int height);

/// Resets the camera to the bounds, looking along `direction`.
void LookAlong(vtkRenderer* renderer, glm::dvec3 direction, glm::dvec3 up, int width, int height);

/// Builds a scene of unlit white shapes on black with LookAtImage().
vtkSmartPointer<vtkRenderer> RendererOf(const std::vector<Shape>& shapes, int width, int height);

/// Exact coverage of every pixel by the shapes.
std::vector<double> SharesOf(const std::vector<Shape>& shapes, int width, int height);

/// Converts the actors, the camera and the headlight of a renderer for brute force.
BruteForceScene BruteForceOf(vtkRenderer* renderer, int width, int height);

/// Result of the ray caster.
struct Answer
{
  std::vector<glm::dvec3> Colors;
  std::vector<double> Alphas;
  std::vector<double> Estimates; ///< `EstimatedError` per pixel
  double EstimatedError = 0.0;   ///< of the whole image
  double RaysPerPixel = 0.0;
  double Seconds = 0.0; ///< of CPU time
};

/// Casts on one thread; `choose` sets the tolerance, the method and other settings.
Answer Cast(vtkRenderer* renderer, int width, int height,
  const std::function<void(vtkPenumbraRayCaster*)>& choose = {});

}
#endif
