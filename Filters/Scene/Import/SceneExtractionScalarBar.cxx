// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionScalarBar.h"

#include "ClassReplacement.h"
#include "SceneExtractionOverlay.h"
#include "SizeOnlyWindow.h"

#include "vtkCellData.h"
#include "vtkCoordinate.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper2D.h"
#include "vtkProperty2D.h"
#include "vtkScalarBarActor.h"
#include "vtkScalarsToColors.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkTextRenderer.h"
#include "vtkTexture.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace penumbra
{
namespace
{

/// Target of the parts of a bar.
struct OverlayTarget
{
  Overlay& Image;
  int DPI;
  bool Drawn = true; ///< false if VTK could not render some text
};

/// Target of the bar that this thread draws, or null.
thread_local OverlayTarget* Target = nullptr;

/// Returns true if a point is in a polygon. Polygons that share an edge have no point in common.
bool IsInPolygon(const std::vector<glm::dvec2>& corners, glm::dvec2 point)
{
  bool inside = false;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++)
  {
    const glm::dvec2 a = corners[i];
    const glm::dvec2 b = corners[j];
    inside = (a.y > point.y) != (b.y > point.y) &&
        point.x < a.x + (point.y - a.y) * (b.x - a.x) / (b.y - a.y)
      ? !inside
      : inside;
  }
  return inside;
}

/// Fills the pixels whose centers are in a polygon, as OpenGL does without antialiasing.
void FillPolygon(const std::vector<glm::dvec2>& corners, glm::vec4 color)
{
  glm::dvec2 low(1e9);
  glm::dvec2 high(-1e9);
  for (const glm::dvec2& corner : corners)
  {
    low = glm::min(low, corner);
    high = glm::max(high, corner);
  }
  low = glm::max(glm::floor(low), 0.0);
  high = glm::min(high, glm::dvec2(Target->Image.GetWidth(), Target->Image.GetHeight()));
  for (double y = low.y; y < high.y; ++y)
  {
    for (double x = low.x; x < high.x; ++x)
    {
      if (IsInPolygon(corners, { x + 0.5, y + 0.5 }))
      {
        Target->Image.FillRectangle({ x, y }, { x + 1.0, y + 1.0 }, color);
      }
    }
  }
}

/// Fills a line as a rectangle.
void FillLine(glm::dvec2 from, glm::dvec2 to, double width, glm::vec4 color)
{
  const double length = glm::length(to - from);
  if (length > 0.0)
  {
    const glm::dvec2 along = 0.5 * width * (to - from) / length;
    const glm::dvec2 across(-along.y, along.x);
    FillPolygon(
      { from - along - across, to + along - across, to + along + across, from - along + across },
      color);
  }
}

glm::dvec2 ComputeViewportPosition(vtkActor2D* actor, vtkViewport* viewport)
{
  const int* at = actor->GetActualPositionCoordinate()->GetComputedViewportValue(viewport);
  return { at[0], at[1] };
}

/// Draws polygons and lines into the overlay.
class OverlayMapper : public vtkPolyDataMapper2D
{
public:
  static OverlayMapper* New();
  vtkTypeMacro(OverlayMapper, vtkPolyDataMapper2D);

  void RenderOverlay(vtkViewport* viewport, vtkActor2D* actor) override
  {
    vtkPolyData* input = this->GetInput();
    if (!Target || !input || !input->GetPoints() || actor->IsA("vtkTexturedActor2D"))
    {
      return;
    }
    vtkProperty2D* property = actor->GetProperty();
    vtkUnsignedCharArray* colors = this->MapScalars(property->GetOpacity());
    const bool perCell = input->GetCellData()->GetScalars() != nullptr;
    const glm::dvec2 origin = ComputeViewportPosition(actor, viewport);
    vtkNew<vtkIdList> ids;
    for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
    {
      input->GetCellPoints(cell, ids);
      std::vector<glm::dvec2> corners;
      for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
      {
        const double* point = input->GetPoint(ids->GetId(i));
        corners.push_back(origin + glm::dvec2(point[0], point[1]));
      }
      const double* c = property->GetColor();
      glm::vec4 color(c[0], c[1], c[2], property->GetOpacity());
      if (colors && !corners.empty())
      {
        double bytes[4];
        colors->GetTuple(perCell ? cell : ids->GetId(0), bytes);
        color = glm::vec4(bytes[0], bytes[1], bytes[2], bytes[3]) / 255.f;
      }
      this->DrawCell(input->GetCellType(cell), corners, property->GetLineWidth(), color);
    }
  }

private:
  static void DrawCell(
    int type, const std::vector<glm::dvec2>& corners, double lineWidth, glm::vec4 color)
  {
    if (type != VTK_LINE && type != VTK_POLY_LINE)
    {
      FillPolygon(corners, color);
      return;
    }
    for (std::size_t i = 1; i < corners.size(); ++i)
    {
      FillLine(corners[i - 1], corners[i], lineWidth, color);
    }
  }
};
vtkStandardNewMacro(OverlayMapper);

/// Draws its text into the overlay.
class OverlayText : public vtkTextActor
{
public:
  static OverlayText* New();
  vtkTypeMacro(OverlayText, vtkTextActor);

  int RenderOverlay(vtkViewport* viewport) override
  {
    const char* text = this->GetInput();
    if (Target && text && *text)
    {
      Target->Drawn = DrawText(text, this->GetTextProperty(),
                        ComputeViewportPosition(this, viewport), Target->DPI, Target->Image) &&
        Target->Drawn;
    }
    return 1;
  }

  int RenderOpaqueGeometry(vtkViewport*) override { return 0; }
};
vtkStandardNewMacro(OverlayText);

/// Texture of the bar, whose rectangle OverlayMapper omits. It needs no graphics context.
class OverlayTexture : public vtkTexture
{
public:
  static OverlayTexture* New();
  vtkTypeMacro(OverlayTexture, vtkTexture);
  void Render(vtkRenderer*) override {}
  void PostRender(vtkRenderer*) override {}
};
vtkStandardNewMacro(OverlayTexture);

/// Makes the bar that this thread draws create parts that draw into the overlay.
void ReplaceClasses()
{
  static const bool replaced = [] {
    ReplaceClass("vtkPolyDataMapper2D", "OverlayMapper",
      [] { return static_cast<vtkObject*>(Target ? OverlayMapper::New() : nullptr); });
    ReplaceClass("vtkTextActor", "OverlayText",
      [] { return static_cast<vtkObject*>(Target ? OverlayText::New() : nullptr); });
    ReplaceClass("vtkTexture", "OverlayTexture",
      [] { return static_cast<vtkObject*>(Target ? OverlayTexture::New() : nullptr); });
    return true;
  }();
  static_cast<void>(replaced);
}

/// Copies settings that VTK 9.1 and 9.2 do not have.
template <typename Bar>
auto CopyLaterSettings(Bar* from, Bar* to, int)
  -> decltype(from->GetForceVerticalTitle(), from->GetOpacityFunction(), void())
{
  to->SetForceVerticalTitle(from->GetForceVerticalTitle());
  to->SetOpacityFunction(from->GetOpacityFunction());
}
template <typename Bar>
void CopyLaterSettings(Bar*, Bar*, long)
{
}

/// Copies all settings; vtkScalarBarActor::ShallowCopy() omits most.
void CopySettings(vtkScalarBarActor* from, vtkScalarBarActor* to)
{
  to->ShallowCopy(from);
  to->SetBarRatio(from->GetBarRatio());
  to->SetTitleRatio(from->GetTitleRatio());
  to->SetTextPad(from->GetTextPad());
  to->SetTextPosition(from->GetTextPosition());
  to->SetNumberOfLabels(from->GetNumberOfLabels());
  to->SetComponentTitle(from->GetComponentTitle());
  to->SetUseOpacity(from->GetUseOpacity());
  to->SetMaximumWidthInPixels(from->GetMaximumWidthInPixels());
  to->SetMaximumHeightInPixels(from->GetMaximumHeightInPixels());
  to->SetAnnotationLeaderPadding(from->GetAnnotationLeaderPadding());
  to->SetAnnotationTextScaling(from->GetAnnotationTextScaling());
  to->SetFixedAnnotationLeaderLineColor(from->GetFixedAnnotationLeaderLineColor());
  to->SetVerticalTitleSeparation(from->GetVerticalTitleSeparation());
  to->SetUnconstrainedFontSize(from->GetUnconstrainedFontSize());
  to->SetDrawAnnotations(from->GetDrawAnnotations());
  to->SetDrawColorBar(from->GetDrawColorBar());
  to->SetDrawTickLabels(from->GetDrawTickLabels());
  to->SetDrawNanAnnotation(from->GetDrawNanAnnotation());
  to->SetNanAnnotation(from->GetNanAnnotation());
  to->SetDrawBelowRangeSwatch(from->GetDrawBelowRangeSwatch());
  to->SetBelowRangeAnnotation(from->GetBelowRangeAnnotation());
  to->SetDrawAboveRangeSwatch(from->GetDrawAboveRangeSwatch());
  to->SetAboveRangeAnnotation(from->GetAboveRangeAnnotation());
  CopyLaterSettings(from, to, 0);
}

}

bool DrawScalarBar(vtkScalarBarActor* bar, vtkRenderer* renderer, int dpi, Scene& scene)
{
  if (!bar->GetLookupTable())
  {
    return true;
  }
  if (!vtkTextRenderer::GetInstance())
  {
    return false;
  }
  ReplaceClasses();
  vtkNew<SizeOnlyWindow> window;
  vtkNew<SizeOnlyRenderer> layoutRenderer;
  window->SetSize(scene.ViewCamera.Width, scene.ViewCamera.Height);
  window->SetDPI(dpi);
  window->AddRenderer(layoutRenderer);
  if (renderer->IsActiveCameraCreated())
  {
    layoutRenderer->SetActiveCamera(renderer->GetActiveCamera());
  }
  OverlayTarget target{ scene.OverlayImage, dpi };
  Target = &target;
  {
    vtkNew<vtkScalarBarActor> copy;
    CopySettings(bar, copy);
    copy->GetLookupTable()->Build();
    copy->RenderOverlay(layoutRenderer);
  }
  Target = nullptr;
  window->RemoveRenderer(layoutRenderer);
  return target.Drawn;
}

}
