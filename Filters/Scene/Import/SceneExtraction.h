// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Extracts a Scene from VTK: actors, transforms, properties, mapped colors, lights, camera,
// background. Scene::Warnings lists unsupported features.
#ifndef penumbra_SceneExtraction_h
#define penumbra_SceneExtraction_h

#include "Annotation/VisiblePoints.h"
#include "Execution/ParallelFor.h"
#include "Tessellation/DepthOffset.h"
#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

#include "vtkBoundingBox.h"
#include "vtkType.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

class vtkDataObject;
class vtkLight;
class vtkProp;
class vtkRenderer;

namespace penumbra
{

struct Scene;
struct SurfaceChange;

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
  /// Called with the bounds of what is shown (Low > High: nothing) and the largest radius of spheres and
  /// tubes, in world units, which it may enlarge by those of other processes. Empty: there are none.
  std::function<void(double bounds[6], double& radius)> UniteExtent;
  DepthQuery FindDepths;     ///< for labels of visible points; if empty, all points are visible
  ProgressCallback Progress; ///< on a stop request, ExtractScene() throws Stopped
};

/// What a prop of a renderer has added to a scene.
struct PropRecord
{
  vtkProp* Prop = nullptr;
  vtkMTimeType Time = 0; ///< of all objects that were read
  vtkBoundingBox Bounds; ///< visible ones, in world coordinates
  int FirstObject = 0;   ///< id of its first object
  int NumberOfObjects = 0;
  double LargestRadius = 0.0; ///< of its spheres and tubes, in world units
  std::vector<std::string> Warnings;
  std::size_t FirstSurface = 0; ///< index into Scene::Surfaces
  std::size_t NumberOfSurfaces = 0;
};

/// What ExtractScene() has read of a renderer. Without props if the surfaces depend on the view or on
/// each other, so that they cannot be updated in parts.
struct SceneRecord
{
  std::vector<PropRecord> Props; ///< in the order of their surfaces
  DepthOffset FarthestOffset;    ///< of all polygons
};

/// Extracts the scene of `renderer` for an image of options.Resolution. The renderer does not need
/// a window. Stores the props in `record` if it is not null and the scene has a fixed origin.
VTKPENUMBRAFILTERSSCENE_EXPORT Scene ExtractScene(
  vtkRenderer* renderer, const ExtractionOptions& options, SceneRecord* record = nullptr);

/// Extracts the camera, the lights, the background, the overlay and those props again that have changed
/// since ExtractScene() or this function filled `scene` and `record`, with the same options. Calls
/// `update` with the changed surfaces after they are replaced and before labels are extracted, which
/// may need depths. Returns false, with `scene` unchanged, unless this is possible: props were added
/// or removed, a prop has more surfaces than before, the origin of the scene moves, or surfaces now depend on
/// the view. `scene` otherwise equals a newly extracted one, except that surfaces of
/// hidden props become empty.
VTKPENUMBRAFILTERSSCENE_EXPORT bool UpdateScene(vtkRenderer* renderer,
  const ExtractionOptions& options, SceneRecord& record, Scene& scene,
  const std::function<void(const std::vector<SurfaceChange>&)>& update);

/// Extracts a scene of data sets with white surfaces, one headlight and the camera reset to their
/// bounds.
VTKPENUMBRAFILTERSSCENE_EXPORT Scene ExtractScene(
  const std::vector<vtkDataObject*>& data, const ExtractionOptions& options);

}
#endif
