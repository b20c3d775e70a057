// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Exact coverage in PixelIntegrator: projected edges and intersections of triangles cut the pixel
// into faces, and each face shows one surface.
#include "PixelIntegrator.h"
#include "Scene.h"
#include "Surface.h"

#include "Edges/RoundOutlines.h"
#include "PixelErrors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

namespace
{

/// Returns the distance of p to the segment from a to b.
double ComputeDistanceToSegment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b)
{
  const glm::dvec2 d = b - a;
  const double square = glm::dot(d, d);
  const double u = square > 0.0 ? glm::clamp(glm::dot(p - a, d) / square, 0.0, 1.0) : 0.0;
  return glm::distance(p, a + u * d);
}

}

// Returns the maximum depth in this pixel of the opaque surface that a sample hit.
double PixelIntegrator::MaximumOpaqueDepth(const Sample& sample) const
{
  if (!(sample.OpaqueDepth < std::numeric_limits<float>::infinity()))
  {
    return std::numeric_limits<double>::infinity();
  }
  if (sample.OpaqueDepth != sample.FirstHit.Distance)
  {
    return sample.OpaqueDepth +
      this->Tracer.GetScene().ViewCamera.DepthOfRayOrigins(); // behind something translucent
  }
  return MaximumDepthInPixel(this->Tracer.GetScene(),
    { sample.FirstHit.Surface, sample.FirstHit.Primitive }, glm::dvec2(this->X, this->Y));
}

// Returns the smallest depth that is behind `depth` in spite of rounding.
double PixelIntegrator::ComputeDepthBehind(double depth) const
{
  return depth +
    RelativeDepthTolerance *
    std::abs(depth - this->Tracer.GetScene().ViewCamera.DepthOfRayOrigins());
}

void PixelIntegrator::UpdateMaximumFaceDepth(const Sample& sample)
{
  if (this->NearestCulledDepth < std::numeric_limits<double>::infinity())
  {
    this->MaximumFaceDepth = std::max(this->MaximumFaceDepth, this->MaximumOpaqueDepth(sample));
  }
}

void PixelIntegrator::LoadSegments(const std::uint32_t* edgeIndices, std::size_t count, bool cull)
{
  this->Segments.clear();
  this->NearestCulledDepth = std::numeric_limits<double>::infinity();

  // An edge behind the opaque surfaces at all four corners is hidden, unless an edge in front of it
  // uncovers it. IntegrateExact() therefore loads the segments again without culling when a face is
  // deeper. In a valley the edge at the bottom is deeper than the corners, but not deeper than the
  // planes of the triangles that meet there. The limit is the maximum depth of these planes.
  double limit = std::numeric_limits<double>::infinity();
  if (cull && count > 0)
  {
    limit = 0.0;
    for (const Sample& corner : this->Corners)
    {
      limit = std::max(limit, this->MaximumOpaqueDepth(corner));
    }
    limit = this->ComputeDepthBehind(limit);
  }

  const bool parallel = this->Tracer.GetScene().ViewCamera.Parallel;
  const glm::dvec2 origin(this->X, this->Y);
  for (std::size_t i = 0; i < count; ++i)
  {
    const ProjectedEdge& edge = this->Edges[edgeIndices[i]];
    PixelSegment segment{ edge.A - origin, edge.B - origin };
    const glm::dvec2 a = segment.A;
    const glm::dvec2 d = segment.B - a;
    const bool inside = ClipToPixel(segment);
    if (inside && limit < std::numeric_limits<double>::infinity())
    {
      const double square = glm::dot(d, d);
      const double slope = edge.DepthB - edge.DepthA;
      const double u = edge.DepthA + slope * (glm::dot(segment.A - a, d) / square);
      const double v = edge.DepthA + slope * (glm::dot(segment.B - a, d) / square);
      const double depth = parallel ? std::min(u, v) : 1.0 / std::max(u, v);
      if (depth > limit)
      {
        this->NearestCulledDepth = std::min(this->NearestCulledDepth, depth);
        this->AddHiddenShape(edge, depth, limit);
        continue;
      }
    }
    for (int corner = 0; corner < 4; ++corner)
    {
      if (ComputeDistanceToSegment(GetCornerOffset(corner), a, a + d) < EdgePrecision)
      {
        this->TrustedCorners &= ~(1u << corner);
      }
    }
    if (inside)
    {
      this->Segments.push_back(segment);
    }
  }
}

// Adds the intersections of the visible triangles to the segments. Returns false if there are no
// new ones.
bool PixelIntegrator::AddIntersectionSegments()
{
  const std::size_t before = this->Segments.size();
  const glm::dvec2 origin(this->X, this->Y);
  const Scene& scene = this->Tracer.GetScene();
  bool found = false;
  for (std::size_t i = this->PairsTested; i < this->VisibleTriangles.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      const PrimitiveId a = this->VisibleTriangles[i];
      const PrimitiveId b = this->VisibleTriangles[j];
      PixelSegment segment;
      if (scene.Surfaces[a.Surface].IsRound() || scene.Surfaces[b.Surface].IsRound())
      {
        IntersectSphere(scene, a, b, origin, this->Segments);
        this->IsTubeIntersected = this->IsTubeIntersected || MayIntersectTube(scene, a, b, origin);
      }
      else if (IntersectTriangles(scene, a, b, origin, segment))
      {
        this->Segments.push_back(segment);
        found = true;
      }
    }
  }
  this->PairsTested = this->VisibleTriangles.size();
  this->HasIntersections = this->HasIntersections || found;
  this->FoundIntersection = this->FoundIntersection || found;
  return this->Segments.size() > before;
}

// Intersects the triangles at the corners. If any intersect, also those at neighboring corners,
// because intersections continue there.
void PixelIntegrator::FindNearbyIntersections()
{
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = 0.0;
  for (const Sample& corner : this->Corners)
  {
    this->AddTriangle(corner);
    nearest = std::min(nearest, static_cast<double>(corner.OpaqueDepth));
    farthest = std::max(farthest, static_cast<double>(corner.OpaqueDepth));
  }
  // Two surfaces at similar depths may intersect even if the triangles at the corners do not.
  const Camera& camera = this->Tracer.GetScene().ViewCamera;
  const double footprint =
    camera.PixelSize * (camera.Parallel ? 1.0 : nearest + camera.DepthOfRayOrigins());
  this->HasIntersections = this->SearchAllPixels ||
    (!this->CornersAgree() && farthest - nearest < TouchingDepth * footprint);
  if (!this->AddIntersectionSegments() && !this->HasIntersections)
  {
    return;
  }
  this->AnyNeighborCorner([this](const Sample& neighbor) {
    this->AddTriangle(neighbor);
    return false;
  });
  this->AddIntersectionSegments();
}

// Returns true if there is an edge between two hits in one face.
bool PixelIntegrator::AreDisconnected(const Hit& a, const Hit& b) const
{
  if (a.Surface != b.Surface || !a.IsHit() || a.Primitive == b.Primitive)
  {
    return a.Surface != b.Surface;
  }
  return this->Tracer.GetShading().IsConstantPerTriangle(a.Surface) &&
    !HaveCommonEdge(
      this->Tracer.GetScene(), { a.Surface, a.Primitive }, { b.Surface, b.Primitive });
}

// Finds triangles that no corner ray hit, in pixels in which surfaces may intersect.
void PixelIntegrator::ProbeLargeTrapezoids()
{
  for (const PixelArrangement::Trapezoid& t : this->Arrangement.GetTrapezoids())
  {
    if (t.Area() < MinimumTrapezoidArea)
    {
      continue;
    }
    for (const glm::dvec2 at : { glm::dvec2(0.2, 0.2), glm::dvec2(0.8, 0.2), glm::dvec2(0.5, 0.8) })
    {
      this->ProbeAt(t.At(at.x, at.y));
    }
  }
}

Hit PixelIntegrator::ProbeAt(glm::dvec2 local)
{
  Sample sample;
  sample.FirstHit = this->Tracer.TraceFirstHit(glm::dvec2(this->X, this->Y) + local);
  ++this->Rays.Refinement;
  this->AddTriangle(sample);
  return sample.FirstHit;
}

// Finds triangles that no corner ray hit, in pixels in which surfaces are known to intersect. If
// two triangles intersect within a face, rays at its extreme points hit different triangles. Faces
// whose hits are disconnected are marked as discontinuous.
void PixelIntegrator::ProbeTrapezoids()
{
  std::vector<FaceProbe>& probes = this->FaceProbes;
  probes.assign(this->Arrangement.GetFaces().size(), FaceProbe());
  for (const PixelArrangement::Trapezoid& t : this->Arrangement.GetTrapezoids())
  {
    for (int corner = 0; corner < 4 && t.Area() > MinimumFaceArea; ++corner)
    {
      const glm::dvec2 at = ProbeInset + (1.0 - 2.0 * ProbeInset) * GetCornerOffset(corner);
      probes[t.Face].Add(t.At(at.x, at.y));
    }
  }
  for (std::size_t i = 0; i < probes.size(); ++i)
  {
    if (this->Arrangement.GetFaces()[i].Area < MinimumProbedFaceArea)
    {
      continue;
    }
    const glm::dvec2* const begin = probes[i].ExtremePoints;
    const Hit first = this->ProbeAt(*begin);
    for (int side = 1; side < FaceProbe::Sides; ++side)
    {
      const glm::dvec2* const at = begin + side;
      if (std::find(begin, at, *at) == at)
      {
        const Hit hit = this->ProbeAt(*at);
        probes[i].IsDiscontinuous = probes[i].IsDiscontinuous || this->AreDisconnected(first, hit);
      }
    }
  }
}

void PixelIntegrator::FaceProbe::Add(glm::dvec2 point)
{
  // Counterclockwise, starting at the left.
  static const glm::dvec2 Directions[Sides] = { { -1.0, 0.0 }, { -1.0, -1.0 }, { 0.0, -1.0 },
    { 1.0, -1.0 }, { 1.0, 0.0 }, { 1.0, 1.0 }, { 0.0, 1.0 }, { -1.0, 1.0 } };
  for (int side = 0; side < Sides; ++side)
  {
    if (this->IsEmpty || glm::dot(point - this->ExtremePoints[side], Directions[side]) > 0.0)
    {
      this->ExtremePoints[side] = point;
    }
  }
  this->IsEmpty = false;
}

// Returns true if the color is constant over the face that contains the sample. A medium makes it
// vary.
bool PixelIntegrator::IsConstant(const Sample& sample) const
{
  return !this->Tracer.HasShafts() && this->IsConstantBehindMedium(sample);
}

bool PixelIntegrator::IsConstantBehindMedium(const Sample& sample) const
{
  return !sample.FirstHit.IsHit() ||
    (!this->Tracer.HasTranslucentSurfaces() && !this->Tracer.UsesIrradianceProvider() &&
      this->Tracer.GetShading().IsConstantPerTriangle(sample.FirstHit.Surface));
}

PixelResult PixelIntegrator::ComputeFaceColor(std::size_t index)
{
  const PixelArrangement::Face face = this->Arrangement.GetFaces()[index];
  const unsigned int inside = face.Corners & this->TrustedCorners;
  if (!this->FaceProbes.empty() && this->FaceProbes[index].IsDiscontinuous)
  {
    return this->SplitFace(index);
  }
  PixelResult result;
  const Sample* reference = nullptr;
  bool agree = true;
  for (int i = 0; i < 4; ++i)
  {
    if ((inside >> i & 1u) && !this->HasIntersections && this->IsConstant(this->Corners[i]))
    {
      const Sample& corner = this->Corners[i];
      agree = agree &&
        (!reference ||
          (reference->FirstHit.Surface == corner.FirstHit.Surface &&
            ComputeMaximumDifference(reference->Color, corner.Color) <= this->Settings.Tolerance));
      reference = reference ? reference : &corner;
    }
  }
  if (reference && !agree)
  {
    return this->SplitFace(index);
  }
  if (reference)
  {
    this->UpdateMaximumFaceDepth(*reference);
    result.Color = reference->FirstHit.IsHit()
      ? reference->Color
      : this->Tracer.GetBackground(glm::dvec2(this->X, this->Y) + face.Point);
    return result;
  }
  const Sample sample = this->Trace(face.Point, face.Area);
  this->UpdateMaximumFaceDepth(sample);
  this->AddTriangle(sample);
  this->HitsUnsteadyTriangle = this->HitsUnsteadyTriangle || this->IsUnsteady(sample);
  result.Color = sample.Color;
  if (inside == 0u && this->IsConstantBehindMedium(sample))
  {
    return result;
  }
  // The face is one surface, so the differences between its corners and the sample estimate the
  // variation of the color. A face without corners is assumed to vary by UnknownVariation.
  const bool unknown = !inside || this->IsNearShadowBoundary();
  const float variation =
    std::max(unknown ? UnknownVariation : 0.f, this->ComputeVariation(inside, sample));
  const float area = static_cast<float>(face.Area);
  const float limit = static_cast<float>(this->Settings.Tolerance + 2.0 * this->Noise);
  // Occlusion and light shafts are expensive and rarely discontinuous. With them, a face is not
  // split because of an assumed variation.
  const bool isExpensive = this->Tracer.UsesIrradianceProvider() || this->Tracer.HasShafts();
  const bool skipSplit = unknown && isExpensive && variation <= UnknownVariation;
  if (variation * area > limit && !skipSplit)
  {
    return this->SplitFace(index);
  }
  result.Error = ResidualErrorFraction * variation;
  return result;
}

// Subdivides the trapezoids of a face until their samples agree. Used if the color varies
// nonlinearly or is discontinuous within the face, or if surfaces intersect there.
PixelResult PixelIntegrator::SplitFace(std::size_t index)
{
  PixelResult result;
  float area = 0.f;
  float squares = 0.f;
  this->Arrangement.VisitTrapezoids(index, [&](const PixelArrangement::Trapezoid& t) {
    if (t.Area() > MinimumFaceArea)
    {
      const Sample center = this->Trace(t.Centroid(), t.Area());
      this->SplitTrapezoid(t, { 0.0, 0.0 }, 1.0, center, result.Color, squares);
      area += static_cast<float>(t.Area());
    }
  });
  if (!(area > 0.f))
  {
    // All trapezoids are too small. One ray represents them.
    result.Color = this->Trace(this->Arrangement.GetFaces()[index].Point).Color;
    return result;
  }
  result.Color /= area;
  result.Error = std::sqrt(squares) / area;
  return result;
}

void PixelIntegrator::SplitTrapezoid(const PixelArrangement::Trapezoid& t, glm::dvec2 low,
  double side, const Sample& center, glm::vec4& color, float& squaredError)
{
  this->UpdateMaximumFaceDepth(center);
  const double height = 0.5 * (t.Top0 + t.Top1 - t.Bottom0 - t.Bottom1);
  const double slope = (t.Top1 - t.Bottom1) - (t.Top0 - t.Bottom0);
  const auto computeArea = [&](double u, double s) {
    return (t.X1 - t.X0) * s * s * (height + slope * (u + 0.5 * s - 0.5));
  };
  const float area = static_cast<float>(computeArea(low.x, side));
  if (area * UnknownVariation < this->Settings.Tolerance ||
    side < std::ldexp(1.5, -this->Settings.MaximumLevel))
  {
    color += area * center.Color;
    const float error = ResidualErrorFraction * area * UnknownVariation;
    squaredError += error * error;
    return;
  }
  const double half = 0.5 * side;
  Sample quarters[4];
  glm::vec4 sum(0.f);
  bool disconnected = false;
  for (int i = 0; i < 4; ++i)
  {
    const glm::dvec2 at = low + half * GetCornerOffset(i);
    quarters[i] = this->Trace(t.At(at.x + 0.5 * half, at.y + 0.5 * half), 0.25 * area);
    sum += static_cast<float>(computeArea(at.x, half)) * quarters[i].Color;
    disconnected = disconnected || quarters[i].FirstHit.Surface != center.FirstHit.Surface;
  }
  const float deviation = ComputeMaximumDifference(sum, area * center.Color);
  if (!disconnected && deviation < this->Settings.Tolerance + 2.0 * area * this->Noise)
  {
    color += sum;
    squaredError += ResidualErrorFraction * ResidualErrorFraction * deviation * deviation;
    return;
  }
  for (int i = 0; i < 4; ++i)
  {
    this->SplitTrapezoid(
      t, low + half * GetCornerOffset(i), half, quarters[i], color, squaredError);
  }
}

PixelResult PixelIntegrator::IntegrateExact(const std::uint32_t* edgeIndices, std::size_t count)
{
  long long& pixelCount = this->CornersAgree() ? this->Pixels.SmallObject : this->Pixels.Edge;
  ++pixelCount;
  this->FindNearbyIntersections();
  int probePasses = 0;
  // The pixel is sampled as soon as the arrangement costs more than samples of the same accuracy.
  const long long sampleBudget = ComputeMaximumSamples(this->Settings.Tolerance);
  const long long maximumRays = this->Rays.Refinement + sampleBudget;
  const PixelArrangement::Limits limits{ static_cast<std::size_t>(sampleBudget),
    static_cast<std::size_t>(sampleBudget) * TrapezoidsPerRay };
  for (;;)
  {
    // Intersections of tubes are not computed.
    if (this->IsTubeIntersected ||
      !this->Arrangement.Build(
        this->Segments.data(), static_cast<int>(this->Segments.size()), limits))
    {
      --pixelCount;
      return this->IntegrateSampled();
    }
    this->FaceProbes.clear();
    if (this->HasIntersections && probePasses < (this->SearchAllPixels ? MaximumProbePasses : 1))
    {
      ++probePasses;
      this->SearchAllPixels ? this->ProbeTrapezoids() : this->ProbeLargeTrapezoids();
      if (this->AddIntersectionSegments())
      {
        continue;
      }
    }
    this->MaximumFaceDepth = 0.0;
    PixelResult result;
    double covered = 0.0;
    float squares = 0.f;
    const std::size_t faces = this->Arrangement.GetFaces().size();
    for (std::size_t i = 0; i < faces; ++i)
    {
      const double area = this->Arrangement.GetFaces()[i].Area;
      if (area < MinimumFaceArea)
      {
        continue;
      }
      if (this->Rays.Refinement > maximumRays)
      {
        --pixelCount;
        return this->IntegrateSampled();
      }
      const PixelResult face = this->ComputeFaceColor(i);
      if (this->HitsUnsteadyTriangle)
      {
        --pixelCount;
        return this->IntegrateUnsteady();
      }
      const float weight = static_cast<float>(area);
      result.Color += weight * face.Color;
      squares += weight * face.Error * weight * face.Error;
      covered += area;
    }
    if (this->ComputeDepthBehind(this->MaximumFaceDepth) >= this->NearestCulledDepth)
    {
      // An edge that was culled may be visible.
      this->LoadSegments(edgeIndices, count, false);
      this->PairsTested = 0;
      this->AddIntersectionSegments();
      continue;
    }
    if (this->AddIntersectionSegments() || this->IsTubeIntersected)
    {
      continue;
    }
    result.Color /= static_cast<float>(covered);
    this->SetErrors(std::sqrt(squares), EdgeErrorFloor, result);
    return result;
  }
}

}
