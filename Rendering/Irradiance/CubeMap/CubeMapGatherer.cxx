// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CubeMapGatherer.h"

#include "Embree/RayScene.h"
#include "Embree/RayTriangle.h"
#include "Gathering/HemisphereGrid.h"
#include "Shading/HemisphereSampling.h"

namespace penumbra
{
namespace
{

/// What is nearer than this share of the gap between a point and where it looks from is not seen.
constexpr float ShareOfGap = .25f;

/// Of depths, relatively: rays that go on start so much further.
constexpr float DepthError = 1e-5f;

/// What fills a part of a cell: one surface, or nothing.
struct CellFragment
{
  std::uint32_t Surface = Hit::None;
  float Share = 0.f;
  float Counted = 0.f; ///< of the share, after the fall-off
  float Most = 0.f;    ///< of its texels' shares
  int Texel = 0;       ///< that texel, which stands for all
};

struct Patches
{
  std::vector<CellFragment> All;
  std::vector<std::size_t> First; ///< those of cell i are from First[i] on to before First[i + 1]
};

Patches FindFragments(const Hemicube& cube, const Hemicube::Cells& cells,
  const TriangleClusters& bundles, const std::vector<HemicubeTexel>& texels,
  const DistanceFalloff& falloff)
{
  std::vector<std::uint32_t> surfaces(texels.size(), Hit::None);
  std::vector<float> counting(texels.size(), 1.f);
  for (std::size_t i = 0; i < texels.size(); ++i)
  {
    const float distance = texels[i].Depth * glm::length(cube.GetDirections()[i]);
    if (texels[i].Number > 0.f && distance <= falloff.Radius)
    {
      counting[i] = falloff.Evaluate(distance);
      surfaces[i] = bundles.GetTriangle(static_cast<std::size_t>(texels[i].Number)).Surface;
    }
  }
  Patches patches;
  for (std::size_t cell = 0; cell + 1 < cells.First.size(); ++cell)
  {
    patches.First.push_back(patches.All.size());
    for (std::size_t i = cells.First[cell]; i < cells.First[cell + 1]; ++i)
    {
      const Hemicube::TexelWeight& part = cells.Parts[i];
      const std::uint32_t surface = surfaces[part.Texel];
      std::size_t at = patches.First.back();
      while (at < patches.All.size() && patches.All[at].Surface != surface)
      {
        ++at;
      }
      if (at == patches.All.size())
      {
        patches.All.push_back({ surface });
      }
      CellFragment& patch = patches.All[at];
      patch.Share += part.Share;
      patch.Counted += counting[part.Texel] * part.Share;
      if (part.Share > patch.Most)
      {
        patch.Most = part.Share;
        patch.Texel = part.Texel;
      }
    }
  }
  patches.First.push_back(patches.All.size());
  return patches;
}

/// The texel as `ray` would have met it.
Hit HitOf(
  const Scene& scene, const TriangleClusters& bundles, const HemicubeTexel& texel, const Ray& ray)
{
  const auto& which = bundles.GetTriangle(static_cast<std::size_t>(texel.Number));
  const RayTriangle met(scene.Surfaces[which.Surface], which.Triangle, ray);
  const double u = met.IsValid ? std::clamp(met.U, 0.0, 1.0) : 1.0 / 3.0;
  Hit hit;
  hit.Surface = which.Surface;
  hit.Triangle = which.Triangle;
  hit.U = static_cast<float>(u);
  hit.V = static_cast<float>(met.IsValid ? std::clamp(met.V, 0.0, 1.0 - u) : 1.0 / 3.0);
  return hit;
}

/// What a cell shows as a whole: distance and normal are those of what fills most of it.
HemisphereSample CombineFragments(
  const Patches& patches, int cell, const std::vector<HemisphereSample>& seen)
{
  HemisphereSample sight;
  float most = 0.f;
  for (std::size_t i = patches.First[cell]; i < patches.First[cell + 1]; ++i)
  {
    const float share = patches.All[i].Share;
    sight.Radiance += patches.All[i].Counted * seen[i].Radiance;
    if (share > most && !std::isinf(seen[i].Distance))
    {
      most = share;
      sight.Distance = seen[i].Distance;
      sight.Normal = seen[i].Normal;
    }
  }
  return sight;
}

}

CubeMapGatherer::CubeMapGatherer(
  const RayGatherer& seen, int side, std::shared_ptr<CubeMapCounts> counts)
  : Seen(seen),
    Cube(side),
    Bundles(seen.GetRays().GetScene()),
    Picture(
      std::make_unique<HemicubeRenderer>(seen.GetRays().GetScene(), this->Bundles, this->Cube)),
    Counts(std::move(counts))
{
}

void CubeMapGatherer::SampleEmitters(glm::vec3 point, std::vector<EmitterSample>& beams) const
{
  this->Seen.SampleEmitters(point, beams);
}

long long CubeMapGatherer::Gather(glm::vec3 point, glm::vec3 normal,
  const std::vector<glm::vec3>& directions, std::vector<HemisphereSample>& sights) const
{
  return this->Seen.Gather(point, normal, directions, sights);
}

const Hemicube::Cells& CubeMapGatherer::CellsOf(const HemisphereGrid& grid) const
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const auto found = this->Cells.find(grid.Side);
  return found != this->Cells.end()
    ? found->second
    : this->Cells.emplace(grid.Side, this->Cube.MapToGrid(grid)).first->second;
}

long long CubeMapGatherer::SampleHemisphere(glm::vec3 point, const glm::mat3& frame,
  const HemisphereGrid& grid, std::uint32_t /*seed*/, std::vector<glm::vec3>& directions,
  std::vector<HemisphereSample>& sights) const
{
  const float gap = RayOriginOffset(point);
  const glm::vec3 origin = point + gap * frame[2];
  std::vector<HemicubeTexel> texels;
  this->Counts->Triangles +=
    this->Picture->Draw(origin, frame, ShareOfGap * gap, this->GetReach(), texels);
  ++this->Counts->Pictures;

  const Hemicube::Cells& cells = this->CellsOf(grid);
  const Patches patches =
    FindFragments(this->Cube, cells, this->Bundles, texels, this->GetFalloff());
  std::vector<Ray> rays;
  std::vector<Hit> hits;
  for (const CellFragment& patch : patches.All)
  {
    const glm::vec3 along = frame * this->Cube.GetDirections()[patch.Texel];
    const float length = glm::length(along);
    rays.push_back({ origin, along / length });
    Hit hit;
    if (patch.Surface != Hit::None)
    {
      const HemicubeTexel& texel = texels[patch.Texel];
      hit = HitOf(this->Seen.GetRays().GetScene(), this->Bundles, texel, rays.back());
      hit.Distance = texel.Depth * length;
      hit.NextNear = hit.Distance * (1.f + DepthError);
    }
    hits.push_back(hit);
  }
  std::vector<HemisphereSample> seen;
  const long long traced = this->Seen.ShadeHits(point, frame[2], rays, hits, seen);

  directions.clear();
  sights.clear();
  for (int cell = 0; cell < grid.Cells(); ++cell)
  {
    const glm::vec2 at(cell % grid.Side, cell / grid.Side);
    const glm::vec2 middle = (at + .5f) / static_cast<float>(grid.Side);
    directions.push_back(DiskToHemisphere(SampleUniformDiskConcentric(middle.x, middle.y)));
    sights.push_back(CombineFragments(patches, cell, seen));
    // Of m x m texels that a straight border cuts, as of rays: m^-3.
    const auto parts = static_cast<float>(cells.First[cell + 1] - cells.First[cell]);
    sights.back().Variance = 1.f / (parts * std::sqrt(parts));
  }
  return traced;
}

}
