// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// From VTK to Scene: actors, transforms, properties, mapper colours, lights, camera, background.
// What cannot be drawn is named in Scene::Warnings.
#ifndef penumbra_SceneExtraction_h
#define penumbra_SceneExtraction_h

#include "Execution/ParallelFor.h"
#include "Scene.h"
#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

#include <vector>

class vtkDataObject;
class vtkRenderer;

namespace penumbra
{

struct ExtractionOptions
{
  int Resolution[2] = { 1, 1 };
  int DPI = 72;
  bool Background = true;
  ProgressCallback Progress; ///< asked to stop, the functions below throw Stopped
};

/// The scene that `renderer` would draw into a picture of options.Resolution. Needs no window.
VTKPENUMBRAFILTERSSCENE_EXPORT Scene ExtractScene(
  vtkRenderer* renderer, const ExtractionOptions& options);

/// The scene of data sets alone: white surfaces, one headlight, the view reset to their bounds.
VTKPENUMBRAFILTERSSCENE_EXPORT Scene ExtractScene(
  const std::vector<vtkDataObject*>& data, const ExtractionOptions& options);

}
#endif
