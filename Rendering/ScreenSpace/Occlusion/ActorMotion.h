// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Actors that have moved as rigid bodies since the last frame: from where, and which pixels show
// them. With it a history finds the points of what moves, where depth alone shows another surface.
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
  /// Finds which of the renderer's actors moved since the last call; to be called when they are drawn.
  void UpdateMotion(vtkRenderer* renderer);

  /// Nothing has moved since the last call.
  void ClearMotion() { this->MovedActors.clear(); }

  /// Draws the actors that moved, as Draw() of `image` did the scene. False when there are none, or
  /// when OpenGL refuses. `depth`: of this frame and the last one.
  bool Draw(vtkRenderer* renderer, DelegateImage& image, const EyeDepth& depth);

  /// The picture of Draw(). Alpha: the number of the actor that a pixel shows, from 1, in 255ths; 0
  /// where nothing moved.
  vtkTextureObject* GetTarget() const { return this->Target; }
  std::vector<unsigned char> ReadNumbers() const;

  /// A row an actor of Draw(): the four columns of the matrix from eye coordinates to those of the
  /// last frame.
  vtkTextureObject* GetMatrices() const { return this->Matrices; }

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  /// An actor's place, and when its mesh was changed.
  struct ActorState
  {
    Matrix ToWorld{};
    vtkMTimeType MeshTime = 0;
  };
  struct Motion
  {
    vtkActor* Actor;
    Matrix ToWorld;
    Matrix ToWorldBefore; ///< from world to world
  };

  static bool IsMotion(const ActorState& before, const ActorState& now, Matrix& toWorldBefore);

  /// By actor and, of those that are part of several assemblies, number.
  std::map<std::pair<vtkActor*, int>, ActorState> Last;
  std::vector<Motion> MovedActors;
  vtkSmartPointer<vtkTextureObject> Target;
  vtkSmartPointer<vtkTextureObject> Matrices;
};

}
#endif
