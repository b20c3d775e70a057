// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RegionRenderer.h"

#include "Pixels/CoverageConstants.h"
#include "Pixels/PixelErrors.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numeric>
#include <utility>

namespace penumbra
{

namespace
{

/// Minimum estimated error of the mean of four corners of which nothing else is known.
constexpr float CornerErrorFloor = 1e-3f;

/// Returns the squared estimated error of a tile.
double SumSquares(const ImageRegion& region, const RegionTiles::Rectangle& pixels)
{
  double sum = 0.0;
  for (int y = pixels.Low.y; y < pixels.High.y; ++y)
  {
    for (int x = pixels.Low.x; x < pixels.High.x; ++x)
    {
      const double error = region.Errors[region.Index(x, y)];
      sum += error * error;
    }
  }
  return sum;
}

/// Multiplies the color of a pixel by a factor of its light.
void Apply(const LightField::Change& change, std::size_t index, ImageRegion& region)
{
  glm::vec4& color = region.Colors[index];
  const glm::vec3& factor = change.Factor;
  color = glm::vec4(glm::max(factor * glm::vec3(color) + change.Offset, glm::vec3(0.f)), color.a);
  const float scale = std::max({ 1.f, factor.r, factor.g, factor.b }); // of other errors
  region.Errors[index] = std::hypot(scale * region.Errors[index], change.Error);
  region.LightErrors[index] = std::hypot(scale * region.LightErrors[index], change.Error);
}

}

RegionRenderer::RegionRenderer(const CameraRayTracer& tracer, const SceneEdges& sceneEdges,
  const RenderSettings& settings, glm::ivec2 low, glm::ivec2 high)
  : Tracer(tracer),
    Edges(sceneEdges),
    Settings(settings),
    UsesCorners(settings.Integration.Method != CoverageMethods::Uniform),
    PixelsOfCorners(RegionTiles::FindPixelsOfCorners(tracer.GetScene(), low, high)),
    Ends(!settings.Light ? Schedule{ 0.4, 0.4, 1.0 } : Schedule{ 0.16, 0.28, 0.52 }),
    Grid(PixelsOfCorners.Low, PixelsOfCorners.High, UsesCorners, tracer.GetShading().HasPenumbrae())
{
  this->Grid.SetCountedPixels(low, high);
  this->Region.Low = low;
  this->Region.High = high;
  const std::size_t pixels = static_cast<std::size_t>(high.x - low.x) * (high.y - low.y);
  this->Region.Colors.resize(pixels);
  this->Region.Errors.resize(pixels);
  this->Region.LightErrors.resize(settings.HasLightErrors() ? pixels : 0);
  this->Region.RaysPerPixel.resize(pixels);
  this->Region.Occlusions.resize(settings.KeepsOcclusion ? pixels : 0);
  this->Traced.assign(UsesCorners ? this->Grid.GetNumberOfStrips() : 0, 0);
  this->Resolved.assign(tracer.GetShading().HasPenumbrae() ? this->Traced.size() : 0, 0);
  if (settings.Light)
  {
    this->Field = LightField::Make(tracer, *settings.Light, low, high);
    this->Settings.Integration.Light = this->Field.get();
  }
}

RegionRenderer::~RegionRenderer() = default;

bool RegionRenderer::Run(const ProgressCallback& progress)
{
  WorkLimit* const limit = this->Settings.Limit;
  if (limit && !this->Coarse)
  {
    this->Coarse = std::make_unique<CoarseImage>(this->Tracer, this->Settings.Light.get(),
      this->Region.Low, this->Region.High, progress, this->Region.Rays);
  }
  if (!this->AreCornersComplete)
  {
    this->AreCornersComplete = this->TraceCorners(progress) && this->ResolvePenumbrae(progress);
    if (limit)
    {
      this->FillPixels();
    }
  }
  return this->AreCornersComplete &&
    (!this->Field ||
      this->Field->FindSites(
        limit, this->Ends.Corners, this->Ends.Sites, progress, this->Region.Rays)) &&
    this->RenderTiles(progress) &&
    (!this->Field ||
      this->Field->AddRounds(limit, this->Ends.Tiles, 1.0, progress, this->Region.Rays));
}

template <typename Work>
bool RegionRenderer::ForStrips(
  std::vector<char>& done, double from, const ProgressCallback& progress, const Work& work)
{
  std::mutex totals;
  std::atomic<bool> finished{ true };
  const auto visit = [&](int strip) {
    if (done[strip])
    {
      return;
    }
    if (IsReached(this->Settings.Limit))
    {
      finished = false;
      return;
    }
    RayCounts counts;
    work(strip, counts);
    done[strip] = 1;
    const std::lock_guard<std::mutex> lock(totals);
    this->Region.Rays += counts;
  };
  if (!ParallelForWithProgress(
        static_cast<int>(done.size()), from, this->Ends.Corners, progress, visit))
  {
    throw Stopped();
  }
  return finished;
}

bool RegionRenderer::TraceCorners(const ProgressCallback& progress)
{
  return !this->UsesCorners ||
    this->ForStrips(this->Traced, 0.0, progress, [&](int strip, RayCounts& counts) {
      this->Grid.TraceStrip(this->Tracer, strip, this->Settings.UsePackets, counts);
    });
}

bool RegionRenderer::ResolvePenumbrae(const ProgressCallback& progress)
{
  if (this->Resolved.empty())
  {
    return true;
  }
  this->Grid.FindPenumbrae();
  return this->ForStrips(
    this->Resolved, this->Ends.Corners, progress, [&](int strip, RayCounts& counts) {
      this->Grid.ResolvePenumbrae(this->Tracer, strip, this->Settings.UsePackets, counts);
    });
}

// With a limit, the tiles with the largest errors come first.
void RegionRenderer::BeginTiles(const ProgressCallback& progress)
{
  if (this->Settings.UpdateEdges)
  {
    this->Settings.UpdateEdges();
  }
  this->Tiles = std::make_unique<RegionTiles>(this->Tracer, this->Grid, this->Edges, this->Settings,
    this->Region, progress, this->Ends.Sites);
  const int count = this->Tiles->GetCount();
  this->Order.resize(count);
  std::iota(this->Order.begin(), this->Order.end(), 0);
  std::vector<double> squares;
  for (int tile = 0; tile < count; ++tile)
  {
    const RegionTiles::Rectangle pixels = this->Tiles->GetPixels(tile);
    this->Unfinished.push_back(pixels.GetArea());
    squares.push_back(SumSquares(this->Region, pixels));
  }
  this->Region.Edges = this->Tiles->GetNumberOfEdges();
  std::stable_sort(
    this->Order.begin(), this->Order.end(), [&](int a, int b) { return squares[a] > squares[b]; });
}

bool RegionRenderer::RenderTiles(const ProgressCallback& progress)
{
  if (!this->Tiles)
  {
    if (IsReached(this->Settings.Limit))
    {
      return false;
    }
    this->BeginTiles(progress);
  }
  std::mutex totals;
  std::atomic<bool> finished{ true };
  const auto visit = [&](int i) {
    const int tile = this->Order[i];
    if (this->Unfinished[tile] == 0)
    {
      return;
    }
    if (IsReached(this->Settings.Limit))
    {
      finished = false;
      return;
    }
    RegionTiles::Totals own;
    this->Unfinished[tile] = this->Tiles->Render(tile, this->Region, own);
    finished = finished && this->Unfinished[tile] == 0;
    const std::lock_guard<std::mutex> lock(totals);
    this->Region.Edges += own.Edges;
    this->Region.Rays += own.Rays;
    this->Region.Pixels += own.Pixels;
  };
  const double from = this->Ends.Sites + (this->UsesCorners ? 0.05 : 0.0);
  if (!ParallelForWithProgress(this->Tiles->GetCount(), from, this->Ends.Tiles, progress, visit))
  {
    throw Stopped();
  }
  return finished;
}

bool RegionRenderer::HasCorners(int x, int y) const
{
  return this->AreCornersComplete ||
    (this->UsesCorners && this->Traced[this->Grid.GetStrip(x, y)] &&
      this->Traced[this->Grid.GetStrip(x + 1, y)] && this->Traced[this->Grid.GetStrip(x, y + 1)] &&
      this->Traced[this->Grid.GetStrip(x + 1, y + 1)]);
}

void RegionRenderer::FillPixels()
{
  ParallelFor(this->Region.Low.y, this->Region.High.y, 0, [&](int y) {
    for (int x = this->Region.Low.x; x < this->Region.High.x; ++x)
    {
      this->FillPixel(x, y);
    }
  });
}

void RegionRenderer::FillPixel(int x, int y)
{
  PixelResult result;
  float mediumError = 0.f;
  if (this->UsesCorners && this->HasCorners(x, y))
  {
    Sample corners[4];
    float noise = 0.f;
    for (int i = 0; i < 4; ++i)
    {
      corners[i] = this->Grid.At(x + (i & 1), y + (i >> 1));
      noise = std::max(noise, corners[i].Noise);
      mediumError = std::max(mediumError, corners[i].Error);
    }
    result.Color = ComputeMean(corners);
    result.LightError =
      0.5f * std::hypot(noise, static_cast<float>(this->Settings.Integration.Noise));
    result.Error = std::hypot(
      std::max(ContrastError * ComputeContrast(corners), CornerErrorFloor), result.LightError);
  }
  else
  {
    const CoarseImage::Value value = this->Coarse->At(x, y);
    result.Color = value.Color;
    result.Error = value.Error;
  }
  StorePixel(result, mediumError, this->Region.Index(x, y), this->Region);
}

ImageRegion RegionRenderer::CopyResult() const
{
  ImageRegion region = this->Region;
  this->Complete(region);
  return region;
}

ImageRegion RegionRenderer::TakeResult()
{
  ImageRegion region = std::move(this->Region);
  this->Complete(region);
  return region;
}

// Applies the changes by the light.
void RegionRenderer::Complete(ImageRegion& region) const
{
  region.Unfinished = this->Tiles
    ? std::accumulate(this->Unfinished.begin(), this->Unfinished.end(), 0LL)
    : static_cast<long long>(region.Colors.size());
  if (!this->Field)
  {
    return;
  }
  ParallelFor(region.Low.y, region.High.y, 0, [&](int y) {
    for (int x = region.Low.x; x < region.High.x; ++x)
    {
      const std::size_t index = region.Index(x, y);
      const bool isSampled = this->Field->HasSites() && this->Field->LightsSamples({ x, y });
      if (isSampled && region.RaysPerPixel[index] > 0.f)
      {
        continue; // with light
      }
      if (this->Field->HasSites() && !isSampled)
      {
        Apply(this->Field->At(x, y), index, region);
      }
      else
      {
        const CoarseImage::Value value = this->Coarse->At(x, y);
        Apply(value.FindChange(region.Colors[index], region.Errors[index]), index, region);
      }
      if (!region.Occlusions.empty())
      {
        region.Occlusions[index] = this->Field->HasSites() && !isSampled
          ? this->Field->GetMeanOcclusion(x, y)
          : this->Coarse->At(x, y).Occlusion;
      }
    }
  });
}

}
