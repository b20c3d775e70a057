// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleBins.h"

#include "Sampling/LayerOrder.h"
#include "Scene.h"
#include "ScreenTriangle.h"
#include "Surface.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace penumbra
{

namespace
{

// Distance in pixels up to which a triangle outside a tile is also binned into it.
constexpr double Margin = 2e-3;

/// `ordered`: the order of drawing decides what is visible, so that opaque surfaces may hide nothing.
TriangleBins::Visibility FindVisibility(const Surface& surface, bool ordered)
{
  using Visibility = TriangleBins::Visibility;
  if (surface.ColorTexture || surface.BaseColorTexture || surface.DetailTextures ||
    (surface.LitTexture && !surface.TextureOnBackfaces))
  {
    return Visibility::Rays;
  }
  return ordered || surface.IsTranslucent() || surface.IsAdditive ? Visibility::Layers
    : surface.LitTexture                                          ? Visibility::Textured
                                                                  : Visibility::Nearest;
}

/// The triangles of all surfaces that are binned, one after the other.
class TriangleSequence
{
public:
  explicit TriangleSequence(const std::vector<Surface>& surfaces)
    : Surfaces(surfaces)
  {
    for (const Surface& surface : surfaces)
    {
      const bool isBinned = !surface.IsRound() && !surface.Instances;
      this->Begin.push_back(this->Begin.back() + (isBinned ? surface.Triangles.size() : 0));
    }
  }

  std::size_t GetCount() const { return this->Begin.back(); }

  /// Calls visit(id, points) for the triangles in [first, last).
  template <typename Visit>
  void VisitRange(std::size_t first, std::size_t last, const Visit& visit) const
  {
    auto surface = static_cast<std::uint32_t>(
      std::upper_bound(this->Begin.begin(), this->Begin.end(), first) - this->Begin.begin() - 1);
    for (std::size_t at = first; at < last; ++surface)
    {
      for (; at < std::min(last, this->Begin[surface + 1]); ++at)
      {
        const auto triangle = static_cast<std::uint32_t>(at - this->Begin[surface]);
        visit(PrimitiveId{ surface, triangle }, this->Surfaces[surface].GetPoints(triangle));
      }
    }
  }

private:
  const std::vector<Surface>& Surfaces;
  std::vector<std::size_t> Begin{ 0 };
};

}

TriangleBins::TriangleBins(
  const Scene& scene, const TileGrid& tiles, const std::vector<char>& selected)
{
  if (std::find_if(selected.begin(), selected.end(), [](char c) { return c != 0; }) ==
    selected.end())
  {
    return;
  }
  const bool ordered = !LayerOrder::FindKinds(scene.Surfaces).empty();
  std::transform(scene.Surfaces.begin(), scene.Surfaces.end(), std::back_inserter(this->BySurface),
    [=](const Surface& surface) { return FindVisibility(surface, ordered); });
  const TriangleSequence triangles(scene.Surfaces);
  this->Triangles.Fill(triangles.GetCount(), selected.size(),
    [&](std::size_t first, std::size_t last, const auto& add) {
      triangles.VisitRange(
        first, last, [&](PrimitiveId id, const std::array<glm::vec3, 3>& points) {
          VisitCells(ScreenTriangle(points, scene.ViewCamera), Margin, tiles.Origin, tiles.Side,
            tiles.Count, [&](int tile) {
              if (selected[tile])
              {
                add(tile, id);
              }
            });
        });
    });
}

}
