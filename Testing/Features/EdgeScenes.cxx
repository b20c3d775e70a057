// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FeatureProps.h"
#include "SceneList.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkUnsignedCharArray.h"

using penumbra::Feature;

namespace
{

/// Shows the edges of an actor, which must be sorted with others if it is translucent.
void ShowEdges(vtkActor* actor, Renderer renderer)
{
  actor->GetProperty()->EdgeVisibilityOn();
  actor->GetProperty()->SetEdgeColor(0.8, 0.1, 0.1);
  actor->GetProperty()->SetLineWidth(4.f);
  renderer->SetUseDepthPeeling(true);
  renderer->SetMaximumNumberOfPeels(20);
  renderer->SetOcclusionRatio(0.0);
}

}

void AddEdges(SceneList& add)
{
  add(
    Feature::VertexAndEdgeVisibility,
    [](Renderer r, Window) {
      vtkActor* actor = Add(r, MakeCube());
      ShowEdges(actor, r);
      actor->GetProperty()->SetOpacity(0.3);
      Look(r);
    },
    0.025); // VTK draws half of the width at silhouettes
  for (const int coloring : { 0, 1, 2 })
  {
    add(
      Feature::VertexAndEdgeVisibility,
      [coloring](Renderer r, Window) {
        vtkSmartPointer<vtkPolyData> data = MakePlane(6);
        vtkNew<vtkUnsignedCharArray> colors;
        colors->SetNumberOfComponents(4);
        const bool perCell = coloring == 1;
        const vtkIdType count = perCell ? data->GetNumberOfCells() : data->GetNumberOfPoints();
        for (vtkIdType i = 0; i < count; ++i)
        {
          const double position =
            perCell ? 0.5 : 0.5 + data->GetPoint(i)[0]; // cells of one opacity, points of many
          colors->InsertNextTuple4(40.0, 160.0, 220.0, 255.0 * position);
        }
        vtkActor* actor = Add(r, data);
        if (coloring == 2)
        {
          AddElevation(data);
          vtkNew<vtkLookupTable> table;
          table->SetAlphaRange(0.0, 1.0);
          table->Build();
          actor->GetMapper()->SetLookupTable(table);
          actor->GetMapper()->InterpolateScalarsBeforeMappingOn();
        }
        else if (perCell)
        {
          data->GetCellData()->SetScalars(colors);
        }
        else
        {
          data->GetPointData()->SetScalars(colors);
        }
        ShowEdges(actor, r);
        r->ResetCamera();
      },
      0.025); // VTK draws half of the width at silhouettes
  }
  for (const bool culls : { false, true })
  {
    // VTK draws edges in fragments of polygons, which those without area do not have.
    add(
      Feature::VertexAndEdgeVisibility,
      [culls](Renderer r, Window) {
        vtkNew<vtkPolyData> data;
        data->DeepCopy(MakePlane());
        vtkPoints* points = data->GetPoints();
        for (int i = 0; i <= 10; ++i)
        {
          const double x = 0.1 * i - 0.5;
          const vtkIdType first = points->InsertNextPoint(x, 0.6, 0.0);
          points->InsertNextPoint(x, 0.7, 0.1);
          points->InsertNextPoint(x, 0.8, 0.2);
          const vtkIdType corners[] = { first, first + 1, first + 2 };
          data->GetPolys()->InsertNextCell(3, corners);
        }
        data->GetPointData()->Initialize();
        vtkActor* actor = Add(r, data);
        ShowEdges(actor, r);
        actor->GetProperty()->SetBackfaceCulling(culls);
        r->ResetCamera();
      },
      0.025);
  }
  for (const bool front : { false, true })
  {
    add(
      Feature::VertexAndEdgeVisibility,
      [front](Renderer r, Window) {
        vtkActor* actor = Add(r, MakeCube());
        ShowEdges(actor, r);
        actor->GetProperty()->SetFrontfaceCulling(front);
        actor->GetProperty()->SetBackfaceCulling(!front);
        Look(r);
      },
      0.025); // VTK draws half of the width at silhouettes
  }
}
