// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OccluderGeometry.h"

#include "Import/SceneExtraction.h"
#include "Import/SceneExtractionActors.h"
#include "Import/SceneModificationTime.h"

#include "vtkActor.h"
#include "vtkAssemblyNode.h"
#include "vtkAssemblyPath.h"
#include "vtkCamera.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkMapper.h"
#include "vtkMath.h"
#include "vtkPolyData.h"
#include "vtkProp3D.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
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

/// Whether a data set has vertices or lines. Grids may have them, too: they are assumed to.
bool HasCells(vtkDataObject* data, vtkIdType (vtkPolyData::*count)())
{
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    vtkSmartPointer<vtkCompositeDataIterator> leaf;
    leaf.TakeReference(composite->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      if (HasCells(leaf->GetCurrentDataObject(), count))
      {
        return true;
      }
    }
    return false;
  }
  auto* mesh = vtkPolyData::SafeDownCast(data);
  return data && (!mesh || (mesh->*count)() > 0);
}

/// What of a prop rays cannot hit although it is rendered with depth; empty if there is nothing.
std::string FindUnseen(vtkProp* prop)
{
  auto* actor = vtkActor::SafeDownCast(prop);
  if (!actor)
  {
    return "it is not an actor";
  }
  vtkMapper* mapper = actor->GetMapper();
  if (!mapper)
  {
    return {};
  }
  if (DrawsByShadersAlone(mapper))
  {
    return std::string("its mapper is a ") + mapper->GetClassName();
  }
  vtkProperty* property = actor->GetProperty();
  vtkDataObject* data = mapper->GetInputDataObject(0, 0);
  if (property->GetRenderPointsAsSpheres() &&
    (property->GetRepresentation() == VTK_POINTS || property->GetVertexVisibility() ||
      HasCells(data, &vtkPolyData::GetNumberOfVerts)))
  {
    return "it renders points as spheres";
  }
  if (property->GetRenderLinesAsTubes() &&
    (property->GetRepresentation() == VTK_WIREFRAME || property->GetEdgeVisibility() ||
      HasCells(data, &vtkPolyData::GetNumberOfLines)))
  {
    return "it renders lines as tubes";
  }
  return {};
}

/// The first visible prop that rays cannot hit, and why; empty if they can hit all. Overlays and
/// volumes have no depth.
std::string FindMissing(vtkRenderer* renderer)
{
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator position;
  props->InitTraversal(position);
  int index = 0;
  for (; vtkProp* prop = props->GetNextProp(position); ++index)
  {
    if (!prop->GetVisibility() || !vtkProp3D::SafeDownCast(prop) || vtkVolume::SafeDownCast(prop))
    {
      continue;
    }
    prop->InitPathTraversal();
    while (vtkAssemblyPath* path = prop->GetNextPath())
    {
      const std::string unseen = FindUnseen(path->GetLastNode()->GetViewProp());
      if (!unseen.empty())
      {
        return "prop " + std::to_string(index) + " of the renderer (" + prop->GetClassName() +
          "): " + unseen;
      }
    }
  }
  return {};
}

/// Drops all that rays do not ask for; depth passes leave out what is translucent, and so do the rays.
void RemoveShadingData(Scene& scene)
{
  std::vector<Surface> surfaces;
  for (Surface& surface : scene.Surfaces)
  {
    if (!surface.IsTranslucent() && !surface.IsLineOrPoint)
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

bool OccluderGeometry::Update(vtkRenderer* renderer, double radius)
{
  double eye[3];
  renderer->GetActiveCamera()->GetPosition(eye);
  const double moved = std::sqrt(vtkMath::Distance2BetweenPoints(eye, this->Eye));
  if (this->Rays && GetGeometryMTime(renderer) == this->Time && moved <= FarthestMove * radius)
  {
    this->Missing = FindMissing(renderer);
    return false;
  }
  ExtractionOptions options;
  const int* size = renderer->GetSize();
  options.Resolution[0] = std::max(size[0], 1);
  options.Resolution[1] = std::max(size[1], 1);
  this->Rays.reset();
  this->Meshes = std::make_unique<Scene>(ExtractScene(renderer, options));
  this->Missing = FindMissing(renderer); // the pipelines are up to date now
  RemoveShadingData(*this->Meshes);
  this->Rays =
    std::make_unique<RayScene>(*this->Meshes, vtkSMPTools::GetEstimatedNumberOfThreads());
  this->Time = GetGeometryMTime(renderer); // mappers may have made their colours meanwhile
  std::copy_n(eye, 3, this->Eye);
  return true;
}

}
