// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MediumDensity.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
/// Largest exponent of the density; e^300 squared is finite.
constexpr double MaximumExponent = 300.0;
/// Number of intermediate columns along a ray per point of the image.
constexpr double ColumnsPerPoint = 2.0;

}

double Attenuate(double extinction, double column)
{
  return extinction > 0.0 ? std::exp(-extinction * column) : 1.0;
}

double DensityImage::At(glm::dvec3 point) const
{
  const glm::dvec3 position = (point - this->Low) / this->Spacing;
  const glm::dvec3 last(this->Size - 1);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(position[axis] >= 0.0) || position[axis] > last[axis])
    {
      return 0.0;
    }
  }
  const glm::dvec3 cell = glm::min(glm::floor(position), last - 1.0);
  const glm::dvec3 f = position - cell;
  const glm::ivec3 corner(cell);
  const std::size_t row = static_cast<std::size_t>(this->Size.x);
  const std::size_t slice = row * static_cast<std::size_t>(this->Size.y);
  const float* v = this->Values.data() + corner.x + row * corner.y + slice * corner.z;
  const auto alongX = [&f](const float* at) { return (1.0 - f.x) * at[0] + f.x * at[1]; };
  const auto alongY = [&](const float* at) {
    return (1.0 - f.y) * alongX(at) + f.y * alongX(at + row);
  };
  return (1.0 - f.z) * alongY(v) + f.z * alongY(v + slice);
}

double MediumDensity::HeightFactor(glm::dvec3 point) const
{
  const double exponent = (this->BaseHeight - glm::dot(this->Up, point)) / this->ScaleHeight;
  return std::exp(std::min(exponent, MaximumExponent));
}

double MediumDensity::At(glm::dvec3 point) const
{
  const double value = this->Image ? this->Image->At(point) : 1.0;
  return this->HasFalloff() ? value * this->HeightFactor(point) : value;
}

double MediumDensity::Decay(glm::dvec3 direction) const
{
  return this->HasFalloff() ? glm::dot(this->Up, direction) / this->ScaleHeight : 0.0;
}

double MediumDensity::Column(glm::dvec3 point, glm::dvec3 direction, double length) const
{
  if (this->Image)
  {
    return this->MarchCells(point, direction, length);
  }
  if (!this->HasFalloff())
  {
    return length;
  }
  const double decay = this->Decay(direction);
  const double density = this->HeightFactor(point);
  if (std::isinf(length))
  {
    return decay > 0.0 ? density / decay : Infinity;
  }
  const double x = decay * length;
  return density * (std::abs(x) < 1e-9 ? length : -std::expm1(-x) / decay);
}

double MediumDensity::LengthOfColumn(glm::dvec3 point, glm::dvec3 direction, double column) const
{
  if (!this->HasFalloff())
  {
    return column;
  }
  const double decay = this->Decay(direction);
  const double length = column / this->HeightFactor(point);
  const double x = decay * length;
  return std::abs(x) < 1e-9 ? length : x < 1.0 ? -std::log1p(-x) / decay : Infinity;
}

/// Sums cell by cell. Along a ray, a trilinear function is a polynomial of degree 3 in each cell,
/// which Gauss-Legendre quadrature with two points integrates exactly. With a fall-off, cells are
/// divided into parts that are short compared with the scale height.
double MediumDensity::MarchCells(glm::dvec3 point, glm::dvec3 direction, double length) const
{
  const DensityImage& image = *this->Image;
  const glm::dvec3 high = image.High();
  double near = 0.0;
  double far = length;
  glm::dvec3 next(Infinity); // length at which the ray enters the next cell along each axis
  glm::dvec3 stride(Infinity);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (direction[axis] == 0.0)
    {
      far = point[axis] < image.Low[axis] || point[axis] > high[axis] ? near : far;
      continue;
    }
    const double a = (image.Low[axis] - point[axis]) / direction[axis];
    const double b = (high[axis] - point[axis]) / direction[axis];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
    stride[axis] = image.Spacing[axis] / std::abs(direction[axis]);
  }
  if (!(near < far))
  {
    return 0.0;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    if (direction[axis] != 0.0)
    {
      const double start = direction[axis] > 0.0 ? image.Low[axis] : high[axis];
      const double first = (start - point[axis]) / direction[axis];
      next[axis] = first + stride[axis] * (std::floor((near - first) / stride[axis]) + 1.0);
    }
  }
  const double decay = std::abs(this->Decay(direction));
  double sum = 0.0;
  for (double t = near; t < far;)
  {
    const int axis = next.x <= next.y && next.x <= next.z ? 0 : next.y <= next.z ? 1 : 2;
    const double end = std::min(far, next[axis]);
    next[axis] += stride[axis];
    const int parts = 1 + static_cast<int>(std::min(2.0 * decay * (end - t), 1e4));
    const double half = 0.5 * (end - t) / parts;
    for (int i = 0; i < parts && half > 0.0; ++i)
    {
      const double middle = t + (2 * i + 1) * half;
      const double offset = half / std::sqrt(3.0);
      sum += half *
        (this->At(point + (middle - offset) * direction) +
          this->At(point + (middle + offset) * direction));
    }
    t = std::max(end, std::nextafter(t, Infinity));
  }
  return sum;
}

RayColumn::RayColumn(
  const MediumDensity& density, glm::dvec3 origin, glm::dvec3 direction, double length)
  : Density(density),
    Origin(origin),
    Direction(direction)
{
  if (!density.Image || !(length > 0.0))
  {
    return;
  }
  const glm::dvec3 cells = glm::abs(direction) * length / density.Image->Spacing;
  const double wanted = std::ceil(ColumnsPerPoint * (cells.x + cells.y + cells.z));
  const int count = static_cast<int>(std::clamp(wanted, 1.0, 1e5));
  this->Step = length / count;
  this->Columns.push_back(0.0);
  for (int i = 0; i < count; ++i)
  {
    this->Columns.push_back(this->Columns.back() +
      density.Column(origin + i * this->Step * direction, direction, this->Step));
  }
}

double RayColumn::At(double length) const
{
  if (this->Columns.empty())
  {
    return this->Density.Column(this->Origin, this->Direction, length);
  }
  const double last = static_cast<double>(this->Columns.size() - 1);
  const double index = std::clamp(std::floor(length / this->Step), 0.0, last);
  const double start = index * this->Step;
  return this->Columns[static_cast<std::size_t>(index)] +
    this->Density.Column(
      this->Origin + start * this->Direction, this->Direction, std::max(length - start, 0.0));
}

}
