// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionActors.h"

#include "Annotation/SceneExtractionOverlay.h"
#include "CoincidentTopology.h"
#include "CollectionItems.h"
#include "Features/SceneFeatures.h"
#include "Features/UnsupportedFeatures.h"
#include "Geometry/CurvedCells.h"
#include "Geometry/SurfaceGeometry.h"
#include "Material.h"
#include "SceneExtractionAxes.h"
#include "SceneExtractionBlocks.h"
#include "SceneExtractionColors.h"
#include "SceneExtractionGlyphs.h"
#include "SceneExtractionProps.h"
#include "SceneExtractionSky.h"
#include "SceneExtractionSplats.h"
#include "Tessellation/SceneExtractionImposters.h"

#include "vtkActor.h"
#include "vtkAssemblyNode.h"
#include "vtkAssemblyPath.h"
#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkGlyph3DMapper.h"
#include "vtkLODProp3D.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkPointGaussianMapper.h"
#include "vtkPolyData.h"
#include "vtkProp3DFollower.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <initializer_list>

namespace penumbra
{
namespace
{

bool IsAnyOf(vtkObjectBase* object, std::initializer_list<const char*> names)
{
  return std::any_of(
    names.begin(), names.end(), [&](const char* name) { return object->IsA(name); });
}

/// Returns the row of the feature table for a prop that is skipped.
Feature FindRefusedFeature(vtkProp* prop)
{
  if (prop->IsA("vtkImageSlice"))
  {
    return Feature::ObliqueImageSlices;
  }
  if (prop->IsA("vtkVolume"))
  {
    return Feature::Volumes;
  }
  return prop->IsA("vtkAxisActor") ? Feature::AxisActors : Feature::OtherProps;
}

/// Converts a matrix whose last element, by which coordinates are divided, need not be 1.
glm::dmat4 ToMatrix(vtkMatrix4x4* from)
{
  glm::dmat4 result(1.0);
  for (int i = 0; from && i < 4; ++i)
  {
    for (int j = 0; j < 4; ++j)
    {
      result[j][i] = from->GetElement(i, j);
    }
  }
  return result[3][3] == 0.0 || result[3][3] == 1.0 ? result : result / result[3][3];
}

std::vector<glm::dvec4> ToPlanes(vtkPlaneCollection* from)
{
  std::vector<glm::dvec4> planes;
  for (int i = 0; from && i < from->GetNumberOfItems(); ++i)
  {
    vtkPlane* plane = from->GetItem(i);
    const double* n = plane->GetNormal();
    const double* x = plane->GetOrigin();
    planes.emplace_back(n[0], n[1], n[2], -(n[0] * x[0] + n[1] * x[1] + n[2] * x[2]));
  }
  return planes;
}

class DrawItemCollector
{
public:
  DrawItemCollector(std::vector<std::string>& warnings, const ProgressCallback& progress)
    : Warnings(warnings),
      Progress(progress)
  {
  }

  void AddProp(vtkProp* prop)
  {
    if (!prop->GetVisibility() || IsOverlay(prop))
    {
      return;
    }
    if (vtkNew<vtkPropCollection> parts; CollectParts(prop, parts))
    {
      for (vtkProp* part : GetItems<vtkProp>(parts))
      {
        this->AddProp(part);
      }
      return;
    }
    if (vtkProp3DFollower::SafeDownCast(prop))
    {
      prop->GetBounds(); // turns the followed prop toward the camera
    }
    prop->InitPathTraversal();
    while (vtkAssemblyPath* path = prop->GetNextPath())
    {
      vtkAssemblyNode* leaf = path->GetLastNode();
      this->AddLeaf(leaf->GetViewProp(), leaf->GetMatrix());
    }
  }

  void AddData(vtkDataObject* data, const DrawItem& prototype, ScalarMapper* scalars)
  {
    if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
    {
      ForEachBlock(composite, nullptr, prototype, scalars, this->Warnings,
        [&](vtkDataSet* leaf, const DrawItem& blockPrototype, ScalarMapper* blockScalars) {
          this->AddDataSet(leaf, blockPrototype, blockScalars);
        });
    }
    else if (auto* dataSet = vtkDataSet::SafeDownCast(data))
    {
      this->AddDataSet(dataSet, prototype, scalars);
    }
    else if (data)
    {
      this->Warnings.push_back(
        prototype.Name + ": " + data->GetClassName() + " is not supported and was skipped.");
    }
  }

  /// Returns the collected items, without attributes of mismatched length.
  std::vector<DrawItem> ReleaseItems()
  {
    for (DrawItem& item : this->Items)
    {
      std::vector<std::string> dropped;
      item.Data = DropMismatchedAttributes(item.Data, dropped);
      item.Progress = this->Progress;
      for (const std::string& message : dropped)
      {
        this->Warnings.push_back(item.Name + ": " + message);
      }
    }
    return std::move(this->Items);
  }

  int NextObject = 0;
  bool RemoveHiddenLines = false; ///< of actors with wireframe representation

private:
  void AddLeaf(vtkProp* prop, vtkMatrix4x4* matrix)
  {
    auto* actor = vtkActor::SafeDownCast(prop);
    if (!prop->GetVisibility() || IsOverlay(prop) || IsBillboard(prop) || IsCubeAxes(prop) ||
      IsSky(prop))
    {
      return;
    }
    if (DrawItem item; MakeTexturedProp(prop, ToMatrix(matrix), item, this->Warnings))
    {
      item.ObjectId = this->NextObject++;
      item.Name = "Object " + std::to_string(item.ObjectId);
      if (item.Data)
      {
        this->Items.push_back(std::move(item));
      }
      return;
    }
    if (auto* details = vtkLODProp3D::SafeDownCast(prop))
    {
      if (vtkProp3D* best = FindBestLevel(details))
      {
        this->AddLeaf(best, matrix);
      }
      return;
    }
    if (!actor || IsAnyOf(actor, { "vtkAxisActor", "vtkSkybox" }))
    {
      WarnFeature(FindRefusedFeature(prop), prop->GetClassName(), this->Warnings);
      return;
    }
    this->Prop = actor;
    DrawItem prototype;
    prototype.ObjectId = this->NextObject++;
    prototype.Name = "Object " + std::to_string(prototype.ObjectId);
    vtkMapper* mapper = actor->GetMapper();
    if (!mapper)
    {
      return;
    }
    if (ImposterSettings imposters; DrawsByShadersAlone(mapper) &&
        !vtkPointGaussianMapper::SafeDownCast(mapper) && !ReadImposterSettings(mapper, imposters))
    {
      WarnFeature(Feature::ShaderMappers, prototype.Name + " (" + mapper->GetClassName() + ")",
        this->Warnings);
      return;
    }
    prototype.ToWorld = ToMatrix(matrix ? matrix : actor->GetMatrix());
    prototype.Property = actor->GetProperty();
    prototype.BackProperty = actor->GetBackfaceProperty();
    if (actor->GetProperty()->GetInterpolation() != VTK_PBR)
    {
      prototype.LitTexture = MakeTexture(actor->GetTexture(), prototype.Name, this->Warnings);
    }
    else // VTK uses the textures of the material only
    {
      prototype.BaseColorTexture =
        MakeTexture(actor->GetProperty()->GetTexture("albedoTex"), prototype.Name, this->Warnings);
      prototype.DetailTextures =
        MakeMaterialTextures(actor->GetProperty(), prototype.Name, this->Warnings);
    }
    prototype.ForceOpaque = actor->GetForceOpaque();
    ReadDepthOffsets(actor, prototype);
    prototype.RemoveHiddenLines =
      this->RemoveHiddenLines && actor->GetProperty()->GetRepresentation() == VTK_WIREFRAME;
    prototype.ClippingPlanes = ToPlanes(mapper->GetClippingPlanes());
    WarnUnsupportedActor(actor, prototype.Name, this->Warnings);
    mapper->Update();
    vtkNew<ScalarMapper> scalars;
    scalars->ShallowCopy(mapper);
    vtkDataObject* data = mapper->GetInputDataObject(0, 0);
    if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
    {
      ForEachBlock(composite, mapper, prototype, scalars, this->Warnings,
        [&](vtkDataSet* leaf, const DrawItem& blockPrototype, ScalarMapper* blockScalars) {
          this->AddMapped(mapper, leaf, blockPrototype, blockScalars);
        });
    }
    else if (auto* dataSet = vtkDataSet::SafeDownCast(data))
    {
      this->AddMapped(mapper, dataSet, prototype, scalars);
    }
    else
    {
      this->AddData(data, prototype, scalars);
    }
  }

  void AddMapped(
    vtkMapper* mapper, vtkDataSet* data, const DrawItem& prototype, ScalarMapper* scalars)
  {
    if (auto* splats = vtkPointGaussianMapper::SafeDownCast(mapper))
    {
      if (auto* points = vtkPolyData::SafeDownCast(data))
      {
        AddSplats(splats, points, prototype, scalars, this->Items, this->Warnings);
      }
      return;
    }
    if (ImposterSettings imposters; ReadImposterSettings(mapper, imposters))
    {
      if (auto* points = vtkPolyData::SafeDownCast(data); points && points->GetPoints())
      {
        scalars->SetInterpolateScalarsBeforeMapping(false);
        DrawItem item =
          MakeImposters(imposters, points, prototype, scalars->Map(points), this->Warnings);
        if (item.Data->GetNumberOfCells() > 0)
        {
          this->Items.push_back(std::move(item));
        }
      }
      return;
    }
    auto* glyphs = vtkGlyph3DMapper::SafeDownCast(mapper);
    if (!glyphs)
    {
      this->AddDataSet(data, prototype, scalars);
      return;
    }
    for (DrawItem& item : MakeGlyphs(glyphs, data, prototype, scalars, this->Warnings))
    {
      this->Items.push_back(std::move(item));
    }
  }

  void AddDataSet(vtkDataSet* data, const DrawItem& prototype, ScalarMapper* scalars)
  {
    DrawItem item = prototype;
    item.Data = ExtractCurvedSurface(data, "vtkOriginalCellIds", this->Progress);
    if (!item.Data)
    {
      item.Data = ExtractSurface(data, this->Progress);
    }
    if (this->Prop)
    {
      item.Data = TransformTextureCoordinates(item.Data, this->Prop);
      if (auto* actor = vtkActor::SafeDownCast(this->Prop); actor && item.LitTexture)
      {
        item.Data = UnwrapTextureCoordinates(item.Data, actor->GetMapper());
      }
    }
    if (item.Data != data)
    {
      item.CellIds = item.Data->GetCellData()->GetArray("vtkOriginalCellIds");
    }
    if (item.Data->GetNumberOfPoints() > 0 && item.Data->GetNumberOfCells() > 0)
    {
      if (scalars)
      {
        item.Colors = scalars->Map(item.Data);
      }
      this->Items.push_back(std::move(item));
    }
  }

  std::vector<DrawItem> Items;
  vtkProp* Prop = nullptr; ///< prop whose data is added
  std::vector<std::string>& Warnings;
  const ProgressCallback& Progress;
};

}

bool DrawsByShadersAlone(vtkMapper* mapper)
{
  return IsAnyOf(
    mapper, { "vtkOpenGLSphereMapper", "vtkOpenGLStickMapper", "vtkPointGaussianMapper" });
}

PropItems CollectPropItems(
  vtkRenderer* renderer, vtkProp* prop, int firstObject, const ProgressCallback& progress)
{
  ThrowIfStopped(progress, 0.0);
  PropItems result;
  DrawItemCollector collector(result.Warnings, progress);
  collector.RemoveHiddenLines = renderer->GetUseHiddenLineRemoval();
  collector.NextObject = firstObject;
  collector.AddProp(prop);
  result.Items = collector.ReleaseItems();
  result.NumberOfObjects = collector.NextObject - firstObject;
  return result;
}

std::vector<DrawItem> CollectDrawItems(const std::vector<vtkDataObject*>& data,
  std::vector<std::string>& warnings, const ProgressCallback& progress)
{
  DrawItemCollector collector(warnings, progress);
  for (vtkDataObject* object : data)
  {
    DrawItem prototype;
    prototype.ObjectId = collector.NextObject++;
    prototype.Name = "Object " + std::to_string(prototype.ObjectId);
    prototype.Property = vtkSmartPointer<vtkProperty>::New();
    collector.AddData(object, prototype, nullptr);
  }
  return collector.ReleaseItems();
}

}
