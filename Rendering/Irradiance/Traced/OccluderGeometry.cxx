// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OccluderGeometry.h"

#include "CollectionItems.h"
#include "Import/SceneExtraction.h"
#include "Import/SceneExtractionActors.h"
#include "Import/SceneModificationTime.h"
#include "Scene.h"
#include "Surface.h"

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

/// Maximum distance, in radii, between the camera and its position at the last build. Scene
/// coordinates are relative to that position; beyond this distance their rounding to floats could
/// become visible.
constexpr double MaximumCameraMove = 1e4;

/// Returns whether a data set has vertices or lines. Data sets other than vtkPolyData are assumed
/// to have them.
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

/// Returns why rays cannot hit a prop that is rendered with depth; empty if they can.
std::string FindObstacle(vtkProp* prop)
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

/// Returns the first visible prop that rays cannot hit, with the reason; empty if they can hit all.
/// Overlays and volumes do not write depth and are skipped.
std::string FindMissing(vtkRenderer* renderer)
{
  int index = -1;
  for (vtkProp* prop : GetItems<vtkProp>(renderer->GetViewProps()))
  {
    ++index;
    if (!prop->GetVisibility() || !vtkProp3D::SafeDownCast(prop) || vtkVolume::SafeDownCast(prop))
    {
      continue;
    }
    prop->InitPathTraversal();
    while (vtkAssemblyPath* path = prop->GetNextPath())
    {
      const std::string reason = FindObstacle(path->GetLastNode()->GetViewProp());
      if (!reason.empty())
      {
        return "prop " + std::to_string(index) + " of the renderer (" + prop->GetClassName() +
          "): " + reason;
      }
    }
  }
  return {};
}

/// Removes all attributes except the geometry, and those of translucent surfaces that their opacity may
/// depend on. Also removes spheres and tubes, whose size depends on the camera.
void RemoveShadingData(Scene& scene)
{
  std::vector<Surface> surfaces;
  for (Surface& surface : scene.Surfaces)
  {
    if (surface.IsLineOrPoint || surface.IsRound())
    {
      continue;
    }
    if (surface.IsTranslucent())
    {
      surfaces.push_back(std::move(surface));
    }
    else
    {
      Surface geometry;
      geometry.Positions = std::move(surface.Positions);
      geometry.Triangles = std::move(surface.Triangles);
      geometry.Instances = std::move(surface.Instances);
      geometry.Frontfaces = surface.Frontfaces;
      geometry.Backfaces = surface.Backfaces;
      surfaces.push_back(std::move(geometry));
    }
  }
  scene.Surfaces = std::move(surfaces);
}

}

OccluderGeometry::OccluderGeometry() = default;
OccluderGeometry::~OccluderGeometry() = default;

bool OccluderGeometry::Update(vtkRenderer* renderer, double radius)
{
  double position[3];
  renderer->GetActiveCamera()->GetPosition(position);
  const double moved = std::sqrt(vtkMath::Distance2BetweenPoints(position, this->CameraPosition));
  if (this->Rays && GetGeometryMTime(renderer) == this->Time && moved <= MaximumCameraMove * radius)
  {
    this->Missing = FindMissing(renderer);
    return false;
  }
  ExtractionOptions options;
  const int* size = renderer->GetSize();
  options.Resolution[0] = std::max(size[0], 1);
  options.Resolution[1] = std::max(size[1], 1);
  // What the camera clips still occludes, and the trees are kept when the camera turns.
  options.ClipToRange = false;
  this->Rays.reset();
  this->Meshes = std::make_unique<Scene>(ExtractScene(renderer, options));
  this->Missing = FindMissing(renderer); // after extraction, which updates the pipelines
  RemoveShadingData(*this->Meshes);
  this->Rays =
    std::make_unique<RayScene>(*this->Meshes, vtkSMPTools::GetEstimatedNumberOfThreads());
  this->Time =
    GetGeometryMTime(renderer); // after extraction, in which mappers may create their colors
  std::copy_n(position, 3, this->CameraPosition);
  return true;
}

}
