// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionScalarBar.h"

#include "OverlayRecorder.h"
#include "Scene.h"

#include "vtkNew.h"
#include "vtkScalarBarActor.h"
#include "vtkScalarsToColors.h"
#include "vtkTextRenderer.h"

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
  OverlayRecorder recorder(renderer, dpi, scene, true);
  {
    vtkNew<vtkScalarBarActor> copy;
    CopySettings(bar, copy);
    copy->GetLookupTable()->Build();
    copy->RenderOverlay(recorder.GetViewport());
  }
  return recorder.HasText;
}

}
