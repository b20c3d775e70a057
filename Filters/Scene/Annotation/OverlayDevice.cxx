// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OverlayDevice.h"

#include "ChartShapes.h"
#include "Overlay.h"
#include "OverlayPainter.h"
#include "SceneExtractionOverlay.h"

#include "vtkBrush.h"
#include "vtkContext2D.h"
#include "vtkContextDevice2D.h"
#include "vtkContextScene.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPen.h"
#include "vtkPointData.h"
#include "vtkRect.h"
#include "vtkSmartPointer.h"
#include "vtkStdString.h"
#include "vtkTextProperty.h"
#include "vtkTextRenderer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#if __has_include("vtkUnicodeString.h")
#include "vtkUnicodeString.h"
#define PENUMBRA_HAS_UNICODE_STRINGS
#pragma GCC diagnostic ignored "-Wdeprecated-declarations" // of the class, in VTK 9.2
#endif

namespace penumbra
{
namespace
{

glm::vec4 ToColor(const vtkColor4ub& c)
{
  return glm::vec4(c[0], c[1], c[2], c[3]) / 255.f;
}

/// Draws into an overlay.
class OverlayDevice : public vtkContextDevice2D
{
public:
  static OverlayDevice* New();
  vtkTypeMacro(OverlayDevice, vtkContextDevice2D);

  /// @param scale Pixels of the overlay per unit of the scene.
  void SetTarget(Overlay& overlay, double scale)
  {
    this->Image = &overlay;
    this->Scale = scale;
    this->Geometry[0] = static_cast<int>(std::lround(overlay.GetWidth() / scale));
    this->Geometry[1] = static_cast<int>(std::lround(overlay.GetHeight() / scale));
    this->SetViewportSize(vtkVector2i(this->Geometry[0], this->Geometry[1]));
    this->SetViewportRect(vtkRecti(0, 0, this->Geometry[0], this->Geometry[1]));
  }

  /// True if something was not drawn as asked for.
  bool IsIncomplete = false;

  void DrawPoly(float* points, int n, unsigned char* colors, int components) override
  {
    double length = 0.0;
    for (int i = 1; i < n; ++i)
    {
      this->DrawSegment(points + 2 * (i - 1), points + 2 * i,
        this->FindColor(this->Pen->GetColorObject(), colors, components, i - 1), length);
    }
  }

  void DrawLines(float* points, int n, unsigned char* colors, int components) override
  {
    for (int i = 0; i + 1 < n; i += 2)
    {
      double length = 0.0;
      this->DrawSegment(points + 2 * i, points + 2 * (i + 1),
        this->FindColor(this->Pen->GetColorObject(), colors, components, i), length);
    }
  }

  void DrawPoints(float* points, int n, unsigned char* colors, int components) override
  {
    this->DrawPointSprites(nullptr, points, n, colors, components);
  }

  void DrawPointSprites(
    vtkImageData* sprite, float* points, int n, unsigned char* colors, int components) override
  {
    const Texture texels = this->FindTexels(sprite);
    const double half = 0.5 * this->Scale * std::max(this->Pen->GetWidth(), 1.f);
    for (int i = 0; i < n; ++i)
    {
      const glm::dvec2 p = this->ToPixels(points + 2 * i);
      this->FillRectangle(p - half, p + half,
        this->FindColor(this->Pen->GetColorObject(), colors, components, i), texels);
    }
  }

  void DrawMarkers(
    int shape, bool, float* points, int n, unsigned char* colors, int components) override
  {
    const double half = 0.5 * this->Scale * std::max(this->Pen->GetWidth(), 1.f);
    for (int i = 0; i < n; ++i)
    {
      const glm::vec4 color = this->FindColor(this->Pen->GetColorObject(), colors, components, i);
      for (std::vector<OverlayVertex>& part :
        MakeMarker(shape, this->ToPixels(points + 2 * i), half, std::max(1.0, this->Scale), color))
      {
        this->Fill(std::move(part), false);
      }
    }
  }

  // Virtual functions of later versions of VTK, whose positions are any array.
  // NOLINTBEGIN(modernize-use-override)
  void DrawPoints(vtkDataArray* positions, vtkUnsignedCharArray* colors, std::uintptr_t)
  {
    this->DrawArray(
      positions, colors, [this](float* points, int n, unsigned char* c, int components) {
        this->DrawPoints(points, n, c, components);
      });
  }

  void DrawPointSprites(
    vtkImageData* sprite, vtkDataArray* positions, vtkUnsignedCharArray* colors, std::uintptr_t)
  {
    this->DrawArray(positions, colors, [&](float* points, int n, unsigned char* c, int components) {
      this->DrawPointSprites(sprite, points, n, c, components);
    });
  }

  void DrawMarkers(int shape, bool highlight, vtkDataArray* positions, vtkUnsignedCharArray* colors,
    std::uintptr_t)
  {
    this->DrawArray(positions, colors, [&](float* points, int n, unsigned char* c, int components) {
      this->DrawMarkers(shape, highlight, points, n, c, components);
    });
  }

#ifdef PENUMBRA_HAS_UNICODE_STRINGS
  // Those of VTK 9.1.
  void DrawString(float* point, const vtkUnicodeString& text)
  {
    this->DrawString(point, vtkStdString(text.utf8_str()));
  }
  void ComputeStringBounds(const vtkUnicodeString& text, float bounds[4])
  {
    this->ComputeStringBounds(vtkStdString(text.utf8_str()), bounds);
  }
#endif
  // NOLINTEND(modernize-use-override)

  void DrawQuad(float* points, int n) override
  {
    for (int i = 0; i + 3 < n; i += 4)
    {
      this->DrawColoredPolygon(points + 2 * i, 4, nullptr, 0);
    }
  }

  void DrawQuadStrip(float* points, int n) override
  {
    for (int i = 0; i + 3 < n; i += 2)
    {
      const float* p = points + 2 * i;
      float corners[8] = { p[0], p[1], p[2], p[3], p[6], p[7], p[4], p[5] };
      this->DrawColoredPolygon(corners, 4, nullptr, 0);
    }
  }

  void DrawColoredPolygon(float* points, int n, unsigned char* colors, int components) override
  {
    std::vector<OverlayVertex> corners;
    for (int i = 0; i < n; ++i)
    {
      corners.push_back({ this->ToPixels(points + 2 * i),
        this->FindColor(this->Brush->GetColorObject(), colors, components, i) });
    }
    const Texture texels = this->FindTexels(this->Brush->GetTexture());
    if (texels.Texels.empty())
    {
      this->Fill(std::move(corners), colors != nullptr);
      return;
    }
    this->IsIncomplete |= (this->Brush->GetTextureProperties() & vtkContextDevice2D::Repeat) != 0;
    StretchTexture(corners);
    this->Fill(std::move(corners), true, &texels);
  }

  void DrawEllipseWedge(float x, float y, float outRx, float outRy, float inRx, float inRy,
    float startAngle, float stopAngle) override
  {
    std::vector<OverlayVertex> corners =
      this->MakeArc({ x, y }, { outRx, outRy }, startAngle, stopAngle);
    const std::vector<OverlayVertex> inner =
      this->MakeArc({ x, y }, { inRx, inRy }, stopAngle, startAngle);
    corners.insert(corners.end(), inner.begin(), inner.end());
    this->Fill(std::move(corners), false);
  }

  void DrawEllipticArc(
    float x, float y, float rX, float rY, float startAngle, float stopAngle) override
  {
    const std::vector<OverlayVertex> arc =
      this->MakeArc({ x, y }, { rX, rY }, startAngle, stopAngle);
    this->Fill(arc, false);
    double length = 0.0;
    for (std::size_t i = 1; i < arc.size(); ++i)
    {
      this->DrawPixels(
        arc[i - 1].Position, arc[i].Position, ToColor(this->Pen->GetColorObject()), length);
    }
  }

  void DrawString(float* point, const vtkStdString& text) override
  {
    if (!text.empty())
    {
      const glm::dvec2 anchor = glm::floor(this->ToPixels(point) + 0.5);
      this->IsIncomplete |= !DrawText(text, this->TextProp, anchor, this->FindDPI(), *this->Image);
    }
  }

  /// The bounds are those of the window, so that images of all sizes have its layout.
  void ComputeStringBounds(const vtkStdString& text, float bounds[4]) override
  {
    std::fill_n(bounds, 4, 0.f);
    int box[4];
    vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
    if (!text.empty() && renderer && renderer->GetBoundingBox(this->TextProp, text, box, 72))
    {
      const glm::dvec2 unit = this->FindUnit();
      bounds[0] = static_cast<float>(box[0] / unit.x);
      bounds[1] = static_cast<float>(box[2] / unit.y);
      bounds[2] = static_cast<float>((box[1] - box[0] + 1) / unit.x);
      bounds[3] = static_cast<float>((box[3] - box[2] + 1) / unit.y);
    }
  }

  void ComputeJustifiedStringBounds(const char* text, float bounds[4]) override
  {
    this->ComputeStringBounds(text, bounds);
  }

  void DrawMathTextString(float* point, const vtkStdString& text) override
  {
    this->DrawString(point, text);
  }

  void DrawImage(float p[2], float scale, vtkImageData* image) override
  {
    const glm::dvec2 low = this->ToPixels(p);
    const int* size = image->GetDimensions();
    const glm::dvec2 extent =
      this->Scale * static_cast<double>(scale) * glm::dvec2(size[0], size[1]);
    this->FillRectangle(low, low + extent, glm::vec4(1.f), this->FindTexels(image));
  }

  void DrawImage(const vtkRectf& rectangle, vtkImageData* image) override
  {
    const float low[2] = { rectangle.GetX(), rectangle.GetY() };
    const float high[2] = { low[0] + rectangle.GetWidth(), low[1] + rectangle.GetHeight() };
    this->FillRectangle(
      this->ToPixels(low), this->ToPixels(high), glm::vec4(1.f), this->FindTexels(image));
  }

  void SetColor4(unsigned char[4]) override {}
  void SetTexture(vtkImageData* image, int) override
  {
    this->IsIncomplete |= image != nullptr;
  }
  void SetPointSize(float size) override
  {
    this->Pen->SetWidth(size);
  }
  void SetLineWidth(float width) override
  {
    this->Pen->SetWidth(width);
  }
  void SetLineType(int type) override
  {
    this->Pen->SetLineType(type);
  }

  void SetMatrix(vtkMatrix3x3* m) override
  {
    this->Matrix->DeepCopy(m);
  }
  void GetMatrix(vtkMatrix3x3* m) override
  {
    m->DeepCopy(this->Matrix);
  }
  void MultiplyMatrix(vtkMatrix3x3* m) override
  {
    vtkMatrix3x3::Multiply3x3(this->Matrix, m, this->Matrix);
  }
  void PushMatrix() override
  {
    auto copy = vtkSmartPointer<vtkMatrix3x3>::New();
    copy->DeepCopy(this->Matrix);
    this->Stack.push_back(copy);
  }
  void PopMatrix() override
  {
    if (!this->Stack.empty())
    {
      this->Matrix->DeepCopy(this->Stack.back());
      this->Stack.pop_back();
    }
  }

  void SetClipping(int* box) override
  {
    this->ClipLow = this->Scale * glm::dvec2(box[0], box[1]);
    this->ClipHigh = this->Scale * glm::dvec2(box[0] + box[2], box[1] + box[3]);
  }
  void EnableClipping(bool enable) override
  {
    this->IsClipping = enable;
  }

protected:
  OverlayDevice() = default;

private:
  int FindDPI() const
  {
    return static_cast<int>(std::lround(72.0 * this->Scale));
  }

  /// Returns the pixels of the window per unit along both axes.
  glm::dvec2 FindUnit() const
  {
    const glm::dvec2 unit(this->Matrix->GetElement(0, 0), this->Matrix->GetElement(1, 1));
    return { unit.x == 0.0 ? 1.0 : unit.x, unit.y == 0.0 ? 1.0 : unit.y };
  }

  /// VTK's projection moves the scene by half a pixel and moves the last pixel to the end of the viewport.
  glm::dvec2 ToPixels(const float* p) const
  {
    double y[3] = { p[0], p[1], 1.0 };
    this->Matrix->MultiplyPoint(y, y);
    const glm::dvec2 size(this->Geometry[0], this->Geometry[1]);
    return this->Scale * (glm::dvec2(y[0], y[1]) - 0.5) * size / glm::max(size - 1.0, 1.0);
  }

  static glm::vec4 FindColor(
    const vtkColor4ub& color, const unsigned char* colors, int components, int i)
  {
    if (!colors || components < 3)
    {
      return ToColor(color);
    }
    const unsigned char* c = colors + static_cast<std::ptrdiff_t>(components) * i;
    return glm::vec4(c[0], c[1], c[2], components > 3 ? c[3] : 255) / 255.f;
  }

  Texture FindTexels(vtkImageData* image)
  {
    auto* colors =
      image ? vtkUnsignedCharArray::SafeDownCast(image->GetPointData()->GetScalars()) : nullptr;
    this->IsIncomplete |= image && !colors;
    Texture texels = colors
      ? ConvertTexels(colors, image->GetDimensions()[0], image->GetDimensions()[1])
      : Texture();
    texels.Interpolate = true;
    return texels;
  }

  void Fill(std::vector<OverlayVertex> corners, bool isShaded, const Texture* texels = nullptr)
  {
    if (this->IsClipping)
    {
      corners = Clip(corners, this->ClipLow, this->ClipHigh);
    }
    if (corners.size() < 3)
    {
      return;
    }
    if (isShaded || texels)
    {
      FillShadedPolygon(corners, texels, *this->Image);
      return;
    }
    std::vector<glm::dvec2> polygon;
    for (const OverlayVertex& corner : corners)
    {
      polygon.push_back(corner.Position);
    }
    FillPolygon(polygon, corners.front().Color, *this->Image);
  }

  void FillRectangle(glm::dvec2 low, glm::dvec2 high, glm::vec4 color, const Texture& texels)
  {
    this->Fill({ { low, color, { 0.0, 0.0 } }, { { high.x, low.y }, color, { 1.0, 0.0 } },
                 { high, color, { 1.0, 1.0 } }, { { low.x, high.y }, color, { 0.0, 1.0 } } },
      false, texels.Texels.empty() ? nullptr : &texels);
  }

  /// Calls `draw` with positions of two floats each.
  template <typename Function>
  static void DrawArray(vtkDataArray* positions, vtkUnsignedCharArray* colors, Function&& draw)
  {
    std::vector<float> points;
    for (vtkIdType i = 0; i < positions->GetNumberOfTuples(); ++i)
    {
      points.push_back(static_cast<float>(positions->GetComponent(i, 0)));
      points.push_back(static_cast<float>(positions->GetComponent(i, 1)));
    }
    draw(points.data(), static_cast<int>(positions->GetNumberOfTuples()),
      colors ? colors->GetPointer(0) : nullptr, colors ? colors->GetNumberOfComponents() : 0);
  }

  std::vector<OverlayVertex> MakeArc(
    glm::dvec2 center, glm::dvec2 radii, double startAngle, double stopAngle) const
  {
    std::vector<OverlayVertex> corners;
    for (const glm::dvec2& point : MakeEllipticArc(center, radii, startAngle, stopAngle))
    {
      const float p[2] = { static_cast<float>(point.x), static_cast<float>(point.y) };
      corners.push_back({ this->ToPixels(p), ToColor(this->Brush->GetColorObject()) });
    }
    return corners;
  }

  void DrawSegment(const float* from, const float* to, glm::vec4 color, double& length)
  {
    this->DrawPixels(this->ToPixels(from), this->ToPixels(to), color, length);
  }

  /// Draws a part of a line that begins at `length`, which it increases.
  void DrawPixels(glm::dvec2 from, glm::dvec2 to, glm::vec4 color, double& length)
  {
    const double width = this->Scale * std::max(this->Pen->GetWidth(), 1.f);
    for (std::vector<OverlayVertex>& dash :
      MakeDashes(from, to, width, this->Pen->GetLineType(), this->Scale, color, length))
    {
      this->Fill(std::move(dash), false);
    }
  }

  Overlay* Image = nullptr;
  double Scale = 1.0;
  vtkNew<vtkMatrix3x3> Matrix;
  std::vector<vtkSmartPointer<vtkMatrix3x3>> Stack;
  bool IsClipping = false;
  glm::dvec2 ClipLow{ 0.0 };
  glm::dvec2 ClipHigh{ 0.0 };
};
vtkStandardNewMacro(OverlayDevice);

}

bool PaintItems(vtkContextScene* items, Overlay& overlay, double scale)
{
  vtkNew<OverlayDevice> device;
  device->SetTarget(overlay, scale);
  vtkNew<vtkContext2D> painter;
  items->SetGeometry(device->GetWidth(), device->GetHeight());
  painter->Begin(device);
  items->Paint(painter);
  painter->End();
  return device->IsIncomplete;
}

}
