// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionScalarBar.h"

#include "SceneExtractionOverlay.h"

#include "vtkCoordinate.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkScalarBarActor.h"
#include "vtkScalarsToColors.h"
#include "vtkTextProperty.h"
#include "vtkTextRenderer.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <regex>

namespace penumbra
{
namespace
{

/// Layout of the bar as fractions of its rectangle's height: the title of a vertical bar, and the
/// gap between title and color bar. A horizontal bar has a title of three times this height.
constexpr double TitleFraction = 0.1;
constexpr double TitleGapFraction = 0.04;
/// Gap between the color bar and its labels, in pixels.
constexpr double LabelGap = 4.0;

/// Label at a position in [0, 1] along the color bar.
struct BandLabel
{
  double Position;
  std::string Text;
};

std::vector<BandLabel> MakeLabels(vtkScalarBarActor* bar)
{
  std::vector<BandLabel> labels;
  vtkScalarsToColors* table = bar->GetLookupTable();
  if (table->GetIndexedLookup())
  {
    const int count = table->GetNumberOfAnnotatedValues();
    for (int i = 0; bar->GetDrawAnnotations() && i < count; ++i)
    {
      labels.push_back({ (i + 0.5) / count, table->GetAnnotation(i) });
    }
    return labels;
  }
  if (!bar->GetDrawTickLabels())
  {
    return labels;
  }
  const int count = bar->GetNumberOfLabels();
  const std::vector<double> values = SampleRange(table, count);
  for (int i = 0; i < count; ++i)
  {
    labels.push_back({ count > 1 ? static_cast<double>(i) / (count - 1) : 0.5,
      FormatLabel(bar->GetLabelFormat(), values[i]) });
  }
  return labels;
}

std::vector<glm::vec4> ComputeBandColors(vtkScalarBarActor* bar)
{
  vtkScalarsToColors* table = bar->GetLookupTable();
  std::vector<glm::vec4> colors;
  const auto append = [&](const unsigned char* c) {
    colors.emplace_back(glm::vec4(c[0], c[1], c[2], bar->GetUseOpacity() ? c[3] : 255) / 255.f);
  };
  if (table->GetIndexedLookup())
  {
    for (int i = 0; i < table->GetNumberOfAnnotatedValues(); ++i)
    {
      double c[4];
      table->GetAnnotationColor(table->GetAnnotatedValue(i), c);
      colors.emplace_back(c[0], c[1], c[2], bar->GetUseOpacity() ? c[3] : 1.0);
    }
    return colors;
  }
  const auto numberOfColors = static_cast<int>(table->GetNumberOfAvailableColors());
  const int count = std::max(1, std::min(numberOfColors, bar->GetMaximumNumberOfColors()));
  // Each color is sampled at the center of its interval.
  const std::vector<double> values = SampleRange(table, 2 * count + 1);
  for (int i = 0; i < count; ++i)
  {
    append(table->MapValue(values[2 * i + 1]));
  }
  return colors;
}

/// Adds a warning for each requested part of the bar that is not supported.
void WarnUnsupportedParts(vtkScalarBarActor* bar, std::vector<std::string>& warnings)
{
  const struct
  {
    bool IsRequested;
    const char* Name;
  } parts[] = {
    { bar->GetDrawNanAnnotation() != 0, "NaN swatches" },
    { bar->GetDrawBelowRangeSwatch() != 0, "swatches below the range" },
    { bar->GetDrawAboveRangeSwatch() != 0, "swatches above the range" },
    { bar->GetDrawFrame() != 0, "frames" },
    { bar->GetDrawBackground() != 0, "backgrounds" },
  };
  for (const auto& part : parts)
  {
    if (part.IsRequested)
    {
      warnings.push_back(
        std::string("Scalar bar: ") + part.Name + " are not supported and were skipped.");
    }
  }
}

/// Reduces the font size of `property` so that each of `texts` fits into `available` (pixels).
void FitFontSize(
  const std::vector<BandLabel>& texts, glm::dvec2 available, int dpi, vtkTextProperty* property)
{
  vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
  int smallest = 1 << 20;
  for (const BandLabel& label : texts)
  {
    vtkNew<vtkTextProperty> fitted;
    fitted->ShallowCopy(property);
    if (renderer && !label.Text.empty())
    {
      const int size = renderer->GetConstrainedFontSize(label.Text, fitted,
        std::max(1, static_cast<int>(available.x)), std::max(1, static_cast<int>(available.y)),
        dpi);
      smallest = size > 0 ? std::min(smallest, size) : smallest;
    }
  }
  if (smallest < 1 << 20)
  {
    property->SetFontSize(smallest);
  }
}

/// Computes the layout of a scalar bar and draws it.
class ScalarBarPainter
{
public:
  ScalarBarPainter(vtkScalarBarActor* bar, int dpi, Scene& scene)
    : Bar(bar),
      DPI(dpi),
      Target(scene.OverlayImage),
      Vertical(bar->GetOrientation() == VTK_ORIENT_VERTICAL)
  {
    this->Low = ComputePixelPosition(bar->GetPositionCoordinate(), scene);
    this->High = ComputePixelPosition(bar->GetPosition2Coordinate(), scene);
    const double height = this->High.y - this->Low.y;
    const bool titled = bar->GetTitle() && *bar->GetTitle();
    const double title = titled ? (this->Vertical ? TitleFraction : 3.0 * TitleFraction) : 0.0;
    this->TitleHeight = title * height;
    // The color bar extends along the rectangle below the title; BarRatio is its relative width.
    this->BandHigh =
      this->High - glm::dvec2(0.0, this->TitleHeight + (titled ? TitleGapFraction * height : 0.0));
    this->LabelsAfter = bar->GetTextPosition() == vtkScalarBarActor::SucceedScalarBar;
    const int across = this->Vertical ? 0 : 1;
    this->BandLow = this->Low;
    const double width = this->BandHigh[across] - this->BandLow[across];
    (this->LabelsAfter ? this->BandHigh : this->BandLow)[across] = this->LabelsAfter
      ? this->Low[across] + bar->GetBarRatio() * width
      : this->BandHigh[across] - bar->GetBarRatio() * width;
  }

  bool Draw()
  {
    if (this->Bar->GetDrawColorBar())
    {
      this->DrawBand();
    }
    return this->DrawLabels() && this->DrawTitle();
  }

private:
  void DrawBand()
  {
    const std::vector<glm::vec4> colors = ComputeBandColors(this->Bar);
    const int axis = this->Vertical ? 1 : 0;
    const double length = this->BandHigh[axis] - this->BandLow[axis];
    // Each opaque color is drawn to the end of the bar and the next one over it, which avoids seams
    // in partially covered pixels. The edges of translucent colors are rounded to whole pixels
    // instead.
    const bool opaque = !this->Bar->GetUseOpacity();
    const auto computeEdge = [&](std::size_t i) {
      const double at = this->BandLow[axis] + length * static_cast<double>(i) / colors.size();
      return opaque ? at : std::round(at);
    };
    for (std::size_t i = 0; i < colors.size(); ++i)
    {
      glm::dvec2 low = this->BandLow;
      glm::dvec2 high = this->BandHigh;
      low[axis] = computeEdge(i);
      high[axis] = opaque ? high[axis] : computeEdge(i + 1);
      this->Target.FillRectangle(low, high, colors[i]);
    }
  }

  bool DrawLabels()
  {
    const std::vector<BandLabel> labels = MakeLabels(this->Bar);
    vtkNew<vtkTextProperty> property;
    property->ShallowCopy(this->Bar->GetLabelTextProperty());
    const int axis = this->Vertical ? 1 : 0;
    const int across = 1 - axis;
    const double length = this->BandHigh[axis] - this->BandLow[axis];
    if (!this->Bar->GetUnconstrainedFontSize() && !labels.empty())
    {
      glm::dvec2 available;
      available[axis] = 0.8 * length / static_cast<double>(labels.size());
      available[across] = (this->LabelsAfter ? this->High[across] - this->BandHigh[across]
                                             : this->BandLow[across] - this->Low[across]) -
        LabelGap;
      if (!this->Vertical)
      {
        available.y -= this->TitleHeight;
      }
      FitFontSize(labels, available, this->DPI, property);
    }
    if (this->Vertical)
    {
      property->SetVerticalJustificationToCentered();
      property->SetJustification(this->LabelsAfter ? VTK_TEXT_LEFT : VTK_TEXT_RIGHT);
    }
    else
    {
      property->SetVerticalJustification(this->LabelsAfter ? VTK_TEXT_BOTTOM : VTK_TEXT_TOP);
      property->SetJustificationToCentered();
    }
    bool drawn = true;
    for (const BandLabel& label : labels)
    {
      glm::dvec2 at;
      at[axis] = this->BandLow[axis] + label.Position * length;
      at[across] =
        this->LabelsAfter ? this->BandHigh[across] + LabelGap : this->BandLow[across] - LabelGap;
      drawn = label.Text.empty() || DrawText(label.Text, property, at, this->DPI, this->Target);
    }
    return drawn;
  }

  bool DrawTitle()
  {
    if (this->TitleHeight <= 0.0)
    {
      return true;
    }
    std::string text = this->Bar->GetTitle();
    if (this->Bar->GetComponentTitle() && *this->Bar->GetComponentTitle())
    {
      text += std::string(" ") + this->Bar->GetComponentTitle();
    }
    vtkNew<vtkTextProperty> property;
    property->ShallowCopy(this->Bar->GetTitleTextProperty());
    if (!this->Bar->GetUnconstrainedFontSize())
    {
      FitFontSize(
        { { 0.0, text } }, { this->High.x - this->Low.x, this->TitleHeight }, this->DPI, property);
    }
    property->SetJustificationToCentered();
    property->SetVerticalJustificationToTop();
    return DrawText(text, property, { 0.5 * (this->Low.x + this->High.x), this->High.y }, this->DPI,
      this->Target);
  }

  vtkScalarBarActor* Bar;
  int DPI;
  Overlay& Target;
  bool Vertical;
  bool LabelsAfter = true;
  glm::dvec2 Low;
  glm::dvec2 High;
  glm::dvec2 BandLow;
  glm::dvec2 BandHigh;
  double TitleHeight = 0.0;
};

}

bool DrawScalarBar(vtkScalarBarActor* bar, int dpi, Scene& scene)
{
  if (!bar->GetLookupTable())
  {
    return true;
  }
  bar->GetLookupTable()->Build();
  WarnUnsupportedParts(bar, scene.Warnings);
  return ScalarBarPainter(bar, dpi, scene).Draw();
}

std::vector<double> SampleRange(vtkScalarsToColors* table, int count)
{
  const double* range = table->GetRange();
  const bool logarithmic = table->UsingLogScale() && range[0] * range[1] > 0.0;
  std::vector<double> values;
  for (int i = 0; i < count; ++i)
  {
    const double t = count > 1 ? static_cast<double>(i) / (count - 1) : 0.5;
    values.push_back(logarithmic ? range[0] * std::pow(range[1] / range[0], t)
                                 : range[0] + t * (range[1] - range[0]));
  }
  return values;
}

std::string FormatLabel(const char* format, double value)
{
  // VTK 9.6 and later use std::format strings, such as "{:<#6.3g}" instead of "%-#6.3g".
  static const std::regex braces(R"(\{:[<>^]?([-+ #0]*\d*(\.\d+)?[eEfFgG])\})");
  static const std::regex percent(R"([^%]*%[-+ #0]*\d*(\.\d+)?[eEfFgG][^%]*)");
  std::string style = std::regex_replace(std::string(format ? format : ""), braces, "%$1");
  if (!std::regex_match(style, percent))
  {
    style = "%g";
  }
  char text[400];
  std::snprintf(text, sizeof text, style.c_str(), value);
  std::string label = text;
  label.erase(0, label.find_first_not_of(' '));
  label.erase(label.find_last_not_of(' ') + 1);
  return label;
}

}
