// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OverlayText.h"

#include "OverlayRecorder.h"
#include "SceneExtractionOverlay.h"

#include "vtkObjectFactory.h"
#include "vtkStdString.h" // the type of text in VTK 9.2
#include "vtkTextActor.h"
#include "vtkTextMapper.h"
#include "vtkTextProperty.h"
#include "vtkTextRenderer.h"

namespace penumbra
{
namespace
{

/// Draws its text into the overlay.
class OverlayText : public vtkTextActor
{
public:
  static OverlayText* New();
  vtkTypeMacro(OverlayText, vtkTextActor);

  int RenderOverlay(vtkViewport* viewport) override
  {
    const char* text = this->GetInput();
    OverlayRecorder* recorder = OverlayRecorder::GetCurrent();
    if (recorder && text && *text)
    {
      recorder->HasText =
        DrawText(text, this->GetTextProperty(), ComputeViewportPosition(this, viewport),
          recorder->DPI, recorder->Image) &&
        recorder->HasText;
    }
    return 1;
  }

  int RenderOpaqueGeometry(vtkViewport*) override { return 0; }
};
vtkStandardNewMacro(OverlayText);

/// Calls `render`, which draws the image of a text as a texture.
template <typename Function>
void RenderText(const char* text, vtkTextProperty* style, Function&& render)
{
  OverlayRecorder* recorder = OverlayRecorder::GetCurrent();
  if (recorder)
  {
    recorder->Text = text;
    recorder->TextStyle = style;
  }
  render();
  if (recorder)
  {
    recorder->Text = nullptr;
    recorder->TextStyle = nullptr;
  }
}

/// Draws an image of its text into the overlay, and describes it.
class DescribedText : public vtkTextActor
{
public:
  static DescribedText* New();
  vtkTypeMacro(DescribedText, vtkTextActor);

  int RenderOverlay(vtkViewport* viewport) override
  {
    int result = 0;
    RenderText(this->GetInput(), this->ScaledTextProperty,
      [&] { result = this->Superclass::RenderOverlay(viewport); });
    return result;
  }
};
vtkStandardNewMacro(DescribedText);

/// The same for mappers of text.
class DescribedTextMapper : public vtkTextMapper
{
public:
  static DescribedTextMapper* New();
  vtkTypeMacro(DescribedTextMapper, vtkTextMapper);

  void RenderOverlay(vtkViewport* viewport, vtkActor2D* actor) override
  {
    RenderText(this->GetInput(), this->GetTextProperty(),
      [&] { this->Superclass::RenderOverlay(viewport, actor); });
  }
};
vtkStandardNewMacro(DescribedTextMapper);

}

vtkObject* MakeTextActor(OverlayRecorder* recorder)
{
  if (!recorder)
  {
    return nullptr;
  }
  return recorder->SkipsTextures ? static_cast<vtkObject*>(OverlayText::New())
                                 : static_cast<vtkObject*>(DescribedText::New());
}

vtkObject* MakeTextMapper(OverlayRecorder* recorder)
{
  return recorder ? DescribedTextMapper::New() : nullptr;
}

void DescribeText(glm::dvec2 corner, OverlayRecorder& recorder)
{
  vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
  int box[4];
  if (renderer && renderer->GetBoundingBox(recorder.TextStyle, recorder.Text, box, recorder.DPI))
  {
    const glm::dvec2 anchor = glm::round(corner - glm::dvec2(box[0], box[2]));
    AddTextShapes(
      recorder.Text, recorder.TextStyle, anchor, recorder.DPI, renderer, recorder.Image);
  }
}

}
