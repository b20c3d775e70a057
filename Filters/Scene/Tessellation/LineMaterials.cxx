// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LineMaterials.h"

#include "SceneExtractionItem.h"
#include "Surface.h"

#include "vtkProperty.h"

#include <algorithm>
#include <memory>

namespace penumbra
{
namespace
{

// vtkProperty has an edge width since VTK 9.3 and an edge opacity since VTK 9.4.
template <typename Property>
auto FindWidth(Property* property, int)
  -> decltype(property->GetUseLineWidthForEdgeThickness(), property->GetEdgeWidth())
{
  return property->GetUseLineWidthForEdgeThickness() ? property->GetLineWidth()
                                                     : property->GetEdgeWidth();
}
template <typename Property>
float FindWidth(Property* property, long)
{
  return property->GetLineWidth();
}
template <typename Property>
auto FindOpacity(Property* property, int) -> decltype(property->GetEdgeOpacity())
{
  return property->GetEdgeOpacity();
}
template <typename Property>
double FindOpacity(Property*, long)
{
  return 1.0;
}

/// Sets the red, green and blue parts of colors, or removes all colors if they are opaque.
void ReplaceColors(std::vector<glm::u8vec4>& colors, glm::u8vec3 by)
{
  if (std::all_of(colors.begin(), colors.end(), [](glm::u8vec4 c) { return c.a == 255; }))
  {
    colors.clear();
  }
  for (glm::u8vec4& color : colors)
  {
    color = glm::u8vec4(by, color.a);
  }
}

}

double FindEdgeWidth(vtkProperty* property)
{
  return FindWidth(property, 0);
}

double FindEdgeOpacity(vtkProperty* property)
{
  return FindOpacity(property, 0);
}

Material MakeUnlitMaterial(const double color[3], double opacity)
{
  Material material;
  material.AmbientColor = glm::vec3(color[0], color[1], color[2]);
  material.DiffuseColor = material.AmbientColor;
  material.Ambient = 1.f;
  material.Diffuse = 0.f;
  material.Opacity = static_cast<float>(opacity);
  material.Lighting = false;
  return material;
}

Material MakeRoundMaterial(vtkProperty* property, const Material& unlit)
{
  Material material = MakeMaterial(property);
  material.AmbientColor = unlit.AmbientColor;
  material.DiffuseColor = unlit.DiffuseColor;
  material.Opacity = unlit.Opacity;
  return material;
}

void ReplaceColors(const Material& material, Surface& surface)
{
  const float opacity = surface.Front.Opacity * material.Opacity;
  surface.Front = material;
  surface.Front.Opacity = opacity;
  surface.ScalarColoring = false;
  surface.LitTexture = nullptr;
  const glm::u8vec3 color(glm::clamp(material.DiffuseColor, 0.f, 1.f) * 255.f + 0.5f);
  ReplaceColors(surface.PointColors, color);
  ReplaceColors(surface.CellColors, color);
  if (surface.ColorTexture)
  {
    auto texture = std::make_shared<Texture>(*surface.ColorTexture);
    ReplaceColors(texture->Texels, color);
    texture->IsSRGB = false;
    texture->BorderColor = glm::vec4(glm::vec3(color) / 255.f, texture->BorderColor.a);
    surface.ColorTexture = texture->Texels.empty() ? nullptr : texture;
    if (!surface.ColorTexture)
    {
      surface.ColorCoordinates.clear();
    }
  }
}

}
