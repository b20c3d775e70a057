// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Light/SiteJoining.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

using namespace penumbra;

namespace
{

constexpr int Columns = 13;
constexpr int Rows = 12;

/// Adds rays to the sites of a tile; some turn away from their neighbors, so that the tile gets more patches.
void ChangeTile(SiteGrid<1>& grid, int tile, std::mt19937& random)
{
  std::uniform_real_distribution<float> uniform(0.f, 1.f);
  for (const LightPixel& pixel : grid.Tiles[tile])
  {
    for (std::uint32_t i = pixel.Begin; i < pixel.Begin + pixel.Sites; ++i)
    {
      LightSite<1>& site = grid.Sites[i];
      for (int half = 0; half < Halves; ++half)
      {
        site.Rays[half] = static_cast<std::uint16_t>(site.Rays[half] + 4);
        site.Sums[half] += 4.f * uniform(random);
      }
      if (uniform(random) < 0.1f)
      {
        site.Normal = { 1.f, 0.f, 0.f };
      }
    }
  }
}

/// Pixels of a wavy surface before the background. Some pixels also show a second layer.
SiteGrid<1> MakeGrid(std::mt19937& random)
{
  std::uniform_real_distribution<float> uniform(0.f, 1.f);
  SiteGrid<1> grid;
  grid.High = LightTileSide * glm::ivec2(Columns, Rows);
  grid.Tiles.resize(static_cast<std::size_t>(Columns) * Rows);
  for (int tile = 0; tile < Columns * Rows; ++tile)
  {
    if (tile % 11 == 5)
    {
      continue; // without sites
    }
    grid.Tiles[tile].resize(static_cast<std::size_t>(LightTileSide) * LightTileSide);
    for (int i = 0; i < LightTileSide * LightTileSide; ++i)
    {
      const float x = LightTileSide * (tile % Columns) + i % LightTileSide + 0.5f;
      const float y = LightTileSide * (tile / Columns) + i / LightTileSide + 0.5f;
      LightPixel& pixel = grid.Tiles[tile][i];
      pixel.Begin = static_cast<std::uint32_t>(grid.Sites.size());
      pixel.Sites = uniform(random) < 0.1f ? 2 : 1;
      pixel.IsComplex = pixel.Sites > 1;
      pixel.Samples[0] = pixel.Samples[1] = 4;
      for (int k = 0; k < pixel.Sites; ++k)
      {
        LightSite<1> site;
        site.Position = { x, y, 3.f * std::sin(0.2f * x) - 40.f * static_cast<float>(k) };
        site.Normal = glm::normalize(glm::vec3(-0.6f * std::cos(0.2f * x), 0.f, 1.f));
        site.Layer = static_cast<std::uint16_t>(k);
        site.Footprint = 1.f;
        site.Samples = pixel.IsComplex ? 4.f : 8.f;
        for (int half = 0; half < Halves; ++half)
        {
          site.Rays[half] = 4;
          site.Sums[half] = LightTerms<1>::Value(4.f * uniform(random));
        }
        grid.Sites.push_back(site);
      }
    }
  }
  return grid;
}

/// The estimates of all sites, site by site.
struct Estimates
{
  explicit Estimates(const SiteGrid<1>& grid)
  {
    for (const LightSite<1>& site : grid.Sites)
    {
      const SitePatch<1>& patch = grid.Patches[site.Patch];
      this->Values.push_back(EvaluateSite(grid, site)[0]);
      this->Values.push_back(patch.SquaredError[0]);
      this->Values.push_back(patch.SharedPixels);
    }
  }

  bool Matches(const Estimates& other, std::size_t site) const
  {
    return std::memcmp(&this->Values[3 * site], &other.Values[3 * site], 3 * sizeof(float)) == 0;
  }

  std::vector<float> Values;
};

}

TEST(SiteJoining, UpdatesToTheBitsOfAllTiles)
{
  std::mt19937 random(3);
  SiteGrid<1> grid = MakeGrid(random);
  SiteJoining<1> joining(grid);
  joining.Start();
  const std::vector<std::vector<int>> rounds = { { 70 }, { 0, 12, 40, 41, 155 }, {}, { 70, 71 } };
  for (const std::vector<int>& tiles : rounds)
  {
    for (const int tile : tiles)
    {
      ChangeTile(grid, tile, random);
    }
    joining.Update(tiles);
    SiteGrid<1> all = grid;
    JoinSites(all);
    const Estimates updated(grid);
    const Estimates expected(all);
    std::size_t differing = 0;
    for (std::size_t i = 0; i < grid.Sites.size(); ++i)
    {
      differing += updated.Matches(expected, i) ? 0 : 1;
      EXPECT_TRUE(std::isfinite(updated.Values[3 * i]));
    }
    EXPECT_EQ(differing, 0u);
  }
}

TEST(SiteJoining, ReportsTheTilesWithOtherEstimates)
{
  std::mt19937 random(5);
  SiteGrid<1> grid = MakeGrid(random);
  SiteJoining<1> joining(grid);
  joining.Start();
  const Estimates before(grid);
  ChangeTile(grid, 0, random);
  const std::vector<int> reported = joining.Update({ 0 });
  const Estimates after(grid);
  std::vector<char> flags(grid.Tiles.size(), 0);
  for (const int tile : reported)
  {
    flags[tile] = 1;
  }
  int others = 0;
  for (std::size_t tile = 0; tile < grid.Tiles.size(); ++tile)
  {
    for (const LightPixel& pixel : grid.Tiles[tile])
    {
      for (std::uint32_t i = pixel.Begin; i < pixel.Begin + pixel.Sites; ++i)
      {
        others += before.Matches(after, i) ? 0 : 1;
        EXPECT_TRUE(flags[tile] != 0 || before.Matches(after, i));
      }
    }
  }
  EXPECT_GT(others, 0);
  EXPECT_LE(reported.size(), 25u); // of 156
}
