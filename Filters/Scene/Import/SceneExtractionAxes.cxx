// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// vtkCubeAxesActor computes its parts only while it renders. A copy renders into a window without a
// graphics context, with actors that record their parts.
#include "SceneExtractionAxes.h"

#include "Annotation/OverlayRecorder.h"
#include "ClassReplacement.h"
#include "CollectionItems.h"
#include "Overlay.h"
#include "Scene.h"
#include "SizeOnlyWindow.h"
#include "Surface.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCubeAxesActor.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkStringArray.h"
#include "vtkTextProperty.h"
#include "vtkVectorText.h"

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace penumbra
{
namespace
{

/// Height of tall letters above the base line, as a fraction of the font size.
constexpr double AscenderHeight = 0.75;

/// Lines and polygons of axes.
struct RecordedPart
{
  DrawItem Item;
  std::string Text; ///< that the polygons show; may be empty
};

/// Parts of the axes that this thread renders, or null.
thread_local std::vector<RecordedPart>* RecordedParts = nullptr;

/// Records its mapper's polygons and lines instead of rendering them.
class RecordingActor : public vtkActor
{
public:
  static RecordingActor* New();
  vtkTypeMacro(RecordingActor, vtkActor);

  int RenderOpaqueGeometry(vtkViewport*) override
  {
    return this->HasOpaqueGeometry() && this->Record(this->GetMapper());
  }

  int RenderTranslucentPolygonalGeometry(vtkViewport*) override
  {
    return this->HasTranslucentPolygonalGeometry() && this->Record(this->GetMapper());
  }

  /// Called by followers.
  void Render(vtkRenderer*, vtkMapper* mapper) override { this->Record(mapper); }

private:
  int Record(vtkMapper* mapper)
  {
    auto* polygons = vtkPolyDataMapper::SafeDownCast(mapper);
    if (!RecordedParts || !polygons || !this->GetVisibility())
    {
      return 0;
    }
    polygons->Update();
    if (!polygons->GetInput() || polygons->GetInput()->GetNumberOfCells() == 0)
    {
      return 0;
    }
    RecordedPart part;
    auto* text = vtkVectorText::SafeDownCast(polygons->GetInputAlgorithm());
    part.Text = text && text->GetText() ? text->GetText() : "";
    DrawItem& item = part.Item;
    item.Data = vtkSmartPointer<vtkPolyData>::New();
    item.Data->DeepCopy(polygons->GetInput());
    item.Property = vtkSmartPointer<vtkProperty>::New();
    item.Property->DeepCopy(this->GetProperty());
    vtkMatrix4x4* matrix = this->GetMatrix();
    for (int i = 0; i < 4; ++i)
    {
      for (int j = 0; j < 4; ++j)
      {
        item.ToWorld[j][i] = matrix->GetElement(i, j);
        if (!std::isfinite(item.ToWorld[j][i])) // of a label of an axis along the view direction
        {
          return 1;
        }
      }
    }
    RecordedParts->push_back(std::move(part));
    return 1;
  }
};
vtkStandardNewMacro(RecordingActor);

/// Property that needs no graphics context.
class RecordedProperty : public vtkProperty
{
public:
  static RecordedProperty* New();
  vtkTypeMacro(RecordedProperty, vtkProperty);
  void Render(vtkActor*, vtkRenderer*) override {}
  void PostRender(vtkActor*, vtkRenderer*) override {}
};
vtkStandardNewMacro(RecordedProperty);

/// Makes the axes that this thread renders create actors and properties that record.
void ReplaceClasses()
{
  static const bool replaced = [] {
    ReplaceClass("vtkActor", "RecordingActor",
      [] { return static_cast<vtkObject*>(RecordedParts ? RecordingActor::New() : nullptr); });
    ReplaceClass("vtkProperty", "RecordedProperty",
      [] { return static_cast<vtkObject*>(RecordedParts ? RecordedProperty::New() : nullptr); });
    return true;
  }();
  static_cast<void>(replaced);
}

/// Copies the appearance of the three axes.
void CopyProperties(vtkCubeAxesActor* from, vtkCubeAxesActor* to)
{
  using Property = vtkProperty* (vtkCubeAxesActor::*)();
  for (Property property :
    { &vtkCubeAxesActor::GetXAxesLinesProperty, &vtkCubeAxesActor::GetYAxesLinesProperty,
      &vtkCubeAxesActor::GetZAxesLinesProperty, &vtkCubeAxesActor::GetXAxesGridlinesProperty,
      &vtkCubeAxesActor::GetYAxesGridlinesProperty, &vtkCubeAxesActor::GetZAxesGridlinesProperty,
      &vtkCubeAxesActor::GetXAxesInnerGridlinesProperty,
      &vtkCubeAxesActor::GetYAxesInnerGridlinesProperty,
      &vtkCubeAxesActor::GetZAxesInnerGridlinesProperty,
      &vtkCubeAxesActor::GetXAxesGridpolysProperty, &vtkCubeAxesActor::GetYAxesGridpolysProperty,
      &vtkCubeAxesActor::GetZAxesGridpolysProperty })
  {
    (to->*property)()->DeepCopy((from->*property)());
  }
  to->GetProperty()->DeepCopy(from->GetProperty());
  for (int axis = 0; axis < 3; ++axis)
  {
    to->GetTitleTextProperty(axis)->ShallowCopy(from->GetTitleTextProperty(axis));
    to->GetLabelTextProperty(axis)->ShallowCopy(from->GetLabelTextProperty(axis));
    if (from->GetAxisLabels(axis))
    {
      to->SetAxisLabels(axis, from->GetAxisLabels(axis));
    }
  }
}

// vtkCubeAxesActor has a two-component title offset since VTK 9.3.
template <typename Axes>
auto CopyTitleOffset(Axes* from, Axes* to, int)
  -> decltype(to->SetTitleOffset(from->GetTitleOffset()))
{
  to->SetTitleOffset(from->GetTitleOffset());
}
template <typename Axes>
void CopyTitleOffset(Axes*, Axes*, long)
{
}

void CopySettings(vtkCubeAxesActor* from, vtkCubeAxesActor* to)
{
  CopyProperties(from, to);
  CopyTitleOffset(from, to, 0);
  to->SetBounds(from->GetBounds());
  to->SetXAxisRange(from->GetXAxisRange());
  to->SetYAxisRange(from->GetYAxisRange());
  to->SetZAxisRange(from->GetZAxisRange());
  to->SetScreenSize(from->GetScreenSize());
  to->SetLabelOffset(from->GetLabelOffset());
  to->SetFlyMode(from->GetFlyMode());
  to->SetXTitle(from->GetXTitle());
  to->SetYTitle(from->GetYTitle());
  to->SetZTitle(from->GetZTitle());
  to->SetXUnits(from->GetXUnits());
  to->SetYUnits(from->GetYUnits());
  to->SetZUnits(from->GetZUnits());
  to->SetXLabelFormat(from->GetXLabelFormat());
  to->SetYLabelFormat(from->GetYLabelFormat());
  to->SetZLabelFormat(from->GetZLabelFormat());
  to->SetInertia(from->GetInertia());
  to->SetCornerOffset(from->GetCornerOffset());
  to->SetEnableDistanceLOD(from->GetEnableDistanceLOD());
  to->SetDistanceLODThreshold(from->GetDistanceLODThreshold());
  to->SetEnableViewAngleLOD(from->GetEnableViewAngleLOD());
  to->SetViewAngleLODThreshold(from->GetViewAngleLODThreshold());
  to->SetXAxisVisibility(from->GetXAxisVisibility());
  to->SetYAxisVisibility(from->GetYAxisVisibility());
  to->SetZAxisVisibility(from->GetZAxisVisibility());
  to->SetXAxisLabelVisibility(from->GetXAxisLabelVisibility());
  to->SetYAxisLabelVisibility(from->GetYAxisLabelVisibility());
  to->SetZAxisLabelVisibility(from->GetZAxisLabelVisibility());
  to->SetXAxisTickVisibility(from->GetXAxisTickVisibility());
  to->SetYAxisTickVisibility(from->GetYAxisTickVisibility());
  to->SetZAxisTickVisibility(from->GetZAxisTickVisibility());
  to->SetXAxisMinorTickVisibility(from->GetXAxisMinorTickVisibility());
  to->SetYAxisMinorTickVisibility(from->GetYAxisMinorTickVisibility());
  to->SetZAxisMinorTickVisibility(from->GetZAxisMinorTickVisibility());
  to->SetDrawXGridlines(from->GetDrawXGridlines());
  to->SetDrawYGridlines(from->GetDrawYGridlines());
  to->SetDrawZGridlines(from->GetDrawZGridlines());
  to->SetDrawXInnerGridlines(from->GetDrawXInnerGridlines());
  to->SetDrawYInnerGridlines(from->GetDrawYInnerGridlines());
  to->SetDrawZInnerGridlines(from->GetDrawZInnerGridlines());
  to->SetDrawXGridpolys(from->GetDrawXGridpolys());
  to->SetDrawYGridpolys(from->GetDrawYGridpolys());
  to->SetDrawZGridpolys(from->GetDrawZGridpolys());
  to->SetTickLocation(from->GetTickLocation());
  to->SetOrientedBounds(from->GetOrientedBounds());
  to->SetUseOrientedBounds(from->GetUseOrientedBounds());
  to->SetAxisBaseForX(from->GetAxisBaseForX());
  to->SetAxisBaseForY(from->GetAxisBaseForY());
  to->SetAxisBaseForZ(from->GetAxisBaseForZ());
  to->SetAxisOrigin(from->GetAxisOrigin());
  to->SetUseAxisOrigin(from->GetUseAxisOrigin());
  to->SetGridLineLocation(from->GetGridLineLocation());
  to->SetUse2DMode(from->GetUse2DMode());
  to->SetStickyAxes(from->GetStickyAxes());
  to->SetCenterStickyAxes(from->GetCenterStickyAxes());
}

/// Adds the text of a part to the overlay, invisible at the place of its polygons, so that it can be selected
/// and found in vector graphics.
void AddInvisibleText(const RecordedPart& part, Scene& scene)
{
  if (part.Text.empty())
  {
    return;
  }
  double bounds[6];
  part.Item.Data->GetBounds(bounds);
  const SceneTransform toScene(part.Item.ToWorld, scene);
  const double lower[3] = { bounds[0], 0.0, 0.0 };
  const double right[3] = { bounds[1], 0.0, 0.0 };
  const double upper[3] = { bounds[0], bounds[3], 0.0 };
  const Camera& camera = scene.ViewCamera;
  for (const double* corner : { lower, right, upper })
  {
    if (!camera.Parallel && !(camera.Depth(toScene.Point(corner)) > camera.Near))
    {
      return;
    }
  }
  OverlayShape shape;
  shape.Text = part.Text;
  shape.FontFamily = "Arial";
  shape.Baseline = camera.Project(toScene.Point(lower));
  const glm::dvec2 line = camera.Project(toScene.Point(right)) - shape.Baseline;
  shape.Angle = glm::degrees(std::atan2(line.y, line.x));
  shape.FontSize =
    glm::distance(shape.Baseline, camera.Project(toScene.Point(upper))) / AscenderHeight;
  scene.OverlayImage->AddShape(std::move(shape));
}

}

bool IsCubeAxes(vtkProp* prop)
{
  return vtkCubeAxesActor::SafeDownCast(prop) != nullptr;
}

std::vector<DrawItem> MakeCubeAxes(vtkRenderer* renderer, int dpi, int firstObject, Scene& scene)
{
  std::vector<DrawItem> items;
  for (vtkProp* prop : GetItems<vtkProp>(renderer->GetViewProps()))
  {
    if (!prop->GetVisibility() || !IsCubeAxes(prop) || !renderer->IsActiveCameraCreated())
    {
      continue;
    }
    ReplaceClasses();
    vtkNew<SizeOnlyWindow> window;
    vtkNew<SizeOnlyRenderer> layoutRenderer;
    window->SetSize(scene.ViewCamera.Width, scene.ViewCamera.Height);
    window->SetDPI(dpi);
    window->AddRenderer(layoutRenderer);
    layoutRenderer->SetActiveCamera(renderer->GetActiveCamera());
    std::vector<RecordedPart> parts;
    RecordedParts = &parts;
    auto* axes = vtkCubeAxesActor::SafeDownCast(prop);
    {
      // In 2-D mode, titles and labels are text in the overlay.
      std::unique_ptr<OverlayRecorder> overlay;
      if (axes->GetUse2DMode())
      {
        overlay = std::make_unique<OverlayRecorder>(renderer, dpi, scene);
      }
      vtkNew<vtkCubeAxesActor> copy;
      CopySettings(axes, copy);
      copy->SetCamera(renderer->GetActiveCamera());
      copy->RenderOpaqueGeometry(layoutRenderer);
      copy->RenderTranslucentPolygonalGeometry(layoutRenderer);
      if (overlay)
      {
        copy->RenderOverlay(layoutRenderer);
      }
    }
    RecordedParts = nullptr;
    window->RemoveRenderer(layoutRenderer);
    for (RecordedPart& part : parts)
    {
      AddInvisibleText(part, scene);
      part.Item.ObjectId = firstObject;
      part.Item.Name = "Object " + std::to_string(firstObject);
      items.push_back(std::move(part.Item));
    }
    ++firstObject;
  }
  return items;
}

}
