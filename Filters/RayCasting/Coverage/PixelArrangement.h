// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The pieces into which projected edges cut one pixel: a slab decomposition into trapezoids, which
// are joined to faces. Areas are exact up to rounding.
#ifndef penumbra_PixelArrangement_h
#define penumbra_PixelArrangement_h

#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro

#include <glm/glm.hpp>

#include <vector>

namespace penumbra
{

/// A straight piece of an edge in pixel coordinates, the pixel being [0, 1] x [0, 1].
struct PixelSegment
{
  glm::dvec2 A;
  glm::dvec2 B;
};

/// Clips a segment to the unit square; false when nothing (or only a point) is left.
VTKPENUMBRAFILTERSRAYCASTING_EXPORT bool ClipToPixel(PixelSegment& segment);

class VTKPENUMBRAFILTERSRAYCASTING_EXPORT PixelArrangement
{
public:
  /// Left and right x, and the y of bottom and top at both.
  struct Trapezoid
  {
    double X0, X1;
    double Bottom0, Bottom1;
    double Top0, Top1;
    int Face;

    double Area() const
    {
      return 0.5 * (this->X1 - this->X0) *
        ((this->Top0 - this->Bottom0) + (this->Top1 - this->Bottom1));
    }
    /// The point at relative coordinates u (along x) and v (from bottom to top).
    glm::dvec2 At(double u, double v) const
    {
      const double bottom = this->Bottom0 + u * (this->Bottom1 - this->Bottom0);
      const double top = this->Top0 + u * (this->Top1 - this->Top0);
      return { this->X0 + u * (this->X1 - this->X0), bottom + v * (top - bottom) };
    }
    glm::dvec2 Centroid() const;
  };

  /// A connected piece of the pixel that no segment crosses.
  struct Face
  {
    double Area = 0.0;
    glm::dvec2 Point{ 0.0 };  ///< strictly inside: the centroid, where that lies inside
    double Offset = 0.0;      ///< distance from Point to the centroid
    unsigned int Corners = 0; ///< bit i: contains corner (i & 1, i >> 1) of the pixel
  };

  /// Cuts the pixel by `count` segments, each inside the unit square (ClipToPixel).
  void Build(const PixelSegment* segments, int count);

  const std::vector<Face>& GetFaces() const { return this->Faces; }
  const std::vector<Trapezoid>& GetTrapezoids() const { return this->Trapezoids; }

private:
  void CollectEvents(const PixelSegment* segments, int count);
  void CutSlabs(const PixelSegment* segments, int count);
  void JoinSlabs(const PixelSegment* segments, int count);
  void CollectFaces();
  int Root(int trapezoid);
  int FaceAt(glm::dvec2 p) const;

  struct Crossing
  {
    double Middle, Left, Right;
  };

  std::vector<double> Events;
  std::vector<int> SlabBegin; ///< first trapezoid of each slab, and the end
  std::vector<Trapezoid> Trapezoids;
  std::vector<int> Parent;
  std::vector<Face> Faces;
  std::vector<Crossing> Crossings;
  std::vector<glm::dvec2> Barriers;
};

}
#endif
