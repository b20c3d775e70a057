// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes of the benchmark `limits`: adversarial scenes of any size, single scenes that were once
// slow, and the plain mesh that each is compared with.
#ifndef penumbra_LimitScenes_h
#define penumbra_LimitScenes_h

#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <vector>

class vtkPolyData;
class vtkProperty;
class vtkRenderer;

namespace penumbra
{

struct LimitScene
{
  enum class Tasks
  {
    Draw,
    DrawWithOcclusion,
    Bake
  };
  std::string Name;
  Tasks Task = Tasks::Draw;
  int Primitives = 0; ///< number of triangles or lines
  int Width = 256;    ///< of the image, in pixels
  int Height = 256;
  std::function<vtkSmartPointer<vtkPolyData>()> MakeMesh;
  /// Changes the property of the actor, or null.
  std::function<void(vtkProperty*)> Prepare = {};
  bool ResetCamera = false; ///< shows the whole mesh, whatever its coordinates are
};

/// A family of scenes: an adversary that is drawn, drawn with occlusion, or baked.
struct LimitFamily
{
  std::string Name;
  std::string Adversary;
  LimitScene::Tasks Task;
};

/// All families whose growth is measured.
const std::vector<LimitFamily>& GetLimitFamilies();

/// Returns the scene of a family with n primitives.
LimitScene MakeScene(const LimitFamily& family, int n);

/// Returns single scenes. `data`: folder of the meshes of the repository.
std::vector<LimitScene> MakeSingleScenes(const std::string& data);

/// Returns a smooth mesh with as many primitives as `scene`, which fills its image and is drawn or
/// baked in the same way.
LimitScene MakePlainScene(const LimitScene& scene);

/// Draws or bakes the mesh of the scene on one thread.
void RunScene(const LimitScene& scene, vtkPolyData* mesh);

}
#endif
