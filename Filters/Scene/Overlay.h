// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Image of 2-D props, such as text and scalar bars, which is composited over the rendered image.
// Rectangles are drawn with exact pixel coverage. The shapes are also kept, for vector graphics.
#ifndef penumbra_Overlay_h
#define penumbra_Overlay_h

#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

#include <glm/glm.hpp>

#include <string>
#include <vector>

class vtkImageData;

namespace penumbra
{

/// A line of text, or a filled polygon if Text is empty. Coordinates are in pixels with (0, 0) at
/// the lower left corner of the image.
struct OverlayShape
{
  std::vector<glm::dvec2> Corners; ///< of a polygon
  glm::vec4 Color{ 0.f };          ///< straight alpha
  std::string Text;                ///< UTF-8, one line
  glm::dvec2 Baseline{ 0.0 };      ///< left end of the base line of the text
  double Angle = 0.0;              ///< of the base line, in degrees, counterclockwise
  double FontSize = 0.0;           ///< height of the font in pixels
  std::string FontFamily;          ///< Arial, Courier, Times, or the name of another font
  std::string FontFile;            ///< path of the font; may be empty
  bool Bold = false;
  bool Italic = false;
};

/// RGBA image that is composited over the rendered image. Colors are clamped to [0, 1], as in VTK.
class VTKPENUMBRAFILTERSSCENE_EXPORT Overlay
{
public:
  Overlay() = default;
  Overlay(int width, int height);

  bool IsEmpty() const { return this->Pixels.empty(); }
  int GetWidth() const { return this->Width; }
  int GetHeight() const { return this->Height; }

  /// Fills the rectangle [low, high] with `color` (straight alpha). Coordinates are in pixels with
  /// (0, 0) at the lower left corner of the image.
  void FillRectangle(glm::dvec2 low, glm::dvec2 high, glm::vec4 color);

  /// Draws an 8-bit RGBA image with its lower left corner at pixel (x, y). Other formats are
  /// ignored.
  void DrawImage(vtkImageData* image, int x, int y);

  /// Keeps a shape, whose pixels are drawn by the other methods.
  void AddShape(OverlayShape shape);

  /// Sets whether shapes describe the pixels that are drawn next; those of a texture have none.
  void SetDescribed(bool described) { this->IsDescribed = described; }

  /// Removes the shapes, the text and the polygons in the order of drawing, and all pixels that they
  /// describe.
  std::vector<OverlayShape> TakeShapes();

  /// Returns the text and the polygons in the order of drawing.
  const std::vector<OverlayShape>& GetShapes() const { return this->Shapes; }

  /// Composites the overlay's pixels (x, y) to (x + count - 1, y) over `colors` (straight alpha).
  void CompositeOver(int x, int y, int count, glm::vec4* colors) const;

private:
  void Blend(int x, int y, glm::vec4 color);
  void Blend(int x, int y, glm::vec4 color, std::vector<glm::vec4>& pixels) const;

  int Width = 0;
  int Height = 0;
  std::vector<glm::vec4> Pixels;      ///< premultiplied alpha; empty until something is drawn
  std::vector<glm::vec4> Undescribed; ///< the same without the pixels of shapes
  std::vector<OverlayShape> Shapes;
  bool IsDescribed = true;
};

}
#endif
