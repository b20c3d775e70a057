// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes that the ray caster and its truths both understand: vtkRenderers made from shapes or
// meshes, what brute force draws of them, and the ray caster's answer as plain numbers.
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

/// A mesh of triangles that fan out from the shapes' centres.
vtkSmartPointer<vtkPolyData> MeshOf(const std::vector<Shape>& shapes);

/// A sphere of diameter 1 with deep bumps, `sides` around: most of its borders lie before itself.
vtkSmartPointer<vtkPolyData> Burr(int sides = 48);

/// An empty renderer with a black background.
vtkSmartPointer<vtkRenderer> NewRenderer();

/// Shows a mesh; without `lighting` in plain white.
vtkActor* AddMesh(vtkRenderer* renderer, vtkPolyData* mesh, bool lighting);

/// A parallel camera for which world x and y are picture coordinates.
void LookAtPicture(vtkRenderer* renderer, int width, int height);

/// The view reset to the bounds, seen along `direction`.
void LookAlong(vtkRenderer* renderer, glm::dvec3 direction, glm::dvec3 up, int width, int height);

/// Unlit shapes, white on black, under LookAtPicture().
vtkSmartPointer<vtkRenderer> PictureOf(const std::vector<Shape>& shapes, int width, int height);

/// The exact share of every pixel that shapes cover.
std::vector<double> SharesOf(const std::vector<Shape>& shapes, int width, int height);

/// Everything that brute force needs to know of a renderer's actors, camera and headlight.
BruteForceScene BruteForceOf(vtkRenderer* renderer, int width, int height);

/// What the ray caster answered.
struct Answer
{
  std::vector<glm::dvec3> Colors;
  std::vector<double> Alphas;
  std::vector<double> Estimates; ///< `EstimatedError` per pixel
  double EstimatedError = 0.0;   ///< of the whole picture
  double RaysPerPixel = 0.0;
  double Seconds = 0.0; ///< of CPU time
};

/// Casts on one thread; `choose` sets tolerance, method and the like.
Answer Cast(vtkRenderer* renderer, int width, int height,
  const std::function<void(vtkPenumbraRayCaster*)>& choose = {});

}
#endif
