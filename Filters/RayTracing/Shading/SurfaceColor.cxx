// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceColor.h"

#include "Background.h"
#include "Environment/CubeMap.h"
#include "Scene.h"
#include "Surface.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace penumbra
{
namespace
{

glm::vec4 ToFloatColor(glm::u8vec4 color)
{
  return glm::vec4(color) * (1.f / 255.f);
}

/// Maps a texel index into [0, size).
int WrapIndex(int i, int size, Texture::WrapModes wrap)
{
  if (i >= 0 && i < size)
  {
    return i; // divisions take most of the time
  }
  const auto modulo = [](int x, int n) { return x % n < 0 ? x % n + n : x % n; };
  switch (wrap)
  {
    case Texture::WrapModes::Repeat:
      return modulo(i, size);
    case Texture::WrapModes::MirroredRepeat:
    {
      const int j = modulo(i, 2 * size);
      return j < size ? j : 2 * size - 1 - j;
    }
    default:
      return std::clamp(i, 0, size - 1);
  }
}

}

glm::vec4 GetTexel(const Texture& texture, glm::ivec2 texel)
{
  if (texture.Wrap == Texture::WrapModes::ClampToBorder &&
    (texel.x < 0 || texel.x >= texture.Width || texel.y < 0 || texel.y >= texture.Height))
  {
    return texture.BorderColor;
  }
  const int i = WrapIndex(texel.x, texture.Width, texture.Wrap);
  const int j = WrapIndex(texel.y, texture.Height, texture.Wrap);
  return texture.Decode(texture.Texels[static_cast<std::size_t>(j) * texture.Width + i]);
}

glm::vec4 SampleTexture(const Texture& texture, glm::vec2 coordinates)
{
  const auto texel = [&](int i, int j) { return GetTexel(texture, { i, j }); };
  if (!std::isfinite(coordinates.x) || !std::isfinite(coordinates.y))
  {
    return texel(0, 0);
  }
  // Larger coordinates would overflow the texel index.
  const float limit = 1e6f;
  const float x = glm::clamp(coordinates.x, -limit, limit) * texture.Width;
  const float y = glm::clamp(coordinates.y, -limit, limit) * texture.Height;
  if (!texture.Interpolate)
  {
    return texel(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
  }
  const float left = std::floor(x - .5f);
  const float bottom = std::floor(y - .5f);
  const int i = static_cast<int>(left);
  const int j = static_cast<int>(bottom);
  const float s = x - .5f - left;
  const float t = y - .5f - bottom;
  return glm::mix(glm::mix(texel(i, j), texel(i + 1, j), s),
    glm::mix(texel(i, j + 1), texel(i + 1, j + 1), s), t);
}

glm::vec4 SampleTexture(
  const Surface& surface, const Texture& texture, glm::uvec3 corners, glm::vec3 weights)
{
  return SampleTexture(texture, Interpolate(surface.TextureCoordinates, corners, weights));
}

glm::vec4 MappedColor(const Surface& surface, const Hit& hit, glm::uvec3 corners, glm::vec3 weights)
{
  if (!surface.PointColors.empty())
  {
    return weights.x * ToFloatColor(surface.PointColors[corners.x]) +
      weights.y * ToFloatColor(surface.PointColors[corners.y]) +
      weights.z * ToFloatColor(surface.PointColors[corners.z]);
  }
  if (surface.HasTriangleColors())
  {
    return ToFloatColor(surface.GetTriangleColor(hit.Primitive));
  }
  return SampleTexture(
    *surface.ColorTexture, Interpolate(surface.ColorCoordinates, corners, weights));
}

bool HasMappedColor(const Surface& surface)
{
  return !surface.PointColors.empty() || surface.HasTriangleColors() || surface.ColorTexture;
}

float MultiplyOpacity(const Surface& surface, const Hit& hit, float opacity)
{
  const glm::uvec3 corners = surface.GetCorners(hit.Primitive);
  const glm::vec3 weights(1.f - hit.U - hit.V, hit.U, hit.V);
  if (HasMappedColor(surface))
  {
    opacity *= MappedColor(surface, hit, corners, weights).a;
  }
  for (const Texture* texture : { surface.BaseColorTexture.get(), surface.LitTexture.get() })
  {
    if (texture)
    {
      opacity *= SampleTexture(surface, *texture, corners, weights).a;
    }
  }
  return opacity;
}

glm::vec4 SampleSky(const Sky& sky, glm::dvec3 direction)
{
  const glm::dvec3 d = glm::normalize(sky.FromScene * direction);
  glm::vec4 color;
  if (sky.Faces.size() < 6)
  {
    const glm::dvec2 coordinates(0.5 * std::atan2(d.z, d.x), std::atan2(d.y, std::hypot(d.x, d.z)));
    color =
      SampleTexture(*sky.Faces[0], glm::vec2(coordinates / glm::pi<double>() + glm::dvec2(0.5)));
  }
  else
  {
    const CubeMapPoint<double> point = FindCubeMapPoint(d);
    color = SampleTexture(*sky.Faces[point.Face], glm::vec2(point.Position));
  }
  return sky.IsGammaCorrected
    ? glm::vec4(glm::pow(glm::vec3(color), glm::vec3(1.f / 2.2f)), color.a)
    : color;
}

glm::vec4 SampleBackground(const Scene& scene, const glm::dvec2& p)
{
  const Background& background = scene.BackgroundColors;
  const Camera& camera = scene.ViewCamera;
  const glm::vec2 position(p / glm::dvec2(camera.Width, camera.Height));
  if (background.Image || background.Surroundings)
  {
    const Sky* sky = background.Surroundings.get();
    const glm::vec4 texel = sky
      ? SampleSky(*sky,
          camera.Parallel ? camera.RayOrigin(p) - camera.Position + sky->Depth * camera.Forward
                          : camera.RayDirection(p))
      : SampleTexture(*background.Image, position);
    const float alpha = texel.a + (1.f - texel.a) * background.First.a;
    const glm::vec3 color =
      glm::mix(background.First.a * glm::vec3(background.First), glm::vec3(texel), texel.a);
    return alpha > 0.f ? glm::vec4(color / alpha, alpha) : glm::vec4(0.f);
  }
  const float radius = 2.f * glm::length(position - .5f);
  float t = 0.f;
  switch (background.Gradient)
  {
    case Background::Gradients::Vertical:
      t = position.y;
      break;
    case Background::Gradients::Horizontal:
      t = position.x;
      break;
    case Background::Gradients::RadialToSide:
      t = std::min(radius, 1.f);
      break;
    case Background::Gradients::RadialToCorner:
      t = std::min(radius / std::sqrt(2.f), 1.f);
      break;
  }
  return glm::mix(background.First, background.Second, t);
}

}
