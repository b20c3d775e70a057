// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PixelArrangement.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace penumbra
{

namespace
{
// Distance in pixels below which two coordinates are equal. It is far below the precision of a ray
// (1e-4) and far above the rounding of coordinates in double precision.
constexpr double Epsilon = 1e-10;

// Openings of a smaller height do not connect trapezoids of two slabs. A height is less precise than
// Epsilon by the slope of its segment.
constexpr double MinimumOpening = 1e-6;

// Segments of a smaller width are made vertical: a crossing near the end of a steep one would be closer than Epsilon
// to that end.
constexpr double MinimumWidth = 1e-5;

// Returns the y of the segment at x. Events are precise to Epsilon, by which the height of a steep
// segment may change a lot, so that it would leave its own end.
double ComputeHeight(const PixelSegment& s, double x)
{
  for (const glm::dvec2& end : { s.A, s.B })
  {
    if (std::abs(x - end.x) <= Epsilon)
    {
      return end.y;
    }
  }
  const double u = (x - s.A.x) / (s.B.x - s.A.x);
  return std::clamp(s.A.y + u * (s.B.y - s.A.y), 0.0, 1.0);
}

// Computes the x at which two segments cross in their interiors. Returns false if they do not.
// Common end points are events already.
bool FindCrossing(const PixelSegment& s, const PixelSegment& t, double& x)
{
  const glm::dvec2 d = s.B - s.A;
  const glm::dvec2 e = t.B - t.A;
  const double denominator = d.x * e.y - d.y * e.x;
  if (denominator == 0.0)
  {
    return false;
  }
  const glm::dvec2 w = t.A - s.A;
  const double u = (w.x * e.y - w.y * e.x) / denominator;
  const double v = (w.x * d.y - w.y * d.x) / denominator;
  if (!(u > 0.0 && u < 1.0 && v > 0.0 && v < 1.0))
  {
    return false;
  }
  x = s.A.x + u * d.x;
  return true;
}

// Keeps the heights of ends relative to the segments that they touch, or may have crossed because the ends of either
// were moved in x. `segments`: before that.
void KeepJunctions(const PixelSegment* segments, std::vector<PixelSegment>& moved)
{
  const auto keep = [&](const glm::dvec2& from, glm::dvec2& to) {
    if (!(from.y > 0.0 && from.y < 1.0))
    {
      return;
    }
    double nearest = 1.0;
    for (std::size_t i = 0; i < moved.size(); ++i)
    {
      const auto [low, high] = std::minmax(segments[i].A.x, segments[i].B.x);
      const auto [movedLow, movedHigh] = std::minmax(moved[i].A.x, moved[i].B.x);
      if (from.x > low + Epsilon && from.x < high - Epsilon && movedLow < movedHigh &&
        to.x >= movedLow && to.x <= movedHigh)
      {
        const double before = ComputeHeight(segments[i], from.x);
        const double after = ComputeHeight(moved[i], to.x);
        const double distance = std::abs(from.y - before);
        if (distance < nearest && distance <= MinimumOpening + std::abs(after - before))
        {
          nearest = distance;
          to.y = after + (from.y - before);
        }
      }
    }
  };
  for (std::size_t i = 0; i < moved.size(); ++i)
  {
    keep(segments[i].A, moved[i].A);
    keep(segments[i].B, moved[i].B);
  }
}
}

bool ClipToPixel(PixelSegment& segment)
{
  double enter = 0.0;
  double leave = 1.0;
  const glm::dvec2 d = segment.B - segment.A;
  for (int axis = 0; axis < 2; ++axis)
  {
    const double a = segment.A[axis];
    if (d[axis] == 0.0)
    {
      if (!(a > 0.0 && a < 1.0))
      {
        return false;
      }
      continue;
    }
    double t0 = (0.0 - a) / d[axis];
    double t1 = (1.0 - a) / d[axis];
    if (t0 > t1)
    {
      std::swap(t0, t1);
    }
    enter = std::max(enter, t0);
    leave = std::min(leave, t1);
  }
  if (!(enter < leave))
  {
    return false;
  }
  const glm::dvec2 a = segment.A;
  if (leave < 1.0)
  {
    segment.B = glm::clamp(a + leave * d, 0.0, 1.0);
  }
  if (enter > 0.0)
  {
    segment.A = glm::clamp(a + enter * d, 0.0, 1.0);
  }
  return glm::distance(segment.A, segment.B) > Epsilon;
}

glm::dvec2 PixelArrangement::Trapezoid::Centroid() const
{
  const double left = this->Top0 - this->Bottom0;
  const double right = this->Top1 - this->Bottom1;
  const double sum = left + right;
  const double u = sum > 0.0 ? (left + 2.0 * right) / (3.0 * sum) : 0.5;
  return this->At(u, 0.5);
}

bool PixelArrangement::Build(const PixelSegment* segments, int count, const Limits& limits)
{
  segments = this->MakeVertical(segments, count);
  if (!this->CollectEvents(segments, count, limits.Crossings) ||
    !this->CutSlabs(segments, count, limits.Trapezoids))
  {
    return false;
  }
  this->JoinSlabs(segments, count);
  this->CollectFaces();
  return true;
}

// Moves the ends of all segments within the width of a steep one to its middle, or to the side of the pixel, so that
// connected ends remain connected.
const PixelSegment* PixelArrangement::MakeVertical(const PixelSegment* segments, int count)
{
  std::vector<glm::dvec2>& widths = this->Barriers;
  widths.clear();
  for (int i = 0; i < count; ++i)
  {
    const auto [low, high] = std::minmax(segments[i].A.x, segments[i].B.x);
    if (high > low && high - low < MinimumWidth)
    {
      widths.emplace_back(low, high);
    }
  }
  if (widths.empty())
  {
    return segments;
  }
  std::sort(widths.begin(), widths.end(),
    [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x; });
  std::size_t kept = 0;
  for (const glm::dvec2& width : widths)
  {
    if (kept > 0 && width.x <= widths[kept - 1].y + Epsilon)
    {
      widths[kept - 1].y = std::max(widths[kept - 1].y, width.y);
    }
    else
    {
      widths[kept++] = width;
    }
  }
  widths.resize(kept);
  this->Vertical.assign(segments, segments + count);
  const auto move = [&](double& x) {
    const auto next = std::upper_bound(widths.begin(), widths.end(), x + Epsilon,
      [](double value, const glm::dvec2& width) { return value < width.x; });
    if (next != widths.begin() && x <= next[-1].y + Epsilon)
    {
      const glm::dvec2 width = next[-1];
      x = width.x < Epsilon ? 0.0 : width.y > 1.0 - Epsilon ? 1.0 : 0.5 * (width.x + width.y);
    }
  };
  for (PixelSegment& segment : this->Vertical)
  {
    move(segment.A.x);
    move(segment.B.x);
  }
  KeepJunctions(segments, this->Vertical);
  return this->Vertical.data();
}

bool PixelArrangement::CollectEvents(
  const PixelSegment* segments, int count, std::size_t maximumCrossings)
{
  this->Events.assign({ 0.0, 1.0 });
  std::size_t crossings = 0;
  for (int i = 0; i < count; ++i)
  {
    this->Events.push_back(segments[i].A.x);
    this->Events.push_back(segments[i].B.x);
    for (int j = 0; j < i; ++j)
    {
      double x;
      if (FindCrossing(segments[i], segments[j], x))
      {
        if (++crossings > maximumCrossings)
        {
          return false;
        }
        this->Events.push_back(x);
      }
    }
  }
  std::sort(this->Events.begin(), this->Events.end());
  // Merge events closer than Epsilon. The first and last remain 0 and 1.
  std::size_t kept = 0;
  for (const double x : this->Events)
  {
    if (kept == 0 || x - this->Events[kept - 1] > Epsilon)
    {
      this->Events[kept++] = x;
    }
  }
  this->Events.resize(kept);
  this->Events.back() = 1.0;
  return true;
}

bool PixelArrangement::CutSlabs(
  const PixelSegment* segments, int count, std::size_t maximumTrapezoids)
{
  this->Trapezoids.clear();
  this->SlabBegin.assign(1, 0);
  for (std::size_t slab = 0; slab + 1 < this->Events.size(); ++slab)
  {
    const double x0 = this->Events[slab];
    const double x1 = this->Events[slab + 1];
    const double center = 0.5 * (x0 + x1);
    this->Crossings.clear();
    for (int i = 0; i < count; ++i)
    {
      const PixelSegment& s = segments[i];
      if (std::min(s.A.x, s.B.x) < center && std::max(s.A.x, s.B.x) > center)
      {
        this->Crossings.push_back(
          { ComputeHeight(s, center), ComputeHeight(s, x0), ComputeHeight(s, x1) });
      }
    }
    std::sort(this->Crossings.begin(), this->Crossings.end(),
      [](const Crossing& a, const Crossing& b) { return a.Center < b.Center; });
    Trapezoid t{ x0, x1, 0.0, 0.0, 0.0, 0.0, -1 };
    for (const Crossing& c : this->Crossings)
    {
      t.Top0 = std::max(c.Left, t.Bottom0);
      t.Top1 = std::max(c.Right, t.Bottom1);
      if (c.Center - 0.5 * (t.Bottom0 + t.Bottom1) > Epsilon)
      {
        this->Trapezoids.push_back(t);
      }
      t.Bottom0 = t.Top0;
      t.Bottom1 = t.Top1;
    }
    t.Top0 = 1.0;
    t.Top1 = 1.0;
    this->Trapezoids.push_back(t);
    this->SlabBegin.push_back(static_cast<int>(this->Trapezoids.size()));
    if (this->Trapezoids.size() > maximumTrapezoids)
    {
      return false;
    }
  }
  return true;
}

int PixelArrangement::FindRoot(int trapezoid)
{
  while (this->Parent[trapezoid] != trapezoid)
  {
    this->Parent[trapezoid] = this->Parent[this->Parent[trapezoid]];
    trapezoid = this->Parent[trapezoid];
  }
  return trapezoid;
}

void PixelArrangement::JoinSlabs(const PixelSegment* segments, int count)
{
  this->Parent.resize(this->Trapezoids.size());
  for (std::size_t i = 0; i < this->Parent.size(); ++i)
  {
    this->Parent[i] = static_cast<int>(i);
  }
  const int slabs = static_cast<int>(this->SlabBegin.size()) - 1;
  for (int slab = 0; slab + 1 < slabs; ++slab)
  {
    // Vertical segments lie between two slabs and separate their trapezoids.
    const double x = this->Events[slab + 1];
    this->Barriers.clear();
    for (int i = 0; i < count; ++i)
    {
      const PixelSegment& s = segments[i];
      if (std::abs(s.A.x - x) <= Epsilon && std::abs(s.B.x - x) <= Epsilon)
      {
        this->Barriers.emplace_back(std::min(s.A.y, s.B.y), std::max(s.A.y, s.B.y));
      }
    }
    std::sort(this->Barriers.begin(), this->Barriers.end(),
      [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x; });
    int a = this->SlabBegin[slab];
    int b = this->SlabBegin[slab + 1];
    while (a < this->SlabBegin[slab + 1] && b < this->SlabBegin[slab + 2])
    {
      const Trapezoid& left = this->Trapezoids[a];
      const Trapezoid& right = this->Trapezoids[b];
      double low = std::max(left.Bottom1, right.Bottom0);
      const double high = std::min(left.Top1, right.Top0);
      double opening = 0.0;
      for (const glm::dvec2& barrier : this->Barriers)
      {
        opening = std::max(opening, std::min(barrier.x, high) - low);
        low = std::max(low, barrier.y);
      }
      opening = std::max(opening, high - low);
      if (opening > MinimumOpening)
      {
        this->Parent[this->FindRoot(a)] = this->FindRoot(b);
      }
      (left.Top1 < right.Top0 ? a : b) += 1;
    }
  }
}

void PixelArrangement::CollectFaces()
{
  this->Faces.clear();
  const int count = static_cast<int>(this->Trapezoids.size());
  for (int i = 0; i < count; ++i)
  {
    if (this->FindRoot(i) == i)
    {
      this->Trapezoids[i].Face = static_cast<int>(this->Faces.size());
      this->Faces.emplace_back();
    }
  }
  for (int i = 0; i < count; ++i)
  {
    Trapezoid& t = this->Trapezoids[i];
    t.Face = this->Trapezoids[this->FindRoot(i)].Face;
    Face& face = this->Faces[t.Face];
    const double area = t.Area();
    face.Area += area;
    face.Point += area * t.Centroid();
  }
  const int last = this->SlabBegin[this->SlabBegin.size() - 2];
  this->Faces[this->Trapezoids[0].Face].Corners |= 1u;
  this->Faces[this->Trapezoids[last].Face].Corners |= 2u;
  this->Faces[this->Trapezoids[this->SlabBegin[1] - 1].Face].Corners |= 4u;
  this->Faces[this->Trapezoids[count - 1].Face].Corners |= 8u;

  this->ListTrapezoids();
  for (std::size_t f = 0; f < this->Faces.size(); ++f)
  {
    Face& face = this->Faces[f];
    if (face.Area > 0.0)
    {
      face.Point /= face.Area;
    }
    if (this->FindFace(face.Point) == static_cast<int>(f))
    {
      continue;
    }
    const Trapezoid* largest = nullptr;
    this->VisitTrapezoids(f,
      [&](const Trapezoid& t) { largest = !largest || t.Area() > largest->Area() ? &t : largest; });
    const glm::dvec2 inside = largest->Centroid();
    face.Offset = glm::distance(inside, face.Point);
    face.Point = inside;
  }
}

void PixelArrangement::ListTrapezoids()
{
  this->FaceBegin.assign(this->Faces.size() + 1, 0);
  for (const Trapezoid& t : this->Trapezoids)
  {
    ++this->FaceBegin[t.Face + 1];
  }
  std::partial_sum(this->FaceBegin.begin(), this->FaceBegin.end(), this->FaceBegin.begin());
  this->TrapezoidsByFace.resize(this->Trapezoids.size());
  // In descending order, so that FaceBegin moves from the end of each face to its beginning.
  for (std::size_t i = this->Trapezoids.size(); i-- > 0;)
  {
    this->TrapezoidsByFace[--this->FaceBegin[this->Trapezoids[i].Face + 1]] = static_cast<int>(i);
  }
  this->FaceBegin.erase(this->FaceBegin.begin());
  this->FaceBegin.push_back(static_cast<int>(this->Trapezoids.size()));
}

int PixelArrangement::FindFace(glm::dvec2 p) const
{
  if (!(p.x >= 0.0 && p.x <= 1.0))
  {
    return -1;
  }
  const auto end = std::lower_bound(this->Events.begin() + 1, this->Events.end(), p.x);
  const auto slab = static_cast<std::size_t>(end - this->Events.begin()) - 1;
  const int face = this->FindFaceInSlab(slab, p);
  // A point on the line between two slabs lies in both.
  const bool onLine = p.x == *end && slab + 2 < this->SlabBegin.size();
  return face < 0 && onLine ? this->FindFaceInSlab(slab + 1, p) : face;
}

int PixelArrangement::FindFaceAt(glm::dvec2 p) const
{
  const auto end = std::lower_bound(this->Events.begin() + 1, this->Events.end() - 1, p.x);
  const auto slab = static_cast<std::size_t>(end - this->Events.begin()) - 1;
  const Trapezoid* const first = this->Trapezoids.data() + this->SlabBegin[slab];
  const Trapezoid* const last = this->Trapezoids.data() + this->SlabBegin[slab + 1] - 1;
  const double u = (p.x - first->X0) / (first->X1 - first->X0);
  return std::partition_point(first, last, [&](const Trapezoid& t) {
    return p.y >= t.Top0 + u * (t.Top1 - t.Top0);
  })->Face;
}

int PixelArrangement::FindFaceInSlab(std::size_t slab, glm::dvec2 p) const
{
  // Minimum distance of an inside point from bottom and top, as a fraction of the height.
  constexpr double Margin = 1e-3;
  const Trapezoid* const first = this->Trapezoids.data() + this->SlabBegin[slab];
  const Trapezoid* const end = this->Trapezoids.data() + this->SlabBegin[slab + 1];
  const double u = (p.x - first->X0) / (first->X1 - first->X0);
  const auto computeBottom = [=](const Trapezoid& t) {
    return t.Bottom0 + u * (t.Bottom1 - t.Bottom0);
  };
  const auto computeTop = [=](const Trapezoid& t) { return t.Top0 + u * (t.Top1 - t.Top0); };
  const Trapezoid* const found = std::partition_point(first, end, [&](const Trapezoid& t) {
    return !(p.y < computeTop(t) - Margin * (computeTop(t) - computeBottom(t)));
  });
  return found != end &&
      p.y > computeBottom(*found) + Margin * (computeTop(*found) - computeBottom(*found))
    ? found->Face
    : -1;
}

}
