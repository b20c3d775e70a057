// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "WidgetCopies.h"

#include "AnnotationCopies.h"
#include "OverlayRecorder.h"

#include "vtkCoordinate.h"
#include "vtkLogoRepresentation.h"
#include "vtkProperty2D.h"
#include "vtkSliderRepresentation2D.h"
#include "vtkTextProperty.h"
#include "vtkTexturedButtonRepresentation2D.h"

#include <algorithm>
#include <array>

namespace penumbra
{
namespace
{

vtkSmartPointer<vtkProp> CopySlider(vtkSliderRepresentation2D* from, vtkRenderer* viewport)
{
  auto to = vtkSmartPointer<vtkSliderRepresentation2D>::New();
  to->SetMaximumValue(std::max(from->GetMaximumValue(), to->GetMinimumValue()));
  to->SetMinimumValue(from->GetMinimumValue());
  to->SetMaximumValue(from->GetMaximumValue());
  to->SetValue(from->GetValue());
  to->SetSliderLength(from->GetSliderLength());
  to->SetSliderWidth(from->GetSliderWidth());
  to->SetTubeWidth(from->GetTubeWidth());
  to->SetEndCapLength(from->GetEndCapLength());
  to->SetEndCapWidth(from->GetEndCapWidth());
  to->SetTitleText(from->GetTitleText());
  to->SetTitleHeight(from->GetTitleHeight());
  to->SetLabelFormat(from->GetLabelFormat());
  to->SetLabelHeight(from->GetLabelHeight());
  to->SetShowSliderLabel(from->GetShowSliderLabel());
  CopyCoordinate(from->GetPoint1Coordinate(), to->GetPoint1Coordinate());
  CopyCoordinate(from->GetPoint2Coordinate(), to->GetPoint2Coordinate());
  to->GetSliderProperty()->DeepCopy(from->GetSliderProperty());
  to->GetTubeProperty()->DeepCopy(from->GetTubeProperty());
  to->GetCapProperty()->DeepCopy(from->GetCapProperty());
  to->GetTitleProperty()->ShallowCopy(from->GetTitleProperty());
  to->GetLabelProperty()->ShallowCopy(from->GetLabelProperty());
  to->SetRenderer(viewport);
  return to;
}

/// Reads the place of a button, which has no public accessor.
struct ButtonAccess : public vtkTexturedButtonRepresentation2D
{
  static std::array<double, 6> FindPlace(vtkTexturedButtonRepresentation2D* button)
  {
    const double(&bounds)[6] = button->*(&ButtonAccess::InitialBounds);
    std::array<double, 6> result;
    std::copy_n(bounds, 6, result.begin());
    return result;
  }
  static bool HasAnchor(vtkTexturedButtonRepresentation2D* button)
  {
    return button->*(&ButtonAccess::Anchor) != nullptr;
  }
};

vtkSmartPointer<vtkProp> CopyButton(
  vtkTexturedButtonRepresentation2D* from, vtkRenderer* viewport, int dpi)
{
  if (ButtonAccess::HasAnchor(from)) // at a point of the scene
  {
    return nullptr;
  }
  auto to = vtkSmartPointer<vtkTexturedButtonRepresentation2D>::New();
  to->ShallowCopy(from);
  to->SetRenderer(viewport);
  to->SetPlaceFactor(1.0); // the place of the other one includes its factor
  std::array<double, 6> place = ButtonAccess::FindPlace(from);
  std::transform(place.begin(), place.end(), place.begin(),
    [dpi](double pixels) { return pixels * dpi / 72.0; });
  to->PlaceWidget(place.data());
  return to;
}

vtkSmartPointer<vtkProp> CopyLogo(vtkLogoRepresentation* from, vtkRenderer* viewport)
{
  auto to = vtkSmartPointer<vtkLogoRepresentation>::New();
  to->SetImage(from->GetImage());
  to->GetImageProperty()->DeepCopy(from->GetImageProperty());
  to->SetProportionalResize(from->GetProportionalResize());
  to->SetShowBorder(from->GetShowBorder());
  to->GetBorderProperty()->DeepCopy(from->GetBorderProperty());
  CopyCoordinate(from->GetPositionCoordinate(), to->GetPositionCoordinate());
  CopyCoordinate(from->GetPosition2Coordinate(), to->GetPosition2Coordinate());
  to->SetRenderer(viewport);
  return to;
}

}

bool IsOverlayWidget(vtkProp* prop)
{
  return vtkSliderRepresentation2D::SafeDownCast(prop) ||
    vtkTexturedButtonRepresentation2D::SafeDownCast(prop) ||
    vtkLogoRepresentation::SafeDownCast(prop);
}

vtkSmartPointer<vtkProp> CopyWidget(vtkProp* prop)
{
  const OverlayRecorder& recorder = *OverlayRecorder::GetCurrent();
  vtkRenderer* viewport = OverlayRecorder::GetCurrent()->GetViewport();
  if (auto* slider = vtkSliderRepresentation2D::SafeDownCast(prop))
  {
    return CopySlider(slider, viewport);
  }
  if (auto* button = vtkTexturedButtonRepresentation2D::SafeDownCast(prop))
  {
    return CopyButton(button, viewport, recorder.DPI);
  }
  auto* logo = vtkLogoRepresentation::SafeDownCast(prop);
  return logo ? CopyLogo(logo, viewport) : nullptr;
}

}
