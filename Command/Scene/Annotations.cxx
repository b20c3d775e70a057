// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Annotations.h"

#include "Files/ImageFiles.h"
#include "Files/Placeholders.h"
#include "Options/RenderOptions.h"
#include "Processes/CommandConstants.h"
#include "TextFont.h"

#include "vtkCoordinate.h"
#include "vtkNew.h"
#include "vtkRenderer.h"
#include "vtkScalarBarActor.h"
#include "vtkScalarsToColors.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkTextRenderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <vector>

namespace penumbra
{

namespace
{

/// Height of the text as a fraction of that of the image.
constexpr double TextFraction = 0.03;

/// Height of a horizontal bar with its labels as a fraction of that of the image, at least.
constexpr double LeastHeight = 2.6 * TextFraction;

/// Distance of the bar from the border of the image, as a fraction of it.
constexpr double Margin = 0.02;

void SetFont(const std::string& text, const RenderOptions& options, vtkTextProperty* style)
{
  // Viewers of SVG have other fonts, and PDF files without the characters are refused.
  SetFontFor(text, style, !IsVectorGraphic(options.Output));
}

/// Width and height of a text in pixels.
std::array<double, 2> MeasureText(const std::string& text, vtkTextProperty* style, int dpi)
{
  int box[4] = { 0, -1, 0, -1 };
  vtkTextRenderer* const texts = vtkTextRenderer::GetInstance();
  if (text.empty() || !texts || !texts->GetBoundingBox(style, text, box, dpi))
  {
    return { 0.0, 0.0 };
  }
  return { box[1] - box[0] + 1.0, box[3] - box[2] + 1.0 };
}

/// Width of the widest label in pixels.
double MeasureLabels(
  vtkScalarsToColors* table, const ScalarBarOptions& settings, vtkTextProperty* style, int dpi)
{
  double width = 0.0;
  const double* range = table->GetRange();
  for (int i = 0; i < settings.Labels; ++i)
  {
    const double t = settings.Labels > 1 ? i / (settings.Labels - 1.0) : 0.5;
    char label[400] = "";
    std::snprintf(
      label, sizeof(label), settings.Format.c_str(), range[0] + t * (range[1] - range[0]));
    width = std::max(width, MeasureText(label, style, dpi)[0]);
  }
  return width;
}

/// Adds a text whose lower center is at `position`, in fractions of the image, or further to the left
/// if its end at `right` requires it.
void AddTitle(vtkRenderer* renderer, const std::string& title, vtkTextProperty* style,
  const std::array<double, 2>& position, double width, double right)
{
  if (title.empty())
  {
    return;
  }
  vtkNew<vtkTextActor> text;
  text->SetInput(title.c_str());
  text->GetTextProperty()->ShallowCopy(style);
  const bool isCentered = position[0] + 0.5 * width <= right;
  text->GetTextProperty()->SetJustification(isCentered ? VTK_TEXT_CENTERED : VTK_TEXT_RIGHT);
  text->GetTextProperty()->SetVerticalJustificationToBottom();
  text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  text->SetPosition(isCentered ? position[0] : right, position[1]);
  renderer->AddViewProp(text);
}

}

void AddScalarBar(vtkRenderer* renderer, vtkScalarsToColors* table, const std::string& name,
  const RenderOptions& options, bool darkText)
{
  const ScalarBarOptions& settings = options.Coloring.Bar;
  const double height = options.Resolution[1];
  const int fontSize =
    std::max(6, static_cast<int>(std::lround(TextFraction * height * 72.0 / options.DotsPerInch)));
  vtkNew<vtkScalarBarActor> bar;
  for (vtkTextProperty* text : { bar->GetTitleTextProperty(), bar->GetLabelTextProperty() })
  {
    text->SetFontSize(fontSize);
    text->BoldOff();
    text->ItalicOff();
    const double shade = darkText ? 0.0 : 1.0;
    text->SetColor(shade, shade, shade);
    text->SetShadow(!darkText);
  }
  const std::string title = settings.Title.value_or(name);
  SetFont(title, options, bar->GetTitleTextProperty());
  SetFont("0", options, bar->GetLabelTextProperty());
  bar->UnconstrainedFontSizeOn();
  bar->SetLookupTable(table);
  bar->SetTitle(title.c_str());
  bar->SetLabelFormat(settings.Format.c_str());
  bar->SetNumberOfLabels(settings.Labels);
  const int pixels = static_cast<int>(std::lround(TextFraction * height));
  bar->SetVerticalTitleSeparation(pixels);
  bar->SetTextPad(std::max(2, pixels / 4));

  // Texts end within the image; sizes are fractions of it.
  const double width = options.Resolution[0];
  const double labels =
    MeasureLabels(table, settings, bar->GetLabelTextProperty(), options.DotsPerInch) / width;
  const std::array<double, 2> titleSize =
    MeasureText(title, bar->GetTitleTextProperty(), options.DotsPerInch);
  std::vector<double> size = settings.Size;
  if (size.empty())
  {
    size = { 0.14, 0.7 };
  }
  const bool isHorizontal = size[0] > size[1];
  double extent = size[0]; // with labels that do not fit
  if (isHorizontal)
  {
    size[0] = std::min(size[0], std::max(0.1, 1.0 - Margin - labels));
    size[1] = std::max(size[1], LeastHeight);
  }
  else
  {
    const double thickness = bar->GetBarRatio() * size[0];
    const double texts = labels + (bar->GetTextPad() + 1.0) / width;
    if (settings.Size.empty())
    {
      size[0] = std::max(size[0], std::min(thickness + texts, 0.5));
    }
    bar->SetBarRatio(std::clamp(1.0 - texts / size[0], 0.1, thickness / size[0]));
    extent = std::max(size[0], bar->GetBarRatio() * size[0] + texts);
  }
  std::vector<double> position = settings.Position;
  if (position.empty())
  {
    position = isHorizontal ? std::vector<double>{ 0.5 * (1.0 - size[0]), Margin }
                            : std::vector<double>{ std::max(0.0, 1.0 - Margin - extent),
                                std::max(0.0, 0.5 * (1.0 - size[1])) };
  }
  const double titleWidth = titleSize[0] / width;
  const double center = position[0] + 0.5 * size[0];
  if (isHorizontal)
  {
    // vtkScalarBarActor draws the title of a horizontal bar over its labels: it is a separate text.
    bar->SetOrientationToHorizontal();
    bar->SetTextPositionToPrecedeScalarBar();
    bar->SetTitle("");
    const double labelHeight = 1.6 * pixels / (size[1] * height);
    bar->SetBarRatio(std::clamp(1.0 - labelHeight, 0.1, 0.9));
    AddTitle(renderer, title, bar->GetTitleTextProperty(),
      { center, position[1] + size[1] + 0.5 * TextFraction }, titleWidth, 1.0 - Margin);
  }
  else if (center + 0.5 * titleWidth > 1.0 - 0.5 * Margin)
  {
    // It also centers the title, which would end outside of the image.
    const double titleHeight = titleSize[1] / height;
    bar->SetTitle("");
    AddTitle(renderer, title, bar->GetTitleTextProperty(),
      { center, position[1] + size[1] - titleHeight }, titleWidth, 1.0 - Margin);
    size[1] = std::max(0.1 * size[1], size[1] - titleHeight - TextFraction);
  }
  bar->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  bar->SetPosition(position[0], position[1]);
  bar->SetWidth(size[0]);
  bar->SetHeight(size[1]);
  renderer->AddViewProp(bar);
}

void AddLabels(vtkRenderer* renderer, const std::vector<std::string>& files,
  const RenderOptions& options, bool darkText)
{
  std::string text = ReplaceAll(options.Text, TimePlaceholder, options.TimeText);
  if (options.FileNameLabel)
  {
    for (const std::string& file : files)
    {
      text += (text.empty() ? "" : "\n") + std::filesystem::path(file).filename().string();
    }
  }
  if (options.TimeLabel)
  {
    text += (text.empty() ? "Time: " : "\nTime: ") + options.TimeText;
  }
  if (text.empty())
  {
    return;
  }
  vtkNew<vtkTextActor> label;
  label->SetInput(text.c_str());
  label->GetPositionCoordinate()->SetCoordinateSystemToDisplay();
  const double margin = LabelMargin * options.DotsPerInch / 72.0;
  label->SetPosition(margin, options.Resolution[1] - margin);
  vtkTextProperty* style = label->GetTextProperty();
  style->SetFontSize(LabelPoints);
  SetFont(text, options, style);
  style->SetVerticalJustificationToTop();
  const double shade = darkText ? 0.0 : 1.0;
  style->SetColor(shade, shade, shade);
  renderer->AddViewProp(label);
}

}
