// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Materials.h"

#include "CollectionItems.h"

#include "Options/RenderOptions.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCellData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkPolyDataTangents.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkTexture.h"

namespace penumbra
{

namespace
{

void ApplyOptions(vtkProperty* property, const RenderOptions& options, double unitsPerPoint)
{
  if (options.Color)
  {
    const Vector3& color = *options.Color;
    property->SetColor(color[0], color[1], color[2]);
  }
  property->SetOpacity(options.Opacity * property->GetOpacity());
  if (!options.Lighting)
  {
    property->LightingOff();
  }
  property->SetEdgeVisibility(options.ShowEdges);
  property->SetLineWidth(static_cast<float>(options.LineWidth * unitsPerPoint));
  property->SetPointSize(static_cast<float>(options.PointSize * unitsPerPoint));
  if (options.Representation == "wireframe")
  {
    property->SetRepresentationToWireframe();
  }
  else if (options.Representation == "points")
  {
    property->SetRepresentationToPoints();
  }
}

}

vtkSmartPointer<vtkPolyData> AddTangents(vtkPolyData* mesh, vtkActor* material)
{
  vtkPointData* points = mesh->GetPointData();
  if (!material || !material->GetProperty()->GetTexture("normalTex") || points->GetTangents() ||
    !points->GetTCoords() || mesh->GetNumberOfPolys() == 0)
  {
    return mesh;
  }
  vtkNew<vtkPolyDataNormals> normals;
  vtkNew<vtkPolyDataTangents> tangents;
  if (points->GetNormals())
  {
    tangents->SetInputData(mesh);
  }
  else
  {
    normals->SetInputData(mesh);
    tangents->SetInputConnection(normals->GetOutputPort());
  }
  tangents->Update();
  return tangents->GetOutput();
}

vtkSmartPointer<vtkPolyDataMapper> MakeMapper(vtkPolyData* mesh, vtkActor* material)
{
  auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  auto* imported = material ? vtkPolyDataMapper::SafeDownCast(material->GetMapper()) : nullptr;
  vtkDataSet* data = imported ? imported->GetInput() : nullptr;
  const bool hasColors = data && imported->GetScalarVisibility() &&
    (data->GetPointData()->GetScalars() || data->GetCellData()->GetScalars());
  if (hasColors)
  {
    mapper->ShallowCopy(imported);
  }
  mapper->SetScalarVisibility(hasColors);
  mapper->SetInputData(mesh);
  return mapper;
}

vtkSmartPointer<vtkActor> MakeActor(
  vtkPolyDataMapper* mapper, vtkActor* material, const RenderOptions& options, double unitsPerPoint)
{
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  if (material)
  {
    vtkProperty* property = material->GetProperty();
    if (property->GetNumberOfTextures() > 0)
    {
      actor->SetProperty(property); // vtkProperty::DeepCopy() does not own the textures.
    }
    else
    {
      vtkProperty* copy = actor->GetProperty();
      copy->DeepCopy(property); // It mixes the colors.
      copy->SetAmbientColor(property->GetAmbientColor());
      copy->SetDiffuseColor(property->GetDiffuseColor());
      copy->SetSpecularColor(property->GetSpecularColor());
    }
    actor->SetTexture(material->GetTexture());
    actor->SetPropertyKeys(material->GetPropertyKeys());
    actor->SetForceTranslucent(material->GetForceTranslucent());
    actor->SetForceOpaque(material->GetForceOpaque());
  }
  ApplyOptions(actor->GetProperty(), options, unitsPerPoint);
  return actor;
}

void RemoveMaterialsOfColored(
  vtkRenderer* renderer, const RenderOptions& options, double unitsPerPoint)
{
  for (vtkActor* actor : GetItems<vtkActor>(renderer->GetActors()))
  {
    const int mode = actor->GetMapper()->GetScalarMode();
    if (mode == VTK_SCALAR_MODE_USE_POINT_FIELD_DATA || mode == VTK_SCALAR_MODE_USE_CELL_FIELD_DATA)
    {
      actor->SetProperty(vtkNew<vtkProperty>());
      actor->SetTexture(nullptr);
      actor->ForceTranslucentOff();
      ApplyOptions(actor->GetProperty(), options, unitsPerPoint);
    }
  }
}

}
