// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Hemicube around a point, packed into one image: the top face has `side` x `side` texels, each of
// the four side faces has half as many. Holds the constant data: directions and form factors of the
// texels.
#ifndef penumbra_Hemicube_h
#define penumbra_Hemicube_h

#include "vtkPenumbraRenderingIrradianceModule.h" // for export macro, which tests need

#include <glm/glm.hpp>

#include <array>
#include <vector>

namespace penumbra
{

struct HemisphereGrid;

class VTKPENUMBRARENDERINGIRRADIANCE_EXPORT Hemicube
{
public:
  /// A full or half face with its view frustum. Axes are local: the origin is the center of the
  /// cube, and the top face is viewed along +z. Right, Up and -Forward form a right-handed system.
  struct Face
  {
    glm::vec3 Right;
    glm::vec3 Up;
    glm::vec3 Forward;
    float MinimumUp; ///< lower edge along Up, at distance 1 along Forward; the upper edge is 1
    int X;           ///< column of its first texel in the image
    int Y;           ///< row of its first texel
    int Width;       ///< texels
    int Height;
  };

  /// `side`: width of the top face in texels, even.
  explicit Hemicube(int side);

  int GetWidth() const { return 3 * this->Side; }
  int GetHeight() const { return this->Side; }
  const std::array<Face, 5>& GetFaces() const { return this->Faces; }

  /// Local direction of each texel center; its component along Forward of its face is 1.
  const std::vector<glm::vec3>& GetDirections() const { return this->Directions; }

  /// Returns the texel in a local direction, whose z is not negative.
  int FindTexel(glm::vec3 direction) const;

  /// A texel and the fraction of a cell that it covers, weighted by the cosine.
  struct TexelWeight
  {
    int Texel;
    float Weight;
  };
  /// Cell i has the texels [First[i], First[i + 1]); their weights sum to 1.
  struct Cells
  {
    std::vector<TexelWeight> Texels;
    std::vector<std::size_t> First;
  };
  /// Computes the texels of the cells of `grid`. Every cell has at least one.
  Cells MapToGrid(const HemisphereGrid& grid) const;

private:
  /// Local direction of a point in texel (x, y); `offset` is in [0, 1] x [0, 1]. Its component
  /// along Forward is 1.
  glm::vec3 ComputeDirection(const Face& face, int x, int y, glm::vec2 offset) const;

  int Side;
  std::array<Face, 5> Faces;
  std::vector<glm::vec3> Directions;
};

}
#endif
