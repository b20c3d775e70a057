// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The cache of screen space [IC]: records at the corners of squares of the picture, squares halved until
// their corners say what lies between. It knows what the picture sees first, and nothing else.
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
  /// Squares are between `settings`' least and greatest radius wide. `rays` and `places` must outlive
  /// this object.
  ScreenSpaceRecords(const RayScene& rays, const RecordPlacement& places,
    const RecordPlacementSettings& settings, float normalAngle);

  /// All records of the picture. False when `progress` stopped it.
  bool PlaceLevels(const ProgressCallback& progress);

  InterpolationResult LookUp(const ShadingPoint& place) const;

  const std::vector<Record>& GetRecords() const { return this->Records; }
  std::size_t GetBytes() const;
  long long GetRays() const { return this->Rays; }

private:
  /// A square of the picture, in units of the finest ones.
  struct Square
  {
    glm::ivec2 Low;
    int Side;
  };

  std::size_t CornerAt(glm::ivec2 corner) const;
  glm::dvec2 PixelAt(glm::dvec2 corner) const { return double(this->Unit) * corner + .5; }

  bool MakeRecords(const std::vector<Square>& squares, const ProgressCallback& progress);

  /// Does what the picture sees in the middle of `square` lack a record?
  bool NeedsSubdivision(const Square& square) const;

  /// The four corners of the square around `at` (finest units) that is `side` wide; null: no record.
  void FindCorners(glm::dvec2 at, int side, const Record* (&corners)[4]) const;

  const RayScene& Seen;
  const RecordPlacement& Places;
  float NormalFactor;
  int Unit = 1;     ///< pixels along a finest square
  int Coarsest = 1; ///< finest squares along a coarsest one
  glm::ivec2 Size;  ///< in finest squares, whole coarsest ones
  std::vector<std::int32_t>
    Corners; ///< of the finest squares, row by row: records, or why there is none
  std::vector<std::uint8_t> Sides; ///< of the finest squares: how wide the square around is
  std::vector<Record> Records;
  long long Rays = 0;
};

}
#endif
