// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionActors.h"

#include "SceneExtractionBlocks.h"
#include "SceneExtractionColors.h"
#include "SceneExtractionGlyphs.h"
#include "SceneExtractionOverlay.h"
#include "SurfaceGeometry.h"
#include "UnsupportedFeatures.h"

#include "vtkActor.h"
#include "vtkAssemblyNode.h"
#include "vtkAssemblyPath.h"
#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkGlyph3DMapper.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkPolyData.h"
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

/// Actors that draw in a way of their own, which triangles of their input are not.
bool IsSupported(vtkActor* actor)
{
  return !IsAnyOf(actor, { "vtkAxisActor", "vtkCubeAxesActor", "vtkSkybox" });
}

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
  return result;
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

class Collector
{
public:
  Collector(std::vector<std::string>& warnings, const ProgressCallback& progress)
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
    prop->InitPathTraversal();
    while (vtkAssemblyPath* path = prop->GetNextPath())
    {
      vtkAssemblyNode* leaf = path->GetLastNode();
      this->AddLeaf(leaf->GetViewProp(), leaf->GetMatrix());
    }
  }

  void AddData(vtkDataObject* data, const DrawItem& look, ScalarMapper* scalars)
  {
    if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
    {
      ForEachBlock(composite, nullptr, look, scalars,
        [&](vtkDataSet* leaf, const DrawItem& blockLook, ScalarMapper* blockScalars) {
          this->AddDataSet(leaf, blockLook, blockScalars);
        });
    }
    else if (auto* dataSet = vtkDataSet::SafeDownCast(data))
    {
      this->AddDataSet(dataSet, look, scalars);
    }
    else if (data)
    {
      this->Warnings.push_back(
        look.Name + ": " + data->GetClassName() + " is not supported; left out.");
    }
  }

  /// What was added, with attributes that can be read.
  std::vector<DrawItem> Take()
  {
    for (DrawItem& piece : this->Pieces)
    {
      std::vector<std::string> left;
      piece.Data = DropMismatchedAttributes(piece.Data, left);
      piece.Progress = this->Progress;
      for (const std::string& what : left)
      {
        this->Warnings.push_back(piece.Name + ": " + what);
      }
    }
    return std::move(this->Pieces);
  }

  int NextObject = 0;

private:
  void AddLeaf(vtkProp* prop, vtkMatrix4x4* matrix)
  {
    auto* actor = vtkActor::SafeDownCast(prop);
    if (!prop->GetVisibility())
    {
      return;
    }
    if (!actor || !IsSupported(actor))
    {
      this->Warnings.push_back(std::string(prop->GetClassName()) + " is not supported; left out.");
      return;
    }
    DrawItem look;
    look.ObjectId = this->NextObject++;
    look.Name = "Object " + std::to_string(look.ObjectId);
    vtkMapper* mapper = actor->GetMapper();
    if (!mapper)
    {
      return;
    }
    if (DrawsByShadersAlone(mapper))
    {
      this->Warnings.push_back(
        look.Name + ": " + mapper->GetClassName() + " is not supported; left out.");
      return;
    }
    look.ToWorld = ToMatrix(matrix ? matrix : actor->GetMatrix());
    look.Property = actor->GetProperty();
    look.BackProperty = actor->GetBackfaceProperty();
    look.LitTexture = MakeTexture(actor->GetTexture(), look.Name, this->Warnings);
    look.ClippingPlanes = ToPlanes(mapper->GetClippingPlanes());
    WarnUnsupportedActor(actor, look.Name, this->Warnings);
    mapper->Update();
    vtkNew<ScalarMapper> scalars;
    scalars->ShallowCopy(mapper);
    vtkDataObject* data = mapper->GetInputDataObject(0, 0);
    if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
    {
      ForEachBlock(composite, mapper, look, scalars,
        [&](vtkDataSet* leaf, const DrawItem& blockLook, ScalarMapper* blockScalars) {
          this->AddMapped(mapper, leaf, blockLook, blockScalars);
        });
    }
    else if (auto* dataSet = vtkDataSet::SafeDownCast(data))
    {
      this->AddMapped(mapper, dataSet, look, scalars);
    }
    else
    {
      this->AddData(data, look, scalars);
    }
  }

  void AddMapped(vtkMapper* mapper, vtkDataSet* data, const DrawItem& look, ScalarMapper* scalars)
  {
    auto* glyphs = vtkGlyph3DMapper::SafeDownCast(mapper);
    if (!glyphs)
    {
      this->AddDataSet(data, look, scalars);
      return;
    }
    for (DrawItem& piece : MakeGlyphs(glyphs, data, look, scalars, this->Warnings))
    {
      this->Pieces.push_back(std::move(piece));
    }
  }

  void AddDataSet(vtkDataSet* data, const DrawItem& look, ScalarMapper* scalars)
  {
    DrawItem piece = look;
    piece.Data = ExtractSurface(data, this->Progress);
    if (piece.Data != data)
    {
      piece.CellIds = piece.Data->GetCellData()->GetArray("vtkOriginalCellIds");
    }
    if (piece.Data->GetNumberOfPoints() > 0 && piece.Data->GetNumberOfCells() > 0)
    {
      if (scalars)
      {
        piece.Colors = scalars->Map(piece.Data);
      }
      this->Pieces.push_back(std::move(piece));
    }
  }

  std::vector<DrawItem> Pieces;
  std::vector<std::string>& Warnings;
  const ProgressCallback& Progress;
};

}

bool DrawsByShadersAlone(vtkMapper* mapper)
{
  return IsAnyOf(
    mapper, { "vtkOpenGLSphereMapper", "vtkOpenGLStickMapper", "vtkPointGaussianMapper" });
}

std::vector<DrawItem> CollectDrawItems(
  vtkRenderer* renderer, std::vector<std::string>& warnings, const ProgressCallback& progress)
{
  WarnOfRenderer(renderer, warnings);
  Collector collector(warnings, progress);
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator position;
  props->InitTraversal(position);
  while (vtkProp* prop = props->GetNextProp(position))
  {
    ThrowIfStopped(progress, 0.0);
    collector.AddProp(prop);
  }
  return collector.Take();
}

std::vector<DrawItem> CollectDrawItems(const std::vector<vtkDataObject*>& data,
  std::vector<std::string>& warnings, const ProgressCallback& progress)
{
  Collector collector(warnings, progress);
  for (vtkDataObject* object : data)
  {
    DrawItem look;
    look.ObjectId = collector.NextObject++;
    look.Name = "Object " + std::to_string(look.ObjectId);
    look.Property = vtkSmartPointer<vtkProperty>::New();
    collector.AddData(object, look, nullptr);
  }
  return collector.Take();
}

}
