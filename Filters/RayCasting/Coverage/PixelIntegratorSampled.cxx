// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Sampling in PixelIntegrator: pixels of dense surfaces, and pixels whose exact coverage would cost
// more than samples of the same accuracy. TileRefinement.h decides the number of samples.
#include "PixelIntegrator.h"
#include "Scene.h"
#include "Surface.h"

#include "Edges/UnsteadyNormals.h"
#include "PixelErrors.h"
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
    if (!pixel.IsRasterized)
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

}

bool PixelIntegrator::HitsDenseSurface() const
{
  return !this->Dense.empty() &&
    std::any_of(this->Corners, this->Corners + 4, [this](const Sample& corner) {
      return corner.FirstHit.IsHit() && this->Dense[corner.FirstHit.Surface];
    });
}

// Returns true if the color changes abruptly within the triangle that the sample hit.
bool PixelIntegrator::IsUnsteady(const Sample& sample) const
{
  const Hit& hit = sample.FirstHit;
  if (!hit.IsHit() || this->Unsteady.empty() || !this->Unsteady[hit.Surface])
  {
    return false;
  }
  const Surface& surface = this->Tracer.GetScene().Surfaces[hit.Surface];
  return HasUnsteadyNormal(surface, surface.GetStoredTriangle(hit.Primitive));
}

// Returns true if the corners lie in different texels of a texture, so that colors may change within
// the pixel without an edge of the mesh.
bool PixelIntegrator::IsTextureDiscontinuous() const
{
  const std::vector<Surface>& surfaces = this->Tracer.GetScene().Surfaces;
  for (int side = 0; side < 4; ++side)
  {
    const Hit& a = this->Corners[side == 3 ? 3 : 0].FirstHit;
    const Hit& b = this->Corners[side < 2 ? side + 1 : side == 2 ? 3 : 1].FirstHit;
    if (a.Surface == b.Surface && a.IsHit() && IsInDifferentTexels(surfaces[a.Surface], a, b))
    {
      return true;
    }
  }
  return !this->Segments.empty() && !this->CornersAgree() && this->IsTextureDiscontinuousInPlane();
}

// The same at an outline, where a single corner may be on the surface: compares it with the points at
// which the other corners see the plane of its triangle.
bool PixelIntegrator::IsTextureDiscontinuousInPlane() const
{
  const std::vector<Surface>& surfaces = this->Tracer.GetScene().Surfaces;
  for (int i = 0; i < 4; ++i)
  {
    const Hit& hit = this->Corners[i].FirstHit;
    if (!hit.IsHit() || surfaces[hit.Surface].IsRound())
    {
      continue;
    }
    for (int j = 0; j < 4; ++j)
    {
      Hit other = hit;
      const glm::dvec2 at = glm::dvec2(this->X, this->Y) + GetCornerOffset(j);
      if (j != i && IntersectPlane(surfaces[hit.Surface], this->Tracer.MakeRay(at), other) &&
        IsInDifferentTexels(surfaces[hit.Surface], hit, other))
      {
        return true;
      }
    }
  }
  return false;
}

SampledPixel& PixelIntegrator::AddSampledPixel()
{
  this->Sampled.emplace_back();
  SampledPixel& pixel = this->Sampled.back();
  pixel.X = this->X;
  pixel.Y = this->Y;
  pixel.Edges = this->ListedEdges;
  pixel.NumberOfEdges = this->NumberOfListedEdges;
  pixel.MediumError = this->MediumError;
  pixel.Noise = this->Noise;
  pixel.MinimumError = ErrorFloor;
  return pixel;
}

PixelResult PixelIntegrator::IntegrateSampled()
{
  SampledPixel& pixel = this->AddSampledPixel();
  pixel.Floor = HiddenError;
  const bool isOpaque = this->Rasterizer && this->Rasterizer->SelectPixel({ this->X, this->Y });
  pixel.IsRasterized = isOpaque && this->RasterizesAll;
  pixel.IsLayered = !isOpaque && this->SelectLayers();
  this->Refine(pixel);
  return pixel.Result;
}

// Rays sample the pixel, because a rasterized triangle has only few colors.
PixelResult PixelIntegrator::IntegrateUnsteady()
{
  SampledPixel& pixel = this->AddSampledPixel();
  pixel.Floor = HiddenError;
  this->Refine(pixel);
  return pixel.Result;
}

// The first estimate of a pixel needs few rays: the mean of the corners, or one ray per face. The
// triangles of a dense surface have no edges, so colors vary within faces. `unknown`: the variation
// of the colors is not known from corners and faces.
PixelResult PixelIntegrator::IntegrateDense(bool unknown)
{
  if (this->Segments.empty())
  {
    this->RetraceCornersOnEdges();
    const bool agree = this->CornersAgree() || this->RetraceIsolatedMiss();
    SampledPixel& pixel = this->AddSampledPixel();
    if (agree && !unknown)
    {
      pixel.Result.Color = ComputeMean(this->Corners);
      this->SetErrors(
        CurvatureSafetyFactor * this->EstimateCurvatureError(), ErrorFloor, pixel.Result);
    }
    else
    {
      this->Refine(pixel);
    }
    return pixel.Result;
  }
  if (this->Segments.size() > MaximumEdgesInCrowdedTile || !this->BuildFaces())
  {
    return this->IntegrateSampled();
  }
  SampledPixel& pixel = this->AddSampledPixel();
  pixel.MinimumError = EdgeErrorFloor;
  this->ComputeFaceColors(pixel);
  if (unknown)
  {
    this->Refine(pixel);
  }
  return pixel.Result;
}

// Arranges the edges of the pixel. Returns false if this costs more than samples.
bool PixelIntegrator::BuildFaces()
{
  const auto budget = static_cast<std::size_t>(ComputeMaximumSamples(this->Settings.Tolerance));
  return this->Arrangement.Build(this->Segments.data(), static_cast<int>(this->Segments.size()),
    { budget, budget * TrapezoidsPerRay });
}

void PixelIntegrator::ComputeFaceColors(SampledPixel& pixel)
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
    const Sample sample = this->Trace(face.Point, face.Area);
    const unsigned int inside = face.Corners & this->TrustedCorners;
    const float variation = inside ? this->ComputeVariation(inside, sample) : UnknownVariation;
    const auto area = static_cast<float>(face.Area);
    pixel.FaceColors.back() = sample.Color;
    pixel.MeanOfFaces += area * sample.Color;
    const float error = area * ResidualErrorFraction * variation;
    squares += error * error;
  }
  pixel.Result.Color = pixel.MeanOfFaces;
  this->SetErrors(std::sqrt(squares), pixel.MinimumError, pixel.Result);
}

void PixelIntegrator::Refine(SampledPixel& pixel)
{
  const std::size_t before = pixel.GetNumberOfSamples();
  const std::size_t first = pixel.IsLayered ? SamplePoints::MinimumCount
    : pixel.IsRasterized ? ComputeFirstRasterizedSamples(this->Settings.Tolerance)
                         : MinimumSamples;
  const std::size_t total = std::max<std::size_t>(2 * before, first);
  if (pixel.IsRasterized)
  {
    this->Rasterizer->SelectPixel({ pixel.X, pixel.Y });
    this->RasterizeSamples(pixel, total);
  }
  else if (pixel.IsLayered)
  {
    this->Rasterizer->SelectPixel({ pixel.X, pixel.Y });
    this->RasterizeLayers(pixel, total);
  }
  else
  {
    this->TraceSamples(pixel, total);
  }
  this->Noise = pixel.Noise;

  pixel.Result.Color = pixel.MeanOfFaces + glm::vec4(ComputeMeanOfSamples(pixel));
  const bool isBlended = pixel.IsLayered && pixel.Textures.empty() && !this->Tracer.HasLayerOrder();
  const float confidence = isBlended ? LayerConfidenceFactor : ConfidenceFactor;
  this->SetErrors(confidence * static_cast<float>(std::sqrt(EstimateVariance(pixel))),
    std::max(pixel.MinimumError, pixel.Floor / static_cast<float>(total)), pixel.Result);
}

void PixelIntegrator::TraceSamples(SampledPixel& pixel, std::size_t total)
{
  const std::size_t before = pixel.Samples.size();
  const bool hasFaces = !pixel.FaceColors.empty();
  if (hasFaces)
  {
    this->LoadCorners(pixel.X, pixel.Y);
    this->LoadSegments(pixel.Edges, pixel.NumberOfEdges, true);
    this->BuildFaces();
  }
  this->Neighbors.clear();
  const OwenSobolSequence sequence(static_cast<std::uint32_t>(pixel.X) * 0x9e3779b1u ^
    static_cast<std::uint32_t>(pixel.Y) * 0x85ebca77u);
  const double toleranceScale = ComputeToleranceScale(1.0 / static_cast<double>(total));
  glm::dvec2 points[CameraRayTracer::PacketSize];
  Sample samples[CameraRayTracer::PacketSize];
  pixel.Samples.reserve(total);
  while (pixel.Samples.size() < total)
  {
    for (glm::dvec2& point : points)
    {
      const auto index = static_cast<std::uint32_t>(pixel.Samples.size() + (&point - points));
      point = glm::dvec2(pixel.X, pixel.Y) + SampleInset +
        (1.0 - 2.0 * SampleInset) * glm::dvec2(sequence.At(index));
    }
    const std::uint32_t penumbrae = this->Grid.GetPenumbrae(glm::dvec2(pixel.X, pixel.Y));
    this->Tracer.TracePacket(points, 0xffffu, samples, this->Rays, toleranceScale, penumbrae,
      this->GetNeighbors(penumbrae));
    for (int i = 0; i < CameraRayTracer::PacketSize; ++i)
    {
      const glm::vec4 expected = hasFaces
        ? pixel.FaceColors[this->Arrangement.FindFaceAt(points[i] - glm::dvec2(pixel.X, pixel.Y))]
        : glm::vec4(0.f);
      pixel.Samples.push_back(samples[i].Color - expected);
    }
  }
  this->Rays.Refinement += static_cast<long long>(total - before);
  pixel.Rays += static_cast<long long>(total - before);
}

}
