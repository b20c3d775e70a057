// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ChartPlot.h"

#include "ChartFamilies.h"
#include "Files/AtomicFile.h"

#include "vtkAxis.h"
#include "vtkChartLegend.h"
#include "vtkChartXY.h"
#include "vtkContextActor.h"
#include "vtkContextScene.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPen.h"
#include "vtkPlotPoints.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTable.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace penumbra
{

namespace
{

// In pixels.
constexpr int ChartWidth = 620;
constexpr int LegendWidth = 300;
constexpr int ChartHeight = 460;
constexpr int OverviewWidth = 900;
constexpr int OverviewHeight = 520;

constexpr char SecondsTitle[] = "CPU seconds of one thread";

/// Stand-in for 0 on a logarithmic axis.
constexpr double Least = 1e-8;

// Distinguishable with color vision deficiency. Penumbra's methods are black and dark red.
constexpr unsigned char Colors[][3] = { { 230, 159, 0 }, { 86, 180, 233 }, { 0, 158, 115 },
  { 204, 121, 167 }, { 0, 114, 178 }, { 213, 94, 0 }, { 150, 150, 40 }, { 120, 80, 160 },
  { 150, 90, 50 }, { 90, 90, 90 } };
constexpr unsigned char Ours[][3] = { { 0, 0, 0 }, { 160, 0, 0 } };
constexpr unsigned char FrontColor[3] = { 210, 210, 210 };

vtkSmartPointer<vtkTable> TableOf(const std::string& name, const std::vector<ChartRow>& rows,
  double ChartRow::*x, double ChartRow::*y)
{
  vtkNew<vtkFloatArray> abscissae;
  abscissae->SetName("cost");
  vtkNew<vtkFloatArray> ordinates;
  ordinates->SetName(name.c_str());
  for (const ChartRow& row : rows)
  {
    abscissae->InsertNextValue(static_cast<float>(std::max(row.*x, Least)));
    ordinates->InsertNextValue(static_cast<float>(std::max(row.*y, Least)));
  }
  auto table = vtkSmartPointer<vtkTable>::New();
  table->AddColumn(abscissae);
  table->AddColumn(ordinates);
  return table;
}

vtkPlotPoints* AddCurve(
  vtkChartXY* chart, vtkTable* table, bool isLine, const unsigned char* color, float width)
{
  // A line requires two points.
  const int type = isLine && table->GetNumberOfRows() > 1 ? vtkChart::LINE : vtkChart::POINTS;
  auto* plot = vtkPlotPoints::SafeDownCast(chart->AddPlot(type));
  plot->SetInputData(table, 0, 1);
  plot->SetColor(color[0], color[1], color[2], 255);
  plot->SetWidth(width);
  plot->SetMarkerStyle(vtkPlotPoints::NONE);
  return plot;
}

void SetUpAxis(vtkAxis* axis, const std::string& title)
{
  axis->SetTitle(title);
  axis->SetLogScale(true);
  axis->GetTitleProperties()->SetFontSize(14);
  axis->GetTitleProperties()->BoldOff();
  axis->GetLabelProperties()->SetFontSize(12);
  axis->GetGridPen()->SetColor(225, 225, 225, 255);
}

/// Returns a range that is slightly larger than the values, so that no mark is clipped.
void SetRange(vtkAxis* axis, const std::vector<double>& values)
{
  constexpr double room = 1.25;
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  axis->SetUnscaledRange(std::max(*least, Least) / room, std::max(*greatest, Least) * room);
  axis->SetBehavior(vtkAxis::FIXED);
}

/// Returns a chart with axes for `rows` and without curves.
vtkSmartPointer<vtkChartXY> NewChart(const ChartFamily& family, const std::string& title,
  const std::vector<ChartRow>& rows, double ChartRow::*cost, const std::string& costTitle)
{
  auto chart = vtkSmartPointer<vtkChartXY>::New();
  chart->SetAutoSize(false);
  chart->SetTitle(title);
  chart->GetTitleProperties()->SetFontSize(15);
  SetUpAxis(chart->GetAxis(vtkAxis::BOTTOM), costTitle);
  SetUpAxis(chart->GetAxis(vtkAxis::LEFT), family.ErrorTitle);
  std::vector<double> costs;
  std::vector<double> errors;
  for (const ChartRow& row : rows)
  {
    costs.push_back(row.*cost);
    errors.push_back(row.Error);
    errors.push_back(row.RequestedTolerance > 0.0 ? row.RequestedTolerance : row.Error);
  }
  SetRange(chart->GetAxis(vtkAxis::BOTTOM), costs);
  SetRange(chart->GetAxis(vtkAxis::LEFT), errors);
  return chart;
}

void AddMethod(vtkChartXY* chart, const ChartCurve& method, double ChartRow::*cost)
{
  const auto steps = TableOf(method.Method, method.Steps, cost, &ChartRow::Error);
  vtkPlotPoints* curve = AddCurve(chart, steps, true, method.Color, method.IsOurs ? 2.5f : 1.5f);
  curve->SetMarkerStyle(method.IsOurs ? vtkPlotPoints::DIAMOND : vtkPlotPoints::CIRCLE);
  curve->SetMarkerSize(method.IsOurs ? 9.f : 7.f);
}

vtkSmartPointer<vtkChartXY> ChartOf(const ChartFamily& family, const ChartPanel& panel,
  double ChartRow::*cost, const std::string& costTitle)
{
  const vtkSmartPointer<vtkChartXY> chart =
    NewChart(family, family.Title + ": " + panel.Scene, panel.Rows, cost, costTitle);
  const auto front = TableOf("Pareto front", ParetoFront(panel.Rows, cost), cost, &ChartRow::Error);
  AddCurve(chart, front, true, FrontColor, 9.f);
  for (const ChartCurve& each : panel.Curves)
  {
    AddMethod(chart, each, cost);
    if (each.HasTolerances())
    {
      const auto requested =
        TableOf("  requested tolerance", each.Steps, cost, &ChartRow::RequestedTolerance);
      vtkPlotPoints* marks = AddCurve(chart, requested, false, each.Color, 1.5f);
      marks->SetMarkerStyle(vtkPlotPoints::CROSS);
      marks->SetMarkerSize(8.f);
    }
  }
  return chart;
}

/// A window with a scene for charts.
struct ChartWindow
{
  ChartWindow(int width, int height)
  {
    this->Window->SetOffScreenRendering(1);
    this->Window->SetShowWindow(false);
    this->Window->SetMultiSamples(8);
    this->Window->SetSize(width, height);
    this->Renderer->SetBackground(1.0, 1.0, 1.0);
    this->Window->AddRenderer(this->Renderer);
    this->Renderer->AddActor(this->Actor);
    this->Actor->GetScene()->SetRenderer(this->Renderer);
  }

  void Write(const std::string& path)
  {
    this->Window->Render();
    AtomicFile image(path, "--output");
    vtkNew<vtkWindowToImageFilter> capture;
    capture->SetInput(this->Window);
    capture->ReadFrontBufferOff();
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(capture->GetOutputPort());
    writer->WriteToMemoryOn();
    writer->Write();
    vtkUnsignedCharArray* bytes = writer->GetResult();
    image.Write(
      std::string(reinterpret_cast<const char*>(bytes->GetPointer(0)), bytes->GetNumberOfValues()));
    image.Commit();
  }

  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkContextActor> Actor;
};

/// Returns where a value lies on an axis, in pixels.
double PixelOf(vtkAxis* axis, double value, double low, double high)
{
  double range[2];
  axis->GetUnscaledRange(range);
  return low + (high - low) * std::log(value / range[0]) / std::log(range[1] / range[0]);
}

/// Writes a label to the right of the last point of a curve. The chart has been drawn.
void AddLabel(vtkRenderer* renderer, vtkChartXY* chart, const ChartCurve& curve)
{
  constexpr double distance = 9.0; // pixels
  const ChartRow& last = curve.Steps.back();
  vtkNew<vtkTextActor> label;
  label->SetInput(curve.Method.c_str());
  label->SetPosition(distance +
      PixelOf(chart->GetAxis(vtkAxis::BOTTOM), last.Seconds, chart->GetPoint1()[0],
        chart->GetPoint2()[0]),
    PixelOf(
      chart->GetAxis(vtkAxis::LEFT), last.Error, chart->GetPoint1()[1], chart->GetPoint2()[1]));
  vtkTextProperty* text = label->GetTextProperty();
  text->SetFontSize(curve.IsOurs ? 17 : 14);
  text->SetBold(curve.IsOurs);
  text->SetVerticalJustificationToCentered();
  text->SetColor(curve.Color[0] / 255.0, curve.Color[1] / 255.0, curve.Color[2] / 255.0);
  renderer->AddViewProp(label);
}

}

bool ChartCurve::HasTolerances() const
{
  return std::any_of(this->Steps.begin(), this->Steps.end(),
    [](const ChartRow& row) { return row.RequestedTolerance > 0.0; });
}

std::vector<ChartPanel> PanelsOf(const std::vector<ChartRow>& rows)
{
  // A method has the same color in every panel.
  std::vector<ChartCurve> methods;
  std::vector<ChartPanel> panels;
  for (const ChartRow& row : rows)
  {
    const auto isSame = [&](const ChartCurve& each) { return each.Method == row.Method; };
    auto method = std::find_if(methods.begin(), methods.end(), isSame);
    if (method == methods.end())
    {
      const bool isOurs = row.Method.rfind("Penumbra", 0) == 0;
      const auto alike = std::count_if(methods.begin(), methods.end(),
        [&](const ChartCurve& each) { return each.IsOurs == isOurs; });
      const unsigned char* color = isOurs ? Ours[alike % static_cast<int>(std::size(Ours))]
                                          : Colors[alike % static_cast<int>(std::size(Colors))];
      method =
        methods.insert(methods.end(), { row.Method, isOurs, { color[0], color[1], color[2] }, {} });
    }
    auto panel = std::find_if(panels.begin(), panels.end(),
      [&](const ChartPanel& each) { return each.Scene == row.Scene; });
    if (panel == panels.end())
    {
      panel = panels.insert(panels.end(), { row.Scene, {}, {} });
    }
    panel->Rows.push_back(row);
    auto curve = std::find_if(panel->Curves.begin(), panel->Curves.end(), isSame);
    if (curve == panel->Curves.end())
    {
      curve = panel->Curves.insert(panel->Curves.end(), *method);
    }
    curve->Steps.push_back(row);
  }
  return panels;
}

void WriteChartPng(
  const ChartFamily& family, const std::vector<ChartPanel>& panels, const std::string& path)
{
  const int height = ChartHeight * static_cast<int>(panels.size());
  ChartWindow window(2 * ChartWidth + LegendWidth, height);
  int bottom = height;
  for (const ChartPanel& panel : panels)
  {
    bottom -= ChartHeight;
    for (const bool counts : { false, true })
    {
      const vtkSmartPointer<vtkChartXY> chart = ChartOf(family, panel,
        counts ? &ChartRow::Count : &ChartRow::Seconds, counts ? family.CountTitle : SecondsTitle);
      chart->SetSize(vtkRectf(counts ? ChartWidth : 0.f, static_cast<float>(bottom),
        counts ? ChartWidth + LegendWidth : ChartWidth, ChartHeight));
      chart->SetShowLegend(counts);
      chart->GetLegend()->SetInline(false);
      chart->GetLegend()->SetHorizontalAlignment(vtkChartLegend::RIGHT);
      chart->GetLegend()->SetVerticalAlignment(vtkChartLegend::TOP);
      chart->GetLegend()->SetLabelSize(12);
      window.Actor->GetScene()->AddItem(chart);
    }
  }
  window.Write(path);
}

void WriteChartOverview(const ChartFamily& family, const ChartPanel& panel, const std::string& path)
{
  constexpr double roomForLabels = 4.0; // a factor of seconds
  std::vector<ChartCurve> curves;
  std::vector<ChartRow> rows;
  for (const auto& [method, label] : family.Overview)
  {
    for (ChartCurve curve : panel.Curves)
    {
      if (curve.Method == method)
      {
        curve.Method = label;
        for (ChartRow& row : curve.Steps)
        {
          row.RequestedTolerance = 0.0;
        }
        rows.insert(rows.end(), curve.Steps.begin(), curve.Steps.end());
        curves.push_back(std::move(curve));
      }
    }
  }
  if (rows.empty())
  {
    return;
  }
  const vtkSmartPointer<vtkChartXY> chart =
    NewChart(family, family.Title + ": " + panel.Scene, rows, &ChartRow::Seconds, SecondsTitle);
  vtkAxis* seconds = chart->GetAxis(vtkAxis::BOTTOM);
  seconds->SetUnscaledRange(
    seconds->GetUnscaledMinimum(), roomForLabels * seconds->GetUnscaledMaximum());
  for (const ChartCurve& curve : curves)
  {
    AddMethod(chart, curve, &ChartRow::Seconds);
  }
  ChartWindow window(OverviewWidth, OverviewHeight);
  chart->SetSize(vtkRectf(0.f, 0.f, OverviewWidth, OverviewHeight));
  window.Actor->GetScene()->AddItem(chart);
  window.Window->Render();
  for (const ChartCurve& curve : curves)
  {
    AddLabel(window.Renderer, chart, curve);
  }
  window.Write(path);
}

}
