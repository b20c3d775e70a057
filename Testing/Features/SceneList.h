// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Collects the scenes of the feature table.
#ifndef SceneList_h
#define SceneList_h

#include "FeatureScenes.h"

#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <vector>

using Renderer = vtkRenderer*;
using Window = vtkRenderWindow*;

/// Collects scenes.
struct SceneList
{
  std::vector<FeatureScene> Scenes;

  /// Adds a scene. `different` is the maximum fraction of different pixels.
  template <typename Function>
  void operator()(penumbra::Feature key, Function&& build, double different = 0.002)
  {
    this->Scenes.push_back({ key, build, different });
  }
};

/// Adds the scenes of mappers and props other than vtkPolyDataMapper and its actors.
void AddOtherProps(SceneList& add);

/// Adds the scenes of coincident surfaces, lines and points.
void AddCoincident(SceneList& add);

/// Adds scenes of edges, which have the opacity and the visible sides of their faces.
void AddEdges(SceneList& add);

/// Adds scenes of image-based lighting.
void AddEnvironments(SceneList& add);

/// Adds scenes of labels of visible points.
void AddVisiblePoints(SceneList& add);

/// Adds scenes of widgets, 2-D charts, and actors of lights and cameras.
void AddWidgets(SceneList& add);

#endif
