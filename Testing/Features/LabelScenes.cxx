// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FeatureProps.h"
#include "SceneList.h"

#include "vtkActor.h"
#include "vtkActor2D.h"
#include "vtkCamera.h"
#include "vtkLabelPlacementMapper.h"
#include "vtkLabeledDataMapper.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSetToLabelHierarchy.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkSelectVisiblePoints.h"
#include "vtkStringArray.h"
#include "vtkVertexGlyphFilter.h"

#include <string>

using penumbra::Feature;

namespace
{

/// Adds a translucent plane before and an opaque plane amid named points.
vtkSmartPointer<vtkPolyData> AddHalfHiddenPoints(Renderer renderer)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkStringArray> names;
  names->SetName("Names");
  for (int i = 0; i < 12; ++i)
  {
    points->InsertNextPoint(0.3 * (i % 4) - 0.45, 0.3 * (i / 4) - 0.3, i % 2 == 0 ? 0.2 : -0.2);
    names->InsertNextValue("P" + std::to_string(i));
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->GetPointData()->AddArray(names);
  Add(renderer, MakePlane(4))->SetScale(1.2);
  vtkActor* front = Add(renderer, MakePlane(4));
  front->SetPosition(0.0, 0.0, 0.4);
  front->GetProperty()->SetOpacity(0.3);
  renderer->GetActiveCamera()->SetPosition(0.2, 0.1, 3.0);
  renderer->ResetCamera();
  return data;
}

void AddLabels(Renderer renderer, vtkMapper2D* mapper)
{
  vtkNew<vtkActor2D> labels;
  labels->SetMapper(mapper);
  renderer->AddViewProp(labels);
}

}

void AddVisiblePoints(SceneList& add)
{
  add(Feature::VisiblePoints, [](Renderer r, Window) { // of points that are drawn, too
    vtkSmartPointer<vtkPolyData> data = AddHalfHiddenPoints(r);
    vtkNew<vtkVertexGlyphFilter> vertices;
    vertices->SetInputData(data);
    Add(r, Make(vertices.Get()))->GetProperty()->SetPointSize(3.f);
    vtkNew<vtkSelectVisiblePoints> visible;
    visible->SetInputData(data);
    visible->SetRenderer(r);
    visible->SetTolerance(0.001);
    vtkNew<vtkPointSetToLabelHierarchy> hierarchy;
    hierarchy->SetInputConnection(visible->GetOutputPort());
    hierarchy->SetLabelArrayName("Names");
    vtkNew<vtkLabelPlacementMapper> mapper;
    mapper->SetInputConnection(hierarchy->GetOutputPort());
    mapper->SetShape(vtkLabelPlacementMapper::RECT);
    mapper->SetBackgroundColor(0.2, 0.5, 0.2);
    AddLabels(r, mapper);
  });
  for (const int shape : { vtkLabelPlacementMapper::NONE, vtkLabelPlacementMapper::ROUNDED_RECT })
  {
    for (const bool invisible : { false, true })
    {
      add(Feature::VisiblePoints, [=](Renderer r, Window) {
        vtkSmartPointer<vtkPolyData> data = AddHalfHiddenPoints(r);
        vtkNew<vtkSelectVisiblePoints> visible;
        visible->SetInputData(data);
        visible->SetRenderer(r);
        visible->SetTolerance(0.001);
        visible->SetSelectInvisible(invisible);
        vtkNew<vtkPointSetToLabelHierarchy> hierarchy;
        hierarchy->SetInputConnection(visible->GetOutputPort());
        hierarchy->SetLabelArrayName("Names");
        vtkNew<vtkLabelPlacementMapper> mapper;
        mapper->SetInputConnection(hierarchy->GetOutputPort());
        mapper->SetShape(shape);
        mapper->SetBackgroundColor(0.2, 0.5, 0.2);
        AddLabels(r, mapper);
      });
    }
  }
  add(Feature::VisiblePoints, [](Renderer r, Window) {
    vtkNew<vtkSelectVisiblePoints> visible;
    visible->SetInputData(AddHalfHiddenPoints(r));
    visible->SetRenderer(r);
    vtkNew<vtkLabeledDataMapper> mapper;
    mapper->SetInputConnection(visible->GetOutputPort());
    AddLabels(r, mapper);
    r->GetActiveCamera()->ParallelProjectionOn();
    r->ResetCamera();
  });
}
