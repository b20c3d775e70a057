// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes for the accuracy of images and of their error estimates. They were not used to choose any
// constant of the ray caster.
#ifndef penumbra_AccuracyScenes_h
#define penumbra_AccuracyScenes_h

#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <vector>

class vtkPolyData;
class vtkRenderer;

namespace penumbra
{

struct AccuracyScene
{
  std::string Name;
  std::function<void(vtkRenderer*)> Build; ///< adds props, sets camera and background
  bool Shadows = false;
};

/// Gyroids, adversaries, foliage, text, hair, moire patterns, textures, glass, highlights, triangle
/// soups from outside and inside, wide and narrow view angles, with shadows.
const std::vector<AccuracyScene>& GetAccuracyScenes();

/// Returns a gyroid with about `triangles` triangles in [-1, 1]^3; without `smooth` it has no
/// normals.
vtkSmartPointer<vtkPolyData> MakeGyroid(double triangles, bool smooth);

/// Adds a gyroid with about `trianglesPerPixel` triangles per pixel of an image of `side` x `side`
/// pixels.
void BuildGyroid(vtkRenderer* renderer, double trianglesPerPixel, bool smooth, int side);

/// Side in pixels of the square images of the scenes.
constexpr int AccuracyImageSide = 128;

}
#endif
