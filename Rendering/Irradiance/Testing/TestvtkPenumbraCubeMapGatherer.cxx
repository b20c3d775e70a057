// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares gathering by cube maps with closed forms and with rays.
#include "vtkPenumbraCubeMapGatherer.h"

#include "ClosedForms/FalloffOcclusion.h"
#include "CubeMap/Hemicube.h"
#include "CubeMap/TriangleClusters.h"
#include "Embree/RayScene.h"
#include "Gathering/HemisphereEstimate.h"
#include "Gathering/RayGatherer.h"
#include "Scenes/Building.h"
#include "Scenes/Solids.h"
#include "Shading/HemisphereSampling.h"
#include "Surface.h"
#include "vtkPenumbraIrradianceCache.h"
#include "vtkPenumbraIrradianceFilter.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"

#include <glm/gtc/constants.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace penumbra;

namespace
{

constexpr float Infinity = std::numeric_limits<float>::infinity();
constexpr int Side = 32;
constexpr unsigned int Rings = 64; ///< resolution of spheres

HemisphereEstimate Estimate(const Gatherer& gatherer, glm::vec3 point, const TangentFrame& frame)
{
  const HemisphereGrid& grid = HemisphereGrid::Get(Side);
  std::vector<glm::vec3> directions;
  std::vector<HemisphereSample> samples;
  gatherer.SampleHemisphere(point, frame, grid, 1, directions, samples);
  return EstimateHemisphere(grid, frame.Axes, directions, samples, gatherer.GetFalloff());
}

HemisphereEstimate Estimate(const Gatherer& gatherer, glm::vec3 point, glm::vec3 normal)
{
  return Estimate(gatherer, point, TangentFrame(FrameFromNormal(normal)));
}

/// Gathers occlusion of one scene by rays and by cube maps.
struct GathererPair
{
  explicit GathererPair(
    const Scene& scene, const DistanceFalloff& falloff = {}, int resolution = 64)
    : Rays(scene, 1),
      ByRays(this->Rays, falloff)
  {
    this->CubeMaps->SetResolution(resolution);
    this->ByCubeMap = this->CubeMaps->Make(this->ByRays);
  }

  float Occlusion(glm::vec3 point, glm::vec3 normal = { 0.f, 0.f, 1.f }) const
  {
    return Estimate(*this->ByCubeMap, point, normal).Mean.x;
  }

  RayScene Rays;
  OcclusionGatherer ByRays;
  vtkNew<vtkPenumbraCubeMapGatherer> CubeMaps;
  std::unique_ptr<Gatherer> ByCubeMap;
};

Scene SphereOverFloor(double height)
{
  Scene scene;
  AddFloor(scene, 1000.f);
  AddSphere(scene, { 0.0, 0.0, height }, 1.0, Rings);
  return scene;
}

double SphereOverFloorOcclusion(double height, double rho)
{
  return height * std::pow(height * height + rho * rho, -1.5);
}

}

TEST(Hemicube, FormFactorsSumToOne)
{
  for (const int side : { 8, 32, 128 })
  {
    const Hemicube cube(side);
    double sum = 0.0;
    glm::dvec3 mean(0.0);
    const double area = 4.0 / (side * side);
    for (const glm::vec3& direction : cube.GetDirections())
    {
      // The component along the normal of the face is 1, so that both cosines are divided by the length.
      const glm::dvec3 v(direction);
      const double factor = v.z * area / (glm::pi<double>() * glm::dot(v, v) * glm::dot(v, v));
      sum += factor;
      mean += factor * glm::normalize(v);
    }
    EXPECT_NEAR(sum, 1.0, 1.0 / (side * side));
    EXPECT_NEAR(mean.x, 0.0, 1e-5);
    EXPECT_NEAR(mean.y, 0.0, 1e-5);
    EXPECT_NEAR(mean.z, 2.0 / 3.0, 1.0 / (side * side)); // 1/pi * integral of cos^2
  }
}

TEST(Hemicube, WeightsOfEveryCellSumToOne)
{
  const Hemicube cube(16);
  for (const int side : { 8, 32, 64 }) // cells larger and smaller than texels
  {
    const Hemicube::Cells cells = cube.MapToGrid(HemisphereGrid::Get(side));
    ASSERT_EQ(cells.First.size(), static_cast<std::size_t>(side) * side + 1);
    for (int cell = 0; cell < side * side; ++cell)
    {
      float sum = 0.f;
      for (std::size_t i = cells.First[cell]; i < cells.First[cell + 1]; ++i)
      {
        sum += cells.Texels[i].Weight;
      }
      EXPECT_NEAR(sum, 1.f, 1e-5f);
    }
  }
}

TEST(TriangleClusters, CullOnlyTrianglesOutsideTheFrustum)
{
  Scene scene;
  AddSphere(scene, { 5.0, 0.0, 0.0 }, 1.0);
  AddSphere(scene, { -5.0, 0.0, 0.0 }, 1.0);
  AddSphere(scene, { 0.0, 5.0, 0.0 }, 1.0);
  const TriangleClusters clusters(scene.Surfaces);
  const glm::vec3 x(1.f, 0.f, 0.f);
  const glm::vec3 y(0.f, 1.f, 0.f);
  const glm::vec3 z(0.f, 0.f, 1.f);
  const Frustum frustum{ glm::vec3(0.f), { x, x - y, x + y, x - z, x + z }, Infinity };
  TriangleClusters::DrawRanges ranges;
  const long long found = clusters.CullToFrustum(frustum, TriangleClusters::Both, ranges);
  const auto all = static_cast<long long>(clusters.GetNumberOfTriangles());
  EXPECT_GE(found, all / 3);
  EXPECT_LT(found, all / 2);
  std::set<std::uint32_t> visible;
  for (std::size_t i = 0; i < ranges.First.size(); ++i)
  {
    for (int corner = ranges.First[i]; corner < ranges.First[i] + ranges.Count[i]; corner += 3)
    {
      const auto& triangle = clusters.GetTriangle(static_cast<std::size_t>(corner) / 3 + 1);
      if (triangle.Surface == 0)
      {
        visible.insert(triangle.Triangle);
      }
    }
  }
  EXPECT_EQ(visible.size(), scene.Surfaces[0].Triangles.size());
  const Frustum near{ frustum.Eye, frustum.Inwards,
    3.f }; // bounding boxes of clusters may extend closer
  EXPECT_LT(clusters.CullToFrustum(near, TriangleClusters::Both, ranges), all / 20);
}

TEST(CubeMapGatherer, ReturnsZeroOnAnOpenPlane)
{
  Scene scene;
  AddFloor(scene, 1000.f);
  const GathererPair both(scene);
  for (const glm::vec3 normal : { glm::vec3(0.f, 0.f, 1.f), glm::vec3(0.f, 0.f, -1.f) })
  {
    EXPECT_EQ(both.Occlusion({ 1.f, 2.f, 0.f }, normal), 0.f);
  }
}

// Clipping at the near plane rounds by far more than the distance between the cube's center and its own plane.
TEST(CubeMapGatherer, ReturnsZeroOnTiltedPlanes)
{
  for (const glm::vec3 axis :
    { glm::vec3(.3f, .5f, .8f), glm::vec3(-.6f, .1f, .2f), glm::vec3(.1f, -.9f, .4f) })
  {
    const glm::vec3 normal = glm::normalize(axis);
    const glm::mat3 frame = FrameFromNormal(normal);
    Scene scene;
    AddRectangle(scene, -1000.f * (frame[0] + frame[1]), 2000.f * frame[0], 2000.f * frame[1]);
    const GathererPair both(scene);
    for (const glm::vec2 at : { glm::vec2(0.f), glm::vec2(1.f, 2.f), glm::vec2(-7.f, 90.f) })
    {
      const glm::vec3 point = at.x * frame[0] + at.y * frame[1];
      EXPECT_LE(both.Occlusion(point, normal), .001f) << axis.x << " " << at.x;
    }
  }
}

TEST(CubeMapGatherer, ReturnsOneInAClosedBox)
{
  Scene scene;
  AddBox(scene, { -1.f, -1.f, -1.f }, { 1.f, 1.f, 1.f });
  const GathererPair both(scene);
  EXPECT_EQ(both.Occlusion({ .3f, -.2f, -1.f }), 1.f);
  EXPECT_EQ(both.Occlusion({ 1.f, .999f, .9f }, { -1.f, 0.f, 0.f }), 1.f);
}

TEST(CubeMapGatherer, ReturnsOneHalfAtTheFootOfAWall)
{
  Scene scene;
  AddFloor(scene, 1000.f);
  AddRectangle(scene, { -1000.f, 0.f, 0.f }, { 2000.f, 0.f, 0.f }, { 0.f, 0.f, 1000.f });
  const GathererPair both(scene);
  EXPECT_NEAR(both.Occlusion({ 0.f, -.01f, 0.f }), .5f, .005f);
}

// Directions below the plane of the triangle show what it reflects, as for rays: all that are toward the wall are
// occluded, (1 + cos a) / 2 of the light if the interpolated normal forms the angle a with the normal of the wall.
TEST(CubeMapGatherer, MatchesTheClosedFormWithInterpolatedNormals)
{
  Scene open;
  AddFloor(open, 1000.f);
  Scene atWall = open;
  AddRectangle(atWall, { -1000.f, 0.f, 0.f }, { 2000.f, 0.f, 0.f }, { 0.f, 0.f, 1000.f });
  const GathererPair onFloor(open);
  const GathererPair before(atWall);
  const glm::vec3 point(3.f, -.1f, 0.f);
  for (const float tilt : { -1.2f, -.5f, -.1f, .01f, .3f, .8f, 1.3f })
  {
    const glm::vec3 normal(0.f, std::sin(tilt), std::cos(tilt));
    const TangentFrame frame(FrameFromNormal(normal), { 0.f, 0.f, 1.f });
    EXPECT_EQ(Estimate(*onFloor.ByCubeMap, point, frame).Mean.x, 0.f) << tilt;
    const double reference = .5 * (1.0 + std::sin(tilt));
    EXPECT_NEAR(Estimate(before.ByRays, point, frame).Mean.x, reference, .01) << tilt;
    EXPECT_NEAR(Estimate(*before.ByCubeMap, point, frame).Mean.x, reference, .01) << tilt;
  }
}

TEST(CubeMapGatherer, MatchesTheClosedFormNearASphere)
{
  const double height = 1.5;
  const Scene scene = SphereOverFloor(height);
  const GathererPair both(scene);
  for (const double rho : { 0.0, .5, 1.0, 2.0, 4.0 })
  {
    const glm::vec3 point(.6 * rho, .8 * rho, 0.0);
    EXPECT_NEAR(both.Occlusion(point), SphereOverFloorOcclusion(height, rho), .003) << rho;
  }
}

TEST(CubeMapGatherer, MatchesTheGradientsOfRays)
{
  const double height = 1.5;
  const Scene scene = SphereOverFloor(height);
  const GathererPair both(scene);
  const double rho = 1.2;
  const HemisphereEstimate cubeMap =
    Estimate(*both.ByCubeMap, { rho, 0.0, 0.0 }, { 0.f, 0.f, 1.f });
  const HemisphereEstimate rays = Estimate(both.ByRays, { rho, 0.0, 0.0 }, { 0.f, 0.f, 1.f });
  const double derivative =
    (SphereOverFloorOcclusion(height, rho + .01) - SphereOverFloorOcclusion(height, rho - .01)) /
    .02;
  EXPECT_NEAR(cubeMap.Translation[0].x, derivative, .1 * std::abs(derivative));
  EXPECT_NEAR(cubeMap.Translation[0].y, 0.0, .05 * std::abs(derivative));
  EXPECT_NEAR(cubeMap.Rotation[0].x, rays.Rotation[0].x, .02);
  EXPECT_NEAR(
    cubeMap.OccluderEdgeDistance, rays.OccluderEdgeDistance, .1f * rays.OccluderEdgeDistance);
  EXPECT_NEAR(cubeMap.HarmonicMean, rays.HarmonicMean, .15f * rays.HarmonicMean);
  EXPECT_NEAR(cubeMap.Nearest, rays.Nearest, .1f * rays.Nearest);
}

TEST(CubeMapGatherer, IgnoresOccludersBeyondTheRadius)
{
  const Scene scene = SphereOverFloor(1.5);
  for (const float radius : { .4f, 1.f, 1.6f })
  {
    const GathererPair both(scene, radius);
    for (const float x : { 0.f, 1.f })
    {
      const glm::vec3 point(x, 0.f, 0.f);
      EXPECT_NEAR(
        both.Occlusion(point), Estimate(both.ByRays, point, { 0.f, 0.f, 1.f }).Mean.x, .015f);
    }
  }
}

TEST(CubeMapGatherer, MatchesRaysInABuilding)
{
  Scene scene;
  AddBuilding(scene, 3, 2);
  const GathererPair both(scene, 2.f);
  for (const glm::vec3 point : { glm::vec3(5.f, 5.2f, 0.f), glm::vec3(1.5f, 9.7f, RoomHeight) })
  {
    EXPECT_NEAR(
      both.Occlusion(point), Estimate(both.ByRays, point, { 0.f, 0.f, 1.f }).Mean.x, .015f);
  }
}

TEST(CubeMapGatherer, IgnoresCulledSides)
{
  Scene scene;
  AddFloor(scene, 1000.f);
  AddSphere(scene, { 0.0, 0.0, 1.5 }, 1.0, Rings);
  for (const bool front : { true, false })
  {
    scene.Surfaces[1].Frontfaces = front;
    scene.Surfaces[1].Backfaces = !front;
    const GathererPair both(scene);
    const glm::vec3 up(0.f, 0.f, 1.f);
    const HemisphereEstimate cubeMap = Estimate(*both.ByCubeMap, glm::vec3(0.f), up);
    const HemisphereEstimate rays = Estimate(both.ByRays, glm::vec3(0.f), up);
    // The near side is at one third of the distance of the far side.
    EXPECT_NEAR(cubeMap.HarmonicMean, rays.HarmonicMean, .1f * rays.HarmonicMean);
  }
}

TEST(CubeMapGatherer, IsIndependentOfTheSceneScale)
{
  for (const float size : { 1e-5f, 1.f, 1e4f })
  {
    Scene scene;
    AddFloor(scene, 1000.f * size);
    AddSphere(scene, { 0.0, 0.0, 1.5 * size }, size, Rings);
    const GathererPair both(scene);
    EXPECT_NEAR(both.Occlusion({ size, 0.f, 0.f }), SphereOverFloorOcclusion(1.5, 1.0), .003)
      << size;
  }
}

TEST(CubeMapGatherer, MatchesTheLightOfRays)
{
  Scene scene;
  AddBox(scene, { -1.f, -1.f, -1.f }, { 1.f, 1.f, 1.f });
  // So large that rays are not traced toward it but hit it.
  AddRectangle(scene, { -.98f, -.98f, .9f }, { 1.96f, 0.f, 0.f }, { 0.f, 1.96f, 0.f });
  Material& emitter = scene.Surfaces.back().Front;
  emitter.Ambient = 1.f;
  emitter.AmbientColor = { 1.f, .5f, .25f };
  emitter.Diffuse = 0.f;
  const RayScene rays(scene, 1);
  const Illumination illumination(rays, IlluminationSettings());
  const LightGatherer byRays(illumination, nullptr, 0);
  vtkNew<vtkPenumbraCubeMapGatherer> cubeMaps;
  cubeMaps->SetResolution(128);
  const std::unique_ptr<Gatherer> byCubeMap = cubeMaps->Make(byRays);
  const glm::vec3 point(.2f, -.4f, -1.f);
  const HemisphereGrid& grid = HemisphereGrid::Get(HemisphereGrid::MaximumSide);
  const glm::mat3 frame = FrameFromNormal({ 0.f, 0.f, 1.f });
  std::vector<glm::vec3> directions;
  std::vector<HemisphereSample> samples;
  byRays.SampleHemisphere(point, frame, grid, 1, directions, samples);
  const glm::vec3 reference = EstimateHemisphere(grid, frame, directions, samples, Infinity).Mean;
  const glm::vec3 light = Estimate(*byCubeMap, point, { 0.f, 0.f, 1.f }).Mean;
  ASSERT_GT(reference.x, .01f);
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(light[c], reference[c], .02f * reference[c]);
  }
}

TEST(CubeMapGatherer, IsIndependentOfThreadCount)
{
  const Scene scene = SphereOverFloor(1.5);
  const GathererPair both(scene);
  std::vector<float> values(16);
  vtkSMPTools::For(0, 16, 1, [&](vtkIdType begin, vtkIdType end) {
    for (vtkIdType i = begin; i < end; ++i)
    {
      values[i] = both.Occlusion({ static_cast<float>(i % 4), 0.f, 0.f });
    }
  });
  for (int i = 4; i < 16; ++i)
  {
    EXPECT_EQ(values[i], values[i % 4]);
  }
}

TEST(CubeMapGatherer, GathersRecordsOfTheCache)
{
  Scene scene = SphereOverFloor(1.5);
  LookAt(scene, { 0.0, -7.0, 4.0 }, { 0.0, 0.0, .6 }, 45.0, 128, 128);
  const RayScene rays(scene, 1);
  vtkNew<vtkPenumbraCubeMapGatherer> cubeMaps;
  vtkNew<vtkPenumbraIrradianceCache> cache;
  cache->SetGatherer(cubeMaps);
  const double tolerance = .02;
  cache->Begin(rays, Infinity, tolerance);
  double square = 0.0;
  double count = 0.0;
  for (double rho = .5; rho < 3.0; rho += .05)
  {
    const double point[3] = { rho * std::sin(40.0 * rho), rho * std::cos(40.0 * rho), 0.0 };
    const double normal[3] = { 0.0, 0.0, 1.0 };
    square +=
      std::pow(cache->Occlusion(point, normal).Value - SphereOverFloorOcclusion(1.5, rho), 2.0);
    count += 1.0;
  }
  EXPECT_LE(std::sqrt(square / count), tolerance);
  vtkNew<vtkFieldData> statistics;
  cache->Report(statistics);
  const auto value = [&](
                       const char* name) { return statistics->GetArray(name)->GetComponent(0, 0); };
  EXPECT_EQ(value("CubeMaps/Total"), value("Cache/Records"));
  EXPECT_GT(value("CubeMaps/Triangles"), value("CubeMaps/Total"));
  // A few rays remain, along horizons.
  EXPECT_LT(value("Rays/Gather"), 100.0 * value("Cache/Records"));
}

TEST(CubeMapGatherer, MatchesTheClosedFormsOfFalloffs)
{
  Scene scene;
  AddFloor(scene, 1000.f);
  AddRectangle(scene, { -1000.f, 0.f, 0.f }, { 2000.f, 0.f, 0.f }, { 0.f, 0.f, 1000.f });
  for (int falloff = 0; falloff < 4; ++falloff)
  {
    const GathererPair both(scene, { 2.f, static_cast<DistanceFalloff::Shapes>(falloff) });
    const FadingOcclusion reference{ 2.0, PowersOfFalloffs[falloff] };
    for (const float distance : { .05f, .5f, 1.2f })
    {
      EXPECT_NEAR(both.Occlusion({ 0.f, -distance, 0.f }), reference.BeforeWall(distance), .006)
        << falloff << " " << distance;
    }
  }
}

TEST(CubeMapGatherer, GathersRecordsOfBaking)
{
  vtkNew<vtkPlaneSource> floor;
  floor->SetOrigin(-6.0, -6.0, 0.0);
  floor->SetPoint1(6.0, -6.0, 0.0);
  floor->SetPoint2(-6.0, 6.0, 0.0);
  floor->SetResolution(40, 40);
  vtkNew<vtkPlaneSource> ceiling;
  ceiling->SetOrigin(-40.0, -40.0, .6);
  ceiling->SetPoint1(40.0, -40.0, .6);
  ceiling->SetPoint2(-40.0, 40.0, .6);
  ceiling->Update();
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputConnection(floor->GetOutputPort());
  filter->SetInputData(1, ceiling->GetOutput());
  filter->SetRadius(2.0);
  filter->SetGatherer(vtkNew<vtkPenumbraCubeMapGatherer>());
  filter->Update();
  vtkDataArray* values =
    vtkPolyData::SafeDownCast(filter->GetOutput())->GetPointData()->GetArray("AmbientOcclusion");
  ASSERT_TRUE(values);
  const double reference = FadingOcclusion{ 2.0, 0.0 }.UnderCeiling(.6);
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    EXPECT_NEAR(values->GetComponent(i, 0), reference, .03);
  }
  const auto value = [&](const char* name) {
    return filter->GetStatistics()->GetArray(name)->GetComponent(0, 0);
  };
  EXPECT_GT(value("CubeMaps/Total"), 0.0);
  EXPECT_EQ(value("CubeMaps/Total"), value("Cache/Records"));
}
