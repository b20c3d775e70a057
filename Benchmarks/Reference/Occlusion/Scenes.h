// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Test scenes for ambient occlusion, each with its camera and radius, for benchmarks and charts.
#ifndef penumbra_occlusion_Scenes_h
#define penumbra_occlusion_Scenes_h

#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

#include <string>

class vtkPolyData;
class vtkTransform;

namespace penumbra
{

struct OcclusionTestScene
{
  std::string Name;
  vtkSmartPointer<vtkRenderer> Renderer; ///< white, unlit
  double Radius;
};

/// 400 spheres at five heights above a plane.
OcclusionTestScene Spheres400();

/// Sticks, plates and boxes in random orientations: thin objects whose back faces are missing in a
/// single depth layer.
OcclusionTestScene Sticks();

/// Three scans on a plane: ChineseDragon-10kv, armadillo and refined_elephant of libcgal-demo.
OcclusionTestScene Scans(vtkPolyData* dragon, vtkPolyData* armadillo, vtkPolyData* elephant);

///@{
/// Parts of these scenes: a transformed mesh, rendered in white regardless of the lights; the plane
/// at `z`; the camera.
vtkSmartPointer<vtkPolyData> Moved(vtkPolyData* mesh, vtkTransform* transform);
void Show(vtkRenderer* renderer, vtkPolyData* mesh);
void ShowPlane(vtkRenderer* renderer, double low, double high, double z);
void Look(vtkRenderer* renderer, const double eye[3], const double target[3], double angle);
///@}

}
#endif
