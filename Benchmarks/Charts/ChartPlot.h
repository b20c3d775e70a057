// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The plots of a chart: for each scene, error against seconds and error against counts, both
// logarithmic. The PNG is drawn by VTK's charts. The SVG is written directly, because not every VTK
// build has an SVG exporter and GL2PS of VTK 9.7 crashes on charts.
#ifndef penumbra_ChartPlot_h
#define penumbra_ChartPlot_h

#include "ChartTable.h"

#include <string>
#include <vector>

namespace penumbra
{

struct ChartFamily;

/// The settings of one method.
struct ChartCurve
{
  std::string Method;
  bool IsOurs;
  unsigned char Color[3];
  std::vector<ChartRow> Steps;
  bool HasTolerances() const; ///< whether any row has a requested tolerance
};

/// All settings in one scene.
struct ChartPanel
{
  std::string Scene;
  std::vector<ChartRow> Rows;
  std::vector<ChartCurve> Curves;
};

std::vector<ChartPanel> PanelsOf(const std::vector<ChartRow>& rows);

///@{
/// Throws Failure if the file cannot be written. A PNG requires an OpenGL window.
void WriteChartPng(
  const ChartFamily& family, const std::vector<ChartPanel>& panels, const std::string& path);
void WriteChartSvg(
  const ChartFamily& family, const std::vector<ChartPanel>& panels, const std::string& path);
/// Draws error against seconds of the methods of ChartFamily::Overview in one scene, with their labels
/// next to their curves.
void WriteChartOverview(
  const ChartFamily& family, const ChartPanel& panel, const std::string& path);
///@}

}
#endif
