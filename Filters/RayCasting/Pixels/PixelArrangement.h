// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Arrangement of projected edges in one pixel: a slab decomposition into trapezoids, which are
// joined to faces. Areas are exact up to rounding.
#ifndef penumbra_PixelArrangement_h
#define penumbra_PixelArrangement_h

#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro

#include <glm/glm.hpp>

#include <cstddef>
#include <limits>
#include <vector>

namespace penumbra
{

/// A line segment in pixel coordinates; the pixel is [0, 1] x [0, 1].
struct PixelSegment
{
  glm::dvec2 A;
  glm::dvec2 B;
};

/// Clips a segment to the unit square. Returns false if nothing or only a point is left.
VTKPENUMBRAFILTERSRAYCASTING_EXPORT bool ClipToPixel(PixelSegment& segment);

/// Subdivision of a pixel into faces by line segments.
class VTKPENUMBRAFILTERSRAYCASTING_EXPORT PixelArrangement
{
public:
  /// Trapezoid with vertical sides: x of the left and right side, y of bottom and top at both.
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
    /// Returns the point at relative coordinates u (along x) and v (from bottom to top), in [0, 1].
    glm::dvec2 At(double u, double v) const
    {
      const double bottom = this->Bottom0 + u * (this->Bottom1 - this->Bottom0);
      const double top = this->Top0 + u * (this->Top1 - this->Top0);
      return { this->X0 + u * (this->X1 - this->X0), bottom + v * (top - bottom) };
    }
    glm::dvec2 Centroid() const;
  };

  /// A connected part of the pixel that no segment crosses.
  struct Face
  {
    double Area = 0.0;
    glm::dvec2 Point{ 0.0 };  ///< a point strictly inside; the centroid if that is inside
    double Offset = 0.0;      ///< distance from Point to the centroid
    unsigned int Corners = 0; ///< bit i is set if the face contains corner (i & 1, i >> 1)
  };

  /// Maximum numbers of crossings and trapezoids.
  struct Limits
  {
    std::size_t Crossings = std::numeric_limits<std::size_t>::max();
    std::size_t Trapezoids = std::numeric_limits<std::size_t>::max();
  };

  /// Cuts the pixel by `count` segments, each inside the unit square (ClipToPixel()). Returns false
  /// if a limit is exceeded; the arrangement is then undefined.
  bool Build(const PixelSegment* segments, int count, const Limits& limits);
  void Build(const PixelSegment* segments, int count) { this->Build(segments, count, Limits()); }

  const std::vector<Face>& GetFaces() const { return this->Faces; }
  const std::vector<Trapezoid>& GetTrapezoids() const { return this->Trapezoids; }

  /// Returns the index of the face that contains a point of the pixel.
  int FindFaceAt(glm::dvec2 p) const;

  /// Calls visit(trapezoid) for the trapezoids of a face in ascending order.
  template <typename Visit>
  void VisitTrapezoids(std::size_t face, Visit visit) const
  {
    for (int i = this->FaceBegin[face]; i < this->FaceBegin[face + 1]; ++i)
    {
      visit(this->Trapezoids[this->TrapezoidsByFace[i]]);
    }
  }

private:
  const PixelSegment* MakeVertical(const PixelSegment* segments, int count);
  bool CollectEvents(const PixelSegment* segments, int count, std::size_t maximumCrossings);
  bool CutSlabs(const PixelSegment* segments, int count, std::size_t maximumTrapezoids);
  void JoinSlabs(const PixelSegment* segments, int count);
  void CollectFaces();
  void ListTrapezoids();
  int FindFaceInSlab(std::size_t slab, glm::dvec2 p) const;
  int FindRoot(int trapezoid);
  int FindFace(glm::dvec2 p) const;

  /// Height of a segment at the center, left and right side of a slab.
  struct Crossing
  {
    double Center, Left, Right;
  };

  std::vector<PixelSegment> Vertical; ///< segments without steep ones
  std::vector<double> Events;
  std::vector<int> SlabBegin; ///< first trapezoid of each slab, and the end
  std::vector<Trapezoid> Trapezoids;
  std::vector<int> Parent;
  std::vector<Face> Faces;
  std::vector<int> FaceBegin;        ///< first entry of each face in TrapezoidsByFace, and the end
  std::vector<int> TrapezoidsByFace; ///< indices of trapezoids, grouped by face
  std::vector<Crossing> Crossings;
  std::vector<glm::dvec2> Barriers;
};

}
#endif
