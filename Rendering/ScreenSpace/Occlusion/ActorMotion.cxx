// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ActorMotion.h"

#include "Frame/OpenGLFunctions.h"
#include "Frame/ScopedCamera.h"
#include "Frame/Stage.h"
#include "vtkActor.h"
#include "vtkAssemblyNode.h"
#include "vtkAssemblyPath.h"
#include "vtkDataObject.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

/// Maximum number of moving actors per frame: their numbers are stored in 8 bits.
constexpr int MaximumActors = 255;

/// Maximum deviation of the entries of R^T R from the identity for a motion to count as rigid,
/// where R is its 3 x 3 part.
constexpr double RigidityTolerance = 1e-6;

/// Returns the modification time of the mapper and its input data.
vtkMTimeType GetMeshMTime(vtkActor* actor)
{
  vtkMapper* mapper = actor->GetMapper();
  vtkMTimeType time = mapper->GetMTime();
  for (int port = 0; port < mapper->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < mapper->GetNumberOfInputConnections(port); ++i)
    {
      const vtkDataObject* data = mapper->GetInputDataObject(port, i);
      time = std::max(time, data ? const_cast<vtkDataObject*>(data)->GetMTime() : 0);
    }
  }
  return time;
}

bool IsRigid(const Matrix& matrix)
{
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      const double product =
        matrix[i] * matrix[j] + matrix[4 + i] * matrix[4 + j] + matrix[8 + i] * matrix[8 + j];
      if (!(std::abs(product - (i == j ? 1.0 : 0.0)) < RigidityTolerance))
      {
        return false;
      }
    }
  }
  return true;
}

}

bool ActorMotion::IsMotion(const ActorState& before, const ActorState& now, Matrix& toWorldBefore)
{
  if (before.MeshTime != now.MeshTime || before.ToWorld == now.ToWorld)
  {
    return false;
  }
  Matrix fromWorld;
  vtkMatrix4x4::Invert(now.ToWorld.data(), fromWorld.data());
  vtkMatrix4x4::Multiply4x4(before.ToWorld.data(), fromWorld.data(), toWorldBefore.data());
  return IsRigid(toWorldBefore);
}

void ActorMotion::UpdateMotion(vtkRenderer* renderer)
{
  this->MovedActors.clear();
  std::map<std::pair<vtkActor*, int>, ActorState> current;
  for (vtkProp* prop : VisibleProps(renderer))
  {
    prop->InitPathTraversal();
    while (vtkAssemblyPath* path = prop->GetNextPath())
    {
      vtkAssemblyNode* node = path->GetLastNode();
      auto* actor = vtkActor::SafeDownCast(node->GetViewProp());
      if (!actor || !actor->GetMapper() || !actor->GetVisibility() || !node->GetMatrix())
      {
        continue;
      }
      ActorState now;
      std::copy_n(node->GetMatrix()->GetData(), 16, now.ToWorld.begin());
      now.MeshTime = GetMeshMTime(actor);
      std::pair<vtkActor*, int> key(actor, 0);
      while (!current.emplace(key, now).second)
      {
        ++key.second;
      }
      const auto before = this->Last.find(key);
      Motion motion{ actor, now.ToWorld, {} };
      if (before != this->Last.end() && IsMotion(before->second, now, motion.ToWorldBefore) &&
        static_cast<int>(this->MovedActors.size()) < MaximumActors)
      {
        this->MovedActors.push_back(motion);
      }
    }
  }
  this->Last.swap(current);
}

bool ActorMotion::Draw(vtkRenderer* renderer, DelegateImage& image, const EyeDepth& depth)
{
  if (this->MovedActors.empty())
  {
    return false;
  }
  auto* window = static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow());
  const ScreenTransform& view = depth.GetView();
  std::vector<float> matrices;
  for (const Motion& motion : this->MovedActors)
  {
    const Matrix matrix = view.EyeTransformTo(depth.GetPreviousView(), motion.ToWorldBefore.data());
    for (int i = 0; i < 16; ++i)
    {
      matrices.push_back(static_cast<float>(matrix[4 * (i % 4) + i / 4]));
    }
  }
  const auto rows = static_cast<int>(this->MovedActors.size());
  this->Matrices = vtkSmartPointer<vtkTextureObject>::New();
  this->Matrices->SetContext(window);
  this->Matrices->Create2DFromRaw(4, rows, 4, VTK_FLOAT, matrices.data());

  const bool fits = this->Target && this->Target->GetContext() == window &&
    static_cast<int>(this->Target->GetWidth()) == view.Width &&
    static_cast<int>(this->Target->GetHeight()) == view.Height;
  if (!fits)
  {
    this->Target = image.CreateColor(window, 1);
  }
  return image.DrawAgain(renderer, this->Target, [&]() {
    // Opaque actors have alpha 1, which blending replaces by the number of the actor.
    vtkOpenGLState* state = window->GetState();
    const vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
    const vtkOpenGLState::ScopedglBlendFuncSeparate function(state);
    state->vtkglEnable(GL_BLEND);
    state->vtkglBlendFuncSeparate(GL_ZERO, GL_ZERO, GL_CONSTANT_ALPHA, GL_ZERO);
    for (int i = 0; i < rows; ++i)
    {
      const Motion& motion = this->MovedActors[i];
      glBlendColor(0.f, 0.f, 0.f, static_cast<float>(i + 1) / MaximumActors);
      vtkNew<vtkMatrix4x4> toWorld;
      toWorld->DeepCopy(motion.ToWorld.data());
      motion.Actor->PokeMatrix(toWorld); // as assemblies do
      motion.Actor->RenderOpaqueGeometry(renderer);
      motion.Actor->PokeMatrix(nullptr);
    }
    glBlendColor(0.f, 0.f, 0.f, 0.f);
  });
}

void ActorMotion::ReleaseGraphicsResources(vtkWindow* window)
{
  Release(window, this->Target, this->Matrices);
}

}
