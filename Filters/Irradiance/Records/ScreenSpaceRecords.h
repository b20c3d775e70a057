// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Screen-space cache [IC]: records at the corners of image squares, which are subdivided until the
// corners predict the values between them. Only visible surfaces have records.
#ifndef penumbra_ScreenSpaceRecords_h
#define penumbra_ScreenSpaceRecords_h

#include "RecordPlacement.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

class RayScene;

class ScreenSpaceRecords
{
public:
  /// The sides of squares are between the minimum and maximum radius of `settings`. `rays` and
  /// `placement` must outlive this object.
  ScreenSpaceRecords(const RayScene& rays, const RecordPlacement& placement,
    const RecordPlacementSettings& settings, float normalAngle);

  /// Makes all records of the image. Returns false if `progress` requested a stop.
  bool PlaceLevels(const ProgressCallback& progress);

  InterpolationResult LookUp(const ShadingPoint& point) const;

  const std::vector<Record>& GetRecords() const { return this->Records; }
  std::size_t GetBytes() const;
  long long GetRays() const { return this->Rays; }

private:
  /// Square of the image, in units of the finest squares.
  struct Square
  {
    glm::ivec2 Low;
    int Side;
  };

  std::size_t CornerAt(glm::ivec2 corner) const;
  glm::dvec2 PixelAt(glm::dvec2 corner) const { return double(this->Unit) * corner + .5; }

  bool MakeRecords(const std::vector<Square>& squares, const ProgressCallback& progress);

  /// Returns true if the visible point at the center of `square` has no record of sufficient
  /// weight.
  bool NeedsSubdivision(const Square& square) const;

  /// Finds the records at the four corners of the square of `side` around `at`, in units of the
  /// finest squares; null for a corner without a record.
  void FindCorners(glm::dvec2 at, int side, const Record* (&corners)[4]) const;

  const RayScene& Seen;
  const RecordPlacement& Placement;
  float NormalFactor;
  int Unit = 1;     ///< side of a finest square in pixels
  int Coarsest = 1; ///< side of a coarsest square in finest squares
  glm::ivec2 Size;  ///< image size in finest squares, rounded up to coarsest squares

  /// Record at each corner of the finest squares, row by row; Unknown or Nothing if there is none.
  std::vector<std::int32_t> Corners;

  std::vector<std::uint8_t> Sides; ///< per finest square, side of the square that contains it
  std::vector<Record> Records;
  long long Rays = 0;
};

}
#endif
