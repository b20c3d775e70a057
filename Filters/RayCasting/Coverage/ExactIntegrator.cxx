// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ExactIntegrator.h"

#include "Pixels/CoverageConstants.h"
#include "Pixels/PixelErrors.h"
#include "Scene.h"
#include "Surface.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

/// Rank-1 lattices of samples on a face of a small sphere or tube. Measured on parts of lit spheres: the RMS error
/// of the mean of n samples is 0.6 to 1 of their standard deviation, divided by n.
struct RoundLattice
{
  int Count, Generator;
};
constexpr RoundLattice RoundLattices[] = { { 16, 7 }, { 64, 27 }, { 256, 75 } };

/// Error of a lattice over its difference from the one before, with a quarter of the samples: 1/4 if it falls with
/// the number of samples, 1/2 if with its root.
constexpr float LatticeStepFraction = 0.5f;

}

ExactIntegrator::ExactIntegrator(PixelContext& pixel, PixelEdges& edges, const TileGeometry& tile)
  : Pixel(pixel),
    Edges(edges),
    Tile(tile)
{
}

void ExactIntegrator::UpdateMaximumFaceDepth(const Sample& sample)
{
  if (this->Edges.HasHiddenEdges())
  {
    this->MaximumFaceDepth =
      std::max(this->MaximumFaceDepth, this->Edges.MaximumOpaqueDepth(sample));
  }
}

// Returns true if there is an edge between two hits in one face.
bool ExactIntegrator::AreDisconnected(const Hit& a, const Hit& b) const
{
  if (a.Surface != b.Surface || !a.IsHit() || a.Primitive == b.Primitive)
  {
    return a.Surface != b.Surface;
  }
  return this->Pixel.Tracer.GetShading().IsConstantPerTriangle(a.Surface) &&
    !HaveCommonEdge(
      this->Pixel.GetSurfaces(), { a.Surface, a.Primitive }, { b.Surface, b.Primitive });
}

bool ExactIntegrator::AreDisconnected(const VisibleHits& a, const VisibleHits& b) const
{
  for (int i = 0; i < std::min(a.Count, b.Count); ++i)
  {
    if (this->AreDisconnected(a.Layers[i], b.Layers[i]))
    {
      return true;
    }
  }
  return a.Count != b.Count;
}

// Finds triangles that no corner ray hit, in pixels in which surfaces may intersect.
void ExactIntegrator::ProbeLargeTrapezoids()
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

ExactIntegrator::VisibleHits ExactIntegrator::ProbeAt(glm::dvec2 local)
{
  VisibleHits found;
  Ray ray = this->Pixel.Tracer.MakeRay(this->Pixel.GetOrigin() + local);
  for (Hit& hit : found.Layers)
  {
    hit = this->Pixel.Tracer.GetRays().Intersect(ray);
    ++found.Count;
    ++this->Pixel.Rays.Refinement;
    this->Edges.AddPrimitive(hit);
    if (!hit.IsHit() || !this->Pixel.GetSurfaces()[hit.Surface].IsTranslucent())
    {
      break;
    }
    ray = ContinueBehind(ray, hit);
  }
  return found;
}

// Finds triangles that no corner ray hit, in pixels in which surfaces are known to intersect. If
// two triangles intersect within a face, rays at its extreme points hit different triangles. Faces
// whose hits are disconnected are marked as discontinuous.
void ExactIntegrator::ProbeTrapezoids()
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
    const VisibleHits first = this->ProbeAt(*begin);
    for (int side = 1; side < FaceProbe::Sides; ++side)
    {
      const glm::dvec2* const at = begin + side;
      if (std::find(begin, at, *at) == at)
      {
        const VisibleHits hits = this->ProbeAt(*at);
        probes[i].IsDiscontinuous = probes[i].IsDiscontinuous || this->AreDisconnected(first, hits);
      }
    }
  }
}

void ExactIntegrator::FaceProbe::Add(glm::dvec2 point)
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

// The value at the center of a square differs from its mean by 1/24 of its area times the sum of both
// second derivatives. At the middle of a lit sphere, these are 1 over the squared radius.
float ExactIntegrator::ComputeRoundVariation(const Hit& hit, float area) const
{
  if (!hit.IsHit() || !this->Pixel.GetSurfaces()[hit.Surface].IsRound())
  {
    return 0.f;
  }
  const RoundShape shape = this->Pixel.GetSurfaces()[hit.Surface].GetRoundShape(hit.Primitive);
  const double inverse =
    this->Pixel.ComputePixelSize(hit.Distance) / std::max(shape.RadiusA, shape.RadiusB);
  return static_cast<float>(area * inverse * inverse / 12.0);
}

// A sphere whose outline is hidden may emerge from the triangles of a face.
bool ExactIntegrator::ShowsOtherSurface(const PixelArrangement::Face& face, const Hit& expected)
{
  if (!this->Edges.HasRoundShapes || face.Area < MinimumTrapezoidArea || !expected.IsHit() ||
    this->Pixel.Tracer.GetScene().Surfaces[expected.Surface].IsRound())
  {
    return false;
  }
  ++this->Pixel.Rays.Refinement;
  const Hit hit = this->Pixel.Tracer.TraceFirstHit(this->Pixel.GetOrigin() + face.Point);
  this->Edges.AddPrimitive(hit);
  return hit.Surface != expected.Surface;
}

PixelResult ExactIntegrator::ComputeFaceColor(std::size_t index)
{
  const PixelArrangement::Face face = this->Arrangement.GetFaces()[index];
  const unsigned int inside = face.Corners & this->Pixel.TrustedCorners;
  if (!this->FaceProbes.empty() && this->FaceProbes[index].IsDiscontinuous)
  {
    return this->SplitFace(index);
  }
  PixelResult result;
  const Sample* reference = nullptr;
  bool agree = true;
  for (int i = 0; i < 4; ++i)
  {
    if ((inside >> i & 1u) && !this->Edges.MayIntersect &&
      this->Pixel.IsConstant(this->Pixel.Corners[i].FirstHit))
    {
      const Sample& corner = this->Pixel.Corners[i];
      agree = agree &&
        (!reference ||
          (reference->FirstHit.Surface == corner.FirstHit.Surface &&
            ComputeMaximumDifference(reference->Color, corner.Color) <=
              this->Pixel.Settings.Tolerance));
      reference = reference ? reference : &corner;
    }
  }
  if (reference && (!agree || this->ShowsOtherSurface(face, reference->FirstHit)))
  {
    return this->SplitFace(index);
  }
  if (reference)
  {
    this->UpdateMaximumFaceDepth(*reference);
    result.Color = reference->FirstHit.IsHit()
      ? reference->Color
      : this->Pixel.Tracer.GetBackground(this->Pixel.GetOrigin() + face.Point);
    return result;
  }
  const Sample sample = this->Pixel.Trace(face.Point, face.Area);
  this->UpdateMaximumFaceDepth(sample);
  this->Edges.AddPrimitive(sample.FirstHit);
  this->Pixel.LeastSteady = std::max(
    this->Pixel.LeastSteady, this->Tile.FindSteadiness(this->Pixel.Tracer, sample.FirstHit));
  result.Color = sample.Color;
  if (inside == 0u && this->Pixel.IsConstantBehindMedium(sample.FirstHit))
  {
    return result;
  }
  // The face is one surface, so the differences between its corners and the sample estimate the
  // variation of the color. A face without corners is assumed to vary by UnknownVariation.
  const bool unknown = !inside || this->Pixel.IsNearShadowBoundary();
  const float area = static_cast<float>(face.Area);
  const float roundVariation = this->ComputeRoundVariation(sample.FirstHit, area);
  const float variation = std::max({ unknown ? UnknownVariation : 0.f,
    this->Pixel.ComputeVariation(inside, sample), roundVariation });
  const float limit = static_cast<float>(this->Pixel.Settings.Tolerance + 2.0 * this->Pixel.Noise);
  // Occlusion and light shafts are expensive and rarely discontinuous. With them, a face is not
  // split because of an assumed variation.
  const bool isExpensive =
    this->Pixel.Tracer.UsesIrradianceProvider() || this->Pixel.Tracer.HasShafts();
  const bool skipSplit = unknown && isExpensive && variation <= UnknownVariation;
  if (variation * area > limit && !skipSplit)
  {
    return roundVariation * area > limit ? this->SampleRoundFace(index) : this->SplitFace(index);
  }
  result.Error = ResidualErrorFraction * variation;
  return result;
}

// The trapezoids of a face of a sphere reach from outline to outline, and the color decreases toward it:
// their centers are all too bright. So samples are spread over the face as a whole.
PixelResult ExactIntegrator::SampleRoundFace(std::size_t index)
{
  std::vector<PixelArrangement::Trapezoid> trapezoids;
  std::vector<double> sums; // of areas
  this->Arrangement.VisitTrapezoids(index, [&](const PixelArrangement::Trapezoid& t) {
    trapezoids.push_back(t);
    sums.push_back((sums.empty() ? 0.0 : sums.back()) + t.Area());
  });
  const double area = sums.back();
  const auto trace = [&](double u, double v, double part) {
    const auto at = std::min(std::lower_bound(sums.begin(), sums.end(), u * area), sums.end() - 1);
    const auto k = static_cast<std::size_t>(at - sums.begin());
    const double before = k > 0 ? sums[k - 1] : 0.0;
    const double x = (u * area - before) / (sums[k] - before);
    return this->Pixel.Trace(trapezoids[k].At(glm::clamp(x, 0.0, 1.0), v), part);
  };
  PixelResult result;
  const float limit = static_cast<float>(this->Pixel.Settings.Tolerance + 2.0 * this->Pixel.Noise);
  for (const RoundLattice& lattice : RoundLattices)
  {
    const glm::vec4 before = result.Color;
    const bool isFirst = &lattice == RoundLattices;
    const double weight = 1.0 / lattice.Count;
    glm::vec4 sum(0.f);
    glm::vec4 squares(0.f);
    for (int i = 0; i < lattice.Count; ++i)
    {
      const Sample sample = trace(
        (i + 0.5) * weight, glm::fract((i * lattice.Generator + 0.5) * weight), area * weight);
      this->UpdateMaximumFaceDepth(sample);
      sum += sample.Color;
      squares += sample.Color * sample.Color;
    }
    const auto part = static_cast<float>(weight);
    const glm::vec4 variance = glm::max(part * squares - part * sum * part * sum, 0.f);
    result.Color = part * sum;
    // Highlights and shadows converge more slowly than smooth colors.
    result.Error = std::max(part * ComputeMaximumDifference(glm::sqrt(variance), glm::vec4(0.f)),
      isFirst ? 0.f : LatticeStepFraction * ComputeMaximumDifference(result.Color, before));
    if (static_cast<float>(area) * result.Error <= limit)
    {
      break;
    }
  }
  return result;
}

// Subdivides the trapezoids of a face until their samples agree. Used if the color varies
// nonlinearly or is discontinuous within the face, or if surfaces intersect there.
PixelResult ExactIntegrator::SplitFace(std::size_t index)
{
  PixelResult result;
  float area = 0.f;
  float squares = 0.f;
  this->Arrangement.VisitTrapezoids(index, [&](const PixelArrangement::Trapezoid& t) {
    if (t.Area() > MinimumFaceArea)
    {
      const Sample center = this->Pixel.Trace(t.Centroid(), t.Area());
      this->SplitTrapezoid(t, { 0.0, 0.0 }, 1.0, center, result.Color, squares);
      area += static_cast<float>(t.Area());
    }
  });
  if (!(area > 0.f))
  {
    // All trapezoids are too small. One ray represents them.
    result.Color = this->Pixel.Trace(this->Arrangement.GetFaces()[index].Point).Color;
    return result;
  }
  result.Color /= area;
  result.Error = std::sqrt(squares) / area;
  return result;
}

void ExactIntegrator::SplitTrapezoid(const PixelArrangement::Trapezoid& t, glm::dvec2 low,
  double side, const Sample& center, glm::vec4& color, float& squaredError)
{
  this->UpdateMaximumFaceDepth(center);
  const double height = 0.5 * (t.Top0 + t.Top1 - t.Bottom0 - t.Bottom1);
  const double slope = (t.Top1 - t.Bottom1) - (t.Top0 - t.Bottom0);
  const auto computeArea = [&](double u, double s) {
    return (t.X1 - t.X0) * s * s * (height + slope * (u + 0.5 * s - 0.5));
  };
  const float area = static_cast<float>(computeArea(low.x, side));
  if (area * UnknownVariation < this->Pixel.Settings.Tolerance ||
    side < std::ldexp(1.5, -this->Pixel.Settings.MaximumLevel))
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
    quarters[i] = this->Pixel.Trace(t.At(at.x + 0.5 * half, at.y + 0.5 * half), 0.25 * area);
    sum += static_cast<float>(computeArea(at.x, half)) * quarters[i].Color;
    disconnected = disconnected || quarters[i].FirstHit.Surface != center.FirstHit.Surface;
  }
  const float deviation = ComputeMaximumDifference(sum, area * center.Color);
  if (!disconnected && deviation < this->Pixel.Settings.Tolerance + 2.0 * area * this->Pixel.Noise)
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

std::optional<PixelResult> ExactIntegrator::Integrate(bool once)
{
  long long& pixelCount =
    this->Pixel.CornersAgree() ? this->Pixel.Pixels.SmallObject : this->Pixel.Pixels.Edge;
  this->Edges.FindNearbyIntersections();
  int probePasses = 0;
  // The pixel is sampled as soon as the arrangement costs more than samples of the same accuracy.
  const long long sampleBudget = ComputeMaximumSamples(this->Pixel.Settings.Tolerance);
  const long long maximumRays = this->Pixel.Rays.Refinement + sampleBudget;
  const PixelArrangement::Limits limits{ static_cast<std::size_t>(sampleBudget),
    static_cast<std::size_t>(sampleBudget) * TrapezoidsPerRay };
  for (;;)
  {
    // Intersections of tubes are not computed.
    if (this->Edges.IsTubeIntersected || (once && this->Edges.MayIntersect) ||
      !this->Arrangement.Build(
        this->Edges.Segments.data(), static_cast<int>(this->Edges.Segments.size()), limits))
    {
      return std::nullopt;
    }
    this->FaceProbes.clear();
    if (this->Edges.MayIntersect &&
      probePasses < (this->Edges.SearchesAllPixels ? MaximumProbePasses : 1))
    {
      ++probePasses;
      this->Edges.SearchesAllPixels ? this->ProbeTrapezoids() : this->ProbeLargeTrapezoids();
      if (this->Edges.AddIntersections())
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
      if (this->Pixel.Rays.Refinement > maximumRays)
      {
        return std::nullopt;
      }
      const PixelResult face = this->ComputeFaceColor(i);
      if (this->Pixel.LeastSteady != Steadiness::Steady)
      {
        return std::nullopt;
      }
      const float weight = static_cast<float>(area);
      result.Color += weight * face.Color;
      squares += weight * face.Error * weight * face.Error;
      covered += area;
    }
    if (this->Edges.UncoversHiddenEdge(this->MaximumFaceDepth))
    {
      if (once || this->Edges.UncoversHiddenShape(this->MaximumFaceDepth))
      {
        return std::nullopt;
      }
      this->Edges.Load(false);
      this->Edges.AddIntersectionsAgain();
      continue;
    }
    if (this->Edges.AddIntersections() || this->Edges.IsTubeIntersected)
    {
      continue;
    }
    ++pixelCount;
    result.Color /= static_cast<float>(covered);
    this->Pixel.SetErrors(std::sqrt(squares), EdgeErrorFloor, result);
    return result;
  }
}

}
