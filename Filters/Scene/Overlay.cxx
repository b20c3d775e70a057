// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Overlay.h"

#include "vtkImageData.h"

#include <algorithm>
#include <utility>

namespace penumbra
{
namespace
{

/// Returns the fraction of the interval [i, i + 1] that [low, high] covers.
float ComputeCoverage(int i, double low, double high)
{
  return static_cast<float>(
    std::max(0.0, std::min(high, i + 1.0) - std::max(low, static_cast<double>(i))));
}

}

Overlay::Overlay(int width, int height)
  : Width(width),
    Height(height)
{
}

void Overlay::Blend(int x, int y, glm::vec4 color)
{
  if (x < 0 || y < 0 || x >= this->Width || y >= this->Height || color.a <= 0.f)
  {
    return;
  }
  color = glm::clamp(color, 0.f, 1.f);
  this->Blend(x, y, color, this->Pixels);
  if (!this->IsDescribed)
  {
    this->Blend(x, y, color, this->Undescribed);
  }
}

void Overlay::Blend(int x, int y, glm::vec4 color, std::vector<glm::vec4>& pixels) const
{
  if (pixels.empty())
  {
    pixels.resize(static_cast<std::size_t>(this->Width) * this->Height, glm::vec4(0.f));
  }
  glm::vec4& pixel = pixels[static_cast<std::size_t>(y) * this->Width + x];
  pixel = glm::vec4(color.a * glm::vec3(color), color.a) + (1.f - color.a) * pixel;
}

std::vector<OverlayShape> Overlay::TakeShapes()
{
  this->Pixels = std::move(this->Undescribed);
  this->Undescribed.clear();
  return std::exchange(this->Shapes, {});
}

void Overlay::AddShape(OverlayShape shape)
{
  shape.Color = glm::clamp(shape.Color, 0.f, 1.f);
  this->Shapes.push_back(std::move(shape));
}

void Overlay::FillRectangle(glm::dvec2 low, glm::dvec2 high, glm::vec4 color)
{
  low = glm::max(low, glm::dvec2(0.0));
  high = glm::min(high, glm::dvec2(this->Width, this->Height));
  if (!(low.x < high.x && low.y < high.y))
  {
    return;
  }
  for (int y = static_cast<int>(low.y); y < high.y; ++y)
  {
    for (int x = static_cast<int>(low.x); x < high.x; ++x)
    {
      const float coverage = ComputeCoverage(x, low.x, high.x) * ComputeCoverage(y, low.y, high.y);
      this->Blend(x, y, glm::vec4(glm::vec3(color), color.a * coverage));
    }
  }
}

void Overlay::DrawImage(vtkImageData* image, int x, int y)
{
  int size[3];
  image->GetDimensions(size);
  if (image->GetScalarType() != VTK_UNSIGNED_CHAR || image->GetNumberOfScalarComponents() != 4)
  {
    return;
  }
  const int* extent = image->GetExtent();
  for (int j = 0; j < size[1]; ++j)
  {
    for (int i = 0; i < size[0]; ++i)
    {
      const auto* c = static_cast<const unsigned char*>(
        image->GetScalarPointer(extent[0] + i, extent[2] + j, extent[4]));
      this->Blend(x + i, y + j, glm::vec4(c[0], c[1], c[2], c[3]) / 255.f);
    }
  }
}

void Overlay::CompositeOver(int x, int y, int count, glm::vec4* colors) const
{
  if (this->IsEmpty())
  {
    return;
  }
  const glm::vec4* over = &this->Pixels[static_cast<std::size_t>(y) * this->Width + x];
  for (int i = 0; i < count; ++i)
  {
    if (over[i].a > 0.f)
    {
      const float below = (1.f - over[i].a) * colors[i].a;
      const float alpha = over[i].a + below;
      colors[i] = glm::vec4((glm::vec3(over[i]) + below * glm::vec3(colors[i])) / alpha, alpha);
    }
  }
}

}
