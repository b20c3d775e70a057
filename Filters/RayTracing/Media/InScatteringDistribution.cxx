// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "InScatteringDistribution.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

// Pieces of a table: at equal angles seen from the light, and at equal losses seen from the eye.
constexpr int PiecesByAngle = 16;
constexpr int PiecesByLoss = 8;
// What is left of light after so many mean free paths is nothing: e^-18 = 1.5e-8.
constexpr double EndOfSight = 18.0;
// Nearer than this share of the ray's length no ray passes a light.
constexpr double NearestPass = 1e-6;

/// The integral of exp(-slope t) over [0, length], length possibly infinite.
double Decay(double slope, double length)
{
  const double x = slope * length;
  return std::abs(x) < 1e-9 ? length : -std::expm1(-x) / slope;
}

}

LightDirection DirectionToLight(const Light& light, glm::dvec3 point)
{
  LightDirection way;
  if (light.Kind == Light::Kinds::Directional)
  {
    way.Direction = -glm::dvec3(light.Direction);
    return way;
  }
  const glm::dvec3 path = glm::dvec3(light.Position) - point;
  way.Distance = glm::length(path);
  way.Direction = path / std::max(way.Distance, 1e-300);
  way.InCone = light.Kind != Light::Kinds::Spot ||
    glm::dot(way.Direction, -glm::dvec3(light.Direction)) >= light.ConeCosine;
  return way;
}

InScatteringDistribution::InScatteringDistribution(const Medium& medium, const Light& light,
  glm::dvec3 origin, glm::dvec3 direction, double from, double to)
  : Fog(medium),
    Source(light),
    Origin(origin),
    Direction(direction),
    From(from),
    To(medium.Extinction > 0.0 ? std::min(to, from + EndOfSight / medium.Extinction) : to)
{
  if (!(this->Fog.Scattering > 0.0) || !(this->To > this->From) || !std::isfinite(this->To))
  {
    return;
  }
  if (light.Kind == Light::Kinds::Directional)
  {
    this->AddExactPieces();
  }
  else
  {
    this->AddTabulatedPieces();
  }
}

/// Scattered towards the eye per unit of length.
double InScatteringDistribution::Density(double t) const
{
  const glm::dvec3 point = this->Origin + t * this->Direction;
  const LightDirection way = DirectionToLight(this->Source, point);
  double inside = std::min(this->Fog.DistanceToExit(point, way.Direction), way.Distance);
  // The light of a source infinitely far in a medium without end is told as it arrives here.
  inside = std::isfinite(inside) ? inside : 0.0;
  double strength = 1.0;
  if (this->Source.Kind != Light::Kinds::Directional)
  {
    const glm::dvec3 a(this->Source.Attenuation);
    strength = 1.0 / std::max(a.x + way.Distance * (a.y + way.Distance * a.z), 1e-30);
    if (this->Source.Kind == Light::Kinds::Spot)
    {
      const double cosine = glm::dot(way.Direction, -glm::dvec3(this->Source.Direction));
      strength *= std::pow(std::max(cosine, 0.0), static_cast<double>(this->Source.Exponent));
    }
  }
  const double cosine = glm::dot(way.Direction, this->Direction);
  return strength * this->Fog.Scattering * this->Fog.PhaseFunction(cosine) *
    std::exp(-this->Fog.Extinction * (t - this->From + inside));
}

void InScatteringDistribution::AddPiece(double begin, double end, double slope, double weight)
{
  this->Pieces.push_back({ begin, end - begin, slope, this->Sum, weight });
  this->Sum += weight;
}

// The way to the light ends at the nearest of three faces of the medium, and the way to each of
// them is linear along the ray: pieces end where two of them are equally far.
void InScatteringDistribution::AddExactPieces()
{
  const glm::dvec3 towards = -glm::dvec3(this->Source.Direction);
  glm::dvec3 distances(std::numeric_limits<double>::infinity());
  glm::dvec3 changes(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (towards[axis] != 0.0)
    {
      const double face = towards[axis] > 0.0 ? this->Fog.High[axis] : this->Fog.Low[axis];
      distances[axis] = (face - this->Origin[axis]) / towards[axis];
      changes[axis] = -this->Direction[axis] / towards[axis];
    }
  }
  std::vector<double> ends{ this->From, this->To };
  for (int axis = 0; axis < 3; ++axis)
  {
    const int next = (axis + 1) % 3;
    const double t = (distances[next] - distances[axis]) / (changes[axis] - changes[next]);
    if (t > this->From && t < this->To)
    {
      ends.push_back(t);
    }
  }
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
  {
    const double middle = 0.5 * (ends[i] + ends[i + 1]);
    int nearest = 0;
    for (int axis = 1; axis < 3; ++axis)
    {
      nearest =
        distances[axis] + middle * changes[axis] < distances[nearest] + middle * changes[nearest]
        ? axis
        : nearest;
    }
    const double change = std::isfinite(distances[nearest]) ? changes[nearest] : 0.0;
    const double slope = this->Fog.Extinction * (1.0 + change);
    // From the middle, where the nearest face is beyond doubt, back to the beginning.
    const double first = this->Density(middle) * std::exp(slope * (middle - ends[i]));
    this->AddPiece(ends[i], ends[i + 1], slope, first * Decay(slope, ends[i + 1] - ends[i]));
  }
}

void InScatteringDistribution::AddTabulatedPieces()
{
  const glm::dvec3 towards = glm::dvec3(this->Source.Position) - this->Origin;
  const double closest = glm::dot(towards, this->Direction);
  const double pass = std::max(
    glm::length(towards - closest * this->Direction), NearestPass * (this->To - this->From));
  const double low = std::atan((this->From - closest) / pass);
  const double high = std::atan((this->To - closest) / pass);
  const double loss = -std::expm1(-this->Fog.Extinction * (this->To - this->From));

  std::vector<double> ends{ this->From, this->To };
  for (int i = 1; i < PiecesByAngle; ++i)
  {
    ends.push_back(closest + pass * std::tan(low + (high - low) * i / PiecesByAngle));
  }
  for (int i = 1; i < PiecesByLoss; ++i)
  {
    const double share = static_cast<double>(i) / PiecesByLoss;
    ends.push_back(loss > 1e-6 ? this->From - std::log1p(-share * loss) / this->Fog.Extinction
                               : this->From + share * (this->To - this->From));
  }
  std::sort(ends.begin(), ends.end());
  for (double& end : ends)
  {
    end = std::clamp(end, this->From, this->To);
  }
  double density = this->Density(this->From);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
  {
    const double length = ends[i + 1] - ends[i];
    if (!(length > 0.0))
    {
      continue;
    }
    const double next = this->Density(ends[i + 1]);
    // Gauss and Legendre's three points.
    const double middle = ends[i] + 0.5 * length;
    const double aside = 0.5 * length * std::sqrt(0.6);
    const double weight = length / 18.0 *
      (5.0 * this->Density(middle - aside) + 8.0 * this->Density(middle) +
        5.0 * this->Density(middle + aside));
    const bool falls = density > 0.0 && next > 0.0;
    this->AddPiece(ends[i], ends[i + 1], falls ? std::log(density / next) / length : 0.0, weight);
    density = next;
  }
}

double InScatteringDistribution::CDF(double t) const
{
  if (!(this->Sum > 0.0))
  {
    return 0.0;
  }
  const auto after = std::upper_bound(this->Pieces.begin(), this->Pieces.end(), t,
    [](double place, const Segment& piece) { return place < piece.Begin; });
  if (after == this->Pieces.begin())
  {
    return 0.0;
  }
  const Segment& piece = *(after - 1);
  const double into = std::clamp(t - piece.Begin, 0.0, piece.Length);
  const double part = piece.Weight * Decay(piece.Slope, into) / Decay(piece.Slope, piece.Length);
  return (piece.Before + part) / this->Sum;
}

double InScatteringDistribution::InvertCDF(double share) const
{
  const double wanted = share * this->Sum;
  const auto after = std::upper_bound(this->Pieces.begin(), this->Pieces.end(), wanted,
    [](double amount, const Segment& piece) { return amount < piece.Before; });
  if (after == this->Pieces.begin())
  {
    return this->From;
  }
  const Segment& piece = *(after - 1);
  if (!(piece.Weight > 0.0))
  {
    return piece.Begin;
  }
  const double part = std::clamp((wanted - piece.Before) / piece.Weight, 0.0, 1.0);
  const double x = piece.Slope * piece.Length;
  const double into =
    std::abs(x) < 1e-9 ? part * piece.Length : -std::log1p(part * std::expm1(-x)) / piece.Slope;
  return piece.Begin + std::clamp(into, 0.0, piece.Length);
}

}
