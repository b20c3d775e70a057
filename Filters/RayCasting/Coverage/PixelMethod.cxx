// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PixelMethod.h"

#include "Pixels/CoverageConstants.h"
#include "Pixels/PixelContext.h"
#include "Pixels/PixelErrors.h"
#include "Sampling/SampleLight.h"
#include "Scene.h"
#include "Surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
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
bool IsDiscontinuousInPlane(
  const PixelContext& pixel, const Hit& hit, const std::array<Ray, 4>& rays)
{
  const Surface& surface = pixel.GetSurfaces()[hit.Surface];
  return !surface.IsRound() && std::any_of(rays.begin(), rays.end(), [&](const Ray& ray) {
    Hit other = hit;
    return IntersectPlane(surface, ray, other) && IsInDifferentTexels(surface, hit, other);
  });
}

/// Stores the hits of a corner, up to the first opaque surface, in the layers of the pixel.
void TraceLayers(const PixelContext& pixel, int corner, Ray ray)
{
  const Sample& sample = pixel.Corners[corner];
  std::vector<Hit>& hits = pixel.Layers[corner];
  hits.assign(1, sample.FirstHit);
  if (!(sample.FirstHit.Distance < sample.OpaqueDepth))
  {
    return;
  }
  // Corners are stored without what continues a ray behind their hit.
  Hit hit = pixel.Tracer.GetRays().Intersect(ray);
  ++pixel.Rays.Refinement;
  while (hit.IsHit() && hit.Distance < sample.OpaqueDepth && hits.size() <= MaximumTexturedLayers)
  {
    ray = ContinueBehind(ray, hit);
    hit = pixel.Tracer.GetRays().Intersect(ray);
    ++pixel.Rays.Refinement;
    hits.push_back(hit);
  }
}

/// Corners at the ends of the sides of a pixel.
constexpr std::pair<int, int> SidesOfPixel[] = { { 0, 1 }, { 0, 2 }, { 3, 1 }, { 3, 2 } };

/// Returns true if two corners see different texels of a surface, among the layers of both.
bool SeeDifferentTexels(
  const std::vector<Surface>& surfaces, const std::vector<Hit>& a, const std::vector<Hit>& b)
{
  auto next = b.begin(); // layers of the two corners are in the same order
  for (const Hit& hit : a)
  {
    const auto other = std::find_if(next, b.end(),
      [&](const Hit& candidate) { return hit.IsHit() && candidate.Surface == hit.Surface; });
    if (other != b.end())
    {
      next = other + 1;
      if (IsInDifferentTexels(surfaces[hit.Surface], hit, *other))
      {
        return true;
      }
    }
  }
  return false;
}

/// Returns true if corners at the ends of a side see different texels among the layers of the pixel.
bool SeeDifferentTexels(const PixelContext& pixel)
{
  return std::any_of(std::begin(SidesOfPixel), std::end(SidesOfPixel), [&](const auto& side) {
    return SeeDifferentTexels(
      pixel.GetSurfaces(), pixel.Layers[side.first], pixel.Layers[side.second]);
  });
}

/// Adds the layers of the corners in which textures may differ. Returns true if there are any behind the first hits.
bool TraceTexturedLayers(const PixelContext& pixel, const std::array<Ray, 4>& rays, bool hasEdges)
{
  bool hasLayers = false;
  for (int i = 0; i < 4; ++i)
  {
    TraceLayers(pixel, i, rays[i]);
    hasLayers = hasLayers || pixel.Layers[i].size() > 1;
    // Without edges, all corners see the same layers.
    const auto isTextured = [&](const Hit& hit) {
      return hit.IsHit() && HasTextures(pixel.GetSurfaces()[hit.Surface]);
    };
    if (!hasEdges && std::none_of(pixel.Layers[i].begin() + 1, pixel.Layers[i].end(), isTextured))
    {
      break;
    }
  }
  return hasLayers;
}

/// Returns true if a texture may change abruptly within the pixel, so that colors may change without an edge of the
/// mesh: corners lie in different texels of it. `hasEdges`: edges of the mesh cross the pixel.
bool IsTextureDiscontinuous(const PixelContext& pixel, bool hasEdges)
{
  if (!pixel.Tracer.HasTextures())
  {
    return false;
  }
  std::array<std::vector<Hit>, 4>& layers = pixel.Layers;
  for (int i = 0; i < 4; ++i)
  {
    layers[i].assign(1, pixel.Corners[i].FirstHit);
  }
  if (SeeDifferentTexels(pixel))
  {
    return true;
  }
  const bool isDifferentSurface = hasEdges && !pixel.CornersAgree();
  if (!isDifferentSurface && !pixel.Tracer.HasTexturesBehind())
  {
    return false;
  }
  std::array<Ray, 4> rays;
  for (int i = 0; i < 4; ++i)
  {
    rays[i] = pixel.Tracer.MakeRay(pixel.GetOrigin() + GetCornerOffset(i));
  }
  const bool hasLayers =
    pixel.Tracer.HasTexturesBehind() && TraceTexturedLayers(pixel, rays, hasEdges);
  if (hasLayers && SeeDifferentTexels(pixel))
  {
    return true;
  }
  const bool mayDiffer = isDifferentSurface || (hasEdges && hasLayers);
  return mayDiffer && std::any_of(layers.begin(), layers.end(), [&](const std::vector<Hit>& hits) {
    return std::any_of(hits.begin(), hits.end(),
      [&](const Hit& hit) { return hit.IsHit() && IsDiscontinuousInPlane(pixel, hit, rays); });
  });
}

/// Returns the distance of the first hit through a corner from the cone of a spotlight, negative inside.
double ComputeDistanceFromCone(
  const CameraRayTracer& tracer, glm::ivec2 corner, const Hit& hit, const Light& light)
{
  const Ray ray = tracer.MakeRay(glm::dvec2(corner));
  const glm::dvec3 axis(light.Direction);
  const glm::dvec3 to = glm::dvec3(ray.Origin) +
    static_cast<double>(hit.Distance) * glm::dvec3(ray.Direction) - glm::dvec3(light.Position);
  const double along = glm::dot(to, axis);
  const double cosine = light.ConeCosine;
  return glm::length(to - along * axis) * cosine - along * std::sqrt(1.0 - cosine * cosine);
}

/// Returns true if the cone of a spotlight, at which its light ends abruptly, may cross what the pixel shows: if it
/// separates corners of the pixel and of its neighbors, or is near one of them.
bool IsNearLightCone(const PixelContext& pixel)
{
  const glm::ivec2 low = glm::max(pixel.Position - 1, pixel.Grid.GetLow());
  const glm::ivec2 high = glm::min(pixel.Position + 2, pixel.Grid.GetHigh());
  for (const Light& light : pixel.Tracer.GetScene().Lights)
  {
    bool isInside = false;
    bool isOutside = false;
    for (int y = low.y; light.Kind == Light::Kinds::Spot && y <= high.y; ++y)
    {
      for (int x = low.x; x <= high.x; ++x)
      {
        const Hit hit = pixel.Grid.At(x, y).FirstHit;
        if (hit.IsHit())
        {
          const double distance = ComputeDistanceFromCone(pixel.Tracer, { x, y }, hit, light);
          const double margin = LightConeMargin * pixel.ComputePixelSize(hit.Distance);
          isInside = isInside || distance < margin;
          isOutside = isOutside || distance > -margin;
        }
      }
    }
    if (isInside && isOutside)
    {
      return true;
    }
  }
  return false;
}

/// Returns true if the pixel that was selected last can be sampled by layers.
bool HasLayers(const PixelContext& pixel, const TileRasterizer& rasterizer)
{
  return rasterizer.HasLayers() && !pixel.Tracer.HasShafts() &&
    !pixel.Tracer.UsesIrradianceProvider();
}

/// Chooses where the samples of a pixel come from. Layers are divided where their normals are negated; other triangles
/// that are rasterized have only few colors.
PixelMethod ChooseSamples(
  const PixelContext& pixel, const TileGeometry& tile, Steadiness leastSteady = Steadiness::Steady)
{
  if (!tile.Rasterizer || leastSteady == Steadiness::Unsteady)
  {
    return PixelMethod::Rays;
  }
  if (tile.Rasterizer->SelectPixel(pixel.Position))
  {
    return leastSteady == Steadiness::Steady ? PixelMethod::Triangles : PixelMethod::Rays;
  }
  return HasLayers(pixel, *tile.Rasterizer) ? PixelMethod::Layers : PixelMethod::Rays;
}

/// Returns true if rasterized samples of a pixel with this number of edges, hidden ones included, take less time than
/// exact coverage.
bool IsRasterized(const PixelContext& pixel, const PixelEdges& pixelEdges, const TileGeometry& tile)
{
  const std::size_t edges = pixelEdges.GetNumberOfEdges();
  if (!tile.Rasterizer || edges < MinimumLayeredEdges)
  {
    return false;
  }
  const bool isOpaque = tile.Rasterizer->SelectPixel(pixel.Position);
  const bool isFull = edges >= MinimumRasterizedEdges && tile.RasterizesAll;
  if (isOpaque)
  {
    return (isFull && edges > MaximumHiddenEdges) ||
      (edges >= MinimumRasterizedLineEdges && tile.Rasterizer->HasLines() &&
        !pixelEdges.AreConnected());
  }
  return (isFull || tile.Rasterizer->HasLines()) && HasLayers(pixel, *tile.Rasterizer);
}

/// Returns true if the samples of a pixel of opaque surfaces may be rasterized, which takes less time than exact
/// coverage unless few of its edges are visible.
bool MayBeRasterized(const PixelContext& pixel, const PixelEdges& edges, const TileGeometry& tile)
{
  const std::size_t count = edges.GetNumberOfEdges();
  const bool isFull = count >= MinimumRasterizedEdges && tile.RasterizesAll;
  return tile.Rasterizer && (isFull || count >= MinimumLayeredEdges) &&
    tile.Rasterizer->SelectPixel(pixel.Position) && (isFull || tile.Rasterizer->HasLines());
}

/// Returns true if exact coverage of such a pixel, whose visible edges are loaded, would take many rays.
bool HasManyFaces(const PixelEdges& edges)
{
  return edges.SearchesAllPixels || edges.Segments.size() >= MinimumRasterizedEdges;
}

PixelMethod ChooseExact(
  const PixelContext& pixel, const PixelEdges& edges, const TileGeometry& tile)
{
  return MayBeRasterized(pixel, edges, tile) ? PixelMethod::ExactOnce : PixelMethod::Exact;
}

/// Chooses the method that replaces one that gave up.
PixelMethod ChooseReplacement(
  PixelMethod gaveUp, const PixelContext& pixel, const PixelEdges& edges, const TileGeometry& tile)
{
  if (gaveUp == PixelMethod::Corners)
  {
    return !edges.Segments.empty() || edges.IsTubeIntersected ? ChooseExact(pixel, edges, tile)
                                                              : PixelMethod::Refinement;
  }
  return ChooseSamples(pixel, tile, pixel.LeastSteady);
}

template <typename Test>
bool AnyCorner(const PixelContext& pixel, const Test& test)
{
  return std::any_of(
    pixel.Corners, pixel.Corners + 4, [&](const Sample& corner) { return test(corner.FirstHit); });
}

}

PixelMethod ChooseMethod(const PixelContext& pixel, PixelEdges& edges, const TileGeometry& tile,
  std::optional<PixelMethod> gaveUp)
{
  const IntegrationSettings& settings = pixel.Settings;
  if (settings.Method == CoverageMethods::Uniform)
  {
    return PixelMethod::Uniform;
  }
  if (settings.Light && settings.Light->LightsSamples(pixel.Position))
  {
    return PixelMethod::LitRays;
  }
  if (settings.Method == CoverageMethods::Subdivision)
  {
    return PixelMethod::Subdivision;
  }
  if (gaveUp)
  {
    return ChooseReplacement(*gaveUp, pixel, edges, tile);
  }
  // A rasterized triangle and a face with a corner have only few colors.
  Steadiness leastSteady = Steadiness::Steady;
  for (const Sample& corner : pixel.Corners)
  {
    leastSteady = std::max(leastSteady, tile.FindSteadiness(pixel.Tracer, corner.FirstHit));
  }
  if (IsNearLightCone(pixel))
  {
    return PixelMethod::Rays;
  }
  if (leastSteady != Steadiness::Steady)
  {
    return ChooseSamples(pixel, tile, leastSteady);
  }
  // The pole of a sphere or the center of a fan: too many edges to arrange.
  if (tile.AreEdgesLeftOut || edges.GetNumberOfEdges() > MaximumEdges ||
    IsRasterized(pixel, edges, tile))
  {
    return ChooseSamples(pixel, tile);
  }
  edges.Load(true);
  const bool isDense = AnyCorner(pixel, [&](const Hit& hit) { return tile.IsDense(hit); });
  if ((isDense || HasManyFaces(edges)) && MayBeRasterized(pixel, edges, tile))
  {
    return ChooseSamples(pixel, tile);
  }
  const bool hasEdges = !edges.Segments.empty();
  const bool hasTexels = IsTextureDiscontinuous(pixel, hasEdges);
  if (hasTexels && tile.Rasterizer && !tile.Rasterizer->SelectPixel(pixel.Position) &&
    HasLayers(pixel, *tile.Rasterizer))
  {
    return PixelMethod::Texels;
  }
  const bool isCrowded = edges.Segments.size() > MaximumEdgesInCrowdedTile;
  const bool isUnknown =
    (settings.Shadows && hasEdges) || pixel.IsNearShadowBoundary() || hasTexels;
  if (isUnknown || isDense)
  {
    // Hidden spheres and tubes may emerge from a dense surface between the corners.
    return isCrowded                       ? ChooseSamples(pixel, tile)
      : isUnknown || edges.HasPrimitives() ? PixelMethod::SampledFaces
                                           : PixelMethod::Faces;
  }
  if (tile.IsCrowded && isCrowded)
  {
    return ChooseSamples(pixel, tile);
  }
  return !hasEdges || (!settings.FindSmallObjects && pixel.CornersAgree())
    ? PixelMethod::Corners
    : ChooseExact(pixel, edges, tile);
}

}
