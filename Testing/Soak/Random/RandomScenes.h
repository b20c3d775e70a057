// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Random scenes with random settings of the ray caster. The seed determines both.
#ifndef penumbra_soak_RandomScenes_h
#define penumbra_soak_RandomScenes_h

#include "vtkSmartPointer.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

class vtkPenumbraRayCaster;
class vtkRenderWindow;
class vtkRenderer;

namespace penumbra_soak
{

/// Width and height of the images of the scenes, in pixels.
constexpr int ImageSide = 96;

struct RandomScene
{
  vtkSmartPointer<vtkRenderWindow> Window;
  vtkSmartPointer<vtkRenderer> Renderer;
  std::string Description;
  double Tolerance = 1.0 / 256.0;
  bool Shadows = false;
  /// Light that needs its own sampling: occlusion, indirect light, media, lights with a size.
  bool Effects = false;
  /// Radii, layers or props that only the ray caster draws.
  bool NeedsCaster = false;
  /// VTK's image is a reference for large regions.
  bool ComparesWithVTK = true;
  bool ComparesTiles = true;
  /// Sets everything of the caster that the scene chooses.
  std::function<void(vtkPenumbraRayCaster*)> Choose;
  /// Sets what VTK draws too.
  std::function<void(vtkPenumbraRayCaster*)> ChoosePlain;
};

/// Makes a scene. `kept`: indices of the props to keep, all if empty. `effects` multiplies the
/// probabilities of light effects. `extras`: see AddRandomExtras().
RandomScene MakeRandomScene(
  std::uint64_t seed, const std::vector<int>& kept = {}, double effects = 1.0, bool extras = false);

}
#endif
