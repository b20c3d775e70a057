// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Hemicube.h"

#include "Gathering/HemisphereGrid.h"
#include "Shading/HemisphereSampling.h"

#include <algorithm>

namespace penumbra
{
namespace
{

/// Subdivisions of a texel along each side. Each part is assigned to the cell that contains its
/// center.
constexpr int TexelSubdivisions = 4;

/// Rotation of the cube about z, in radians. Edges parallel to x and y are frequent; the rotation
/// prevents them from following rows of texels.
constexpr float Rotation = .35f;

int ComputeCellIndex(float coordinate, int side)
{
  return std::clamp(static_cast<int>(coordinate * static_cast<float>(side)), 0, side - 1);
}

}

Hemicube::Hemicube(int side)
  : Side(side)
{
  const glm::vec3 x(std::cos(Rotation), std::sin(Rotation), 0.f);
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
  for (const Face& face : this->Faces)
  {
    for (int j = 0; j < face.Height; ++j)
    {
      for (int i = 0; i < face.Width; ++i)
      {
        const std::size_t texel =
          static_cast<std::size_t>(face.Y + j) * this->GetWidth() + face.X + i;
        this->Directions[texel] = this->ComputeDirection(face, i, j, { .5f, .5f });
      }
    }
  }
}

glm::vec3 Hemicube::ComputeDirection(const Face& face, int x, int y, glm::vec2 offset) const
{
  const float step = 2.f / static_cast<float>(this->Side);
  const glm::vec2 at = (glm::vec2(x, y) + offset) * step;
  return face.Forward + (at.x - 1.f) * face.Right + (at.y + face.MinimumUp) * face.Up;
}

int Hemicube::FindTexel(glm::vec3 direction) const
{
  const Face& face =
    *std::max_element(this->Faces.begin(), this->Faces.end(), [&](const Face& a, const Face& b) {
      return glm::dot(a.Forward, direction) < glm::dot(b.Forward, direction);
    });
  const glm::vec3 w = direction / glm::dot(face.Forward, direction);
  const float scale = .5f * static_cast<float>(this->Side);
  const int x = static_cast<int>(scale * (glm::dot(face.Right, w) + 1.f));
  const int y = static_cast<int>(scale * (glm::dot(face.Up, w) - face.MinimumUp));
  return (face.Y + std::clamp(y, 0, face.Height - 1)) * this->GetWidth() + face.X +
    std::clamp(x, 0, face.Width - 1);
}

Hemicube::Cells Hemicube::MapToGrid(const HemisphereGrid& grid) const
{
  std::vector<std::vector<TexelWeight>> weights(grid.Cells());
  for (const Face& face : this->Faces)
  {
    for (int j = 0; j < face.Height; ++j)
    {
      for (int i = 0; i < face.Width; ++i)
      {
        const int texel = (face.Y + j) * this->GetWidth() + face.X + i;
        for (int k = 0; k < TexelSubdivisions * TexelSubdivisions; ++k)
        {
          const glm::vec2 offset = (glm::vec2(k % TexelSubdivisions, k / TexelSubdivisions) + .5f) /
            static_cast<float>(TexelSubdivisions);
          const glm::vec3 w = this->ComputeDirection(face, i, j, offset);
          const float square = glm::dot(w, w);
          const glm::vec2 at = InvertUniformDiskConcentric(glm::vec2(w) / std::sqrt(square));
          std::vector<TexelWeight>& weightsOfCell =
            weights[ComputeCellIndex(at.y, grid.Side) * grid.Side +
              ComputeCellIndex(at.x, grid.Side)];
          if (weightsOfCell.empty() || weightsOfCell.back().Texel != texel)
          {
            weightsOfCell.push_back({ texel, 0.f });
          }
          weightsOfCell.back().Weight += w.z / (square * square);
        }
      }
    }
  }
  Cells cells;
  for (int cell = 0; cell < grid.Cells(); ++cell)
  {
    cells.First.push_back(cells.Texels.size());
    if (weights[cell].empty()) // the cell is smaller than a texel: use the nearest one
    {
      const glm::vec2 corner(cell % grid.Side, cell / grid.Side);
      const glm::vec2 center = (corner + .5f) / static_cast<float>(grid.Side);
      const glm::vec3 w = DiskToHemisphere(SampleUniformDiskConcentric(center.x, center.y));
      const auto cosine = [&](glm::vec3 d) { return glm::dot(d, w) / glm::length(d); };
      const auto nearest = std::max_element(this->Directions.begin(), this->Directions.end(),
        [&](glm::vec3 a, glm::vec3 b) { return cosine(a) < cosine(b); });
      weights[cell].push_back({ static_cast<int>(nearest - this->Directions.begin()), 1.f });
    }
    float sum = 0.f;
    for (const TexelWeight& texel : weights[cell])
    {
      sum += texel.Weight;
    }
    for (const TexelWeight& texel : weights[cell])
    {
      cells.Texels.push_back({ texel.Texel, texel.Weight / sum });
    }
  }
  cells.First.push_back(cells.Texels.size());
  return cells;
}

}
