// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionOverlay.h"

#include "AnnotationCopies.h"
#include "ChartPainter.h"
#include "CollectionItems.h"
#include "Features/SceneFeatures.h"
#include "Overlay.h"
#include "OverlayRecorder.h"
#include "Scene.h"

#include "vtkActor2D.h"
#include "vtkAxesActor.h"
#include "vtkCaptionActor2D.h"
#include "vtkContextActor.h"
#include "vtkCoordinate.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPropAssembly.h"
#include "vtkPropCollection.h"
#include "vtkProperty2D.h"
#include "vtkRenderer.h"
#include "vtkScalarBarActor.h"
#include "vtkScalarsToColors.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkTextRenderer.h"
#include "vtkVector.h"

#include <cmath>
#include <vector>

namespace penumbra
{
namespace
{

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

/// Draws `bar` into scene.OverlayImage. A copy of the bar renders its parts into the overlay
/// instead of a window. The grid behind translucent colors is omitted. Returns false if VTK cannot
/// render text.
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
  OverlayRecorder recorder(renderer, dpi, scene, true);
  {
    vtkNew<vtkScalarBarActor> copy;
    CopySettings(bar, copy);
    copy->GetLookupTable()->Build();
    copy->RenderOverlay(recorder.GetViewport());
  }
  return recorder.HasText;
}

glm::dvec2 ToVector(const vtkVector2i& x)
{
  return { x[0], x[1] };
}

std::vector<std::string> SplitLines(const std::string& text)
{
  std::vector<std::string> lines(1);
  for (const char c : text)
  {
    if (c == '\n')
    {
      lines.emplace_back();
    }
    else
    {
      lines.back() += c;
    }
  }
  return lines;
}

bool DrawTextActor(vtkTextActor* actor, int dpi, Scene& scene)
{
  const char* text = actor->GetInput();
  if (!text || !*text)
  {
    return true;
  }
  vtkNew<vtkTextProperty> property;
  property->ShallowCopy(actor->GetTextProperty());
  const glm::dvec2 anchor = ComputePixelPosition(actor->GetPositionCoordinate(), scene);
  if (actor->GetTextScaleMode() == vtkTextActor::TEXT_SCALE_MODE_PROP)
  {
    const glm::dvec2 size = ComputePixelPosition(actor->GetPosition2Coordinate(), scene) - anchor;
    vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
    if (renderer)
    {
      renderer->GetConstrainedFontSize(
        text, property, static_cast<int>(size.x), static_cast<int>(size.y), dpi);
    }
  }
  return DrawText(text, property, anchor, dpi, *scene.OverlayImage);
}

/// Pixels that vtkTextActor::MinimumSize grants to scaled text.
constexpr double MinimumTextSize = 10.0;

/// Draws the labels of axes: text next to a point of the scene, scaled to a part of the image.
bool DrawAxesLabels(vtkAxesActor* axes, int dpi, Scene& scene)
{
  bool drawn = true;
  if (!axes->GetAxisLabels())
  {
    return drawn;
  }
  for (vtkCaptionActor2D* caption : { axes->GetXAxisCaptionActor2D(),
         axes->GetYAxisCaptionActor2D(), axes->GetZAxisCaptionActor2D() })
  {
    const char* text = caption->GetCaption();
    vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
    if (!caption->GetVisibility() || !text || !*text || !renderer)
    {
      drawn = drawn && renderer;
      continue;
    }
    // The box of the caption, inset by its padding.
    const glm::dvec2 low = ComputePixelPosition(caption->GetPositionCoordinate(), scene);
    const glm::dvec2 high = ComputePixelPosition(caption->GetPosition2Coordinate(), scene);
    const glm::dvec2 size =
      glm::max(high - low - 2.0 * caption->GetPadding(), glm::dvec2(MinimumTextSize));
    vtkNew<vtkTextProperty> property;
    property->ShallowCopy(caption->GetCaptionTextProperty());
    renderer->GetConstrainedFontSize(
      text, property, static_cast<int>(size.x), static_cast<int>(size.y), dpi);
    drawn = DrawText(text, property, low + static_cast<double>(caption->GetPadding()), dpi,
              *scene.OverlayImage) &&
      drawn;
  }
  return drawn;
}

/// Draws other 2-D props: a copy renders into the overlay.
void DrawAnnotation(
  vtkProp* prop, vtkRenderer* renderer, int dpi, const DepthQuery& findDepths, Scene& scene)
{
  OverlayRecorder recorder(renderer, dpi, scene);
  recorder.SelectPoints = [&](vtkSelectVisiblePoints* filter) {
    return SelectVisiblePoints(
      filter, recorder.GetViewport()->GetActiveCamera(), scene, findDepths);
  };
  vtkSmartPointer<vtkProp> copy = CopyAnnotation(prop);
  auto* actor = vtkActor2D::SafeDownCast(copy);
  if (!copy || (actor && actor->GetProperty()->GetDisplayLocation() == VTK_BACKGROUND_LOCATION))
  {
    WarnFeature(Feature::OtherProps, prop->GetClassName(), scene.Warnings);
    return;
  }
  recorder.Render(copy);
  if (recorder.NeedsWindow)
  {
    WarnFeature(Feature::FilteredVisiblePoints, prop->GetClassName(), scene.Warnings);
  }
}

/// Draws the 2-D props and those in assemblies. Returns false if VTK cannot render text.
bool DrawOverlays(vtkPropCollection* props, vtkRenderer* renderer, int dpi,
  const DepthQuery& findDepths, Scene& scene)
{
  bool drawn = true;
  for (vtkProp* prop : GetItems<vtkProp>(props))
  {
    if (!prop->GetVisibility())
    {
      continue;
    }
    if (auto* assembly = vtkPropAssembly::SafeDownCast(prop))
    {
      drawn = DrawOverlays(assembly->GetParts(), renderer, dpi, findDepths, scene) && drawn;
    }
    else if (auto* text = vtkTextActor::SafeDownCast(prop))
    {
      drawn = DrawTextActor(text, dpi, scene) && drawn;
    }
    else if (auto* axes = vtkAxesActor::SafeDownCast(prop))
    {
      drawn = DrawAxesLabels(axes, dpi, scene) && drawn;
    }
    else if (auto* bar = vtkScalarBarActor::SafeDownCast(prop))
    {
      drawn = DrawScalarBar(bar, renderer, dpi, scene) && drawn;
    }
    else if (auto* chart = vtkContextActor::SafeDownCast(prop))
    {
      PaintChart(chart, renderer, dpi, scene);
    }
    else if (IsOverlay(prop))
    {
      DrawAnnotation(prop, renderer, dpi, findDepths, scene);
    }
  }
  return drawn;
}

}

bool IsOverlay(vtkProp* prop)
{
  return vtkActor2D::SafeDownCast(prop) || prop->IsA("vtkLegendScaleActor") ||
    vtkContextActor::SafeDownCast(prop) || IsOverlayWidget(prop);
}

glm::dvec2 ComputePixelPosition(vtkCoordinate* coordinate, const Scene& scene)
{
  const double* value = coordinate->GetValue();
  const glm::dvec2 size(scene.ViewCamera.Width, scene.ViewCamera.Height);
  glm::dvec2 position(value[0], value[1]);
  switch (coordinate->GetCoordinateSystem())
  {
    case VTK_NORMALIZED_DISPLAY:
    case VTK_NORMALIZED_VIEWPORT:
      position *= size;
      break;
    case VTK_VIEW:
      position = 0.5 * (position + 1.0) * size;
      break;
    case VTK_WORLD:
      position = scene.ViewCamera.Project(scene.FromWorld(value));
      break;
    default:
      break; // pixels
  }
  vtkCoordinate* reference = coordinate->GetReferenceCoordinate();
  return reference ? position + ComputePixelPosition(reference, scene) : position;
}

void AddTextShapes(const std::string& text, vtkTextProperty* property, glm::dvec2 anchor, int dpi,
  vtkTextRenderer* renderer, Overlay& overlay)
{
  vtkTextRenderer::Metrics metrics;
  if (!renderer->GetMetrics(property, text, metrics, dpi))
  {
    return;
  }
  const double angle = property->GetOrientation() * vtkMath::Pi() / 180.0;
  const glm::dvec2 along(std::cos(angle), std::sin(angle));
  const glm::dvec2 up(-along.y, along.x);
  // The corners of the metrics are pixels of the text.
  const auto size = [](const vtkTextRenderer::Metrics& m) {
    return glm::dvec2(glm::length(ToVector(m.TopRight) - ToVector(m.TopLeft)) + 1.0,
      glm::length(ToVector(m.TopLeft) - ToVector(m.BottomLeft)) + 1.0);
  };
  const glm::dvec2 whole = size(metrics);
  const glm::dvec2 low = anchor + ToVector(metrics.BottomLeft) + 0.5 - 0.5 * (along + up);
  OverlayShape shape;
  if (property->GetBackgroundOpacity() > 0.0)
  {
    const double* color = property->GetBackgroundColor();
    shape.Corners = { low, low + whole.x * along, low + whole.x * along + whole.y * up,
      low + whole.y * up };
    shape.Color = glm::vec4(color[0], color[1], color[2], property->GetBackgroundOpacity());
    overlay.AddShape(shape);
  }
  const double* color = property->GetColor();
  shape.Corners.clear();
  shape.Color = glm::vec4(color[0], color[1], color[2], property->GetOpacity());
  shape.Angle = property->GetOrientation();
  shape.FontSize = property->GetFontSize() * dpi / 72.0;
  shape.FontFamily = property->GetFontFamilyAsString();
  const bool file = property->GetFontFamily() == VTK_FONT_FILE && property->GetFontFile();
  shape.FontFile = file ? property->GetFontFile() : "";
  shape.Bold = property->GetBold() != 0;
  shape.Italic = property->GetItalic() != 0;
  const std::vector<std::string> lines = SplitLines(text);
  const double lineHeight = whole.y / static_cast<double>(lines.size());
  const double descent = glm::length(ToVector(metrics.Descent)) + 1.0;
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    vtkTextRenderer::Metrics line;
    if (lines[i].empty() || !renderer->GetMetrics(property, lines[i], line, dpi))
    {
      continue;
    }
    const double indent = 0.5 * property->GetJustification() * (whole.x - size(line).x);
    const double height = static_cast<double>(lines.size() - 1 - i) * lineHeight + descent;
    shape.Text = lines[i];
    shape.Baseline = low + indent * along + height * up;
    overlay.AddShape(shape);
  }
}

vtkSmartPointer<vtkImageData> RenderText(
  const char* text, vtkTextProperty* property, int dpi, glm::ivec2& corner)
{
  vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
  auto image = vtkSmartPointer<vtkImageData>::New();
  int size[2];
  int box[4];
  if (!text || !*text || !renderer || !renderer->RenderString(property, text, image, size, dpi) ||
    !renderer->GetBoundingBox(property, text, box, dpi))
  {
    return nullptr;
  }
  corner = { box[0], box[2] };
  return image;
}

bool DrawText(
  const std::string& text, vtkTextProperty* property, glm::dvec2 anchor, int dpi, Overlay& overlay)
{
  glm::ivec2 corner;
  const vtkSmartPointer<vtkImageData> image = RenderText(text.c_str(), property, dpi, corner);
  if (!image)
  {
    return false;
  }
  overlay.DrawImage(image, static_cast<int>(std::lround(anchor.x)) + corner.x,
    static_cast<int>(std::lround(anchor.y)) + corner.y);
  AddTextShapes(text, property, glm::round(anchor), dpi, vtkTextRenderer::GetInstance(), overlay);
  return true;
}

void ExtractOverlay(vtkRenderer* renderer, int dpi, const DepthQuery& findDepths, Scene& scene)
{
  if (!DrawOverlays(renderer->GetViewProps(), renderer, dpi, findDepths, scene))
  {
    scene.Warnings.emplace_back(
      "Text was skipped because VTK cannot render it. Link VTK::RenderingFreeType.");
  }
}

}
