// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Input of baking, extracted from a data set: the occluding surface and the query points.
#ifndef penumbra_BakeInput_h
#define penumbra_BakeInput_h

#include "Records/RecordPlacement.h"
#include "Scene.h"
#include "Surface.h"

#include "vtkBoundingBox.h"
#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

class vtkPointSet;
class vtkPolyData;

namespace penumbra
{

class RankAgreement;

struct BakeInputOptions
{
  bool OnCells = false;        ///< if true, bake at cell centers instead of points
  bool ComputeNormals = false; ///< if true, ignore normals of the data set
  std::string OpacityArray;    ///< point array of opacities in [0, 1]; empty: opaque
  double PointRadius = 0.0; ///< of disks for points without polygons, and of spheres; world units
  double LineRadius = 0.0;  ///< of tubes along lines, world units
  RankAgreement* Ranks = nullptr; ///< that have parts of the data; null: this one has all
};

struct BakeInput
{
  Scene OccluderScene;                        ///< centered on the data set
  std::vector<RecordCandidate> Sites;         ///< query points, with the bounds of records
  std::vector<vtkIdType> Ids;                 ///< point or cell of the data set of each query point
  std::vector<float> Weights;                 ///< of the query points of one id; empty: equal
  std::vector<std::string> SkippedAttributes; ///< one message per attribute of invalid size
  vtkIdType Unused = 0;    ///< points without a cell or cells without area, not baked
  vtkIdType NotFinite = 0; ///< points or normals that are not finite, not baked

  /// Points whose polygons face opposite sides. Their query points have the normal 0 until
  /// SeparateContacts().
  vtkIdType TwoSided = 0;
  vtkIdType DoubledPolygons = 0; ///< with the same points as another, facing the other side
  vtkBoundingBox Bounds;         ///< of all finite points, world units
  double Diagonal = 0.0;         ///< of Bounds, world units
  float Spacing = 0.f;           ///< mean distance of neighboring query points, scene units

  /// Positions of the first surface that belong to each query point: its own, or the corners of its
  /// cell. Empty for disks.
  std::vector<std::uint32_t> Corners;
  std::vector<std::size_t> CornerEnds; ///< index into Corners behind those of each query point

  std::size_t GetNumberOfCornerLists() const { return this->CornerEnds.size(); }

  /// Returns the range of Corners of a query point.
  std::pair<const std::uint32_t*, const std::uint32_t*> GetCorners(std::size_t site) const
  {
    const std::uint32_t* const corners = this->Corners.data();
    return { corners + (site == 0 ? 0 : this->CornerEnds[site - 1]),
      corners + this->CornerEnds[site] };
  }
};

/// Extracts the input of baking from `data`. Throws Stopped if `progress` requests a stop, like
/// AddOccluders(). Collective, with the origin, the scale and the kind of query points of all data together.
VTKPENUMBRAFILTERSIRRADIANCE_EXPORT BakeInput PrepareBakeInput(
  vtkPointSet* data, const BakeInputOptions& options, const ProgressCallback& progress = {});

/// Adds the polygons of `surroundings`, and its vertices and lines with the radii of `options`, to
/// the occluders, without query points. Extends the bounds by all finite points, including those
/// without polygons. Without the opacity array, they are opaque; throws std::runtime_error if it is
/// invalid.
VTKPENUMBRAFILTERSIRRADIANCE_EXPORT void AddOccluders(vtkPolyData* surroundings,
  const BakeInputOptions& options, BakeInput& mesh, const ProgressCallback& progress = {});

/// Extends the bounds by those of other ranks. Collective.
void UniteBounds(const BakeInputOptions& options, BakeInput& mesh);

/// Returns one sentence about each kind of defect of the data that the values suffer from. Those of all ranks are
/// returned on the first one. Collective.
std::vector<std::string> DescribeDefects(const BakeInputOptions& options, const BakeInput& mesh);

}
#endif
