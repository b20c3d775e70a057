// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PixelIntegrator.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

// A corner nearer to an edge than this, in pixels, may lie on either side of it for the ray.
constexpr double TrustDistance = 1e-3;
// How far such a corner moves towards the middle of the pixel, as a share of the way.
constexpr double CornerInset = 4.0 * TrustDistance;
// Faces below this share of a pixel are left out: no ray could be aimed at them.
constexpr double SmallestFace = 1e-6;
// Beyond this many edges in one pixel an arrangement costs more than it is worth.
constexpr std::size_t MostEdges = 512;
// The same where most pixels around have many: there their cost adds up.
constexpr std::size_t MostEdgesInCrowd = 10;
// Objects in one pixel whose depths differ by less than this many pixels may touch.
constexpr double TouchingDepth = 16.0;
// Pieces of such a pixel that are large enough to be worth looking into.
constexpr double SmallestProbe = 0.02;
// Sampling of a crowded pixel stops when its error is this share of the tolerance.
constexpr double DenseShare = 0.1;
// A difference that only a shadow makes between neighbouring corners of one surface.
constexpr float ShadowContrast = 0.05f;
// Triangles of one pixel that are tested for passing through each other.
constexpr std::size_t MostTrianglesSeen = 24;
// The share of its contrast by which the mean of a square's corners errs, RMS over all straight
// borders through it (measured: uniform samples of a half-plane).
constexpr float ContrastError = 0.3f;
// Errors that no pixel with a surface in it is believed to be below: rounding; and with edges in it,
// the precision to which a ray and an edge agree on a place.
constexpr float ErrorFloor = 2e-5f;
constexpr float BorderErrorFloor = 1.5e-4f;
// The share of what the last comparison of samples saw that is believed to be left as an error, and
// by how much second differences are doubted: between the vertices of a mesh colours bend in kinks.
// Measured on a smooth scan, so that 95 % of tiles err by less than is believed.
constexpr float BelievedShare = 0.35f;
constexpr float CurvatureDoubt = 3.f;
// How much the colour is taken to vary across a piece of surface of which one sample is known.
constexpr float UnknownVariation = 0.25f;
// The same where there is nothing but background.
constexpr float EmptyErrorFloor = 1e-6f;

float MaximumDifference(const glm::vec4& a, const glm::vec4& b)
{
  const glm::vec4 d = glm::abs(a - b);
  return std::max(std::max(d.r, d.g), std::max(d.b, d.a));
}

float Contrast(const Sample* corners)
{
  const glm::vec4 low = glm::min(
    glm::min(corners[0].Color, corners[1].Color), glm::min(corners[2].Color, corners[3].Color));
  const glm::vec4 high = glm::max(
    glm::max(corners[0].Color, corners[1].Color), glm::max(corners[2].Color, corners[3].Color));
  return MaximumDifference(low, high);
}

glm::vec4 Mean(const Sample* corners)
{
  return 0.25f * ((corners[0].Color + corners[1].Color) + (corners[2].Color + corners[3].Color));
}

double DistanceToSegment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b)
{
  const glm::dvec2 d = b - a;
  const double square = glm::dot(d, d);
  const double u = square > 0.0 ? glm::clamp(glm::dot(p - a, d) / square, 0.0, 1.0) : 0.0;
  return glm::distance(p, a + u * d);
}

glm::dvec2 CornerOffset(int corner)
{
  return { corner & 1, corner >> 1 };
}

}

PixelCounts& PixelCounts::operator+=(const PixelCounts& other)
{
  this->Empty += other.Empty;
  this->Interior += other.Interior;
  this->Border += other.Border;
  this->Small += other.Small;
  this->Refined += other.Refined;
  this->Uniform += other.Uniform;
  return *this;
}

PixelIntegrator::PixelIntegrator(const Sampler& sampler, const CornerGrid& corners,
  const std::vector<ProjectedEdge>& edges, const IntegrationSettings& settings)
  : Source(sampler),
    Grid(corners),
    Edges(edges),
    Settings(settings)
{
}

Sample PixelIntegrator::Trace(glm::dvec2 local)
{
  ++this->Rays.Refinement;
  return this->Source.At(glm::dvec2(this->X, this->Y) + local, this->Rays);
}

void PixelIntegrator::LoadCorners(int x, int y)
{
  this->X = x;
  this->Y = y;
  for (int i = 0; i < 4; ++i)
  {
    this->Corners[i] = this->Grid.At(x + (i & 1), y + (i >> 1));
  }
  this->TrustedCorners = 15u;
  this->Seen.clear();
  this->PairsTested = 0;
  this->Pierced = false;
}

void PixelIntegrator::See(const Sample& sample)
{
  const TriangleId id{ sample.First.Surface, sample.First.Triangle };
  if (sample.First.IsHit() && this->Seen.size() < MostTrianglesSeen &&
    std::find(this->Seen.begin(), this->Seen.end(), id) == this->Seen.end())
  {
    this->Seen.push_back(id);
  }
}

// Cuts the pixel where triangles that were seen in it pass through each other; false when no new
// border was found.
bool PixelIntegrator::AddPiercings()
{
  const std::size_t before = this->Segments.size();
  const glm::dvec2 origin(this->X, this->Y);
  for (std::size_t i = this->PairsTested; i < this->Seen.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      PixelSegment segment;
      if (FindPiercing(this->Source.GetScene(), this->Seen[i], this->Seen[j], origin, segment))
      {
        this->Segments.push_back(segment);
      }
    }
  }
  this->PairsTested = this->Seen.size();
  this->Pierced = this->Pierced || this->Segments.size() > before;
  return this->Segments.size() > before;
}

// Looks for piercings among the triangles at the corners, and where there are some, among those at
// the corners around, too: they go on there.
void PixelIntegrator::SeeAround()
{
  double nearest = std::numeric_limits<double>::infinity();
  double deepest = 0.0;
  for (const Sample& corner : this->Corners)
  {
    this->See(corner);
    nearest = std::min(nearest, static_cast<double>(corner.OpaqueDepth));
    deepest = std::max(deepest, static_cast<double>(corner.OpaqueDepth));
  }
  // Two objects at one depth may do so even if the triangles at the corners do not.
  const Camera& eye = this->Source.GetScene().Eye;
  const double footprint = eye.PixelSize * (eye.Parallel ? 1.0 : nearest);
  this->Pierced = !this->CornersAgree() && deepest - nearest < TouchingDepth * footprint;
  if (!this->AddPiercings() && !this->Pierced)
  {
    return;
  }
  const glm::ivec2 low = glm::max(glm::ivec2(this->X, this->Y) - 1, this->Grid.GetLow());
  const glm::ivec2 high = glm::min(glm::ivec2(this->X, this->Y) + 2, this->Grid.GetHigh());
  for (int y = low.y; y <= high.y; ++y)
  {
    for (int x = low.x; x <= high.x; ++x)
    {
      this->See(this->Grid.At(x, y));
    }
  }
  this->AddPiercings();
}

bool PixelIntegrator::CornersAgree() const
{
  for (int i = 1; i < 4; ++i)
  {
    if (this->Corners[i].First.Surface != this->Corners[0].First.Surface)
    {
      return false;
    }
  }
  return true;
}

PixelResult PixelIntegrator::Integrate(
  int x, int y, const std::uint32_t* edgeIndices, std::size_t count, Density density)
{
  if (this->Settings.Method == IntegrationSettings::Methods::Uniform)
  {
    this->X = x;
    this->Y = y;
    ++this->Pixels.Uniform;
    return this->Uniform(this->Settings.UniformSamples);
  }
  this->LoadCorners(x, y);
  if (this->Settings.Method == IntegrationSettings::Methods::Subdivision)
  {
    this->Segments.clear();
    if (this->Settings.SmallObjects)
    {
      this->LoadSegments(edgeIndices, count, true);
    }
    return this->Subdivide(true);
  }
  if (count <= MostEdges)
  {
    this->LoadSegments(edgeIndices, count, true);
  }
  if (density == Density::Dense || count > MostEdges ||
    (density == Density::Crowded && this->Segments.size() > MostEdgesInCrowd))
  {
    ++this->Pixels.Uniform;
    return this->UniformAdaptive();
  }
  if (this->Segments.empty() || (!this->Settings.SmallObjects && this->CornersAgree()))
  {
    return this->Smooth();
  }
  return this->Exact(edgeIndices, count);
}

// How deep the surface that a sample met may lie anywhere in this pixel.
double PixelIntegrator::DeepestOf(const Sample& sample) const
{
  if (!(sample.OpaqueDepth < std::numeric_limits<float>::infinity()))
  {
    return std::numeric_limits<double>::infinity();
  }
  if (sample.OpaqueDepth != sample.First.Distance)
  {
    return sample.OpaqueDepth; // behind something translucent
  }
  return DeepestInPixel(this->Source.GetScene(), { sample.First.Surface, sample.First.Triangle },
    glm::dvec2(this->X, this->Y));
}

void PixelIntegrator::Deepen(const Sample& sample)
{
  if (this->NearestCulledDepth < std::numeric_limits<double>::infinity())
  {
    this->DeepestFace = std::max(this->DeepestFace, this->DeepestOf(sample));
  }
}

void PixelIntegrator::LoadSegments(const std::uint32_t* edgeIndices, std::size_t count, bool cull)
{
  this->Segments.clear();
  this->NearestCulledDepth = std::numeric_limits<double>::infinity();

  // An edge behind the opaque surfaces that all four corners see cannot show, unless one in front of
  // it opens them: culling is undone when a face turns out to lie deeper (see Exact). In a valley
  // the edge at the bottom lies deeper than the corners, but not deeper than the planes that meet
  // there.
  double limit = std::numeric_limits<double>::infinity();
  if (cull && count > 0)
  {
    limit = 0.0;
    for (const Sample& corner : this->Corners)
    {
      limit = std::max(limit, this->DeepestOf(corner));
    }
    limit += 1e-5 * std::abs(limit);
  }

  const bool parallel = this->Source.GetScene().Eye.Parallel;
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
        continue;
      }
    }
    for (int corner = 0; corner < 4; ++corner)
    {
      if (DistanceToSegment(CornerOffset(corner), a, a + d) < TrustDistance)
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

// The error of the mean of four corners is (f_xx + f_yy) / 12; second differences with the corners
// around stand for the derivatives. A jump shows up as a second difference, too.
float PixelIntegrator::CurvatureError() const
{
  const float contrast = Contrast(this->Corners);
  if (contrast == 0.f)
  {
    return 0.f;
  }
  const std::uint32_t surface = this->Corners[0].First.Surface;
  float sum = 0.f;
  for (int axis = 0; axis < 2; ++axis)
  {
    const glm::ivec2 step(axis == 0, axis == 1);
    const glm::ivec2 side(axis == 1, axis == 0);
    float worst = 0.f;
    for (int line = 0; line < 2; ++line)
    {
      const glm::ivec2 p = glm::ivec2(this->X, this->Y) + line * side;
      const glm::vec4& first = this->Grid.At(p.x, p.y).Color;
      const glm::vec4& second = this->Grid.At(p.x + step.x, p.y + step.y).Color;
      float least = contrast;
      for (int end = 0; end < 2; ++end)
      {
        const glm::ivec2 q = end == 0 ? p - step : p + 2 * step;
        if (q.x < this->Grid.GetLow().x || q.y < this->Grid.GetLow().y ||
          q.x > this->Grid.GetHigh().x || q.y > this->Grid.GetHigh().y ||
          this->Grid.At(q.x, q.y).First.Surface != surface)
        {
          continue;
        }
        const glm::vec4& outer = this->Grid.At(q.x, q.y).Color;
        const glm::vec4 d = end == 0 ? outer - 2.f * first + second : first - 2.f * second + outer;
        least = std::min(least, MaximumDifference(d, glm::vec4(0.f)));
      }
      worst = std::max(worst, least);
    }
    sum += worst;
  }
  // Second differences of noise alone are about 2.4 of its standard errors.
  const float noise = 2.f * 2.4f * static_cast<float>(this->Settings.Noise);
  return std::max(sum - noise, 0.f) / 12.f;
}

// Where a border runs along the rim of the pixel, the rays of its corners may have met either side:
// they are traced again a little to the inside.
void PixelIntegrator::MoveCornersOffBorders()
{
  for (int i = 0; i < 4; ++i)
  {
    if (!(this->TrustedCorners >> i & 1u))
    {
      const glm::dvec2 inward = glm::dvec2(0.5) - CornerOffset(i);
      this->Corners[i] = this->Trace(CornerOffset(i) + CornerInset * inward);
    }
  }
}

// A ray exactly through a vertex or an edge can slip between the triangles. Where no border is near,
// a single corner that disagrees with the other three is traced again a little to the inside.
bool PixelIntegrator::RepairLeak()
{
  for (int i = 0; i < 4; ++i)
  {
    const Hit& odd = this->Corners[i].First;
    const Hit& a = this->Corners[(i + 1) & 3].First;
    const Hit& b = this->Corners[(i + 2) & 3].First;
    const Hit& c = this->Corners[(i + 3) & 3].First;
    if (a.Surface != b.Surface || a.Surface != c.Surface || odd.Surface == a.Surface)
    {
      continue;
    }
    const glm::dvec2 inward = glm::dvec2(0.5) - CornerOffset(i);
    const Sample again = this->Trace(CornerOffset(i) + CornerInset * inward);
    if (again.First.Surface == a.Surface)
    {
      this->Corners[i] = again;
      return true;
    }
    return false;
  }
  return false;
}

// Shadows may jump where no corner shows it; they do so next to where one does.
bool PixelIntegrator::IsNearShadowBorder() const
{
  if (!this->Settings.Shadows)
  {
    return false;
  }
  const glm::ivec2 low = glm::max(glm::ivec2(this->X, this->Y) - 1, this->Grid.GetLow());
  const glm::ivec2 high = glm::min(glm::ivec2(this->X, this->Y) + 2, this->Grid.GetHigh());
  for (int y = low.y; y <= high.y; ++y)
  {
    for (int x = low.x; x <= high.x; ++x)
    {
      const Sample& around = this->Grid.At(x, y);
      for (const Sample& corner : this->Corners)
      {
        if (around.First.Surface == corner.First.Surface &&
          MaximumDifference(around.Color, corner.Color) > ShadowContrast)
        {
          return true;
        }
      }
    }
  }
  return false;
}

PixelResult PixelIntegrator::Smooth()
{
  this->MoveCornersOffBorders();
  const bool agree = this->CornersAgree() || this->RepairLeak();
  PixelResult result;
  if (agree)
  {
    const float error = this->CurvatureError();
    const bool empty = !this->Corners[0].First.IsHit();
    if (empty || (error <= 0.25f * this->Settings.Tolerance && !this->IsNearShadowBorder()))
    {
      ++(empty ? this->Pixels.Empty : this->Pixels.Interior);
      result.Color = Mean(this->Corners);
      result.Error = empty ? EmptyErrorFloor : std::max(CurvatureDoubt * error, ErrorFloor);
      return result;
    }
  }
  this->SeeAround();
  if (!this->Segments.empty())
  {
    return this->Exact(nullptr, 0);
  }
  return this->Subdivide(false);
}

// Has a face one colour all over, whichever of its points is asked?
bool PixelIntegrator::IsConstant(const Sample& sample) const
{
  return !sample.First.IsHit() ||
    (!this->Source.IsTransparent() && !this->Source.HasOcclusion() &&
      this->Source.GetShading().IsConstantPerTriangle(sample.First.Surface));
}

PixelResult PixelIntegrator::FaceColor(std::size_t index)
{
  const PixelArrangement::Face face = this->Arrangement.GetFaces()[index];
  const unsigned int inside = face.Corners & this->TrustedCorners;
  PixelResult result;
  const Sample* known = nullptr;
  bool agree = true;
  for (int i = 0; i < 4; ++i)
  {
    if ((inside >> i & 1u) && !this->Pierced && this->IsConstant(this->Corners[i]))
    {
      const Sample& corner = this->Corners[i];
      agree = agree &&
        (!known ||
          (known->First.Surface == corner.First.Surface &&
            MaximumDifference(known->Color, corner.Color) <= this->Settings.Tolerance));
      known = known ? known : &corner;
    }
  }
  if (known && !agree)
  {
    return this->SplitFace(index);
  }
  if (known)
  {
    this->Deepen(*known);
    result.Color = known->First.IsHit()
      ? known->Color
      : this->Source.Background(glm::dvec2(this->X, this->Y) + face.Point);
    return result;
  }
  const Sample sample = this->Trace(face.Point);
  this->Deepen(sample);
  this->See(sample);
  result.Color = sample.Color;
  if (inside == 0u && this->IsConstant(sample))
  {
    return result;
  }
  // The face is one surface: how its corners differ from the sample tells how the colour varies
  // within it. A face without corners is taken to vary as much as a rim often does.
  const bool unknown = !inside || this->IsNearShadowBorder();
  float variation = unknown ? UnknownVariation : 0.f;
  for (int i = 0; i < 4; ++i)
  {
    if (inside >> i & 1u)
    {
      const Sample& corner = this->Corners[i];
      const bool torn = corner.First.Surface != sample.First.Surface;
      variation = std::max(
        variation, std::max(torn ? 1.f : 0.f, MaximumDifference(corner.Color, sample.Color)));
    }
  }
  const float area = static_cast<float>(face.Area);
  const float limit = static_cast<float>(this->Settings.Tolerance + 2.0 * this->Settings.Noise);
  // Answers about occlusion are dear, and it seldom jumps: there no face is split on suspicion.
  const bool suspicion = unknown && this->Source.HasOcclusion() && variation <= UnknownVariation;
  if (variation * area > limit && !suspicion)
  {
    return this->SplitFace(index);
  }
  result.Error = BelievedShare * variation;
  return result;
}

// Colours that bend or jump within a face, or surfaces that meet there without an edge
// (interpenetration): the face's trapezoids are quartered until their samples agree.
PixelResult PixelIntegrator::SplitFace(std::size_t index)
{
  PixelResult result;
  float area = 0.f;
  float squares = 0.f;
  for (const PixelArrangement::Trapezoid& t : this->Arrangement.GetTrapezoids())
  {
    if (t.Face == static_cast<int>(index) && t.Area() > SmallestFace)
    {
      const Sample middle = this->Trace(t.Centroid());
      this->SplitTrapezoid(t, { 0.0, 0.0 }, 1.0, middle, result.Color, squares);
      area += static_cast<float>(t.Area());
    }
  }
  result.Color /= area;
  result.Error = std::sqrt(squares) / area;
  return result;
}

void PixelIntegrator::SplitTrapezoid(const PixelArrangement::Trapezoid& t, glm::dvec2 low,
  double side, const Sample& middle, glm::vec4& color, float& squaredError)
{
  this->Deepen(middle);
  const double height = 0.5 * (t.Top0 + t.Top1 - t.Bottom0 - t.Bottom1);
  const double slope = (t.Top1 - t.Bottom1) - (t.Top0 - t.Bottom0);
  const auto share = [&](double u, double s) {
    return (t.X1 - t.X0) * s * s * (height + slope * (u + 0.5 * s - 0.5));
  };
  const float area = static_cast<float>(share(low.x, side));
  if (area * UnknownVariation < this->Settings.Tolerance ||
    side < std::ldexp(1.5, -this->Settings.MaximumLevel))
  {
    color += area * middle.Color;
    const float error = BelievedShare * area * UnknownVariation;
    squaredError += error * error;
    return;
  }
  const double half = 0.5 * side;
  Sample quarters[4];
  glm::vec4 sum(0.f);
  bool torn = false;
  for (int i = 0; i < 4; ++i)
  {
    const glm::dvec2 at = low + half * CornerOffset(i);
    quarters[i] = this->Trace(t.At(at.x + 0.5 * half, at.y + 0.5 * half));
    sum += static_cast<float>(share(at.x, half)) * quarters[i].Color;
    torn = torn || quarters[i].First.Surface != middle.First.Surface;
  }
  const float deviation = MaximumDifference(sum, area * middle.Color);
  if (!torn && deviation < this->Settings.Tolerance + 2.0 * area * this->Settings.Noise)
  {
    color += sum;
    squaredError += BelievedShare * BelievedShare * deviation * deviation;
    return;
  }
  for (int i = 0; i < 4; ++i)
  {
    this->SplitTrapezoid(t, low + half * CornerOffset(i), half, quarters[i], color, squaredError);
  }
}

// Looks for triangles that no corner met, where surfaces pass through each other.
void PixelIntegrator::Probe()
{
  for (const PixelArrangement::Trapezoid& t : this->Arrangement.GetTrapezoids())
  {
    if (t.Area() < SmallestProbe)
    {
      continue;
    }
    for (const glm::dvec2 at : { glm::dvec2(0.2, 0.2), glm::dvec2(0.8, 0.2), glm::dvec2(0.5, 0.8) })
    {
      Sample sample;
      sample.First = this->Source.FirstHit(glm::dvec2(this->X, this->Y) + t.At(at.x, at.y));
      ++this->Rays.Refinement;
      this->See(sample);
    }
  }
}

PixelResult PixelIntegrator::Exact(const std::uint32_t* edgeIndices, std::size_t count)
{
  ++(this->CornersAgree() ? this->Pixels.Small : this->Pixels.Border);
  this->SeeAround();
  bool probed = !this->Pierced;
  for (;;)
  {
    this->Arrangement.Build(this->Segments.data(), static_cast<int>(this->Segments.size()));
    if (!probed)
    {
      probed = true;
      this->Probe();
      if (this->AddPiercings())
      {
        continue;
      }
    }
    this->DeepestFace = 0.0;
    PixelResult result;
    double covered = 0.0;
    float squares = 0.f;
    const std::size_t faces = this->Arrangement.GetFaces().size();
    for (std::size_t i = 0; i < faces; ++i)
    {
      const double area = this->Arrangement.GetFaces()[i].Area;
      if (area < SmallestFace)
      {
        continue;
      }
      const PixelResult face = this->FaceColor(i);
      const float weight = static_cast<float>(area);
      result.Color += weight * face.Color;
      squares += weight * face.Error * weight * face.Error;
      covered += area;
    }
    if (this->DeepestFace > this->NearestCulledDepth)
    {
      // Something shows that was thought hidden.
      this->LoadSegments(edgeIndices, count, false);
      this->PairsTested = 0;
      this->AddPiercings();
      continue;
    }
    if (this->AddPiercings())
    {
      continue;
    }
    result.Color /= static_cast<float>(covered);
    result.Error = std::max(std::sqrt(squares), BorderErrorFloor);
    return result;
  }
}

const Sample& PixelIntegrator::SampleAtFine(glm::ivec2 fine)
{
  if (const Sample* known = this->Cache.Find(fine))
  {
    return *known;
  }
  const double scale = std::ldexp(1.0, -this->Settings.MaximumLevel);
  ++this->Rays.Refinement;
  return this->Cache.Insert(fine, this->Source.At(glm::dvec2(fine) * scale, this->Rays));
}

bool PixelIntegrator::NeedsDescent(const Square& square) const
{
  for (int i = 1; i < 4; ++i)
  {
    if (square.Corners[i].First.Surface != square.Corners[0].First.Surface)
    {
      return true;
    }
  }
  // Case 4: something inside, though the corners agree.
  const double scale = std::ldexp(1.0, -this->Settings.MaximumLevel);
  const glm::dvec2 low = glm::dvec2(square.Low) * scale - glm::dvec2(this->X, this->Y);
  const double side = std::ldexp(1.0, -square.Level);
  for (const PixelSegment& segment : this->Segments)
  {
    PixelSegment inside{ (segment.A - low) / side, (segment.B - low) / side };
    if (ClipToPixel(inside))
    {
      return true;
    }
  }
  return false;
}

void PixelIntegrator::Descend(
  const Square& square, bool byObject, glm::vec4& color, float& squaredError)
{
  const float area = std::ldexp(1.f, -2 * square.Level);
  const glm::vec4 mean = Mean(square.Corners);
  if (square.Level >= this->Settings.MaximumLevel || (byObject && !this->NeedsDescent(square)))
  {
    color += area * mean;
    const float error = area * ContrastError * Contrast(square.Corners);
    squaredError += error * error;
    return;
  }
  const int half = 1 << (this->Settings.MaximumLevel - square.Level - 1);
  Sample nodes[9];
  for (const int i : { 0, 2, 6, 8 })
  {
    nodes[i] = square.Corners[(i % 3) / 2 + 2 * (i / 6)];
  }
  nodes[4] = this->SampleAtFine(square.Low + half);
  if (!byObject && !this->NeedsDescent(square) && nodes[4].First.Surface == nodes[0].First.Surface)
  {
    // For colours bent like a parabola the mean of the corners and the middle err in opposite
    // directions, as 2 to -1.
    const float deviation = area * MaximumDifference(nodes[4].Color, mean);
    const float noise = area * 2.f * static_cast<float>(this->Settings.Noise);
    const bool doubtful = square.Level == 0 && this->IsNearShadowBorder();
    if (!doubtful && deviation <= static_cast<float>(this->Settings.Tolerance) + noise)
    {
      color += area / 3.f * (mean + 2.f * nodes[4].Color);
      squaredError += BelievedShare * BelievedShare * deviation * deviation;
      return;
    }
  }
  for (const int i : { 1, 3, 5, 7 })
  {
    nodes[i] = this->SampleAtFine(square.Low + half * glm::ivec2(i % 3, i / 3));
  }
  for (int child = 0; child < 4; ++child)
  {
    const int cx = child & 1;
    const int cy = child >> 1;
    Square part;
    part.Low = square.Low + half * glm::ivec2(cx, cy);
    part.Level = square.Level + 1;
    for (int i = 0; i < 4; ++i)
    {
      part.Corners[i] = nodes[(cy + (i >> 1)) * 3 + cx + (i & 1)];
    }
    this->Descend(part, byObject, color, squaredError);
  }
}

PixelResult PixelIntegrator::Subdivide(bool byObject)
{
  Square whole;
  whole.Low = glm::ivec2(this->X, this->Y) << this->Settings.MaximumLevel;
  whole.Level = 0;
  std::copy(this->Corners, this->Corners + 4, whole.Corners);
  if (byObject && !this->NeedsDescent(whole))
  {
    ++(this->Corners[0].First.IsHit() ? this->Pixels.Interior : this->Pixels.Empty);
  }
  else
  {
    ++(byObject && this->CornersAgree() ? this->Pixels.Small : this->Pixels.Refined);
  }
  PixelResult result;
  float squares = 0.f;
  this->Descend(whole, byObject, result.Color, squares);
  result.Error = std::max(std::sqrt(squares), ErrorFloor);
  return result;
}

PixelResult PixelIntegrator::Uniform(int side)
{
  PixelResult result;
  glm::dvec4 sum(0.0);
  glm::dvec4 squares(0.0);
  const int total = side * side;
  glm::dvec2 points[Sampler::PacketSize];
  Sample samples[Sampler::PacketSize];
  for (int first = 0; first < total; first += Sampler::PacketSize)
  {
    const int count = std::min(total - first, static_cast<int>(Sampler::PacketSize));
    for (int i = 0; i < Sampler::PacketSize; ++i)
    {
      const int k = std::min(first + i, total - 1);
      points[i] = glm::dvec2(this->X + (k % side + 0.5) / side, this->Y + (k / side + 0.5) / side);
    }
    this->Source.AtPacket(points, (1u << count) - 1u, samples, this->Rays);
    for (int i = 0; i < count; ++i)
    {
      const glm::dvec4 color(samples[i].Color);
      sum += color;
      squares += color * color;
    }
  }
  this->Rays.Primary += total;
  const glm::dvec4 mean = sum / static_cast<double>(total);
  result.Color = glm::vec4(mean);
  const glm::vec4 variance(glm::max(squares / static_cast<double>(total) - mean * mean, 0.0));
  const float largest = std::max(std::max(variance.r, variance.g), variance.b);
  // Regular samples of straight borders err like n^-3/4 of their number, not n^-1/2.
  result.Error = std::sqrt(largest) * std::pow(static_cast<float>(total), -0.75f);
  return result;
}

// 8 x 8 samples in four packets, each spread over the pixel; stops as soon as their mean is known.
PixelResult PixelIntegrator::UniformAdaptive()
{
  constexpr int Side = 8;
  constexpr int Packets = Side * Side / Sampler::PacketSize;
  PixelResult result;
  glm::vec4 sum(0.f);
  glm::vec4 squares(0.f);
  bool hits =
    false; // where all miss something small is meant to be here, or it would not be asked for
  glm::dvec2 points[Sampler::PacketSize];
  Sample samples[Sampler::PacketSize];
  for (int packet = 0; packet < Packets; ++packet)
  {
    int i = 0;
    for (int k = 0; k < Side * Side; ++k)
    {
      if ((k % Side + 2 * (k / Side)) % Packets == packet)
      {
        points[i++] =
          glm::dvec2(this->X + (k % Side + 0.5) / Side, this->Y + (k / Side + 0.5) / Side);
      }
    }
    this->Source.AtPacket(points, 0xffffu, samples, this->Rays);
    this->Rays.Refinement += Sampler::PacketSize;
    for (const Sample& sample : samples)
    {
      hits = hits || sample.First.IsHit();
      sum += sample.Color;
      squares += sample.Color * sample.Color;
    }
    const float n = static_cast<float>((packet + 1) * Sampler::PacketSize);
    result.Color = sum / n;
    const glm::vec4 variance = glm::max(squares / n - result.Color * result.Color, 0.f);
    const float largest = std::max(std::max(variance.r, variance.g), variance.b);
    result.Error = std::max(std::sqrt(largest / n), ErrorFloor);
    if (hits && result.Error < DenseShare * this->Settings.Tolerance)
    {
      break;
    }
  }
  return result;
}

}
