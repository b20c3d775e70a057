// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CubeMapGatherer.h"

#include "Embree/RayScene.h"
#include "Embree/RayTriangle.h"
#include "Gathering/HemisphereGrid.h"
#include "Shading/HemisphereSampling.h"
#include "Surface.h"

namespace penumbra
{
namespace
{

/// Distance of the near plane, as a fraction of the offset of the ray origin from its surface.
constexpr float NearFraction = .25f;

/// Relative error of depths; continuation rays start this much farther.
constexpr float DepthError = 1e-5f;

/// One surface, or the background, in a grid cell.
struct CellFragment
{
  std::uint32_t Surface = Hit::None;
  float Weight = 0.f;        ///< fraction of the cell
  float FalloffWeight = 0.f; ///< Weight, multiplied by the falloff
  float MaximumWeight = 0.f; ///< largest weight of its texels
  int Texel = 0;             ///< the texel with that weight, which is shaded
};

struct CellFragments
{
  std::vector<CellFragment> All;
  std::vector<std::size_t> First; ///< cell i has the fragments [First[i], First[i + 1])
};

/// Returns the texel that shows what is in the direction of each texel: the same one, or, below the plane of the
/// triangle, the one in the reflected direction. `geometric`: local normal of the triangle.
std::vector<int> FindTexelsAbove(const Hemicube& cube, glm::vec3 geometric)
{
  // The center of the texel is above the plane: directions are at most sqrt(3) long, and a texel extends by at
  // most sqrt(2) / side from its center.
  const float lowest = 2.5f / static_cast<float>(cube.GetHeight());
  std::vector<int> texels;
  for (const glm::vec3& direction : cube.GetDirections())
  {
    const float height = glm::dot(direction, geometric);
    const glm::vec3 reflected = direction + (std::max(-height, lowest) - height) * geometric;
    texels.push_back(height < -1e-6f ? cube.FindTexel(reflected) : static_cast<int>(texels.size()));
  }
  return texels;
}

/// `above`: see FindTexelsAbove().
CellFragments FindFragments(const Hemicube& cube, const Hemicube::Cells& cells,
  const TriangleClusters& clusters, const std::vector<HemicubeTexel>& texels,
  const std::vector<int>& above, const DistanceFalloff& falloff)
{
  std::vector<std::uint32_t> surfaces(texels.size(), Hit::None);
  std::vector<float> falloffs(texels.size(), 1.f);
  for (std::size_t i = 0; i < texels.size(); ++i)
  {
    const float distance = texels[i].Depth * glm::length(cube.GetDirections()[i]);
    if (texels[i].TriangleId > 0.f && distance <= falloff.Radius)
    {
      falloffs[i] = falloff.Evaluate(distance);
      surfaces[i] = clusters.GetTriangle(static_cast<std::size_t>(texels[i].TriangleId)).Surface;
    }
  }
  CellFragments fragments;
  for (std::size_t cell = 0; cell + 1 < cells.First.size(); ++cell)
  {
    fragments.First.push_back(fragments.All.size());
    for (std::size_t i = cells.First[cell]; i < cells.First[cell + 1]; ++i)
    {
      const Hemicube::TexelWeight& part = cells.Texels[i];
      const int texel = above[part.Texel];
      const std::uint32_t surface = surfaces[texel];
      std::size_t index = fragments.First.back();
      while (index < fragments.All.size() && fragments.All[index].Surface != surface)
      {
        ++index;
      }
      if (index == fragments.All.size())
      {
        fragments.All.push_back({ surface });
      }
      CellFragment& fragment = fragments.All[index];
      fragment.Weight += part.Weight;
      fragment.FalloffWeight += falloffs[texel] * part.Weight;
      if (part.Weight > fragment.MaximumWeight)
      {
        fragment.MaximumWeight = part.Weight;
        fragment.Texel = texel;
      }
    }
  }
  fragments.First.push_back(fragments.All.size());
  return fragments;
}

/// Returns the hit of `ray` with the triangle in a texel; its distance is not set.
Hit ComputeHit(const std::vector<Surface>& surfaces, const TriangleClusters& clusters,
  const HemicubeTexel& texel, const Ray& ray)
{
  const auto& triangle = clusters.GetTriangle(static_cast<std::size_t>(texel.TriangleId));
  const RayTriangle intersection(surfaces[triangle.Surface], triangle.Triangle, ray);
  const double u = intersection.IsValid ? std::clamp(intersection.U, 0.0, 1.0) : 1.0 / 3.0;
  Hit hit;
  hit.Surface = triangle.Surface;
  hit.Primitive = triangle.Triangle;
  hit.U = static_cast<float>(u);
  hit.V =
    static_cast<float>(intersection.IsValid ? std::clamp(intersection.V, 0.0, 1.0 - u) : 1.0 / 3.0);
  return hit;
}

/// Combines the fragments of a cell. Distance and normal are those of the largest surface in it.
HemisphereSample CombineFragments(
  const CellFragments& fragments, int cell, const std::vector<HemisphereSample>& shaded)
{
  HemisphereSample sample;
  float maximumWeight = 0.f;
  for (std::size_t i = fragments.First[cell]; i < fragments.First[cell + 1]; ++i)
  {
    const float weight = fragments.All[i].Weight;
    sample.Radiance += fragments.All[i].FalloffWeight * shaded[i].Radiance;
    if (weight > maximumWeight && !std::isinf(shaded[i].Distance))
    {
      maximumWeight = weight;
      sample.Distance = shaded[i].Distance;
      sample.Normal = shaded[i].Normal;
    }
  }
  return sample;
}

}

CubeMapGatherer::CubeMapGatherer(
  const RayGatherer& rays, int side, std::shared_ptr<CubeMapCounts> counts)
  : Rays(rays),
    Cube(side),
    Clusters(rays.GetRays().GetSurfaces()),
    Renderer(
      std::make_unique<HemicubeRenderer>(rays.GetRays().GetSurfaces(), this->Clusters, this->Cube)),
    Counts(std::move(counts))
{
}

void CubeMapGatherer::SampleEmitters(glm::vec3 point, std::vector<EmitterSample>& emitters) const
{
  this->Rays.SampleEmitters(point, emitters);
}

long long CubeMapGatherer::Gather(glm::vec3 point, const SurfaceNormals& normals,
  const std::vector<glm::vec3>& directions, std::vector<HemisphereSample>& samples) const
{
  return this->Rays.Gather(point, normals, directions, samples);
}

const Hemicube::Cells& CubeMapGatherer::FindCells(const HemisphereGrid& grid) const
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const auto found = this->Cells.find(grid.Side);
  return found != this->Cells.end()
    ? found->second
    : this->Cells.emplace(grid.Side, this->Cube.MapToGrid(grid)).first->second;
}

long long CubeMapGatherer::SampleHemisphere(glm::vec3 point, const TangentFrame& tangentFrame,
  const HemisphereGrid& grid, std::uint32_t /*seed*/, std::vector<glm::vec3>& directions,
  std::vector<HemisphereSample>& samples) const
{
  const glm::mat3& frame = tangentFrame.Axes;
  const float offset = RayOriginOffset(point);
  const glm::vec3 origin = point + offset * tangentFrame.GeometricNormal;
  std::vector<HemicubeTexel> texels;
  this->Counts->Triangles +=
    this->Renderer->Draw(origin, tangentFrame, NearFraction * offset, this->GetRadius(), texels);
  ++this->Counts->CubeMaps;

  const Hemicube::Cells& cells = this->FindCells(grid);
  const std::vector<int> above =
    FindTexelsAbove(this->Cube, glm::transpose(frame) * tangentFrame.GeometricNormal);
  const CellFragments fragments =
    FindFragments(this->Cube, cells, this->Clusters, texels, above, this->GetFalloff());
  std::vector<Ray> rays;
  std::vector<Hit> hits;
  for (const CellFragment& fragment : fragments.All)
  {
    const glm::vec3 direction = frame * this->Cube.GetDirections()[fragment.Texel];
    const float length = glm::length(direction);
    rays.push_back({ origin, direction / length });
    Hit hit;
    if (fragment.Surface != Hit::None)
    {
      const HemicubeTexel& texel = texels[fragment.Texel];
      hit = ComputeHit(this->Rays.GetRays().GetSurfaces(), this->Clusters, texel, rays.back());
      hit.Distance = texel.Depth * length;
      hit.NextNear = hit.Distance * (1.f + DepthError);
    }
    hits.push_back(hit);
  }
  std::vector<HemisphereSample> shaded;
  const long long traced =
    this->Rays.ShadeHits(point, tangentFrame.GetNormals(), rays, hits, shaded);

  directions.clear();
  samples.clear();
  for (int cell = 0; cell < grid.Cells(); ++cell)
  {
    const glm::vec2 corner(cell % grid.Side, cell / grid.Side);
    const glm::vec2 center = (corner + .5f) / static_cast<float>(grid.Side);
    directions.push_back(DiskToHemisphere(SampleUniformDiskConcentric(center.x, center.y)));
    samples.push_back(CombineFragments(fragments, cell, shaded));
    // The variance of m x m texels that a straight edge crosses decreases as m^-3, as with
    // stratified rays.
    const auto count = static_cast<float>(cells.First[cell + 1] - cells.First[cell]);
    samples.back().Variance = 1.f / (count * std::sqrt(count));
  }
  return traced;
}

}
