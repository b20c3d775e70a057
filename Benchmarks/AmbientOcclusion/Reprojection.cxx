// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Reprojection.h"

#include "vtkCamera.h"
#include "vtkMatrix4x4.h"

#include <cmath>
#include <limits>

namespace penumbra
{

namespace
{

/// Relative distance from the point within which a pixel shows the same surface.
constexpr double SameSurface = .005;

constexpr double Unseen = std::numeric_limits<double>::quiet_NaN();

}

Reprojection::Reprojection(int width, int height)
  : Width(width),
    Height(height)
{
}

void Reprojection::Add(vtkCamera* camera, std::vector<float> values, std::vector<float> depths)
{
  const double aspect = static_cast<double>(this->Width) / this->Height;
  const vtkMatrix4x4* matrix = camera->GetCompositeProjectionTransformMatrix(aspect, -1.0, 1.0);
  glm::dmat4 worldToClip;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      worldToClip[column][row] = matrix->GetElement(row, column);
    }
  }
  this->Frames.push_back({ worldToClip, std::move(values), std::move(depths) });
}

glm::dvec4 Reprojection::Position(const Frame& frame, int i, int j) const
{
  // In perspective, clip w is the eye depth: three equations for the three coordinates.
  const glm::dmat4 rows = glm::transpose(frame.WorldToClip);
  const double depth = frame.Depths[static_cast<std::size_t>(j) * this->Width + i];
  const glm::dvec3 clip(depth * (2.0 * (i + .5) / this->Width - 1.0),
    depth * (2.0 * (j + .5) / this->Height - 1.0), depth);
  const glm::dmat3 matrix =
    glm::transpose(glm::dmat3(glm::dvec3(rows[0]), glm::dvec3(rows[1]), glm::dvec3(rows[3])));
  const glm::dvec3 offset(rows[0].w, rows[1].w, rows[3].w);
  return glm::dvec4(glm::inverse(matrix) * (clip - offset), 1.0);
}

double Reprojection::ValueAt(const Frame& frame, glm::dvec4 position) const
{
  const glm::dvec4 clip = frame.WorldToClip * position;
  const double x = .5 * (clip.x / clip.w + 1.0) * this->Width - .5;
  const double y = .5 * (clip.y / clip.w + 1.0) * this->Height - .5;
  const int i = static_cast<int>(std::floor(x));
  const int j = static_cast<int>(std::floor(y));
  if (i < 0 || j < 0 || i + 1 >= this->Width || j + 1 >= this->Height)
  {
    return Unseen;
  }
  double value = 0.0;
  for (int tap = 0; tap < 4; ++tap)
  {
    const int right = tap % 2;
    const int up = tap / 2;
    const std::size_t at = static_cast<std::size_t>(j + up) * this->Width + i + right;
    if (!(std::abs(frame.Depths[at] - clip.w) < SameSurface * clip.w))
    {
      return Unseen;
    }
    value += (right ? x - i : i + 1 - x) * (up ? y - j : j + 1 - y) * frame.Values[at];
  }
  return value;
}

double Reprojection::StandardDeviation() const
{
  const double count = static_cast<double>(this->Frames.size());
  double total = 0.0;
  double points = 0.0;
  for (int j = 0; j < this->Height; ++j)
  {
    for (int i = 0; i < this->Width; ++i)
    {
      if (!std::isfinite(
            this->Frames.front().Depths[static_cast<std::size_t>(j) * this->Width + i]))
      {
        continue;
      }
      const glm::dvec4 position = this->Position(this->Frames.front(), i, j);
      double sum = 0.0;
      double squares = 0.0;
      for (const Frame& frame : this->Frames)
      {
        const double value = this->ValueAt(frame, position);
        sum += value;
        squares += value * value;
      }
      const double variance = squares / count - sum * sum / (count * count);
      if (!std::isnan(variance))
      {
        total += std::max(variance, 0.0);
        points += 1.0;
      }
    }
  }
  return points > 0.0 ? std::sqrt(total / points) : 0.0;
}

}
