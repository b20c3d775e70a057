// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Hemicube.h"

#include "Gathering/HemisphereGrid.h"
#include "Shading/HemisphereSampling.h"

#include <algorithm>
#include <limits>

namespace penumbra
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

/// Parts along each side of a texel, which go to the cell that their middle looks through.
constexpr int PartsAlong = 4;

/// Borders along x and y are the likeliest; turned by so many radians about z, they cut texels evenly
/// instead of following their rows.
constexpr float Turn = .35f;

/// Share of the rectangle from the axis to (u, v), square to the axis at distance 1, the axis being the
/// normal: the closed form of a differential area's form factor.
double ShareAhead(double u, double v)
{
  const double a = std::sqrt(1.0 + u * u);
  const double b = std::sqrt(1.0 + v * v);
  return (u / a * std::atan(v / a) + v / b * std::atan(u / b)) / (2.0 * Pi);
}

/// The same where the normal is the direction of z.
double ShareAside(double u, double z)
{
  const double a = std::sqrt(1.0 + z * z);
  return (std::atan(u) - std::atan(u / a) / a) / (2.0 * Pi);
}

template <typename Corner>
double ShareOf(const Corner& corner, glm::dvec2 low, glm::dvec2 high)
{
  return corner(high.x, high.y) - corner(low.x, high.y) - corner(high.x, low.y) +
    corner(low.x, low.y);
}

int CellAlong(float at, int side)
{
  return std::clamp(static_cast<int>(at * static_cast<float>(side)), 0, side - 1);
}

}

Hemicube::Hemicube(int side)
  : Side(side)
{
  const glm::vec3 x(std::cos(Turn), std::sin(Turn), 0.f);
  const glm::vec3 y(-x.y, x.x, 0.f);
  const glm::vec3 z(0.f, 0.f, 1.f);
  const int half = side / 2;
  this->Faces = { {
    { y, x, z, -1.f, 0, 0, side, side },
    { -y, z, x, 0.f, side, 0, side, half },
    { y, z, -x, 0.f, side, half, side, half },
    { x, z, y, 0.f, 2 * side, 0, side, half },
    { -x, z, -y, 0.f, 2 * side, half, side, half },
  } };
  const auto texels = static_cast<std::size_t>(this->GetWidth()) * this->GetHeight();
  this->Directions.resize(texels);
  this->Shares.resize(texels);
  const double step = 2.0 / side;
  for (const Face& face : this->Faces)
  {
    const bool top = face.MinimumUp < 0.f;
    for (int j = 0; j < face.Height; ++j)
    {
      for (int i = 0; i < face.Width; ++i)
      {
        const std::size_t texel =
          static_cast<std::size_t>(face.Y + j) * this->GetWidth() + face.X + i;
        const glm::dvec2 low(-1.0 + i * step, face.MinimumUp + j * step);
        const glm::dvec2 high = low + step;
        this->Directions[texel] = this->LookAlong(face, i, j, { .5f, .5f });
        this->Shares[texel] =
          static_cast<float>(top ? ShareOf(ShareAhead, low, high) : ShareOf(ShareAside, low, high));
      }
    }
  }
}

glm::vec3 Hemicube::LookAlong(const Face& face, int x, int y, glm::vec2 within) const
{
  const float step = 2.f / static_cast<float>(this->Side);
  const glm::vec2 at = (glm::vec2(x, y) + within) * step;
  return face.Forward + (at.x - 1.f) * face.Right + (at.y + face.MinimumUp) * face.Up;
}

Hemicube::Cells Hemicube::MapToGrid(const HemisphereGrid& grid) const
{
  std::vector<std::vector<TexelWeight>> parts(grid.Cells());
  for (const Face& face : this->Faces)
  {
    for (int j = 0; j < face.Height; ++j)
    {
      for (int i = 0; i < face.Width; ++i)
      {
        const int texel = (face.Y + j) * this->GetWidth() + face.X + i;
        for (int k = 0; k < PartsAlong * PartsAlong; ++k)
        {
          const glm::vec2 within =
            (glm::vec2(k % PartsAlong, k / PartsAlong) + .5f) / static_cast<float>(PartsAlong);
          const glm::vec3 w = this->LookAlong(face, i, j, within);
          const float square = glm::dot(w, w);
          const glm::vec2 at = InvertUniformDiskConcentric(glm::vec2(w) / std::sqrt(square));
          std::vector<TexelWeight>& of =
            parts[CellAlong(at.y, grid.Side) * grid.Side + CellAlong(at.x, grid.Side)];
          if (of.empty() || of.back().Texel != texel)
          {
            of.push_back({ texel, 0.f });
          }
          of.back().Share += w.z / (square * square);
        }
      }
    }
  }
  Cells cells;
  for (int cell = 0; cell < grid.Cells(); ++cell)
  {
    cells.First.push_back(cells.Parts.size());
    if (parts[cell].empty()) // smaller than a texel
    {
      const glm::vec2 at(cell % grid.Side, cell / grid.Side);
      const glm::vec2 middle = (at + .5f) / static_cast<float>(grid.Side);
      const glm::vec3 w = DiskToHemisphere(SampleUniformDiskConcentric(middle.x, middle.y));
      const auto cosine = [&](glm::vec3 d) { return glm::dot(d, w) / glm::length(d); };
      const auto nearest = std::max_element(this->Directions.begin(), this->Directions.end(),
        [&](glm::vec3 a, glm::vec3 b) { return cosine(a) < cosine(b); });
      parts[cell].push_back({ static_cast<int>(nearest - this->Directions.begin()), 1.f });
    }
    float sum = 0.f;
    for (const TexelWeight& part : parts[cell])
    {
      sum += part.Share;
    }
    for (const TexelWeight& part : parts[cell])
    {
      cells.Parts.push_back({ part.Texel, part.Share / sum });
    }
  }
  cells.First.push_back(cells.Parts.size());
  return cells;
}

}
