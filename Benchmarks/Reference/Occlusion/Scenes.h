// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes under ambient occlusion, each with its camera and radius, for benchmarks and charts.
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

/// 400 spheres at five heights over a plane.
OcclusionTestScene Spheres400();

/// Sticks, plates and boxes, turned every way: thin things, whose backs one layer of depth hides.
OcclusionTestScene Sticks();

/// Three scans on a plane: ChineseDragon-10kv, armadillo and refined_elephant of libcgal-demo.
OcclusionTestScene Scans(vtkPolyData* dragon, vtkPolyData* armadillo, vtkPolyData* elephant);

///@{
/// What such scenes are made of: a mesh that is moved, and shown in white whatever the light; the plane
/// at `z`; the camera.
vtkSmartPointer<vtkPolyData> Moved(vtkPolyData* mesh, vtkTransform* transform);
void Show(vtkRenderer* renderer, vtkPolyData* mesh);
void ShowPlane(vtkRenderer* renderer, double low, double high, double z);
void Look(vtkRenderer* renderer, const double eye[3], const double target[3], double angle);
///@}

}
#endif
