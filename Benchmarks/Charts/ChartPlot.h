// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The pictures of a chart: for each scene error against seconds and error against counts, both
// logarithmic. PNG by VTK's charts. SVG by hand: not every VTK has an exporter for it, and GL2PS of VTK
// 9.7 crashes on charts.
#ifndef penumbra_ChartPlot_h
#define penumbra_ChartPlot_h

#include "ChartTable.h"

#include <string>
#include <vector>

namespace penumbra
{

struct ChartFamily;

/// The steps of one method.
struct ChartCurve
{
  std::string Method;
  bool IsOurs;
  unsigned char Color[3];
  std::vector<ChartRow> Steps;
  bool HasTolerances() const; ///< were tolerances asked?
};

/// All steps in one scene.
struct ChartPanel
{
  std::string Scene;
  std::vector<ChartRow> Rows;
  std::vector<ChartCurve> Curves;
};

std::vector<ChartPanel> PanelsOf(const std::vector<ChartRow>& rows);

///@{
/// Throws Failure where the file cannot be written. The PNG needs an OpenGL window.
void WriteChartPng(
  const ChartFamily& family, const std::vector<ChartPanel>& panels, const std::string& path);
void WriteChartSvg(
  const ChartFamily& family, const std::vector<ChartPanel>& panels, const std::string& path);
///@}

}
#endif
