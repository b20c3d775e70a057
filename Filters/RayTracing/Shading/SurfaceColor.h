// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Colors at a hit that come from data: point and cell colors, textures.
#ifndef penumbra_SurfaceColor_h
#define penumbra_SurfaceColor_h

#include "Background.h"
#include "Embree/RayScene.h"
#include "Material.h"
#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro

#include <vector>

namespace penumbra
{

struct Scene;
struct Surface;

/// Interpolates point data with the barycentric coordinates of a hit.
template <typename T>
T Interpolate(const std::vector<T>& values, glm::uvec3 corners, glm::vec3 weights)
{
  return weights.x * values[corners.x] + weights.y * values[corners.y] +
    weights.z * values[corners.z];
}

/// Returns the RGBA color of a texture, in [0, 1], as VTK samples it without mipmaps. `coordinates`
/// span the image from (0, 0) to (1, 1).
VTKPENUMBRAFILTERSRAYTRACING_EXPORT glm::vec4 SampleTexture(
  const Texture& texture, glm::vec2 coordinates);

/// Returns the RGBA color of a texel, in [0, 1], or what the texture shows at its place if there is none.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT glm::vec4 GetTexel(const Texture& texture, glm::ivec2 texel);

/// Returns the color of a texture of `surface` at a hit.
glm::vec4 SampleTexture(
  const Surface& surface, const Texture& texture, glm::uvec3 corners, glm::vec3 weights);

/// Returns `opacity` times the opacities of the data and textures of `surface` at a hit.
float MultiplyOpacity(const Surface& surface, const Hit& hit, float opacity);

/// Returns the color of a sky in a direction, which need not have unit length.
glm::vec4 SampleSky(const Sky& sky, glm::dvec3 direction);

/// Returns the background at image point p, as non-premultiplied RGBA.
glm::vec4 SampleBackground(const Scene& scene, const glm::dvec2& p);

/// Returns true if the color of the surface is mapped from its data.
bool HasMappedColor(const Surface& surface);

/// Returns the RGBA color at a hit that is mapped from the data of the surface.
glm::vec4 MappedColor(
  const Surface& surface, const Hit& hit, glm::uvec3 corners, glm::vec3 weights);

}
#endif
