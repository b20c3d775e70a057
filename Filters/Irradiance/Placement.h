// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Fills a tree with records, level by level: a level looks only at what earlier levels left, its
// records are made in parallel and inserted in the order of their sites. So which records there are
// depends on the sites alone, never on threads.
#ifndef penumbra_Placement_h
#define penumbra_Placement_h

#include "Gatherer.h"
#include "RecordTree.h"

namespace penumbra
{

/// How the radius of a record is found.
enum class RadiusRules
{
  NearestHit,   ///< [IC] without grazing rays
  HarmonicMean, ///< [IC]
  Hessian       ///< from the error that the tolerance allows
};

struct PlacementSettings
{
  double Tolerance = .01; ///< of the mean over the hemisphere
  RadiusRules Rule = RadiusRules::Hessian;
  double LeastPixels = 3.0; ///< [IC] 2 - 4
  double MostPixels = 64.0; ///< [IC] 20 - 64
  int Side = 0;             ///< cells along the gatherer's grid; 0: from Tolerance
};

/// A place where a record may be needed.
struct Site : Place
{
  float Pixel = 0.f; ///< side of a pixel there, or what stands for it on a mesh
};

class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT Placement
{
public:
  Placement(const Gatherer& gatherer, const PlacementSettings& settings, RecordTree& tree);

  /// Sites where no record serves, or hardly, become records. Returns how many.
  std::size_t AddLevel(const std::vector<Site>& sites);

  /// A record at `site`; adds the directions asked for to `rays`.
  Record Gather(const Site& site, long long& rays) const;

  bool IsServed(const Place& place) const;

  long long GetRays() const { return this->Rays; }
  static int SideFor(double tolerance);
  /// How much normals may differ, in radians, so that what turning leaves out is within tolerance.
  static float NormalAngleFor(double tolerance);

private:
  float RadiusOf(const Derived& found, const Site& site) const;

  const Gatherer& Source;
  PlacementSettings Settings;
  RecordTree& Tree;
  long long Rays = 0;
};

}
#endif
