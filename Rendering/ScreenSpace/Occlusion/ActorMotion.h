// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Finds actors that moved as rigid bodies since the last frame, and renders which pixels show them.
// Temporal reprojection uses their matrices to find the history of moving surfaces.
#ifndef penumbra_ActorMotion_h
#define penumbra_ActorMotion_h

#include "Frame/EyeDepth.h"

#include <map>
#include <utility>
#include <vector>

class vtkActor;
class vtkRenderer;

namespace penumbra
{

class ActorMotion
{
public:
  /// Compares the renderer's actors with those of the last call. Must be called when they are
  /// rendered.
  void UpdateMotion(vtkRenderer* renderer);

  /// Treats all actors as unmoved in this frame.
  void ClearMotion() { this->MovedActors.clear(); }

  /// Draws the actors that moved, with the view of `image`. Returns false if there are none or if
  /// OpenGL reports an error. `depth`: eye depths of this frame and the last one.
  bool Draw(vtkRenderer* renderer, DelegateImage& image, const EyeDepth& depth);

  /// Image that Draw() fills. Alpha: number of the visible actor / 255, starting at 1; 0 if it has
  /// not moved.
  vtkTextureObject* GetTarget() const { return this->Target; }

  /// One row per actor of Draw(): the four columns of the matrix from eye coordinates to those of
  /// the last frame.
  vtkTextureObject* GetMatrices() const { return this->Matrices; }

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  /// Matrix of an actor and modification time of its mesh.
  struct ActorState
  {
    Matrix ToWorld{};
    vtkMTimeType MeshTime = 0;
  };
  struct Motion
  {
    vtkActor* Actor;
    Matrix ToWorld;
    Matrix ToWorldBefore; ///< from world coordinates of this frame to those of the last one
  };

  static bool IsMotion(const ActorState& before, const ActorState& now, Matrix& toWorldBefore);

  /// State of each actor in the last frame. The number distinguishes the occurrences of an actor
  /// that is part of several assemblies.
  std::map<std::pair<vtkActor*, int>, ActorState> Last;
  std::vector<Motion> MovedActors;
  vtkSmartPointer<vtkTextureObject> Target;
  vtkSmartPointer<vtkTextureObject> Matrices;
};

}
#endif
