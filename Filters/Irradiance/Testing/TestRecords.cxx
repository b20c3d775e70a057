// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Records of the cache: positions, radii and octree; storage, reuse and rebuilding.
#include "CacheView.h"
#include "Surface.h"

#include "Embree/RayScene.h"
#include "Records/RecordOctree.h"

#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace penumbra_testing;

TEST(vtkPenumbraIrradianceCache, RecordsRoundTripThroughPolyData)
{
  Scene scene;
  MakeSphereScene(scene, 1.0);
  scene.Scale = 4.0;
  const RayScene rays(scene, 0);
  vtkNew<vtkPenumbraIrradianceCache> first;
  first->Begin(rays, 1.0, .02);
  vtkNew<vtkPolyData> records;
  first->GetRecords(records);
  ASSERT_GT(records->GetNumberOfPoints(), 100);
  EXPECT_TRUE(records->GetPointData()->GetArray("AmbientOcclusion"));
  EXPECT_EQ(records->GetNumberOfVerts(), records->GetNumberOfPoints());

  vtkNew<vtkPenumbraIrradianceCache> second;
  second->SetInitialRecords(records);
  second->Begin(rays, 1.0, .02);
  EXPECT_EQ(GetStatistic(second, "Cache/Records"), GetStatistic(first, "Cache/Records"));
  EXPECT_EQ(GetStatistic(second, "Rays/Gather"), 0);
  vtkNew<vtkPolyData> again;
  second->GetRecords(again);
  for (vtkIdType i = 0; i < records->GetNumberOfPoints(); ++i)
  {
    EXPECT_EQ(again->GetPointData()->GetArray("Serves")->GetComponent(i, 0),
      records->GetPointData()->GetArray("Serves")->GetComponent(i, 0));
  }
  const CacheView view{ scene, CandidatesInImage(rays, 6) };
  for (const RecordCandidate& site : view.Sites)
  {
    EXPECT_NEAR(QueryOcclusion(second, view.World(site), site.Normal),
      QueryOcclusion(first, view.World(site), site.Normal), 1e-3);
  }
}

TEST(vtkPenumbraIrradianceCache, ReloadsModifiedInitialRecords)
{
  Scene scene;
  MakeSphereScene(scene, 1.0);
  const RayScene rays(scene, 0);
  vtkNew<vtkPenumbraIrradianceCache> first;
  first->Begin(rays, 1.0, .02);
  vtkNew<vtkPolyData> records;
  first->GetRecords(records);
  vtkNew<vtkPenumbraIrradianceCache> second;
  second->SetInitialRecords(records);
  second->Begin(rays, 1.0, .02);
  records->GetPointData()->GetArray("AmbientOcclusion")->Fill(.25);
  records->GetPointData()->GetArray("AmbientOcclusion")->Modified();
  second->Begin(rays, 1.0, .02);
  vtkNew<vtkPolyData> again;
  second->GetRecords(again);
  EXPECT_NEAR(again->GetPointData()->GetArray("AmbientOcclusion")->GetComponent(7, 0), .25, 1e-6);
}

TEST(vtkPenumbraIrradianceCache, ReusesRecordsForSameScene)
{
  Scene scene;
  MakeSphereScene(scene, 1.0);
  const RayScene rays(scene, 0);
  vtkNew<vtkPenumbraIrradianceCache> cache;
  int calls = 0;
  const auto count = [&calls](double) {
    ++calls;
    return false;
  };
  ASSERT_TRUE(cache->Begin(rays, 1.0, .02, count));
  const int firstCalls = calls;
  EXPECT_GT(firstCalls, 0);
  ASSERT_TRUE(cache->Begin(rays, 1.0, .02, count));
  EXPECT_EQ(calls, firstCalls) << "gathered again";
  const RayScene another(scene, 0);
  ASSERT_TRUE(cache->Begin(another, 1.0, .02, count));
  EXPECT_GT(calls, firstCalls) << "kept the records of another scene";
}

TEST(vtkPenumbraIrradianceCache, RestartsAfterStop)
{
  Scene scene;
  MakeSphereScene(scene, 1.0);
  const RayScene rays(scene, 0);
  vtkNew<vtkPenumbraIrradianceCache> cache;
  EXPECT_FALSE(cache->Begin(rays, 1.0, .02, [](double fraction) { return fraction > .3; }));
  vtkNew<vtkPenumbraIrradianceCache> fresh;
  ASSERT_TRUE(cache->Begin(rays, 1.0, .02));
  ASSERT_TRUE(fresh->Begin(rays, 1.0, .02));
  EXPECT_EQ(GetStatistic(cache, "Cache/Records"), GetStatistic(fresh, "Cache/Records"));
}

TEST(vtkPenumbraIrradianceCache, RebuildsRecordsForNewFalloff)
{
  Scene scene;
  MakeSphereScene(scene, 1.0);
  const RayScene rays(scene, 0);
  vtkNew<vtkPenumbraIrradianceCache> cache;
  const glm::dvec3 point(1.2, 0.0, 0.0);
  cache->Begin(rays, 2.0, .02);
  const double whole = QueryOcclusion(cache, point);
  cache->Begin(rays, { 2.0, vtkPenumbraIrradianceProvider::LINEAR }, .02);
  EXPECT_LT(QueryOcclusion(cache, point), .8 * whole);
  cache->Begin(rays, 2.0, .02);
  EXPECT_EQ(QueryOcclusion(cache, point), whole);
}

TEST(vtkPenumbraIrradianceCache, PlacesNoRecordOnLineOfCorner)
{
  // The center row of pixels hits the line of the corner between floor and wall.
  Scene scene;
  AddRectangle(scene, { -500, -500, 0 }, { 1000, 0, 0 }, { 0, 501, 0 });
  AddRectangle(scene, { -500, 0, 0 }, { 1000, 0, 0 }, { 0, 0, 500 });
  AddRectangle(scene, { -500, .01f, 0 }, { 1000, 0, 0 }, { 0, 0, 500 });
  LookAt(scene, { 0, -4, 3 }, { 0, 0, 0 }, 30.0, 65, 65);
  const RayScene rays(scene, 0);
  const CacheView view{ scene, FindVisiblePoints(rays) };
  for (const int space : { vtkPenumbraIrradianceCache::WORLD, vtkPenumbraIrradianceCache::SCREEN })
  {
    vtkNew<vtkPenumbraIrradianceCache> cache;
    cache->SetSpace(space);
    cache->SetTolerance(.01);
    cache->Begin(rays, 1.0, .02);
    double maximum = 0.0;
    for (const RecordCandidate& site : view.Sites)
    {
      const glm::dvec3 world = view.World(site);
      const double a = site.Normal.z > .5f ? -world.y : world.z;
      if (a > .01 && a < .4)
      {
        const double reference = (std::acos(a) - a * std::sqrt(1.0 - a * a)) / std::acos(-1.0);
        maximum =
          std::max(maximum, std::abs(QueryOcclusion(cache, world, site.Normal) - reference));
      }
    }
    EXPECT_LT(maximum, .04) << space;
  }
}

TEST(RecordOctree, ClampsRadiiOfRecordsThatContainNewRecord)
{
  constexpr float MinimumPixels = 2.f;
  Record wide;
  wide.Radius = 10.f;
  wide.MaximumPlaneDistance = .05f;
  wide.Gathered.Clearance.fill(100.f);
  Record narrow = wide;
  narrow.Position.x = 2.f;
  narrow.Radius = 1.f;
  Record invalid = narrow;
  invalid.Position.x = -1.f;
  invalid.IsValid = false;
  for (const bool wideFirst : { true, false })
  {
    RecordOctree tree;
    tree.Initialize(glm::vec3(0.f), 20.f);
    tree.InsertClamped(wideFirst ? wide : narrow, MinimumPixels);
    tree.InsertClamped(wideFirst ? narrow : wide, MinimumPixels);
    tree.InsertClamped(invalid, MinimumPixels);
    // The narrow record clamps the wide one only if the wide one contains it on insertion.
    EXPECT_EQ(tree.FindAt(wide)->Radius, wideFirst ? 3.f : 10.f);
    EXPECT_EQ(tree.FindAt(narrow)->Radius, 1.f);
  }
}

TEST(RecordOctree, ClampsNewRecordByRecordsWithinItsRadius)
{
  Record wide;
  wide.Radius = 10.f;
  wide.MaximumPlaneDistance = .05f;
  wide.Gathered.Clearance.fill(100.f);
  for (const float distance : { 4.f, 7.f, 12.f })
  {
    RecordOctree tree;
    tree.Initialize(glm::vec3(0.f), 20.f);
    // Others subdivide the octree.
    for (int i = 0; i < 100; ++i)
    {
      Record other = wide;
      other.Position = { -15.f, .1f * static_cast<float>(i), 0.f };
      other.Radius = .3f;
      tree.InsertClamped(other, 0.f, true);
    }
    Record narrow = wide;
    narrow.Position.y = distance;
    narrow.Radius = 1.f;
    tree.InsertClamped(narrow, 0.f, true);
    Record wall = narrow; // on another surface
    wall.Position.y = .5f;
    wall.Normal = { 1.f, 0.f, 0.f };
    wall.Radius = .1f;
    tree.InsertClamped(wall, 0.f, true);
    tree.InsertClamped(wide, 0.f, true);
    EXPECT_EQ(tree.FindAt(wide)->Radius, std::min(distance + 1.f, 10.f));
    EXPECT_EQ(tree.FindAt(narrow)->Radius, 1.f);
  }
}

TEST(RecordOctree, KeepsMinimumRadiusWhenClamping)
{
  Record coarse;
  coarse.Radius = 10.f;
  coarse.MaximumPlaneDistance = 2.f;
  coarse.Gathered.Clearance.fill(100.f);
  Record fine = coarse;
  fine.Position.x = 1.f;
  fine.Radius = .5f;
  fine.MaximumPlaneDistance = .01f;
  RecordOctree tree;
  tree.Initialize(glm::vec3(0.f), 20.f);
  tree.InsertClamped(coarse, 3.f);
  tree.InsertClamped(fine, 3.f);
  EXPECT_EQ(tree.FindAt(coarse)->Radius, 6.f);
  EXPECT_EQ(tree.FindAt(fine)->Radius, .5f);
}

TEST(RecordOctree, FindsNothingNearestToInvalidRecord)
{
  Record valid;
  valid.Radius = 10.f;
  valid.Gathered.Clearance.fill(100.f);
  Record invalid = valid;
  invalid.Position.x = 9.f;
  invalid.Radius = 5.f;
  invalid.IsValid = false;
  RecordOctree tree;
  tree.Initialize(glm::vec3(0.f), 20.f);
  tree.Insert(valid);
  tree.Insert(invalid);
  ShadingPoint point;
  for (const float x : { 0.f, 3.f, 5.5f, 6.5f, 8.f, 9.5f, 12.f })
  {
    point.Position.x = x;
    EXPECT_EQ(tree.LookUp(point).Found(), x < 6.f) << x; // weights are equal at 6
  }
}
