// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// One small scene per row of the table of VTK's rendering features.
#ifndef FeatureScenes_h
#define FeatureScenes_h

#include "Features/SceneFeatures.h"

#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <functional>
#include <vector>

/// Scene that uses a feature.
struct FeatureScene
{
  penumbra::Feature Key;
  /// Adds the scene. The camera is reset before and the clipping range is not changed afterwards.
  std::function<void(vtkRenderer*, vtkRenderWindow*)> Build;
  /// Maximum fraction of pixels that may differ from VTK's image. Text and axes are placed by
  /// whole pixels, which moves their outlines.
  double MaximumDifferent = 0.002;
};

/// Scenes of all rows that the linked VTK can draw in a test. Rows may have several scenes.
std::vector<FeatureScene> MakeFeatureScenes();

#endif
