// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ScalarBar.h"

#include "Options/RenderOptions.h"
#include "TextFont.h"

#include "vtkNew.h"
#include "vtkRenderer.h"
#include "vtkScalarBarActor.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"

#include <algorithm>
#include <array>
#include <cmath>

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

/// Adds a text whose lower center is at `position`, in fractions of the image.
void AddTitle(vtkRenderer* renderer, const std::string& title, vtkTextProperty* style,
  const std::array<double, 2>& position)
{
  if (title.empty())
  {
    return;
  }
  vtkNew<vtkTextActor> text;
  text->SetInput(title.c_str());
  text->GetTextProperty()->ShallowCopy(style);
  text->GetTextProperty()->SetJustificationToCentered();
  text->GetTextProperty()->SetVerticalJustificationToBottom();
  text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  text->SetPosition(position[0], position[1]);
  renderer->AddViewProp(text);
}

}

void AddScalarBar(vtkRenderer* renderer, vtkScalarsToColors* table, const std::string& name,
  const RenderOptions& options, bool darkText, bool warnsOfFonts)
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
  SetFontFor(title, bar->GetTitleTextProperty(), warnsOfFonts);
  SetFontFor("0", bar->GetLabelTextProperty(), warnsOfFonts);
  bar->UnconstrainedFontSizeOn();
  bar->SetLookupTable(table);
  bar->SetTitle(title.c_str());
  bar->SetLabelFormat(settings.Format.c_str());
  bar->SetNumberOfLabels(settings.Labels);
  const int pixels = static_cast<int>(std::lround(TextFraction * height));
  bar->SetVerticalTitleSeparation(pixels);
  bar->SetTextPad(std::max(2, pixels / 4));

  std::vector<double> size = settings.Size;
  if (size.empty())
  {
    size = { 0.14, 0.7 };
  }
  const bool isHorizontal = size[0] > size[1];
  if (isHorizontal)
  {
    size[1] = std::max(size[1], LeastHeight);
  }
  std::vector<double> position = settings.Position;
  if (position.empty())
  {
    position = isHorizontal ? std::vector<double>{ 0.5 * (1.0 - size[0]), Margin }
                            : std::vector<double>{ std::max(0.0, 1.0 - Margin - size[0]),
                                std::max(0.0, 0.5 * (1.0 - size[1])) };
  }
  if (isHorizontal)
  {
    // vtkScalarBarActor draws the title of a horizontal bar over its labels: it is a separate text.
    bar->SetOrientationToHorizontal();
    bar->SetTextPositionToPrecedeScalarBar();
    bar->SetTitle("");
    const double labels = 1.6 * pixels / (size[1] * height);
    bar->SetBarRatio(std::clamp(1.0 - labels, 0.1, 0.9));
    AddTitle(renderer, title, bar->GetTitleTextProperty(),
      { position[0] + 0.5 * size[0], position[1] + size[1] + 0.5 * TextFraction });
  }
  bar->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  bar->SetPosition(position[0], position[1]);
  bar->SetWidth(size[0]);
  bar->SetHeight(size[1]);
  renderer->AddViewProp(bar);
}

}
