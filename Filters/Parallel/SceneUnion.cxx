// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneUnion.h"

#include "Edges/SubpixelTriangles.h"
#include "Edges/UnsteadyNormals.h"
#include "Embree/CoincidentSurfaces.h"
#include "Embree/PlanarCells.h"
#include "Messages/ByteStream.h"
#include "Messages/RankGroup.h"
#include "Messages/SurfaceAppearance.h"
#include "Scene.h"
#include "SceneBounds.h"
#include "Surface.h"

#include <algorithm>
#include <array>

namespace penumbra
{
namespace
{

using Points = std::array<glm::vec3, 3>;

/// What a rank tells the others of a surface.
struct Summary
{
  int ObjectId = 0;
  std::string Appearance;
  std::size_t Count = 0;
  WholeSurface Traits;         ///< of this part
  bool IsPlanar = false;       ///< a candidate for WholeSurface::MayCoincideWithItself
  std::vector<Points> Samples; ///< one triangle of a part in one plane

  Summary() = default;
  Summary(const Surface& surface, int rank, std::size_t index);
};

/// Calls bytes(members...) for the members of a summary.
template <typename SummaryT, typename Bytes>
void VisitSummary(SummaryT&& s, Bytes& bytes)
{
  bytes(s.ObjectId, s.Appearance, s.Count, s.Traits, s.IsPlanar, s.Samples);
}

Summary::Summary(const Surface& surface, int rank, std::size_t index)
  : ObjectId(surface.ObjectId),
    Appearance(DescribeAppearance(surface)),
    Count(surface.GetNumberOfPrimitives())
{
  if (surface.Instances)
  {
    this->Appearance += "instances of rank " + std::to_string(rank) + ", " + std::to_string(index);
  }
  this->Traits.PositionBounds = ComputePositionBounds(surface);
  this->Traits.DrawnBounds = ComputeDrawnBounds(surface);
  this->Traits.Primitives = surface.GetNumberOfStoredPrimitives();
  this->Traits.HasTriangles = !surface.Triangles.empty();
  this->Traits.IsTranslucent = surface.IsTranslucent();
  this->Traits.IsUnsteady = HasUnsteadyNormals(surface);
  this->Traits.MayCoincideWithItself = MayCoincideWithItself(surface);
  this->IsPlanar = !surface.IsLineOrPoint && !surface.IsRound() && !surface.CellColors.empty() &&
    this->Count > 0 && penumbra::IsPlanar(surface);
  if (this->IsPlanar)
  {
    this->Samples.push_back(surface.GetPoints(0));
  }
}

/// Returns true if all of these triangles are in one plane.
bool AreInOnePlane(const std::vector<Points>& triangles)
{
  Surface surface;
  for (const Points& points : triangles)
  {
    const auto first = static_cast<std::uint32_t>(surface.Positions.size());
    surface.Positions.insert(surface.Positions.end(), points.begin(), points.end());
    surface.Triangles.emplace_back(first, first + 1, first + 2);
  }
  return IsPlanar(surface);
}

/// A united surface while parts are added.
struct Union
{
  int ObjectId;
  UnitedSurface Surface;
  bool IsPlanar = true; ///< so is each part
  std::vector<Points> Samples;

  explicit Union(const Summary& first)
    : ObjectId(first.ObjectId)
  {
    this->Surface.Appearance = first.Appearance;
    this->Surface.Whole = std::make_shared<WholeSurface>();
  }

  void Add(const Summary& part)
  {
    WholeSurface& whole = *this->Surface.Whole;
    whole.PositionBounds.Add(part.Traits.PositionBounds);
    whole.DrawnBounds.Add(part.Traits.DrawnBounds);
    whole.Primitives += part.Traits.Primitives;
    whole.HasTriangles |= part.Traits.HasTriangles;
    whole.IsTranslucent |= part.Traits.IsTranslucent;
    whole.IsUnsteady |= part.Traits.IsUnsteady;
    whole.MayCoincideWithItself |= part.Traits.MayCoincideWithItself;
    this->IsPlanar &= part.IsPlanar;
    this->Samples.insert(this->Samples.end(), part.Samples.begin(), part.Samples.end());
    this->Surface.Count += part.Count;
  }

  UnitedSurface Finish()
  {
    if (!this->Samples.empty())
    {
      this->Surface.Whole->MayCoincideWithItself =
        this->IsPlanar && this->Surface.Count > 1 && AreInOnePlane(this->Samples);
    }
    return std::move(this->Surface);
  }
};

}

std::vector<UnitedSurface> UniteSurfaces(const Scene& scene, RankGroup& ranks)
{
  ByteWriter own;
  for (std::size_t i = 0; i < scene.Surfaces.size(); ++i)
  {
    VisitSummary(Summary(scene.Surfaces[i], ranks.GetRank(), i), own);
  }
  std::vector<Union> unions;
  int rank = 0;
  for (const std::string& message : ranks.AllGather(own.Take()))
  {
    ByteReader reader(message);
    for (std::uint32_t i = 0; !reader.IsAtEnd(); ++i)
    {
      Summary part;
      VisitSummary(part, reader);
      auto found = std::find_if(unions.begin(), unions.end(), [&](const Union& u) {
        return u.ObjectId == part.ObjectId && u.Surface.Appearance == part.Appearance;
      });
      if (found == unions.end())
      {
        unions.emplace_back(part);
        found = unions.end() - 1;
      }
      if (rank == ranks.GetRank())
      {
        found->Surface.Own.push_back(i);
        found->Surface.Firsts.push_back(found->Surface.Count);
      }
      found->Add(part);
    }
    ++rank;
  }
  std::stable_sort(unions.begin(), unions.end(),
    [](const Union& a, const Union& b) { return a.ObjectId < b.ObjectId; });
  std::vector<UnitedSurface> surfaces;
  std::transform(unions.begin(), unions.end(), std::back_inserter(surfaces),
    [](Union& u) { return u.Finish(); });
  return surfaces;
}

// Samples the triangles of all parts in their order, so that the sum is that of the whole surface.
void FindDenseSurfaces(const Scene& scene, RankGroup& ranks, std::vector<UnitedSurface>& surfaces)
{
  const Camera& camera = scene.ViewCamera;
  const std::string last = ranks.Chain({}, [&](const std::string& before) {
    ByteReader reader(before);
    ByteWriter writer;
    for (const UnitedSurface& surface : surfaces)
    {
      SubpixelTriangles triangles(surface.Count, camera);
      if (!before.empty())
      {
        reader.Get(triangles);
      }
      for (std::size_t i = 0; i < surface.Own.size(); ++i)
      {
        triangles.Add(scene.Surfaces[surface.Own[i]], surface.Firsts[i], camera);
      }
      writer.Add(triangles);
    }
    return writer.Take();
  });
  ByteReader reader(last);
  for (UnitedSurface& surface : surfaces)
  {
    SubpixelTriangles triangles(surface.Count, camera);
    reader.Get(triangles);
    surface.Whole->IsDense = triangles.AreDense();
  }
}

}
