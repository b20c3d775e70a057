// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "AnnotationCopies.h"

#include "OverlayRecorder.h"

#include "vtkActor2D.h"
#include "vtkAxisActor2D.h"
#include "vtkCaptionActor2D.h"
#include "vtkCoordinate.h"
#include "vtkCornerAnnotation.h"
#include "vtkImageData.h"
#include "vtkLegendBoxActor.h"
#include "vtkLegendScaleActor.h"
#include "vtkLogoRepresentation.h"
#include "vtkMapper2D.h"
#include "vtkPolyData.h"
#include "vtkProperty2D.h"
#include "vtkSliderRepresentation2D.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkTexture.h"
#include "vtkTexturedActor2D.h"
#include "vtkTexturedButtonRepresentation2D.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>

namespace penumbra
{
namespace
{

vtkSmartPointer<vtkTextProperty> Copy(vtkTextProperty* from)
{
  auto to = vtkSmartPointer<vtkTextProperty>::New();
  to->ShallowCopy(from);
  return to;
}

/// Copies position and appearance. vtkActor2D::ShallowCopy() shares the property and copies the
/// values of coordinates, but not their systems.
void CopyPlacement(vtkActor2D* from, vtkActor2D* to)
{
  CopyCoordinate(from->GetPositionCoordinate(), to->GetPositionCoordinate());
  CopyCoordinate(from->GetPosition2Coordinate(), to->GetPosition2Coordinate());
  vtkNew<vtkProperty2D> property;
  property->DeepCopy(from->GetProperty());
  to->SetProperty(property);
}

// Overloads with `long` serve versions of VTK that lack the settings.
template <typename Axis>
auto CopyLaterAxisSettings(Axis* from, Axis* to, int)
  -> decltype(to->SetSkipFirstTick(from->GetSkipFirstTick()), to->SetNotation(from->GetNotation()))
{
  to->SetSkipFirstTick(from->GetSkipFirstTick());
  to->SetSnapLabelsToGrid(from->GetSnapLabelsToGrid());
  to->SetPrecision(from->GetPrecision());
  to->SetNotation(from->GetNotation());
}
template <typename Axis>
void CopyLaterAxisSettings(Axis*, Axis*, long)
{
}

template <typename Legend>
auto CopyLaterLegendSettings(Legend* from, Legend* to, int)
  -> decltype(to->SetGridVisibility(from->GetGridVisibility()))
{
  to->SetGridVisibility(from->GetGridVisibility());
  to->SetOrigin(from->GetOrigin());
  to->SetNotation(from->GetNotation());
  to->SetPrecision(from->GetPrecision());
  to->SetNumberOfHorizontalLabels(from->GetNumberOfHorizontalLabels());
  to->SetNumberOfVerticalLabels(from->GetNumberOfVerticalLabels());
}
template <typename Legend>
void CopyLaterLegendSettings(Legend*, Legend*, long)
{
}

/// Copies the settings whose virtual functions VTK 9.7.1 moved in the table of the class, where
/// programs that were compiled with 9.7.0 call others: the members have not moved.
struct AxisFontSizes : vtkAxisActor2D
{
  static void Copy(vtkAxisActor2D* from, vtkAxisActor2D* to)
  {
    constexpr auto relativeToAxis = &AxisFontSizes::SizeFontRelativeToAxis;
    constexpr auto fromProperty = &AxisFontSizes::UseFontSizeFromProperty;
    to->*relativeToAxis = from->*relativeToAxis;
    to->*fromProperty = from->*fromProperty;
  }
};

void CopyMore(vtkAxisActor2D* from, vtkAxisActor2D* to)
{
  to->SetLabelTextProperty(Copy(from->GetLabelTextProperty()));
  to->SetTitleTextProperty(Copy(from->GetTitleTextProperty()));
  to->SetNumberOfMinorTicks(from->GetNumberOfMinorTicks());
  to->SetMinorTickLength(from->GetMinorTickLength());
  to->SetRulerMode(from->GetRulerMode());
  to->SetRulerDistance(from->GetRulerDistance());
  to->SetTitlePosition(from->GetTitlePosition());
  AxisFontSizes::Copy(from, to);
  CopyLaterAxisSettings(from, to, 0);
}

void CopyMore(vtkCaptionActor2D* from, vtkCaptionActor2D* to)
{
  to->SetCaptionTextProperty(Copy(from->GetCaptionTextProperty()));
  to->SetAttachEdgeOnly(from->GetAttachEdgeOnly());
  to->SetThreeDimensionalLeader(false); // the overlay has no depth
  CopyCoordinate(from->GetAttachmentPointCoordinate(), to->GetAttachmentPointCoordinate());
  to->GetTextActor()->SetTextScaleMode(from->GetTextActor()->GetTextScaleMode());
  to->GetTextActor()->SetMinimumSize(from->GetTextActor()->GetMinimumSize());
  to->GetTextActor()->SetMaximumLineHeight(from->GetTextActor()->GetMaximumLineHeight());
}

void CopyMore(vtkLegendBoxActor* from, vtkLegendBoxActor* to)
{
  to->SetEntryTextProperty(Copy(from->GetEntryTextProperty()));
  to->SetBox(from->GetBox());
  to->GetBoxProperty()->DeepCopy(from->GetBoxProperty());
  to->SetUseBackground(from->GetUseBackground());
  to->SetBackgroundColor(from->GetBackgroundColor());
  to->SetBackgroundOpacity(from->GetBackgroundOpacity());
  for (int i = 0; i < from->GetNumberOfEntries(); ++i)
  {
    if (vtkImageData* icon = from->GetEntryIcon(i))
    {
      to->SetEntryIcon(i, icon);
    }
  }
}

void CopyMore(vtkLegendScaleActor* from, vtkLegendScaleActor* to)
{
  to->SetLabelMode(from->GetLabelMode());
  to->SetRightAxisVisibility(from->GetRightAxisVisibility());
  to->SetTopAxisVisibility(from->GetTopAxisVisibility());
  to->SetLeftAxisVisibility(from->GetLeftAxisVisibility());
  to->SetBottomAxisVisibility(from->GetBottomAxisVisibility());
  to->SetLegendVisibility(from->GetLegendVisibility());
  to->SetRightBorderOffset(from->GetRightBorderOffset());
  to->SetTopBorderOffset(from->GetTopBorderOffset());
  to->SetLeftBorderOffset(from->GetLeftBorderOffset());
  to->SetBottomBorderOffset(from->GetBottomBorderOffset());
  to->SetCornerOffsetFactor(from->GetCornerOffsetFactor());
  to->GetLegendTitleProperty()->ShallowCopy(from->GetLegendTitleProperty());
  to->GetLegendLabelProperty()->ShallowCopy(from->GetLegendLabelProperty());
  CopyLaterLegendSettings(from, to, 0);
  using Getter = vtkAxisActor2D* (vtkLegendScaleActor::*)();
  for (const Getter get : { static_cast<Getter>(&vtkLegendScaleActor::GetRightAxis),
         static_cast<Getter>(&vtkLegendScaleActor::GetTopAxis),
         static_cast<Getter>(&vtkLegendScaleActor::GetLeftAxis),
         static_cast<Getter>(&vtkLegendScaleActor::GetBottomAxis) })
  {
    (to->*get)()->ShallowCopy((from->*get)());
    CopyMore((from->*get)(), (to->*get)());
    CopyPlacement((from->*get)(), (to->*get)());
  }
}

void CopyMore(vtkCornerAnnotation* from, vtkCornerAnnotation* to)
{
  to->CopyAllTextsFrom(from);
  to->SetTextProperty(Copy(from->GetTextProperty()));
  to->SetMaximumLineHeight(from->GetMaximumLineHeight());
  to->SetMinimumFontSize(from->GetMinimumFontSize());
  to->SetMaximumFontSize(from->GetMaximumFontSize());
  to->SetLinearFontScaleFactor(from->GetLinearFontScaleFactor());
  to->SetNonlinearFontScaleFactor(from->GetNonlinearFontScaleFactor());
  to->SetImageActor(from->GetImageActor());
  to->SetWindowLevel(from->GetWindowLevel());
  to->SetLevelShift(from->GetLevelShift());
  to->SetLevelScale(from->GetLevelScale());
  to->SetShowSliceAndImage(from->GetShowSliceAndImage());
}

/// Returns a copy if `prop` is a Prop, otherwise null.
template <typename Prop>
vtkSmartPointer<vtkProp> CopyAs(vtkProp* prop)
{
  auto* from = Prop::SafeDownCast(prop);
  if (!from)
  {
    return nullptr;
  }
  auto to = vtkSmartPointer<Prop>::New();
  to->ShallowCopy(from);
  CopyMore(from, to.Get());
  if constexpr (std::is_base_of_v<vtkActor2D, Prop>)
  {
    CopyPlacement(from, to);
  }
  return to;
}

/// Copies a vtkActor2D or vtkTexturedActor2D, not a prop of a derived class.
vtkSmartPointer<vtkProp> CopyPlain(vtkProp* prop)
{
  const bool isTextured = std::strcmp(prop->GetClassName(), "vtkTexturedActor2D") == 0;
  if (!isTextured && std::strcmp(prop->GetClassName(), "vtkActor2D") != 0)
  {
    return nullptr;
  }
  vtkSmartPointer<vtkMapper2D> mapper =
    OverlayRecorder::CopyMapper(vtkActor2D::SafeDownCast(prop)->GetMapper());
  if (!mapper)
  {
    return nullptr;
  }
  vtkSmartPointer<vtkActor2D> copy;
  if (isTextured)
  {
    auto textured = vtkSmartPointer<vtkTexturedActor2D>::New();
    vtkTexture* from = vtkTexturedActor2D::SafeDownCast(prop)->GetTexture();
    if (from && from->GetNumberOfInputConnections(0) > 0)
    {
      auto texture = vtkSmartPointer<vtkTexture>::New();
      texture->SetInputConnection(from->GetInputConnection(0, 0));
      texture->SetInterpolate(from->GetInterpolate());
      texture->SetColorMode(from->GetColorMode());
      texture->SetLookupTable(from->GetLookupTable());
      textured->SetTexture(texture);
    }
    copy = textured;
  }
  else
  {
    copy = vtkSmartPointer<vtkActor2D>::New();
  }
  copy->SetMapper(mapper);
  CopyPlacement(vtkActor2D::SafeDownCast(prop), copy);
  return copy;
}

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

/// Returns a copy of the representation of a slider, button or logo that the current OverlayRecorder
/// draws, or null if `prop` is another one.
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

void CopyCoordinate(vtkCoordinate* from, vtkCoordinate* to)
{
  to->SetCoordinateSystem(from->GetCoordinateSystem());
  to->SetReferenceCoordinate(from->GetReferenceCoordinate());
  to->SetValue(from->GetValue());
}

vtkSmartPointer<vtkProp> CopyAnnotation(vtkProp* prop)
{
  using CopyFunction = vtkSmartPointer<vtkProp> (*)(vtkProp*);
  for (const CopyFunction copy :
    { &CopyAs<vtkAxisActor2D>, &CopyAs<vtkCaptionActor2D>, &CopyAs<vtkLegendBoxActor>,
      &CopyAs<vtkLegendScaleActor>, &CopyAs<vtkCornerAnnotation>, &CopyPlain })
  {
    if (vtkSmartPointer<vtkProp> result = copy(prop))
    {
      return result;
    }
  }
  return CopyWidget(prop);
}

bool IsOverlayWidget(vtkProp* prop)
{
  return vtkSliderRepresentation2D::SafeDownCast(prop) ||
    vtkTexturedButtonRepresentation2D::SafeDownCast(prop) ||
    vtkLogoRepresentation::SafeDownCast(prop);
}

}
