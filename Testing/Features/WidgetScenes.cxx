// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes of widgets, 2-D charts, and actors of lights and cameras.
#include "FeatureProps.h"
#include "SceneList.h"

#include "vtkActor.h"
#include "vtkAxis.h"
#include "vtkBrush.h"
#include "vtkCamera.h"
#include "vtkCameraActor.h"
#include "vtkCameraOrientationRepresentation.h"
#include "vtkChartPie.h"
#include "vtkChartXY.h"
#include "vtkColorSeries.h"
#include "vtkContextActor.h"
#include "vtkContextScene.h"
#include "vtkCoordinate.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLightActor.h"
#include "vtkLogoRepresentation.h"
#include "vtkNew.h"
#include "vtkPen.h"
#include "vtkPlot.h"
#include "vtkPlotPie.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkProperty2D.h"
#include "vtkSliderRepresentation2D.h"
#include "vtkTable.h"
#include "vtkTexturedButtonRepresentation2D.h"
#include "vtkVersionMacros.h"

#include <cmath>

using penumbra::Feature;

namespace
{

vtkSmartPointer<vtkImageData> MakeStripes()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(6, 6, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int j = 0; j < 6; ++j)
  {
    for (int i = 0; i < 6; ++i)
    {
      image->SetScalarComponentFromDouble(i, j, 0, 0, i < 3 ? 255.0 : 40.0);
      image->SetScalarComponentFromDouble(i, j, 0, 1, j < 3 ? 200.0 : 80.0);
      image->SetScalarComponentFromDouble(i, j, 0, 2, 30.0);
    }
  }
  return image;
}

void AddWidget(Renderer renderer, vtkWidgetRepresentation* widget)
{
  widget->SetRenderer(renderer);
  widget->BuildRepresentation();
  renderer->AddViewProp(widget);
}

void Place(vtkCoordinate* coordinate, double x, double y)
{
  coordinate->SetCoordinateSystemToNormalizedDisplay();
  coordinate->SetValue(x, y);
}

void AddFlatWidgets(SceneList& add)
{
  add(Feature::Widgets, [](Renderer r, Window) {
    Add(r, MakePlane(4));
    vtkNew<vtkSliderRepresentation2D> slider;
    slider->SetMinimumValue(-2.0);
    slider->SetMaximumValue(5.0);
    slider->SetValue(1.5);
    slider->SetTitleText("Level");
    slider->GetSliderProperty()->SetColor(1.0, 0.3, 0.2);
    slider->GetTubeProperty()->SetColor(0.2, 0.9, 0.4);
    Place(slider->GetPoint1Coordinate(), 0.1, 0.5);
    Place(slider->GetPoint2Coordinate(), 0.9, 0.7);
    AddWidget(r, slider);
  });
  for (const int state : { 0, 1 })
  {
    add(Feature::Widgets, [state](Renderer r, Window) {
      Add(r, MakePlane(4));
      vtkNew<vtkTexturedButtonRepresentation2D> button;
      button->SetNumberOfStates(2);
      button->SetButtonTexture(0, MakeStripes());
      vtkNew<vtkImageData> other;
      other->SetDimensions(4, 4, 1);
      other->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
      other->GetPointData()->GetScalars()->Fill(120.0);
      button->SetButtonTexture(1, other);
      button->SetState(state);
      button->SetPlaceFactor(1.0);
      double bounds[6] = { 20.0, 60.0, 30.0, 70.0, 0.0, 0.0 };
      button->PlaceWidget(bounds);
      AddWidget(r, button);
    });
  }
  add(Feature::Widgets, [](Renderer r, Window) {
    Add(r, MakePlane(4));
    vtkNew<vtkLogoRepresentation> logo;
    vtkSmartPointer<vtkImageData> image = MakeStripes();
    for (int i = 0; i < 6; ++i) // VTK blends opposite sides of the texture
    {
      for (int k = 0; k < 3; ++k)
      {
        image->SetScalarComponentFromDouble(i, 0, 0, k, 90.0);
        image->SetScalarComponentFromDouble(i, 5, 0, k, 90.0);
        image->SetScalarComponentFromDouble(0, i, 0, k, 90.0);
        image->SetScalarComponentFromDouble(5, i, 0, k, 90.0);
      }
    }
    logo->SetImage(image);
    logo->GetImageProperty()->SetOpacity(0.7);
    logo->GetPositionCoordinate()->SetValue(0.1, 0.2);
    logo->GetPosition2Coordinate()->SetValue(0.5, 0.4);
    AddWidget(r, logo);
  });
}

void AddSolidWidgets(SceneList& add)
{
  add(
    Feature::Widgets,
    [](Renderer r, Window) {
      r->GetActiveCamera()->SetPosition(2.0, 1.0, 3.0);
      vtkNew<vtkCameraOrientationRepresentation> widget;
      AddWidget(r, widget);
      r->ResetCamera();
    },
    0.02);
}

void AddLightActors(SceneList& add)
{
  // With VTK 9.2, 0.7 to 1.1 % of the pixels differ.
  constexpr double different = VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0) ? 0.002 : 0.015;
  for (const double angle : { 20.0, 40.0 })
  {
    add(
      Feature::LightActors,
      [angle](Renderer r, Window) {
        Add(r, MakePlane(4));
        vtkNew<vtkLight> light;
        light->SetPosition(0.2, 0.3, 1.0);
        light->SetFocalPoint(0.1, 0.0, 0.0);
        light->SetPositional(true);
        light->SetConeAngle(angle);
        vtkNew<vtkLightActor> actor;
        actor->SetLight(light);
        actor->SetClippingRange(0.2, 0.9);
        r->AddViewProp(actor);
        r->GetActiveCamera()->SetPosition(3.0, -1.0, 3.0);
        r->ResetCamera();
      },
      different);
  }
  add(
    Feature::LightActors,
    [](Renderer r, Window) {
      Add(r, MakePlane(4));
      vtkNew<vtkCamera> camera;
      camera->SetPosition(0.2, 0.3, 1.0);
      camera->SetClippingRange(0.2, 0.9);
      vtkNew<vtkCameraActor> actor;
      actor->SetCamera(camera);
      actor->GetProperty()->SetColor(1.0, 0.6, 0.1);
      actor->SetWidthByHeightRatio(1.5);
      r->AddViewProp(actor);
      r->GetActiveCamera()->SetPosition(3.0, -1.0, 3.0);
      r->ResetCamera();
    },
    different);
}

vtkSmartPointer<vtkTable> MakeTable()
{
  vtkNew<vtkDoubleArray> x;
  x->SetName("x");
  vtkNew<vtkDoubleArray> y;
  y->SetName("y");
  for (int i = 0; i < 20; ++i)
  {
    x->InsertNextValue(0.4 * i);
    y->InsertNextValue(std::sin(0.4 * i));
  }
  auto table = vtkSmartPointer<vtkTable>::New();
  table->AddColumn(x);
  table->AddColumn(y);
  return table;
}

template <typename Chart>
vtkSmartPointer<Chart> AddChart(Renderer renderer)
{
  auto chart = vtkSmartPointer<Chart>::New();
  vtkNew<vtkContextScene> scene;
  scene->AddItem(chart);
  vtkNew<vtkContextActor> actor;
  actor->SetScene(scene);
  scene->SetRenderer(renderer);
  renderer->AddActor(actor);
  return chart;
}

void AddCharts(SceneList& add)
{
  // VTK smooths lines and text, so that more pixels differ.
  for (const int type : { vtkChart::LINE, vtkChart::POINTS, vtkChart::BAR, vtkChart::STACKED })
  {
    add(
      Feature::Charts,
      [type](Renderer r, Window) {
        Add(r, MakePlane(4));
        auto chart = AddChart<vtkChartXY>(r);
        chart->GetBackgroundBrush()->SetColor(230, 240, 250, 200);
        chart->GetAxis(vtkAxis::LEFT)->SetTitle("sine");
        vtkPlot* plot = chart->AddPlot(type);
        plot->SetInputData(MakeTable(), 0, 1);
        plot->SetColor(200, 40, 30, 255);
        plot->SetWidth(3.f);
        plot->GetPen()->SetLineType(vtkPen::DASH_LINE);
      },
      0.03);
  }
  add(
    Feature::Charts,
    [](Renderer r, Window) {
      auto chart = AddChart<vtkChartXY>(r);
      chart->GetBackgroundBrush()->SetTexture(MakeStripes());
      chart->GetBackgroundBrush()->SetTextureProperties(vtkBrush::Linear | vtkBrush::Stretch);
    },
    0.03);
  add(
    Feature::Charts,
    [](Renderer r, Window) {
      auto chart = AddChart<vtkChartPie>(r);
      vtkNew<vtkTable> table;
      vtkNew<vtkDoubleArray> parts;
      parts->SetName("parts");
      for (const double part : { 3.0, 1.0, 2.0 })
      {
        parts->InsertNextValue(part);
      }
      table->AddColumn(parts);
      auto* pie = vtkPlotPie::SafeDownCast(chart->AddPlot(0));
      vtkNew<vtkColorSeries> colors;
      colors->SetColorScheme(vtkColorSeries::WARM);
      pie->SetColorSeries(colors);
      pie->SetInputData(table);
      pie->SetInputArray(0, "parts");
    },
    0.03);
}

}

void AddWidgets(SceneList& add)
{
  AddFlatWidgets(add);
  AddSolidWidgets(add);
  AddLightActors(add);
  AddCharts(add);
}
