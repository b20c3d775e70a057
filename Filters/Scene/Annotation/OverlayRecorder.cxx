// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OverlayRecorder.h"

#include "ClassReplacement.h"
#include "LabelCopies.h"
#include "Material.h"
#include "Overlay.h"
#include "OverlayText.h"
#include "Scene.h"
#include "SceneExtractionOverlay.h"

#include "vtkActor2D.h"
#include "vtkAlgorithm.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkCoordinate.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkImageMapper.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper2D.h"
#include "vtkProperty2D.h"
#include "vtkTextActor.h"
#include "vtkTextMapper.h"
#include "vtkTextProperty.h"
#include "vtkTexture.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace penumbra
{
namespace
{

/// Recorder of this thread, or null.
thread_local OverlayRecorder* Current = nullptr;

/// Returns the perspective camera of a scene, for renderers whose camera VTK has not created yet.
vtkSmartPointer<vtkCamera> MakeCamera(const Scene& scene)
{
  const Camera& from = scene.ViewCamera;
  const glm::dvec3 position = scene.ToWorld(from.Position);
  const glm::dvec3 focus = scene.ToWorld(from.Position + from.Forward);
  auto camera = vtkSmartPointer<vtkCamera>::New();
  camera->SetPosition(&position.x);
  camera->SetFocalPoint(&focus.x);
  camera->SetViewUp(&from.Up.x);
  camera->SetViewAngle(glm::degrees(2.0 * std::atan(0.5 * from.PixelSize * from.Height)));
  return camera;
}

void CopyInput(vtkAlgorithm* from, vtkAlgorithm* to)
{
  if (from->GetNumberOfInputConnections(0) > 0)
  {
    to->SetInputConnection(from->GetInputConnection(0, 0));
  }
}

/// Returns the texels of a texture; empty if it has no image.
Texture FindTexels(vtkTexture* texture)
{
  if (!texture || texture->GetNumberOfInputConnections(0) == 0)
  {
    return {};
  }
  texture->GetInputAlgorithm()->Update();
  vtkImageData* image = texture->GetInput();
  vtkDataArray* scalars = image ? image->GetPointData()->GetScalars() : nullptr;
  if (!scalars)
  {
    return {};
  }
  const int* size = image->GetDimensions();
  auto* bytes = vtkUnsignedCharArray::SafeDownCast(scalars);
  vtkNew<vtkUnsignedCharArray> mapped;
  if (!bytes || texture->GetColorMode() == VTK_COLOR_MODE_MAP_SCALARS)
  {
    mapped->SetNumberOfComponents(4);
    mapped->SetNumberOfTuples(scalars->GetNumberOfTuples());
    if (const unsigned char* colors = texture->MapScalarsToColors(scalars))
    {
      std::copy_n(colors, 4 * mapped->GetNumberOfTuples(), mapped->GetPointer(0));
    }
    bytes = mapped;
  }
  Texture texels = ConvertTexels(bytes, size[0], size[1]);
  texels.Interpolate = texture->GetInterpolate();
  return texels;
}

/// Draws polygons, lines, points and textured rectangles into the overlay.
class OverlayMapper : public vtkPolyDataMapper2D
{
public:
  static OverlayMapper* New();
  vtkTypeMacro(OverlayMapper, vtkPolyDataMapper2D);

  void RenderOverlay(vtkViewport* viewport, vtkActor2D* actor) override
  {
    if (!Current || (Current->SkipsTextures && actor->IsA("vtkTexturedActor2D")))
    {
      return;
    }
    if (this->GetNumberOfInputConnections(0) > 0)
    {
      this->GetInputAlgorithm()->Update();
    }
    vtkPolyData* input = this->GetInput();
    if (!input || !input->GetPoints())
    {
      return;
    }
    const Texture texels = Current->SkipsTextures ? Texture() : FindTexels(Current->CurrentTexture);
    vtkDataArray* coordinates = input->GetPointData()->GetTCoords();
    const bool isTextured = !texels.Texels.empty() && coordinates;
    vtkProperty2D* property = actor->GetProperty();
    const double* c = property->GetColor();
    const glm::vec4 propertyColor(c[0], c[1], c[2], property->GetOpacity());
    vtkUnsignedCharArray* colors = this->MapScalars(property->GetOpacity());
    const bool perCell = this->HasCellColors(input);
    const std::vector<glm::dvec2> points = this->FindPoints(input, viewport, actor);
    const bool isText = isTextured && Current->Text;
    if (isText)
    {
      DescribeText(points.front(), *Current);
    }
    vtkNew<vtkIdList> ids;
    for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
    {
      input->GetCellPoints(cell, ids);
      std::vector<OverlayVertex> corners;
      for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
      {
        const vtkIdType id = ids->GetId(i);
        OverlayVertex corner{ points[static_cast<std::size_t>(id)], propertyColor };
        if (colors)
        {
          double bytes[4];
          colors->GetTuple(perCell ? cell : id, bytes);
          corner.Color = glm::vec4(bytes[0], bytes[1], bytes[2], bytes[3]) / 255.f;
        }
        if (isTextured)
        {
          corner.Coordinates = { coordinates->GetComponent(id, 0),
            coordinates->GetComponent(id, 1) };
        }
        corners.push_back(corner);
      }
      DrawCell(input->GetCellType(cell), corners, property, isTextured || (colors && !perCell),
        isTextured ? &texels : nullptr, isText);
    }
  }

private:
  bool HasCellColors(vtkPolyData* input)
  {
    const int mode = this->GetScalarMode();
    return (mode == VTK_SCALAR_MODE_USE_CELL_DATA || mode == VTK_SCALAR_MODE_USE_CELL_FIELD_DATA ||
             mode == VTK_SCALAR_MODE_USE_FIELD_DATA || !input->GetPointData()->GetScalars()) &&
      mode != VTK_SCALAR_MODE_USE_POINT_FIELD_DATA;
  }

  std::vector<glm::dvec2> FindPoints(vtkPolyData* input, vtkViewport* viewport, vtkActor2D* actor)
  {
    const glm::dvec2 origin = ComputeViewportPosition(actor, viewport);
    std::vector<glm::dvec2> points;
    vtkCoordinate* transform = this->GetTransformCoordinate();
    for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
    {
      double point[3];
      input->GetPoint(i, point);
      if (transform)
      {
        // VTK rounds to whole pixels unless TransformCoordinateUseDouble is set.
        transform->SetValue(point);
        const double* exact = transform->GetComputedDoubleViewportValue(viewport);
        const int* rounded = transform->GetComputedViewportValue(viewport);
        const bool isExact = this->GetTransformCoordinateUseDouble();
        point[0] = isExact ? exact[0] : rounded[0];
        point[1] = isExact ? exact[1] : rounded[1];
      }
      points.push_back(origin + glm::dvec2(point[0], point[1]));
    }
    return points;
  }

  static void DrawCell(int type, const std::vector<OverlayVertex>& corners, vtkProperty2D* property,
    bool isShaded, const Texture* texels, bool isText)
  {
    Overlay& image = Current->Image;
    if (corners.empty())
    {
      return;
    }
    if (type == VTK_VERTEX || type == VTK_POLY_VERTEX)
    {
      for (const OverlayVertex& corner : corners)
      {
        const glm::dvec2 half(0.5 * property->GetPointSize());
        const glm::dvec2 low = corner.Position - half;
        const glm::dvec2 high = corner.Position + half;
        FillPolygon({ low, { high.x, low.y }, high, { low.x, high.y } }, corner.Color, image);
      }
    }
    else if (type == VTK_LINE || type == VTK_POLY_LINE)
    {
      for (std::size_t i = 1; i < corners.size(); ++i)
      {
        FillLine(corners[i - 1].Position, corners[i].Position, property->GetLineWidth(),
          corners[i - 1].Color, image);
      }
    }
    else if (type == VTK_TRIANGLE_STRIP)
    {
      for (std::size_t i = 2; i < corners.size(); ++i)
      {
        FillShadedPolygon({ corners[i - 2], corners[i - 1], corners[i] }, texels, image);
      }
    }
    else if (isShaded)
    {
      FillShadedPolygon(corners, texels, image, isText);
    }
    else
    {
      std::vector<glm::dvec2> polygon;
      for (const OverlayVertex& corner : corners)
      {
        polygon.push_back(corner.Position);
      }
      FillPolygon(polygon, corners.front().Color, image);
    }
  }
};
vtkStandardNewMacro(OverlayMapper);

/// Draws an image into the overlay.
class OverlayImageMapper : public vtkImageMapper
{
public:
  static OverlayImageMapper* New();
  vtkTypeMacro(OverlayImageMapper, vtkImageMapper);

  void RenderOverlay(vtkViewport* viewport, vtkActor2D* actor) override
  {
    this->RenderStart(viewport, actor);
  }

  void RenderData(vtkViewport* viewport, vtkImageData* image, vtkActor2D* actor) override
  {
    vtkDataArray* scalars = image->GetPointData()->GetScalars();
    const int components = scalars ? scalars->GetNumberOfComponents() : 0;
    if (!Current || components < 1 || components > 4)
    {
      return;
    }
    int extent[6];
    image->GetExtent(extent);
    for (int k = 0; k < 6; ++k)
    {
      extent[k] = k % 2 == 0 ? std::max(extent[k], this->DisplayExtent[k])
                             : std::min(extent[k], this->DisplayExtent[k]);
    }
    const int size[2] = { extent[1] - extent[0] + 1, extent[3] - extent[2] + 1 };
    if (size[0] < 1 || size[1] < 1 || extent[4] != extent[5])
    {
      return;
    }
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetNumberOfComponents(components);
    for (int j = 0; j < size[1]; ++j)
    {
      for (int i = 0; i < size[0]; ++i)
      {
        int index[3] = { extent[0] + i, extent[2] + j, extent[4] };
        for (int k = 0; k < components; ++k)
        {
          const double value = scalars->GetComponent(image->ComputePointId(index), k);
          colors->InsertNextValue(static_cast<unsigned char>(std::min(
            std::max((value + this->GetColorShift()) * this->GetColorScale(), 0.0), 255.0)));
        }
      }
    }
    const glm::dvec2 low = ComputeViewportPosition(actor, viewport) +
      glm::dvec2(this->PositionAdjustment[0], this->PositionAdjustment[1]);
    glm::dvec2 high = low + glm::dvec2(size[0], size[1]);
    if (this->GetRenderToRectangle())
    {
      // VTK ignores the coordinate system of the second position.
      vtkNew<vtkActor2D> rectangle;
      rectangle->SetPosition(low.x, low.y);
      rectangle->SetPosition2(actor->GetPosition2());
      const int* at = rectangle->GetPosition2Coordinate()->GetComputedViewportValue(viewport);
      high = glm::dvec2(at[0] + 1, at[1] + 1);
    }
    const double opacity = actor->GetProperty()->GetOpacity();
    const double* c = actor->GetProperty()->GetColor();
    const glm::vec4 color(c[0], c[1], c[2], opacity);
    const Texture texels = ConvertTexels(colors, size[0], size[1]);
    FillShadedPolygon({ { low, color, { 0.0, 0.0 } }, { { high.x, low.y }, color, { 1.0, 0.0 } },
                        { high, color, { 1.0, 1.0 } }, { { low.x, high.y }, color, { 0.0, 1.0 } } },
      &texels, Current->Image);
  }
};
vtkStandardNewMacro(OverlayImageMapper);

/// Texture that tells the mapper which image to draw. It needs no graphics context.
class OverlayTexture : public vtkTexture
{
public:
  static OverlayTexture* New();
  vtkTypeMacro(OverlayTexture, vtkTexture);

  void Render(vtkRenderer*) override { this->SetCurrent(this); }
  void PostRender(vtkRenderer*) override { this->SetCurrent(nullptr); }

private:
  static void SetCurrent(vtkTexture* texture)
  {
    if (Current)
    {
      Current->CurrentTexture = texture;
    }
  }
};
vtkStandardNewMacro(OverlayTexture);

/// Makes props that are created while a recorder exists create parts that draw into the overlay.
void ReplaceClasses()
{
  static const bool replaced = [] {
    ReplaceClass("vtkPolyDataMapper2D", "OverlayMapper",
      [] { return static_cast<vtkObject*>(Current ? OverlayMapper::New() : nullptr); });
    ReplaceClass("vtkImageMapper", "OverlayImageMapper",
      [] { return static_cast<vtkObject*>(Current ? OverlayImageMapper::New() : nullptr); });
    ReplaceClass("vtkTextActor", "OverlayText", [] { return MakeTextActor(Current); });
    ReplaceClass("vtkTextMapper", "OverlayTextMapper", [] { return MakeTextMapper(Current); });
    ReplaceClass("vtkTexture", "OverlayTexture",
      [] { return static_cast<vtkObject*>(Current ? OverlayTexture::New() : nullptr); });
    return true;
  }();
  static_cast<void>(replaced);
}

}

OverlayRecorder::OverlayRecorder(vtkRenderer* renderer, int dpi, Scene& scene, bool skipsTextures)
  : Image(*scene.OverlayImage),
    DPI(dpi),
    SkipsTextures(skipsTextures)
{
  ReplaceClasses();
  this->Window->SetSize(scene.ViewCamera.Width, scene.ViewCamera.Height);
  this->Window->SetDPI(dpi);
  this->Window->AddRenderer(this->Layout);
  if (renderer->IsActiveCameraCreated())
  {
    this->Layout->SetActiveCamera(renderer->GetActiveCamera());
  }
  else
  {
    this->Layout->SetActiveCamera(MakeCamera(scene));
  }
  Current = this;
}

OverlayRecorder::~OverlayRecorder()
{
  Current = nullptr;
  this->Window->RemoveRenderer(this->Layout);
}

glm::dvec2 ComputeViewportPosition(vtkActor2D* actor, vtkViewport* viewport)
{
  const int* at = actor->GetActualPositionCoordinate()->GetComputedViewportValue(viewport);
  return { at[0], at[1] };
}

OverlayRecorder* OverlayRecorder::GetCurrent()
{
  return Current;
}

void OverlayRecorder::Render(vtkProp* prop)
{
  auto* actor = vtkActor2D::SafeDownCast(prop);
  if (actor && actor->GetMapper() && actor->GetMapper()->IsA("vtkLabelPlacementMapper"))
  {
    this->Window->SetHasRendered();
  }
  prop->RenderOpaqueGeometry(this->Layout);
  prop->RenderOverlay(this->Layout);
}

vtkSmartPointer<vtkMapper2D> OverlayRecorder::CopyMapper(vtkMapper2D* mapper)
{
  if (auto* polygons = vtkPolyDataMapper2D::SafeDownCast(mapper))
  {
    auto copy = vtkSmartPointer<OverlayMapper>::New();
    copy->ShallowCopy(polygons);
    CopyInput(polygons, copy);
    return copy;
  }
  if (auto* text = vtkTextMapper::SafeDownCast(mapper))
  {
    auto copy = vtkSmartPointer<vtkTextMapper>::New();
    copy->ShallowCopy(text);
    return copy;
  }
  if (auto* image = vtkImageMapper::SafeDownCast(mapper))
  {
    auto copy = vtkSmartPointer<OverlayImageMapper>::New();
    CopyInput(image, copy);
    copy->SetColorWindow(image->GetColorWindow());
    copy->SetColorLevel(image->GetColorLevel());
    copy->SetZSlice(image->GetZSlice());
    copy->SetRenderToRectangle(image->GetRenderToRectangle());
    copy->SetUseCustomExtents(image->GetUseCustomExtents());
    copy->SetCustomDisplayExtents(image->GetCustomDisplayExtents());
    return copy;
  }
  return CopyLabelMapper(mapper);
}

}
