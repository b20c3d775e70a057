// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes of surfaces, lines and points in one place, with and without offsets of their mappers.
#include "FeatureProps.h"
#include "SceneList.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositePolyDataMapper.h"
#include "vtkContourFilter.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkVersionMacros.h"
#include "vtkVertexGlyphFilter.h"

using penumbra::Feature;

namespace
{

/// Looks at the plane z = 0 at an angle to its normal, in degrees.
void LookAt(Renderer r, double angle, bool parallel)
{
  vtkCamera* camera = r->GetActiveCamera();
  camera->SetPosition(0.0, 0.0, 3.0);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->Elevation(-angle);
  camera->OrthogonalizeViewUp();
  camera->SetParallelProjection(parallel);
  r->ResetCamera();
}

/// Returns a square of the plane z = 0, turned by 30 degrees so that its triangles differ from
/// those of MakePlane().
vtkSmartPointer<vtkPolyData> MakeDecal(double size)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-0.5 * size, -0.2 * size, 0.0);
  plane->SetPoint1(0.3 * size, -0.6 * size, 0.0);
  plane->SetPoint2(-0.2 * size, 0.5 * size, 0.0);
  plane->SetResolution(3, 2);
  return Make(plane.Get());
}

vtkMapper* AddColored(Renderer r, vtkPolyData* data, double red, double green, double blue)
{
  vtkActor* actor = Add(r, data);
  actor->GetProperty()->SetColor(red, green, blue);
  actor->GetMapper()->ScalarVisibilityOff();
  return actor->GetMapper();
}

/// Adds a decal before or after the surface that contains it. `offset` is the one of the decal.
void AddDecal(Renderer r, double offset, bool isFirst)
{
  const auto addDecal = [&] {
    AddColored(r, MakeDecal(0.8), 0.1, 0.4, 0.9)
      ->SetRelativeCoincidentTopologyPolygonOffsetParameters(offset, offset);
  };
  if (isFirst)
  {
    addDecal();
  }
  AddColored(r, MakePlane(4), 0.9, 0.6, 0.3);
  if (!isFirst)
  {
    addDecal();
  }
}

vtkSmartPointer<vtkPolyData> MakeContours()
{
  vtkSmartPointer<vtkPolyData> sphere = MakeSphere(32);
  AddElevation(sphere);
  vtkNew<vtkContourFilter> contours;
  contours->SetInputData(sphere);
  contours->GenerateValues(6, 0.1, 0.9);
  return Make(contours.Get());
}

vtkSmartPointer<vtkPolyData> MakeVertices()
{
  vtkNew<vtkVertexGlyphFilter> vertices;
  vertices->SetInputData(MakePlane(6));
  return Make(vertices.Get());
}

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
/// Adds two coplanar blocks of one actor; the second one is drawn over the first one.
void AddCoplanarBlocks(Renderer r)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakePlane(4));
  blocks->SetBlock(1, MakeDecal(0.8));
  vtkNew<vtkCompositePolyDataMapper> mapper;
  mapper->SetInputDataObject(blocks);
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  mapper->SetCompositeDataDisplayAttributes(attributes);
  const double colors[2][3] = { { 0.9, 0.6, 0.3 }, { 0.1, 0.4, 0.9 } };
  for (unsigned int i = 0; i < 2; ++i)
  {
    attributes->SetBlockColor(blocks->GetBlock(i), colors[i]);
  }
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  r->AddActor(actor);
}
#endif

}

void AddCoincident(SceneList& add)
{
  for (const bool parallel : { false, true })
  {
    for (const double angle : { 20.0, 70.0, 86.0 })
    {
      // VTK's depth buffer resolves offsets of coplanar surfaces even at grazing incidence.
      for (const bool isFirst : { false, true })
      {
        add(Feature::CoincidentTopology, [=](Renderer r, Window) {
          vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
          AddDecal(r, isFirst ? -1.0 : 1.0, isFirst);
          LookAt(r, angle, parallel);
        });
      }
      add(
        Feature::CoincidentTopology,
        [=](Renderer r, Window) {
          vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
          vtkMapper::SetResolveCoincidentTopologyPolygonOffsetParameters(2.0, 2.0);
          AddColored(r, MakeVertices(), 0.1, 0.4, 0.9);
          r->GetActors()->GetLastActor()->GetProperty()->SetPointSize(4.f);
          AddColored(r, MakePlane(4), 0.9, 0.6, 0.3);
          LookAt(r, angle, parallel);
        },
        0.01);
    }
    // Without offsets, the later of two copies is visible, also if one is translucent.
    for (const double opacity : { 1.0, 0.5 })
    {
      add(Feature::CoincidentTopology, [=](Renderer r, Window) {
        AddColored(r, MakeSphere(), 0.9, 0.9, 0.9);
        AddColored(r, MakeSphere(), 0.1, 0.4, 0.9);
        r->GetActors()->GetLastActor()->GetProperty()->SetOpacity(opacity);
        LookAt(r, 30.0, parallel);
      });
    }
    add(
      Feature::CoincidentTopology,
      [=](Renderer r, Window) {
        vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
        vtkMapper::SetResolveCoincidentTopologyPolygonOffsetParameters(2.0, 2.0);
        AddColored(r, MakeContours(), 0.1, 0.1, 0.1);
        AddColored(r, MakeSphere(32), 0.9, 0.6, 0.3);
        LookAt(r, 30.0, parallel);
      },
      0.01);
    add(
      Feature::CoincidentTopology,
      [=](Renderer r, Window) { // edges of a decal
        vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
        AddDecal(r, -1.0, true);
        vtkActor* decal = vtkActor::SafeDownCast(r->GetActors()->GetItemAsObject(0));
        decal->GetProperty()->EdgeVisibilityOn();
        LookAt(r, 60.0, parallel);
      },
      0.01);
    add(
      Feature::CoincidentTopology,
      [=](Renderer r, Window) {
        vtkMapper::SetResolveCoincidentTopologyToShiftZBuffer();
        vtkMapper::SetResolveCoincidentTopologyZShift(300.0);
        AddColored(r, MakeContours(), 0.1, 0.1, 0.1);
        AddColored(r, MakeSphere(32), 0.9, 0.6, 0.3);
        LookAt(r, 30.0, parallel);
      },
      0.01);
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
    add(Feature::CoincidentTopology, [=](Renderer r, Window) {
      AddCoplanarBlocks(r);
      LookAt(r, 0.0, parallel);
    });
#endif
  }
}
