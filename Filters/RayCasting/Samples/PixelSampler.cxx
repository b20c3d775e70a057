// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PixelSampler.h"

#include "Pixels/CoverageConstants.h"
#include "Pixels/PixelErrors.h"
#include "Shading/OwenSobolSequence.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

/// Calls visit(difference) with the differences between samples that share congruent cells of the
/// pixel, unless they are 0.
template <typename Visit>
void VisitPairDifferences(const SampledPixel& pixel, const Visit& visit)
{
  const auto count = static_cast<std::uint32_t>(pixel.GetNumberOfSamples());
  const std::uint32_t partner = OwenSobolSequence::FindPartner(count);
  for (std::uint32_t i = 0; i < count; ++i)
  {
    if (pixel.Source != SampleSource::Triangles)
    {
      visit(glm::dvec3(pixel.Samples[i]) - glm::dvec3(pixel.Samples[i ^ partner]));
    }
    else if (pixel.SampleColors[i] != pixel.SampleColors[i ^ partner])
    {
      visit(glm::dvec3(pixel.TriangleColors[pixel.SampleColors[i]].Color) -
        glm::dvec3(pixel.TriangleColors[pixel.SampleColors[i ^ partner]].Color));
    }
  }
}

/// Returns the estimated variance of the mean of the samples, averaged over the color components.
/// The samples are the first 2^k points of a (0, 2)-sequence. Pairs of samples share congruent
/// cells of the pixel, and their differences estimate the variance that stratification leaves.
double EstimateVariance(const SampledPixel& pixel)
{
  double sum = 0.0;
  VisitPairDifferences(pixel, [&](const glm::dvec3& d) { sum += glm::dot(d, d); });
  const auto n = static_cast<double>(pixel.GetNumberOfSamples());
  return 0.5 * sum / (3.0 * n * n);
}

glm::dvec4 ComputeMeanOfSamples(const SampledPixel& pixel)
{
  glm::dvec4 sum(0.0);
  for (const glm::vec4& sample : pixel.Samples)
  {
    sum += glm::dvec4(sample);
  }
  for (const PixelTriangleColor& triangle : pixel.TriangleColors)
  {
    sum += static_cast<double>(triangle.Count) * glm::dvec4(triangle.Color);
  }
  return sum / static_cast<double>(pixel.GetNumberOfSamples());
}

}

PixelSampler::PixelSampler(PixelContext& pixel, PixelEdges& edges, const TileGeometry& tile)
  : Pixel(pixel),
    Edges(edges),
    Rasterizer(tile.Rasterizer),
    IsExactCostly(tile.AreEdgesLeftOut)
{
  if (this->Rasterizer)
  {
    this->Rasterized.emplace(pixel, *this->Rasterizer);
    this->Layers.emplace(pixel, *this->Rasterizer);
  }
}

SampledPixel& PixelSampler::AddPixel()
{
  SampledPixel& pixel = this->Sampled.emplace_back();
  pixel.X = this->Pixel.Position.x;
  pixel.Y = this->Pixel.Position.y;
  pixel.MediumError = this->Pixel.MediumError;
  pixel.Noise = this->Pixel.Noise;
  pixel.MinimumError = ErrorFloor;
  return pixel;
}

PixelResult PixelSampler::Sample(SampleSource source)
{
  SampledPixel& pixel = this->AddPixel();
  pixel.Floor = HiddenError;
  pixel.Source = source;
  this->Refine(pixel);
  return pixel.Result;
}

// The first estimate needs few rays: the mean of the corners, or one ray per face.
std::optional<PixelResult> PixelSampler::SampleFaces(bool isUnknown)
{
  if (this->Edges.Segments.empty())
  {
    this->Pixel.RetraceCornersOnEdges();
    const bool agree = this->Pixel.CornersAgree() || this->Pixel.RetraceIsolatedMiss();
    SampledPixel& pixel = this->AddPixel();
    if (agree && !isUnknown && !this->Pixel.IsIsolated())
    {
      pixel.Result.Color = ComputeMean(this->Pixel.Corners);
      this->Pixel.SetErrors(
        CurvatureSafetyFactor * this->Pixel.EstimateCurvatureError(), ErrorFloor, pixel.Result);
    }
    else
    {
      this->Refine(pixel);
    }
    return pixel.Result;
  }
  if (!this->BuildFaces())
  {
    return std::nullopt;
  }
  SampledPixel& pixel = this->AddPixel();
  pixel.MinimumError = EdgeErrorFloor;
  this->ComputeFaceColors(pixel);
  if (isUnknown)
  {
    this->Refine(pixel);
  }
  return pixel.Result;
}

// Arranges the edges of the pixel. Returns false if this costs more than samples.
bool PixelSampler::BuildFaces()
{
  const auto budget =
    static_cast<std::size_t>(ComputeMaximumSamples(this->Pixel.Settings.Tolerance));
  return this->Arrangement.Build(this->Edges.Segments.data(),
    static_cast<int>(this->Edges.Segments.size()), { budget, budget * TrapezoidsPerRay });
}

void PixelSampler::ComputeFaceColors(SampledPixel& pixel)
{
  const std::vector<PixelArrangement::Face>& faces = this->Arrangement.GetFaces();
  float squares = 0.f;
  for (const PixelArrangement::Face& face : faces)
  {
    pixel.FaceColors.emplace_back(0.f);
    if (face.Area < MinimumFaceArea)
    {
      continue;
    }
    const penumbra::Sample sample = this->Pixel.Trace(face.Point, face.Area);
    const unsigned int inside = face.Corners & this->Pixel.TrustedCorners;
    const float variation =
      inside ? this->Pixel.ComputeVariation(inside, sample) : UnknownVariation;
    const auto area = static_cast<float>(face.Area);
    pixel.FaceColors.back() = sample.Color;
    pixel.MeanOfFaces += area * sample.Color;
    const float error = area * ResidualErrorFraction * variation;
    squares += error * error;
  }
  pixel.Result.Color = pixel.MeanOfFaces;
  this->Pixel.SetErrors(std::sqrt(squares), pixel.MinimumError, pixel.Result);
}

void PixelSampler::Refine(SampledPixel& pixel)
{
  const std::size_t before = pixel.GetNumberOfSamples();
  const std::size_t first = pixel.Source == SampleSource::Layers ? SamplePoints::MinimumCount
    : pixel.Source == SampleSource::Triangles
    ? ComputeFirstRasterizedSamples(this->Pixel.Settings.Tolerance)
    : MinimumSamples;
  const std::size_t total = std::max<std::size_t>(2 * before, first);
  if (pixel.Source == SampleSource::Rays)
  {
    this->TraceSamples(pixel, total);
  }
  else if (pixel.Source == SampleSource::LitRays)
  {
    this->TraceLitSamples(pixel, total);
  }
  else
  {
    this->Rasterizer->SelectPixel({ pixel.X, pixel.Y });
    pixel.Source == SampleSource::Triangles ? this->Rasterized->AddSamples(pixel, total)
                                            : this->Layers->AddSamples(pixel, total);
  }
  this->Pixel.Noise = pixel.Noise;

  pixel.Result.Color = pixel.MeanOfFaces + glm::vec4(ComputeMeanOfSamples(pixel));
  const bool isBlended = pixel.Source == SampleSource::Layers && pixel.Textures.empty() &&
    !this->Pixel.Tracer.HasLayerOrder();
  const float confidence = isBlended                            ? LayerConfidenceFactor
    : this->IsExactCostly && pixel.Source == SampleSource::Rays ? DenseConfidenceFactor
                                                                : ConfidenceFactor;
  this->Pixel.SetErrors(confidence * static_cast<float>(std::sqrt(EstimateVariance(pixel))),
    std::max(pixel.MinimumError, pixel.Floor / static_cast<float>(total)), pixel.Result);
}

/// Traces camera rays up to `total` samples. trace(first, points) adds the samples of the packet whose first one has
/// the index `first`.
template <typename Trace>
void PixelSampler::TracePackets(SampledPixel& pixel, std::size_t total, const Trace& trace)
{
  const std::size_t before = pixel.Samples.size();
  const OwenSobolSequence sequence(pixel.GetSeed());
  glm::dvec2 points[CameraRayTracer::PacketSize];
  pixel.Samples.reserve(total);
  while (pixel.Samples.size() < total)
  {
    const auto first = static_cast<std::uint32_t>(pixel.Samples.size());
    for (int i = 0; i < CameraRayTracer::PacketSize; ++i)
    {
      points[i] = glm::dvec2(pixel.X, pixel.Y) + SampleInset +
        (1.0 - 2.0 * SampleInset) * glm::dvec2(sequence.At(first + i));
    }
    trace(first, points);
  }
  this->Pixel.Rays.Refinement += static_cast<long long>(total - before);
  pixel.Rays += static_cast<long long>(total - before);
}

void PixelSampler::TraceLitSamples(SampledPixel& pixel, std::size_t total)
{
  this->Lit.Occlusion = pixel.Occlusion;
  this->Lit.Surfaces = pixel.Surfaces;
  this->TracePackets(pixel, total, [&](std::uint32_t first, const glm::dvec2* points) {
    this->Pixel.Settings.Light->TraceSamples(
      pixel.GetSeed(), first, points, this->Lit, this->Pixel.Rays);
    for (const penumbra::Sample& sample : this->Lit.Samples)
    {
      pixel.Samples.push_back(sample.Color);
    }
  });
  pixel.Occlusion = this->Lit.Occlusion;
  pixel.Surfaces = this->Lit.Surfaces;
  pixel.Result.Occlusion =
    pixel.Surfaces > 0 ? pixel.Occlusion / static_cast<float>(pixel.Surfaces) : 0.f;
}

void PixelSampler::TraceSamples(SampledPixel& pixel, std::size_t total)
{
  const bool hasFaces = !pixel.FaceColors.empty();
  if (hasFaces)
  {
    this->Pixel.Load({ pixel.X, pixel.Y });
    this->Edges.Begin();
    this->Edges.Load(true);
    this->BuildFaces();
  }
  this->Pixel.ForgetNeighbors();
  const double toleranceScale = ComputeToleranceScale(1.0 / static_cast<double>(total));
  penumbra::Sample samples[CameraRayTracer::PacketSize];
  this->TracePackets(pixel, total, [&](std::uint32_t, const glm::dvec2* points) {
    const std::uint32_t penumbrae = this->Pixel.Grid.GetPenumbrae(glm::dvec2(pixel.X, pixel.Y));
    this->Pixel.Tracer.TracePacket(points, 0xffffu, samples, this->Pixel.Rays, toleranceScale,
      penumbrae, this->Pixel.GetNeighbors(penumbrae));
    for (int i = 0; i < CameraRayTracer::PacketSize; ++i)
    {
      const glm::vec4 expected = hasFaces
        ? pixel.FaceColors[this->Arrangement.FindFaceAt(points[i] - glm::dvec2(pixel.X, pixel.Y))]
        : glm::vec4(0.f);
      pixel.Samples.push_back(samples[i].Color - expected);
    }
  });
}

}
