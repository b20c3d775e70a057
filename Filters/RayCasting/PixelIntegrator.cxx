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
// Faces below this share of a pixel are left out: no ray could be aimed at them.
constexpr double SmallestFace = 1e-6;
// Beyond this many edges in one pixel an arrangement costs more than it is worth.
constexpr std::size_t MostEdges = 512;
// The share of its contrast by which the mean of a square's corners errs, RMS over all straight
// borders through it (measured: uniform samples of a half-plane).
constexpr float ContrastError = 0.3f;
// Errors that no pixel with a surface in it is believed to be below: rounding, float rays.
constexpr float ErrorFloor = 2e-5f;
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
  int x, int y, const std::uint32_t* edgeIndices, std::size_t count, bool dense)
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
  if (dense || count > MostEdges)
  {
    ++this->Pixels.Uniform;
    return this->UniformAdaptive();
  }
  this->LoadSegments(edgeIndices, count, true);
  if (this->Segments.empty() || (!this->Settings.SmallObjects && this->CornersAgree()))
  {
    return this->Smooth(true);
  }
  return this->Exact(edgeIndices, count);
}

void PixelIntegrator::LoadSegments(const std::uint32_t* edgeIndices, std::size_t count, bool cull)
{
  this->Segments.clear();
  this->NearestCulledDepth = std::numeric_limits<double>::infinity();

  // An edge behind the opaque surface that all four corners see cannot show, unless one in front of
  // it opens that surface: culling is undone when a face turns out to lie deeper (see Exact).
  double deepest = 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Sample& corner : this->Corners)
  {
    deepest = std::max(deepest, static_cast<double>(corner.OpaqueDepth));
    nearest = std::min(nearest, static_cast<double>(corner.OpaqueDepth));
  }
  const double limit = cull ? deepest + (deepest - nearest) + 1e-5 * std::abs(deepest)
                            : std::numeric_limits<double>::infinity();

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
    const Sample again = this->Trace(CornerOffset(i) + 4e-3 * inward);
    if (again.First.Surface == a.Surface)
    {
      this->Corners[i] = again;
      return true;
    }
    return false;
  }
  return false;
}

PixelResult PixelIntegrator::Smooth(bool allowRefinement)
{
  const bool agree = this->CornersAgree() || this->RepairLeak();
  PixelResult result;
  if (agree)
  {
    const float error = this->CurvatureError();
    const bool empty = !this->Corners[0].First.IsHit();
    if (empty || error <= 0.25f * this->Settings.Tolerance || !allowRefinement)
    {
      ++(empty ? this->Pixels.Empty : this->Pixels.Interior);
      result.Color = Mean(this->Corners);
      result.Error = empty ? EmptyErrorFloor : std::max(error, ErrorFloor);
      return result;
    }
  }
  return this->Subdivide(false);
}

bool PixelIntegrator::CanReuse(const Sample& sample) const
{
  if (this->Source.IsTransparent() || this->Source.HasOcclusion())
  {
    return !sample.First.IsHit();
  }
  return !sample.First.IsHit() ||
    this->Source.GetShading().IsConstantPerTriangle(sample.First.Surface);
}

PixelResult PixelIntegrator::FaceColor(std::size_t index)
{
  const PixelArrangement::Face& face = this->Arrangement.GetFaces()[index];
  const unsigned int inside = face.Corners & this->TrustedCorners;
  Sample sample;
  bool known = false;
  for (int i = 0; i < 4 && !known; ++i)
  {
    if ((inside >> i & 1u) && this->CanReuse(this->Corners[i]))
    {
      sample = this->Corners[i];
      known = true;
    }
  }
  if (!known)
  {
    sample = this->Trace(face.Point);
  }
  this->DeepestFace = std::max(this->DeepestFace, sample.OpaqueDepth);

  PixelResult result;
  result.Color = sample.First.IsHit()
    ? sample.Color
    : this->Source.Background(glm::dvec2(this->X, this->Y) + face.Point);
  // The face is one surface, so its corners show what the shading does within it.
  float variation = 0.f;
  bool torn = false;
  for (int i = 0; i < 4; ++i)
  {
    if (inside >> i & 1u)
    {
      const Sample& corner = this->Corners[i];
      torn = torn || corner.First.Surface != sample.First.Surface;
      variation = std::max(variation, MaximumDifference(corner.Color, sample.Color));
    }
  }
  const float area = static_cast<float>(face.Area);
  if (torn || ContrastError * variation * area > 8.f * this->Settings.Tolerance)
  {
    return this->SplitFace(index, sample);
  }
  const bool constant = sample.First.IsHit()
    ? this->Source.GetShading().IsConstantPerTriangle(sample.First.Surface)
    : true;
  if (!constant)
  {
    result.Error = 0.1f * (inside ? variation : static_cast<float>(this->Settings.Tolerance)) +
      variation * static_cast<float>(face.Offset);
  }
  return result;
}

// Surfaces that meet inside a face without an edge (interpenetration), or colours that jump there:
// the face's trapezoids are halved until their samples agree or MaximumLevel is reached.
PixelResult PixelIntegrator::SplitFace(std::size_t index, const Sample&)
{
  struct Part
  {
    double U0, U1, V0, V1;
    int Level;
  };
  PixelResult result;
  double area = 0.0;
  glm::vec4 sum(0.f);
  float error = 0.f;
  std::vector<Part> stack;
  const int deepest = std::min(this->Settings.MaximumLevel, 4);
  const std::vector<PixelArrangement::Trapezoid> trapezoids = this->Arrangement.GetTrapezoids();
  for (const PixelArrangement::Trapezoid& t : trapezoids)
  {
    if (t.Face != static_cast<int>(index) || t.Area() < SmallestFace)
    {
      continue;
    }
    // Begin at the size at which a whole pixel would be after its own subdivision.
    int level = 0;
    while (level < deepest && t.Area() < std::ldexp(1.0, -2 * level - 1))
    {
      ++level;
    }
    stack.assign(1, { 0.0, 1.0, 0.0, 1.0, level });
    while (!stack.empty())
    {
      const Part part = stack.back();
      stack.pop_back();
      const double um = 0.5 * (part.U0 + part.U1);
      const double vm = 0.5 * (part.V0 + part.V1);
      if (part.Level < deepest)
      {
        stack.push_back({ part.U0, um, part.V0, vm, part.Level + 1 });
        stack.push_back({ um, part.U1, part.V0, vm, part.Level + 1 });
        stack.push_back({ part.U0, um, vm, part.V1, part.Level + 1 });
        stack.push_back({ um, part.U1, vm, part.V1, part.Level + 1 });
        continue;
      }
      const double height0 = t.Top0 - t.Bottom0;
      const double height1 = t.Top1 - t.Bottom1;
      const double share = (t.X1 - t.X0) * (part.U1 - part.U0) * (part.V1 - part.V0) *
        (height0 + um * (height1 - height0));
      const Sample sample = this->Trace(t.At(um, vm));
      this->DeepestFace = std::max(this->DeepestFace, sample.OpaqueDepth);
      sum += static_cast<float>(share) * sample.Color;
      error += static_cast<float>(share * share);
      area += share;
    }
  }
  if (area > 0.0)
  {
    result.Color = sum / static_cast<float>(area);
    result.Error = std::sqrt(error) / static_cast<float>(area) * 0.5f;
  }
  return result;
}

PixelResult PixelIntegrator::Exact(const std::uint32_t* edgeIndices, std::size_t count)
{
  ++(this->CornersAgree() ? this->Pixels.Small : this->Pixels.Border);
  for (;;)
  {
    this->Arrangement.Build(this->Segments.data(), static_cast<int>(this->Segments.size()));
    this->DeepestFace = 0.f;
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
      this->LoadSegments(edgeIndices, count, false); // something shows that was thought hidden
      continue;
    }
    result.Color /= static_cast<float>(covered);
    result.Error = std::max(std::sqrt(squares), ErrorFloor);
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

bool PixelIntegrator::NeedsDescent(const Square& square, bool byObject, float& leafError) const
{
  const float area = std::ldexp(1.f, -2 * square.Level);
  leafError = ContrastError * Contrast(square.Corners) * area;
  if (square.Level >= this->Settings.MaximumLevel)
  {
    return false;
  }
  bool differ = false;
  for (int i = 1; i < 4; ++i)
  {
    differ = differ || square.Corners[i].First.Surface != square.Corners[0].First.Surface;
  }
  if (!byObject)
  {
    return differ || leafError > 0.5f * static_cast<float>(this->Settings.Tolerance);
  }
  if (differ)
  {
    return true;
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

void PixelIntegrator::Descend(const Square& square, bool byObject, glm::vec4& color, float& error)
{
  float leafError;
  if (!this->NeedsDescent(square, byObject, leafError))
  {
    color += std::ldexp(1.f, -2 * square.Level) * Mean(square.Corners);
    error += leafError * leafError;
    return;
  }
  const int half = 1 << (this->Settings.MaximumLevel - square.Level - 1);
  Sample nodes[9];
  for (int i = 0; i < 9; ++i)
  {
    const bool corner = i % 2 == 0 && i != 4;
    nodes[i] = corner ? square.Corners[(i % 3) / 2 + 2 * (i / 6)]
                      : this->SampleAtFine(square.Low + half * glm::ivec2(i % 3, i / 3));
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
    this->Descend(part, byObject, color, error);
  }
}

PixelResult PixelIntegrator::Subdivide(bool byObject)
{
  Square whole;
  whole.Low = glm::ivec2(this->X, this->Y) << this->Settings.MaximumLevel;
  whole.Level = 0;
  std::copy(this->Corners, this->Corners + 4, whole.Corners);
  float leafError;
  if (this->NeedsDescent(whole, byObject, leafError))
  {
    ++(this->CornersAgree() && byObject ? this->Pixels.Small : this->Pixels.Refined);
  }
  else
  {
    ++(this->Corners[0].First.IsHit() ? this->Pixels.Interior : this->Pixels.Empty);
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
      sum += sample.Color;
      squares += sample.Color * sample.Color;
    }
    const float n = static_cast<float>((packet + 1) * Sampler::PacketSize);
    result.Color = sum / n;
    const glm::vec4 variance = glm::max(squares / n - result.Color * result.Color, 0.f);
    const float largest = std::max(std::max(variance.r, variance.g), variance.b);
    result.Error = std::max(std::sqrt(largest / n), ErrorFloor);
    if (result.Error < 0.5f * this->Settings.Tolerance)
    {
      break;
    }
  }
  return result;
}

}
