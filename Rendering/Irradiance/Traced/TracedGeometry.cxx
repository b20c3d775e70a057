// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TracedGeometry.h"

#include "Import/SceneExtraction.h"
#include "Import/SceneExtractionActors.h"
#include "Import/SceneExtractionTime.h"

#include "vtkActor.h"
#include "vtkAssemblyNode.h"
#include "vtkAssemblyPath.h"
#include "vtkCamera.h"
#include "vtkMapper.h"
#include "vtkMath.h"
#include "vtkProp3D.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkSMPTools.h"
#include "vtkVolume.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

/// Coordinates are relative to where the eye was when they were rounded. Once it has moved so many
/// radii, their rounding might be seen.
constexpr double FarthestMove = 1e4;

bool IsMesh(vtkProp* prop)
{
  auto* actor = vtkActor::SafeDownCast(prop);
  vtkMapper* mapper = actor ? actor->GetMapper() : nullptr;
  return actor && (!mapper || !DrawsByShadersAlone(mapper));
}

/// Overlays and volumes leave no depth, or shall not count.
bool HasMeshesOnly(vtkRenderer* renderer)
{
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator position;
  props->InitTraversal(position);
  while (vtkProp* prop = props->GetNextProp(position))
  {
    if (!prop->GetVisibility() || !vtkProp3D::SafeDownCast(prop) || vtkVolume::SafeDownCast(prop))
    {
      continue;
    }
    prop->InitPathTraversal();
    while (vtkAssemblyPath* path = prop->GetNextPath())
    {
      if (!IsMesh(path->GetLastNode()->GetViewProp()))
      {
        return false;
      }
    }
  }
  return true;
}

/// Drops all that rays do not ask for; depth passes leave out what is translucent, and so do the rays.
void Strip(Scene& scene)
{
  std::vector<Surface> surfaces;
  for (Surface& surface : scene.Surfaces)
  {
    if (!surface.LetsLightThrough() && !surface.ScreenSpace)
    {
      Surface bare;
      bare.Positions = std::move(surface.Positions);
      bare.Triangles = std::move(surface.Triangles);
      bare.Frontfaces = surface.Frontfaces;
      bare.Backfaces = surface.Backfaces;
      surfaces.push_back(std::move(bare));
    }
  }
  scene.Surfaces = std::move(surfaces);
}

}

bool TracedGeometry::Update(vtkRenderer* renderer, double radius)
{
  double eye[3];
  renderer->GetActiveCamera()->GetPosition(eye);
  const double moved = std::sqrt(vtkMath::Distance2BetweenPoints(eye, this->Eye));
  if (this->Rays && GetGeometryMTime(renderer) == this->Time && moved <= FarthestMove * radius)
  {
    return false;
  }
  ExtractionOptions options;
  const int* size = renderer->GetSize();
  options.Resolution[0] = std::max(size[0], 1);
  options.Resolution[1] = std::max(size[1], 1);
  this->Rays.reset();
  this->Meshes = std::make_unique<Scene>(ExtractScene(renderer, options));
  this->Whole = HasMeshesOnly(renderer);
  Strip(*this->Meshes);
  this->Rays =
    std::make_unique<RayScene>(*this->Meshes, vtkSMPTools::GetEstimatedNumberOfThreads());
  this->Time = GetGeometryMTime(renderer); // mappers may have made their colours meanwhile
  std::copy_n(eye, 3, this->Eye);
  return true;
}

}
