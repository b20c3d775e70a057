// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A coarse sphere with point normals under a sky, against the closed form of the smooth sphere.
#include "Records/PixelCandidates.h"
#include "Scenes/Solids.h"
#include "Shading/EnvironmentMap.h"
#include "Shading/Illumination.h"
#include "Surface.h"

#include "vtkNew.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPenumbraIrradianceCache.h"

#include <glm/gtc/constants.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

using namespace penumbra;

namespace
{

constexpr double Pi = glm::pi<double>();
constexpr int Size = 96;

/// Sphere of 32 x 32 facets around the origin, alone.
struct CoarseSphere
{
  explicit CoarseSphere(bool smooth)
  {
    AddSphere(this->SceneData, glm::dvec3(0.0), 1.0, 32);
    LookAt(this->SceneData, { 0.0, -5.0, 2.0 }, glm::dvec3(0.0), 26.0, Size, Size);
    Surface& surface = this->SceneData.Surfaces[0];
    surface.Front.DiffuseColor = glm::vec3(0.f);
    for (const glm::vec3 position : surface.Positions)
    {
      if (smooth)
      {
        surface.Normals.emplace_back(glm::normalize(glm::dvec3(position) + this->SceneData.Origin));
      }
    }
  }

  std::vector<RecordCandidate> FindVisiblePoints(const RayScene& rays) const
  {
    std::vector<RecordCandidate> all;
    for (int level = 0; level < 11; ++level)
    {
      const std::vector<RecordCandidate> sites = CandidatesInImage(rays, level);
      all.insert(all.end(), sites.begin(), sites.end());
    }
    return all;
  }

  Scene SceneData;
};

/// A sky that is white above the horizon and black below.
IlluminationSettings MakeHalfSky()
{
  IlluminationSettings settings;
  settings.Map =
    std::make_shared<EnvironmentMap>(1, 2, std::vector<glm::vec3>{ glm::vec3(0.f), glm::vec3(1.f) },
      glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0));
  settings.Bounces = 1;
  return settings;
}

/// Returns the RMSE and the largest error of irradiance over pi against the smooth sphere.
glm::dvec2 ComputeErrors(
  const vtkPenumbraIrradianceProvider* provider, const CoarseSphere& sphere, const RayScene& rays)
{
  double square = 0.0;
  double largest = 0.0;
  const std::vector<RecordCandidate> sites = sphere.FindVisiblePoints(rays);
  for (const RecordCandidate& site : sites)
  {
    const glm::dvec3 world = glm::dvec3(site.Position) + sphere.SceneData.Origin;
    const glm::dvec3 normal(site.Normal);
    const glm::dvec3 geometric(site.GeometricNormal);
    const double found =
      provider->Irradiance(&world.x, &normal.x, .005 * Pi, &geometric.x).Value[0] / Pi;
    const double error = std::abs(found - .5 * (1.0 + world.z / glm::length(world)));
    square += error * error;
    largest = std::max(largest, error);
  }
  return { std::sqrt(square / static_cast<double>(sites.size())), largest };
}

}

TEST(SmoothNormals, ReflectDirectionsBelowTheSurface)
{
  const glm::vec3 geometric(0.f, 0.f, 1.f);
  const SurfaceNormals normals(glm::normalize(glm::vec3(.2f, 0.f, 1.f)), geometric);
  EXPECT_EQ(normals.ReflectAbove({ .6f, 0.f, .8f }), glm::vec3(.6f, 0.f, .8f));
  EXPECT_EQ(normals.ReflectAbove({ .8f, 0.f, -.6f }), glm::vec3(.8f, 0.f, .6f));
}

TEST(SmoothNormals, MakeCoarseSphereSmoothUnderSky)
{
  for (const bool smooth : { true, false })
  {
    const CoarseSphere sphere(smooth);
    const RayScene rays(sphere.SceneData, 0);
    const Illumination light(rays, MakeHalfSky());
    vtkNew<vtkPenumbraBruteForceIrradiance> brute;
    ASSERT_TRUE(brute->BeginIrradiance(light, .005 * Pi));
    vtkNew<vtkPenumbraIrradianceCache> cache;
    ASSERT_TRUE(cache->BeginIrradiance(light, .01 * Pi));
    const glm::dvec2 bruteErrors = ComputeErrors(brute, sphere, rays);
    const glm::dvec2 cacheErrors = ComputeErrors(cache, sphere, rays);
    if (smooth)
    {
      EXPECT_LE(bruteErrors.x, .005);
      EXPECT_LE(bruteErrors.y, .02); // four standard errors
      EXPECT_LE(cacheErrors.x, .01);
      EXPECT_LE(cacheErrors.y, .025);
    }
    else
    {
      EXPECT_GE(bruteErrors.y, .02); // facets
    }
  }
}

TEST(SmoothNormals, LeaveConvexSurfacesUnoccluded)
{
  const CoarseSphere sphere(true);
  const RayScene rays(sphere.SceneData, 0);
  vtkNew<vtkPenumbraBruteForceIrradiance> brute;
  ASSERT_TRUE(brute->Begin(rays, 10.0, .01));
  vtkNew<vtkPenumbraIrradianceCache> cache;
  ASSERT_TRUE(cache->Begin(rays, 10.0, .01));
  for (const RecordCandidate& site : sphere.FindVisiblePoints(rays))
  {
    const glm::dvec3 world = glm::dvec3(site.Position) + sphere.SceneData.Origin;
    const glm::dvec3 normal(site.Normal);
    const glm::dvec3 geometric(site.GeometricNormal);
    EXPECT_EQ(brute->Occlusion(&world.x, &normal.x, &geometric.x).Value, 0.0);
    EXPECT_EQ(cache->Occlusion(&world.x, &normal.x, &geometric.x).Value, 0.0);
  }
}

TEST(SmoothNormals, AreIgnoredWhereTheyAreInvalid)
{
  CoarseSphere sphere(true);
  Surface& surface = sphere.SceneData.Surfaces[0];
  for (std::size_t i = 0; i < surface.Normals.size(); ++i)
  {
    const glm::vec3 outward = surface.Normals[i];
    const glm::vec3 tangent(outward.y, -outward.x, 0.f);
    surface.Normals[i] = i % 2 == 0 ? glm::vec3(std::nanf("")) : tangent;
  }
  const RayScene rays(sphere.SceneData, 0);
  for (const RecordCandidate& site : sphere.FindVisiblePoints(rays))
  {
    EXPECT_EQ(site.Normal, site.GeometricNormal);
  }
  // Normals that point inward are used on the visible side.
  for (std::size_t i = 0; i < surface.Normals.size(); ++i)
  {
    surface.Normals[i] = -glm::normalize(surface.Positions[i] + glm::vec3(sphere.SceneData.Origin));
  }
  for (const RecordCandidate& site : sphere.FindVisiblePoints(rays))
  {
    EXPECT_GT(glm::dot(site.Normal, site.GeometricNormal), .9f);
  }
}
