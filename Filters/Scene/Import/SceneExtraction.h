// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Extracts a Scene from VTK: actors, transforms, properties, mapped colors, lights, camera,
// background. Scene::Warnings lists unsupported features.
#ifndef penumbra_SceneExtraction_h
#define penumbra_SceneExtraction_h

#include "Annotation/VisiblePoints.h"
#include "Execution/ParallelFor.h"
#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

#include <functional>
#include <vector>

class vtkDataObject;
class vtkLight;
class vtkRenderer;

namespace penumbra
{

struct Scene;

/// Size of a light, which vtkLight lacks.
struct LightSize
{
  double Radius = 0.0; ///< of positional lights, in world units
  double Angle = 0.0;  ///< angular diameter of directional lights, in degrees
};

/// Options of ExtractScene().
struct ExtractionOptions
{
  int Resolution[2] = { 1, 1 }; ///< image size in pixels
  int DPI = 72;                 ///< scales text, line widths and point sizes
  bool Background = true;       ///< if false, the background is transparent black
  bool ClipToRange = true;      ///< if true, surfaces end at the clipping range of the camera
  bool KeepOrigin = false;      ///< if true, the origin does not follow the camera, if possible
  double PointRadius = 0.0;     ///< world units: points are spheres; 0: as their property requests
  double LineRadius = 0.0;      ///< world units: lines are tubes; 0: as their property requests
  std::function<LightSize(vtkLight*)> GetLightSize; ///< if empty, lights have no size
  DepthQuery FindDepths;     ///< for labels of visible points; if empty, all points are visible
  ProgressCallback Progress; ///< on a stop request, ExtractScene() throws Stopped
};

/// Extracts the scene of `renderer` for an image of options.Resolution. The renderer does not need
/// a window.
VTKPENUMBRAFILTERSSCENE_EXPORT Scene ExtractScene(
  vtkRenderer* renderer, const ExtractionOptions& options);

/// Replaces camera, lights, background and overlay of `scene`, which was extracted from `renderer`
/// with the same options. Its warnings become those of these parts. Returns false, with `scene`
/// unchanged, unless its origin is fixed and also the one that ExtractScene() would choose now.
/// The scene then equals a newly extracted one if GetGeometryMTime() has not changed.
VTKPENUMBRAFILTERSSCENE_EXPORT bool UpdateView(
  vtkRenderer* renderer, const ExtractionOptions& options, Scene& scene);

/// Extracts a scene of data sets with white surfaces, one headlight and the camera reset to their
/// bounds.
VTKPENUMBRAFILTERSSCENE_EXPORT Scene ExtractScene(
  const std::vector<vtkDataObject*>& data, const ExtractionOptions& options);

}
#endif
