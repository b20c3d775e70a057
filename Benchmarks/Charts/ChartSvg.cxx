// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Writes the chart as SVG, directly from the rows.
#include "ChartFamilies.h"
#include "ChartPlot.h"
#include "Files/AtomicFile.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace penumbra
{

namespace
{

constexpr double Width = 620.0;
constexpr double LegendWidth = 300.0;
constexpr double Height = 460.0;
constexpr double Margins[4] = { 70.0, 20.0, 55.0, 35.0 }; ///< left, right, below, above

/// A logarithmic axis; maps decimal logarithms to coordinates of the image.
struct Axis
{
  double Low = 1e9;
  double High = -1e9;
  double From = 0.0;
  double To = 0.0;

  void Include(double value)
  {
    const double logarithm = std::log10(std::max(value, 1e-8));
    this->Low = std::min(this->Low, logarithm - .05);
    this->High = std::max(this->High, logarithm + .05);
  }

  double At(double value) const
  {
    const double share = (std::log10(std::max(value, 1e-8)) - this->Low) / (this->High - this->Low);
    return this->From + share * (this->To - this->From);
  }

  /// Returns the ticks: 1, 2 and 5 of every decade, or only 1 if there are many decades.
  std::vector<double> Ticks() const
  {
    std::vector<double> ticks;
    for (int decade = static_cast<int>(std::floor(this->Low)); decade <= this->High; ++decade)
    {
      for (const double digit : { 1.0, 2.0, 5.0 })
      {
        const double value = digit * std::pow(10.0, decade);
        const double logarithm = std::log10(value);
        const bool fits = logarithm >= this->Low && logarithm <= this->High;
        if (fits && (digit == 1.0 || this->High - this->Low < 3.0))
        {
          ticks.push_back(value);
        }
      }
    }
    return ticks;
  }
};

std::string Escaped(const std::string& text)
{
  std::string result;
  for (const char c : text)
  {
    result += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return result;
}

std::string Color(const unsigned char* color)
{
  return "rgb(" + std::to_string(color[0]) + "," + std::to_string(color[1]) + "," +
    std::to_string(color[2]) + ")";
}

class Drawing
{
public:
  void Text(double x, double y, const std::string& text, const std::string& more = {})
  {
    this->Out << "<text x='" << x << "' y='" << y << "' " << more << ">" << Escaped(text)
              << "</text>\n";
  }

  void Line(const std::vector<ChartRow>& rows, const Axis& x, double ChartRow::*cost, const Axis& y,
    const std::string& color, double width)
  {
    this->Out << "<polyline fill='none' stroke-linejoin='round' stroke='" << color
              << "' stroke-width='" << width << "' points='";
    for (const ChartRow& row : rows)
    {
      this->Out << x.At(row.*cost) << ',' << y.At(row.Error) << ' ';
    }
    this->Out << "'/>\n";
  }

  void Mark(double x, double y, const std::string& color, bool isOurs)
  {
    if (isOurs)
    {
      this->Out << "<path fill='" << color << "' d='M" << x - 5 << ' ' << y
                << "l5 -5 5 5 -5 5z'/>\n";
      return;
    }
    this->Out << "<circle r='3.5' fill='" << color << "' cx='" << x << "' cy='" << y << "'/>\n";
  }

  void Cross(double x, double y, const std::string& color)
  {
    this->Out << "<path fill='none' stroke='" << color << "' d='M" << x - 4 << ' ' << y - 4
              << "l8 8m-8 0l8 -8'/>\n";
  }

  void Frame(const Axis& x, const Axis& y)
  {
    for (const Axis* axis : { &x, &y })
    {
      for (const double tick : axis->Ticks())
      {
        const double at = axis->At(tick);
        std::ostringstream label;
        label << tick;
        const bool across = axis == &x;
        this->Out << "<path stroke='rgb(225,225,225)' d='M" << (across ? at : x.From) << ' '
                  << (across ? y.From : at) << (across ? "V" : "H") << (across ? y.To : x.To)
                  << "'/>\n";
        this->Text(across ? at : x.From - 6, across ? y.From + 16 : at + 4, label.str(),
          across ? "text-anchor='middle'" : "text-anchor='end'");
      }
    }
    this->Out << "<path fill='none' stroke='black' d='M" << x.From << ' ' << y.To << "V" << y.From
              << "H" << x.To << "'/>\n";
  }

  std::ostringstream Out;
};

void DrawChart(Drawing& drawing, const ChartFamily& family, const ChartPanel& panel, double left,
  double top, bool counts)
{
  const auto cost = counts ? &ChartRow::Count : &ChartRow::Seconds;
  Axis x;
  Axis y;
  for (const ChartRow& row : panel.Rows)
  {
    x.Include(row.*cost);
    y.Include(row.Error);
    y.Include(row.RequestedTolerance > 0.0 ? row.RequestedTolerance : row.Error);
  }
  x.From = left + Margins[0];
  x.To = left + Width - Margins[1];
  y.From = top + Height - Margins[2];
  y.To = top + Margins[3];
  drawing.Frame(x, y);
  const std::string middle = "text-anchor='middle' ";
  drawing.Text(
    left + Width / 2, top + 22, family.Title + ": " + panel.Scene, middle + "font-size='15'");
  drawing.Text(left + Width / 2, top + Height - 16,
    counts ? family.CountTitle : "CPU seconds of one thread", middle + "font-size='14'");
  std::ostringstream turned;
  turned << "transform='rotate(-90 " << left + 18 << ' ' << top + Height / 2 << ")' font-size='14'";
  drawing.Text(left + 18, top + Height / 2, family.ErrorTitle, middle + turned.str());
  drawing.Line(ParetoFront(panel.Rows, cost), x, cost, y, "rgb(210,210,210)", 9.0);
  for (const ChartCurve& curve : panel.Curves)
  {
    const std::string color = Color(curve.Color);
    drawing.Line(curve.Steps, x, cost, y, color, curve.IsOurs ? 2.5 : 1.5);
    for (const ChartRow& row : curve.Steps)
    {
      drawing.Mark(x.At(row.*cost), y.At(row.Error), color, curve.IsOurs);
      if (row.RequestedTolerance > 0.0)
      {
        drawing.Cross(x.At(row.*cost), y.At(row.RequestedTolerance), color);
      }
    }
  }
}

void DrawLegend(Drawing& drawing, const ChartPanel& panel, double left, double top)
{
  double y = top + Margins[3] + 10.0;
  drawing.Out << "<path stroke='rgb(210,210,210)' stroke-width='9' d='M" << left << ' ' << y
              << "h26'/>\n";
  drawing.Text(left + 34, y + 4, "Pareto front");
  for (const ChartCurve& curve : panel.Curves)
  {
    y += 20.0;
    const std::string color = Color(curve.Color);
    drawing.Out << "<path stroke='" << color << "' stroke-width='2' d='M" << left << ' ' << y
                << "h26'/>\n";
    drawing.Mark(left + 13, y, color, curve.IsOurs);
    drawing.Text(left + 34, y + 4, curve.Method);
    if (curve.HasTolerances())
    {
      y += 20.0;
      drawing.Cross(left + 13, y, color);
      drawing.Text(left + 44, y + 4, "requested tolerance");
    }
  }
}

}

void WriteChartSvg(
  const ChartFamily& family, const std::vector<ChartPanel>& panels, const std::string& path)
{
  Drawing drawing;
  const double width = 2.0 * Width + LegendWidth;
  const double height = Height * static_cast<double>(panels.size());
  drawing.Out << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 " << width << ' ' << height
              << "' font-family='sans-serif' font-size='12'>\n<rect width='" << width
              << "' height='" << height << "' fill='white'/>\n";
  double top = 0.0;
  for (const ChartPanel& panel : panels)
  {
    DrawChart(drawing, family, panel, 0.0, top, false);
    DrawChart(drawing, family, panel, Width, top, true);
    DrawLegend(drawing, panel, 2.0 * Width + 10.0, top);
    top += Height;
  }
  drawing.Out << "</svg>\n";
  AtomicFile file(path, "--output");
  file.Write(drawing.Out.str());
  file.Commit();
}

}
