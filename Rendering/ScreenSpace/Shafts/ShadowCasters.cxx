// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ShadowCasters.h"

#include "Frame/ScopedCamera.h"
#include "vtkActor.h"
#include "vtkAssemblyNode.h"
#include "vtkAssemblyPath.h"
#include "vtkDataObject.h"
#include "vtkMapper.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkRenderer.h"

#include <algorithm>

namespace penumbra
{

namespace
{

/// Returns whether the prop is part of the scene. The classes are compared by name, because their
/// modules are not used here.
bool CastsShadows(vtkProp* prop)
{
  const double* bounds = prop->GetUseBounds() ? prop->GetBounds() : nullptr;
  return bounds && vtkMath::AreBoundsInitialized(bounds) && !prop->IsA("vtkWidgetRepresentation") &&
    !prop->IsA("vtkCubeAxesActor");
}

/// Updates the mesh of an actor, which is not done by VTK for culled actors, and returns the latest
/// modification time of the actor, its mapper and the mesh.
vtkMTimeType UpdateMesh(vtkActor* actor)
{
  vtkMTimeType time = actor->GetMTime();
  vtkMapper* mapper = actor->GetMapper();
  if (!mapper || mapper->GetNumberOfInputPorts() < 1 || mapper->GetNumberOfInputConnections(0) < 1)
  {
    return time;
  }
  if (!mapper->GetStatic())
  {
    mapper->Update();
  }
  time = std::max(time, mapper->GetMTime());
  for (int port = 0; port < mapper->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < mapper->GetNumberOfInputConnections(port); ++i)
    {
      vtkDataObject* data = mapper->GetInputDataObject(port, i);
      time = std::max(time, data ? data->GetMTime() : 0);
    }
  }
  return time;
}

}

bool ShadowCasters::Part::operator==(const Part& other) const
{
  return this->Prop == other.Prop && this->ToWorld == other.ToWorld && this->Time == other.Time;
}

bool ShadowCasters::Update(vtkRenderer* renderer)
{
  std::vector<Part> parts;
  this->Props.clear();
  for (vtkProp* prop : VisibleProps(renderer))
  {
    if (!CastsShadows(prop))
    {
      continue;
    }
    this->Props.push_back(prop);
    parts.push_back({ prop, {}, prop->GetMTime() });
    prop->InitPathTraversal();
    while (vtkAssemblyPath* path = prop->GetNextPath())
    {
      vtkAssemblyNode* node = path->GetLastNode();
      auto* actor = vtkActor::SafeDownCast(node->GetViewProp());
      if (actor && actor->GetVisibility() && node->GetMatrix())
      {
        Part part{ actor, {}, UpdateMesh(actor) };
        std::copy_n(node->GetMatrix()->GetData(), 16, part.ToWorld.begin());
        parts.push_back(part);
      }
    }
  }
  const bool changed = parts != this->Parts;
  this->Parts.swap(parts);
  this->Version += changed ? 1 : 0;
  return changed;
}

std::vector<std::array<double, 3>> ShadowCasters::GetCorners() const
{
  std::vector<std::array<double, 3>> corners;
  for (vtkProp* prop : this->Props)
  {
    const double* bounds = prop->GetBounds();
    for (int i = 0; bounds && i < 8; ++i)
    {
      corners.push_back({ bounds[i & 1], bounds[2 + (i >> 1 & 1)], bounds[4 + (i >> 2)] });
    }
  }
  return corners;
}

}
