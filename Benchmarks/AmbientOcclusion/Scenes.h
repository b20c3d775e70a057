// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The scenes of the benchmark, each with its camera and radius.
#ifndef penumbra_Scenes_h
#define penumbra_Scenes_h

#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

namespace penumbra
{

struct OcclusionBenchmarkScene
{
  std::string Name;
  vtkSmartPointer<vtkRenderer> Renderer; ///< white, unlit
  double Radius;
};

/// 400 spheres at five heights over a plane.
OcclusionBenchmarkScene Spheres400();

/// Three scanned meshes on a plane; `folder` holds the files of libcgal-demo.
OcclusionBenchmarkScene Scans(const std::string& folder);

/// Sticks, plates and boxes, turned every way: thin things, whose backs one layer of depth hides.
OcclusionBenchmarkScene Sticks();

}
#endif
