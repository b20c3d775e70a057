// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TextureBorders.h"

#include "PixelErrors.h"
#include "Scene.h"
#include "Surface.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace penumbra
{

namespace
{

/// Returns the position of a hit in a texture, in texels.
glm::dvec2 ComputeTexel(const Surface& surface, const Texture& texture,
  const std::vector<glm::vec2>& coordinates, const Hit& hit)
{
  const glm::uvec3 t = surface.GetCorners(hit.Primitive);
  const glm::dvec2 p = (1.0 - hit.U - hit.V) * glm::dvec2(coordinates[t.x]) +
    static_cast<double>(hit.U) * glm::dvec2(coordinates[t.y]) +
    static_cast<double>(hit.V) * glm::dvec2(coordinates[t.z]);
  return p * glm::dvec2(texture.Width, texture.Height);
}

/// Sets the coordinates of a hit in its triangle to those at which a ray meets the plane of the
/// triangle, which may lie outside. Returns false if it does not.
bool IntersectPlane(const Surface& surface, const Ray& ray, Hit& hit)
{
  const std::array<glm::vec3, 3> points = surface.GetPoints(hit.Primitive);
  const glm::dvec3 a(points[0]);
  const glm::dvec3 u = glm::dvec3(points[1]) - a;
  const glm::dvec3 v = glm::dvec3(points[2]) - a;
  const glm::dvec3 direction(ray.Direction);
  const glm::dvec3 p = glm::cross(direction, v);
  const double determinant = glm::dot(u, p);
  const glm::dvec3 offset = glm::dvec3(ray.Origin) - a;
  const glm::dvec3 q = glm::cross(offset, u);
  hit.U = static_cast<float>(glm::dot(offset, p) / determinant);
  hit.V = static_cast<float>(glm::dot(direction, q) / determinant);
  return std::isfinite(hit.U) && std::isfinite(hit.V);
}

/// Returns true if the colors of a surface change between two hits only at an outline: those of a
/// sphere are constant, and only consecutive tubes may be joined.
bool ChangesAtOutlineOnly(const Surface& surface, const Hit& a, const Hit& b)
{
  return surface.IsRound() &&
    (surface.Segments.empty() ||
      std::max(a.Primitive, b.Primitive) - std::min(a.Primitive, b.Primitive) > 1);
}

/// Returns true if a texture may change abruptly between two hits of the surface. With
/// interpolation, it changes abruptly if they are more than one texel apart.
bool IsInDifferentTexels(const Surface& surface, const Hit& a, const Hit& b)
{
  if (ChangesAtOutlineOnly(surface, a, b))
  {
    return false;
  }
  const MaterialTextures* details = surface.DetailTextures.get();
  const Texture* const textures[] = { surface.ColorTexture.get(), surface.LitTexture.get(),
    surface.BaseColorTexture.get(), details ? details->Normal.get() : nullptr,
    details ? details->OcclusionRoughnessMetallic.get() : nullptr,
    details ? details->Emission.get() : nullptr, details ? details->Anisotropy.get() : nullptr,
    details ? details->CoatNormal.get() : nullptr };
  for (const Texture* texture : textures)
  {
    const std::vector<glm::vec2>& coordinates =
      texture == surface.ColorTexture.get() ? surface.ColorCoordinates : surface.TextureCoordinates;
    if (!texture || coordinates.empty())
    {
      continue;
    }
    const glm::dvec2 p = ComputeTexel(surface, *texture, coordinates, a);
    const glm::dvec2 q = ComputeTexel(surface, *texture, coordinates, b);
    const glm::dvec2 d =
      texture->Interpolate ? glm::floor(glm::abs(p - q)) : glm::floor(p) - glm::floor(q);
    if (d != glm::dvec2(0.0))
    {
      return true;
    }
  }
  return false;
}

/// Returns true if a texture is discontinuous at an outline, where a single corner may be on the
/// surface: compares it with the points at which the other corners see the plane of its triangle.
bool IsDiscontinuousInPlane(const PixelContext& pixel)
{
  const std::vector<Surface>& surfaces = pixel.GetScene().Surfaces;
  for (int i = 0; i < 4; ++i)
  {
    const Hit& hit = pixel.Corners[i].FirstHit;
    if (!hit.IsHit() || surfaces[hit.Surface].IsRound())
    {
      continue;
    }
    for (int j = 0; j < 4; ++j)
    {
      Hit other = hit;
      const glm::dvec2 at = pixel.GetOrigin() + GetCornerOffset(j);
      if (j != i && IntersectPlane(surfaces[hit.Surface], pixel.Tracer.MakeRay(at), other) &&
        IsInDifferentTexels(surfaces[hit.Surface], hit, other))
      {
        return true;
      }
    }
  }
  return false;
}

}

bool IsTextureDiscontinuous(const PixelContext& pixel, bool hasEdges)
{
  const std::vector<Surface>& surfaces = pixel.GetScene().Surfaces;
  for (int side = 0; side < 4; ++side)
  {
    const Hit& a = pixel.Corners[side == 3 ? 3 : 0].FirstHit;
    const Hit& b = pixel.Corners[side < 2 ? side + 1 : side == 2 ? 3 : 1].FirstHit;
    if (a.Surface == b.Surface && a.IsHit() && IsInDifferentTexels(surfaces[a.Surface], a, b))
    {
      return true;
    }
  }
  return hasEdges && !pixel.CornersAgree() && IsDiscontinuousInPlane(pixel);
}

}
