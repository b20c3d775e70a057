// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EmissiveSurfaces.h"

#include "Execution/AvailableMemory.h"
#include "Scene.h"
#include "Surface.h"
#include "Vectors.h"

#include <algorithm>
#include <string>

namespace penumbra
{
namespace
{

/// Bytes of a bright emitter here and in an EmitterTree, at least.
constexpr double BytesPerEmitter = 2.0 * sizeof(Emitter);

glm::vec3 MeanColor(const Texture& texture)
{
  glm::dvec3 sum(0.0);
  for (const glm::u8vec4 texel : texture.Texels)
  {
    sum += texture.IsSRGB ? 255.0 * glm::dvec3(texture.Decode(texel)) : glm::dvec3(texel);
  }
  return glm::vec3(
    sum / (255.0 * std::max<double>(static_cast<double>(texture.Texels.size()), 1.0)));
}

/// Radiance of one side of a surface: a factor of the mapped color, or a color.
glm::vec3 ComputeRadiance(const Material& material, bool lit, bool mapped)
{
  if (lit && material.PhysicallyBased)
  {
    return glm::vec3(0.f);
  }
  const float diffuse = material.Lighting ? 0.f : material.Diffuse;
  return mapped ? glm::vec3(material.Ambient + diffuse)
                : material.Ambient * material.AmbientColor + diffuse * material.DiffuseColor;
}

/// Radiance of the primitives of one surface.
class SurfaceRadiance
{
public:
  SurfaceRadiance(const Surface& surface, bool hasLights)
    : Data(surface)
  {
    const bool mapped = !surface.PointColors.empty() || surface.HasTriangleColors() ||
      (surface.ColorTexture != nullptr);
    const bool lit = surface.Front.Lighting && hasLights;
    this->Factor = ComputeRadiance(surface.Front, lit, mapped);
    if (surface.HasBackMaterial)
    {
      this->Factor = glm::max(this->Factor, ComputeRadiance(surface.Back, lit, mapped));
    }
    for (const Texture* texture : { surface.ColorTexture.get(), surface.LitTexture.get() })
    {
      this->Factor *= texture && this->IsEmissive() ? MeanColor(*texture) : glm::vec3(1.f);
    }
  }

  bool IsEmissive() const { return MaximumComponent(this->Factor) > 0.f; }

  glm::vec3 ComputeLight(std::uint32_t primitive) const
  {
    glm::vec3 color(1.f);
    if (this->Data.HasTriangleColors())
    {
      color = glm::vec3(this->Data.GetTriangleColor(primitive)) / 255.f;
    }
    else if (!this->Data.PointColors.empty())
    {
      const glm::uvec3 corners = this->Data.GetCorners(primitive);
      color = glm::max(glm::vec3(this->Data.PointColors[corners.x]),
                glm::max(glm::vec3(this->Data.PointColors[corners.y]),
                  glm::vec3(this->Data.PointColors[corners.z]))) /
        255.f;
    }
    return this->Factor * color;
  }

private:
  const Surface& Data;
  glm::vec3 Factor;
};

Emitter MakeEmitter(const Surface& surface, std::uint32_t primitive)
{
  const glm::uvec3 corners = surface.GetCorners(primitive);
  Emitter emitter;
  emitter.Corners = surface.GetPoints(primitive);
  emitter.Radius = surface.GetRadius(corners.x);
  emitter.Primitive = primitive;
  return emitter;
}

/// Returns the larger of the area of the surfaces, without tubes, and the area of their bounds.
double ComputeReferenceArea(const Scene& scene)
{
  double area = 0.0;
  glm::vec3 low(std::numeric_limits<float>::max());
  glm::vec3 high(-std::numeric_limits<float>::max());
  for (const Surface& surface : scene.Surfaces)
  {
    const std::size_t count =
      surface.IsLineOrPoint || !surface.Segments.empty() ? 0 : surface.GetNumberOfPrimitives();
    for (std::size_t i = 0; i < count; ++i)
    {
      const Emitter shape = MakeEmitter(surface, static_cast<std::uint32_t>(i));
      area += shape.ComputeArea();
      for (const glm::vec3 corner : shape.Corners)
      {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
      }
    }
  }
  const glm::dvec3 size(glm::max(high - low, glm::vec3(0.f)));
  return std::max(area, 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x));
}

/// Calls `function` with each emitter in the order of the scene. Sets `hasTubes` if there are
/// emissive tubes, which are left out.
template <typename Function>
void ForEachEmitter(const Scene& scene, bool& hasTubes, const Function& function)
{
  for (std::size_t i = 0; i < scene.Surfaces.size(); ++i)
  {
    const Surface& surface = scene.Surfaces[i];
    const SurfaceRadiance radiance(surface, !scene.Lights.empty());
    if (surface.IsLineOrPoint || !radiance.IsEmissive())
    {
      continue;
    }
    if (!surface.Segments.empty())
    {
      hasTubes = true;
      continue;
    }
    for (std::size_t k = 0; k < surface.GetNumberOfPrimitives(); ++k)
    {
      const glm::vec3 light = radiance.ComputeLight(static_cast<std::uint32_t>(k));
      const float strength = MaximumComponent(light);
      if (strength > 0.f)
      {
        Emitter emitter = MakeEmitter(surface, static_cast<std::uint32_t>(k));
        emitter.Strength = strength;
        emitter.Color = light / strength;
        emitter.Surface = static_cast<std::uint32_t>(i);
        function(emitter);
      }
    }
  }
}

}

EmissiveSurfaces FindEmissiveSurfaces(const Scene& scene, double threshold, std::size_t maximumDim)
{
  EmissiveSurfaces found;
  double power = 0.0;
  bool isEmissive = false;
  ForEachEmitter(scene, found.HasTubes, [&](const Emitter& emitter) {
    power += static_cast<double>(emitter.Strength) * emitter.ComputeArea();
    isEmissive = true;
  });
  if (!isEmissive)
  {
    return found;
  }
  const double area = ComputeReferenceArea(scene);
  found.MeanRadiance = area > 0.0 ? power / area : 0.0;
  const auto isBright = [&](const Emitter& emitter) {
    return emitter.Strength > threshold * found.MeanRadiance;
  };
  std::size_t bright = 0;
  std::size_t dim = 0;
  ForEachEmitter(
    scene, found.HasTubes, [&](const Emitter& emitter) { ++(isBright(emitter) ? bright : dim); });
  RequireMemory(BytesPerEmitter * static_cast<double>(bright),
    std::to_string(bright) + " emissive triangles and spheres");
  found.Bright.reserve(bright);
  ForEachEmitter(scene, found.HasTubes, [&](const Emitter& emitter) {
    if (isBright(emitter))
    {
      found.Bright.push_back(emitter);
    }
    else if (dim <= maximumDim)
    {
      found.Dim.push_back(emitter);
    }
  });
  found.HasMoreDim = dim > maximumDim;
  return found;
}

}
