// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Labels.h"

#include "Files/ImageFiles.h"
#include "Options/Placeholders.h"
#include "Options/RenderOptions.h"
#include "Processes/CommandConstants.h"
#include "TextFont.h"

#include "vtkCoordinate.h"
#include "vtkNew.h"
#include "vtkRenderer.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"

#include <filesystem>

namespace penumbra
{

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
  // Viewers of SVG have other fonts, and PDF files without the characters are refused.
  SetFontFor(text, style, !IsVectorGraphic(options.Output));
  style->SetVerticalJustificationToTop();
  const double shade = darkText ? 0.0 : 1.0;
  style->SetColor(shade, shade, shade);
  renderer->AddViewProp(label);
}

}
