// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes with colored walls, and the skies that light them.
#ifndef penumbra_light_SkyScenes_h
#define penumbra_light_SkyScenes_h

#include "Scene.h"
#include "Shading/Illumination.h"

#include "vtkPenumbraEnvironment.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkPolyData;
class vtkRenderer;

namespace penumbra
{

struct LightBenchmark;

/// Side of the image of the scenes, in pixels.
constexpr int SkyImageSize = 192;

/// Reads head.ply. Throws std::runtime_error if that fails.
vtkSmartPointer<vtkPolyData> ReadHead(const LightBenchmark& benchmark);

/// Boxes of several colors on a plane, with a blue and a red wall.
Scene MakeBoxScene();

/// The mesh `head` upright on a plane between a blue and a red wall.
Scene MakeHeadScene(vtkPolyData* head);

/// Renderers of the same scenes.
vtkSmartPointer<vtkRenderer> MakeBoxRenderer();
vtkSmartPointer<vtkRenderer> MakeHeadRenderer(vtkPolyData* head);

/// Boxes and the mesh `head` on a plane of many points, to bake.
vtkSmartPointer<vtkPolyData> MakeBakedMesh(vtkPolyData* head);

/// A sky, up is +z.
struct MeasuredSky
{
  std::string Name;
  glm::dvec3 Color{ 1.0 }; ///< radiance, if Environment is null
  vtkSmartPointer<vtkPenumbraEnvironment> Environment;
  double MeanRadiance = 1.0; ///< over the sphere, of the largest channel
};

/// An environment map of smooth colors, or one with a sun of radiance 1e5 in a blue sky.
MeasuredSky MakeColoredSky();
MeasuredSky MakeSunSky();

IlluminationSettings MakeIlluminationSettings(const MeasuredSky& sky);

}
#endif
