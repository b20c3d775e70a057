// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Record placement: adds records to an octree, level by level. The records of a level depend only
// on those of earlier levels. They are computed in parallel and inserted in the order of their
// candidates, so that the result does not depend on the number of threads.
#ifndef penumbra_RecordPlacement_h
#define penumbra_RecordPlacement_h

#include "Execution/ParallelFor.h"
#include "Gathering/Gatherer.h"
#include "Gathering/IrradianceConstants.h"
#include "RecordOctree.h"

#include <limits>
#include <optional>
#include <vector>

namespace penumbra
{

/// Rules for the radius of a record.
enum class RadiusRules
{
  NearestHit,   ///< [IC] without grazing rays
  HarmonicMean, ///< [IC]
  Hessian       ///< from the second derivative and the tolerance
};

struct RecordPlacementSettings
{
  double Tolerance = .01; ///< accepted error of the mean over the hemisphere, relative to Radiance
  double Radiance = 1.0;  ///< of the light sources; 1 for occlusion
  RadiusRules Rule = RadiusRules::Hessian;
  double MinimumRadiusPixels = 3.0;  ///< [IC]: 2 to 4
  double MaximumRadiusPixels = 64.0; ///< [IC]: 20 to 64
  int Side = 0;                      ///< cells along the hemisphere grid; 0: from Tolerance
  bool Refine = false; ///< supersample cells that differ from their neighbors (small bright lights)
  bool KeepAllValid = false; ///< keep records valid that would need less than the minimum radius
  float CoverageWeight = MinimumWeight; ///< see IsCovered()
  bool ClampReached = false;            ///< see RecordOctree::InsertClamped()
  float ClearanceFraction = 1.f;        ///< of the distance of a wall up to which a record is used
};

/// Point at which a record may be placed.
struct RecordCandidate : ShadingPoint
{
  float Pixel =
    0.f; ///< size of a pixel at this point, scene units; on a mesh, from the point spacing
  float MaximumRadius = std::numeric_limits<float>::infinity(); ///< upper bound of the radius

  /// Distance of the nearest surface that is in front of the point and does not continue its own.
  float ObstacleDistance = std::numeric_limits<float>::infinity();
};

class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT RecordPlacement
{
public:
  RecordPlacement(
    const Gatherer& gatherer, const RecordPlacementSettings& settings, RecordOctree& tree);

  /// Adds a record at each candidate that IsCovered() rejects. Returns false if `progress`
  /// requested a stop.
  bool AddLevel(const std::vector<RecordCandidate>& sites, const ProgressCallback& progress = {});

  /// Returns true if a record at `shadingPoint` has more than the coverage weight, so that no
  /// further record is needed.
  bool IsCovered(const ShadingPoint& shadingPoint) const;
  float GetCoverageWeight() const { return this->Settings.CoverageWeight; }

  /// Returns a record at `site`, or nothing if that lies in a concave edge, where two surfaces
  /// meet. Adds the number of rays traced to `rays`.
  std::optional<Record> Gather(const RecordCandidate& site, long long& rays) const;

  long long GetRays() const { return this->Rays; }

  /// Returns the minimum radius of a record.
  float GetMinimumRadius(const RecordCandidate& site) const;

  /// Returns the number of records added so far that are not valid.
  std::size_t GetNumberOfInvalidRecords() const { return this->InvalidRecords; }

  /// Returns the side of the hemisphere grid whose error is about `tolerance`.
  static int ComputeSide(double tolerance);

  /// Returns the maximum angle between normals in radians for which the error of the rotation
  /// gradient is within tolerance.
  static float ComputeNormalAngle(double tolerance);

private:
  /// Traces rays that find the edges of planar surfaces that seem to end at their horizon. Returns
  /// the number of rays.
  long long FindOccluderEdges(const RecordCandidate& site, const HemisphereGrid& grid,
    const std::vector<glm::vec3>& directions, std::vector<HemisphereSample>& samples) const;

  /// Returns the accuracy of split-sphere radii, as a fraction of the distance.
  double ComputeAccuracy() const;
  double ComputeRadius(const HemisphereEstimate& estimate) const;
  /// Returns the upper bound of a radius that the obstacle of the candidate allows.
  static double ComputeObstacleRadius(
    const RecordCandidate& site, const HemisphereEstimate& estimate);
  double GetAbsoluteTolerance() const { return this->Settings.Tolerance * this->Settings.Radiance; }

  const Gatherer& Source;
  RecordPlacementSettings Settings;
  RecordOctree& Tree;
  long long Rays = 0;
  std::size_t InvalidRecords = 0;
};

}
#endif
