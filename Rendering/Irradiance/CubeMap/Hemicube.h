// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The upper half of a cube about a point, as one picture: `side` x `side` texels look up, half as many
// look to each of four sides. What of it never changes: where texels look, what each counts.
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
  /// One square or half of one, seen at right angles. Axes are local: the middle of the cube is the
  /// origin, its top looks along +z; Right, Up and against Ahead are a right-handed system.
  struct Face
  {
    glm::vec3 Right;
    glm::vec3 Up;
    glm::vec3 Forward;
    float MinimumUp; ///< along Up, of what is seen at distance 1 along Ahead; the most is 1
    int X;           ///< of its first texel in the picture
    int Y;
    int Width; ///< texels
    int Height;
  };

  /// `side`: even.
  explicit Hemicube(int side);

  int GetWidth() const { return 3 * this->Side; }
  int GetHeight() const { return this->Side; }
  const std::array<Face, 5>& GetFaces() const { return this->Faces; }

  /// Where the middle of each texel looks, local; of length 1 along its face's Ahead.
  const std::vector<glm::vec3>& GetDirections() const { return this->Directions; }

  /// 1/pi times the integral of the cosine over the solid angle of each texel, exactly: their sum is 1.
  const std::vector<float>& GetFormFactors() const { return this->Shares; }

  /// A texel and what share of a cell it fills.
  struct TexelWeight
  {
    int Texel;
    float Share;
  };
  /// The parts of cell i are from First[i] on to before First[i + 1]; their shares add up to 1.
  struct Cells
  {
    std::vector<TexelWeight> Parts;
    std::vector<std::size_t> First;
  };
  /// What fills the cells of `grid`. Every cell has a part.
  Cells MapToGrid(const HemisphereGrid& grid) const;

private:
  /// The middle of part (i, j) of so many along each side of a texel; length 1 along Ahead.
  glm::vec3 LookAlong(const Face& face, int x, int y, glm::vec2 within) const;

  int Side;
  std::array<Face, 5> Faces;
  std::vector<glm::vec3> Directions;
  std::vector<float> Shares;
};

}
#endif
