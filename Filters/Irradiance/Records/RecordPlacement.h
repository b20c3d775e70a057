// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Fills a tree with records, level by level: a level looks only at what earlier levels left, its
// records are made in parallel and inserted in the order of their sites. So which records there are
// depends on the sites alone, never on threads.
#ifndef penumbra_RecordPlacement_h
#define penumbra_RecordPlacement_h

#include "Execution/ParallelFor.h"
#include "Gathering/Gatherer.h"
#include "RecordOctree.h"

#include <limits>
#include <optional>
#include <vector>

namespace penumbra
{

/// How the radius of a record is found.
enum class RadiusRules
{
  NearestHit,   ///< [IC] without grazing rays
  HarmonicMean, ///< [IC]
  Hessian       ///< from the error that the tolerance allows
};

struct RecordPlacementSettings
{
  double Tolerance = .01; ///< of the mean over the hemisphere
  RadiusRules Rule = RadiusRules::Hessian;
  double MinimumRadiusPixels = 3.0; ///< [IC] 2 - 4
  double MostPixels = 64.0;         ///< [IC] 20 - 64
  int Side = 0;                     ///< cells along the gatherer's grid; 0: from Tolerance
  bool Refine = false; ///< look closer where neighbouring cells differ most: small bright lights
  bool KeepAllValid = false; ///< even those whose radius the least one makes too large
};

/// A place where a record may be needed.
struct RecordCandidate : ShadingPoint
{
  float Pixel = 0.f; ///< side of a pixel there, or what stands for it on a mesh
  float MaximumRadius = std::numeric_limits<float>::infinity(); ///< no radius above this
};

class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT RecordPlacement
{
public:
  RecordPlacement(
    const Gatherer& gatherer, const RecordPlacementSettings& settings, RecordOctree& tree);

  /// Sites that no record covers, or hardly, become records. False when `progress` stopped it.
  bool AddLevel(const std::vector<RecordCandidate>& sites, const ProgressCallback& progress = {});

  /// Is another record not worth while at `place`?
  static bool IsCovered(const RecordOctree& tree, const ShadingPoint& place);

  /// A record at `site`, none where that lies in a corner itself; adds the directions asked for to `rays`.
  std::optional<Record> Gather(const RecordCandidate& site, long long& rays) const;

  long long GetRays() const { return this->Rays; }

  /// Of the records made so far, those that do not serve.
  std::size_t GetNumberOfInvalidRecords() const { return this->Idle; }
  static int SideFor(double tolerance);
  /// How much normals may differ, in radians, so that what turning leaves out is within tolerance.
  static float NormalAngleFor(double tolerance);

private:
  /// Cells that make the mean uncertain get more rays, until it is certain enough; returns how many.
  long long SupersampleCells(const RecordCandidate& site, const glm::mat3& frame,
    const HemisphereGrid& grid, const std::vector<EmitterSample>& beams,
    std::vector<HemisphereSample>& sights) const;

  /// Where flat surfaces near the point seem to end at their horizons: do they go on? Returns how many rays.
  long long FindOccluderEdges(const RecordCandidate& site, const HemisphereGrid& grid,
    const std::vector<glm::vec3>& directions, std::vector<HemisphereSample>& sights) const;

  double RadiusOf(const HemisphereEstimate& found) const;

  const Gatherer& Source;
  RecordPlacementSettings Settings;
  RecordOctree& Tree;
  long long Rays = 0;
  std::size_t Idle = 0;
};

}
#endif
