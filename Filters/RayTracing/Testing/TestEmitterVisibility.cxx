// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Rays toward emitters against intersections in double precision, and emitters that hide behind their sides.
#include "Embree/RayScene.h"
#include "Lights/EmissiveSurfaces.h"
#include "Scenes/Solids.h"
#include "Shading/HemisphereSampling.h"
#include "Shading/Illumination.h"
#include "Shading/RayTracingConstants.h"
#include "Surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <tuple>
#include <utility>

using namespace penumbra;

namespace
{

constexpr std::uint32_t Samples = 4000;
const glm::vec3 Up(0.f, 0.f, 1.f);
const glm::vec3 Radiance(80.f, 60.f, 40.f);

void MakeEmitter(Surface& surface)
{
  surface.Front.Ambient = 1.f;
  surface.Front.AmbientColor = Radiance;
  surface.Front.DiffuseColor = glm::vec3(0.f);
}

/// A panel above a floor, which is below all points.
Scene MakePanel(glm::vec3 side, glm::vec3 other)
{
  Scene scene;
  AddRectangle(scene, { -.4f, -.3f, 2.f }, side, other);
  MakeEmitter(scene.Surfaces[0]);
  AddRectangle(scene, { -5.f, -5.f, -1.5f }, { 10.f, 0.f, 0.f }, { 0.f, 10.f, 0.f });
  return scene;
}

Scene MakeTiltedPanel()
{
  return MakePanel({ .8f, 0.f, .1f }, { 0.f, .6f, -.05f });
}

Scene MakeLevelPanel()
{
  return MakePanel({ .8f, 0.f, 0.f }, { 0.f, .6f, 0.f });
}

class Random
{
public:
  float operator()(float low, float high) { return low + (high - low) * NextFloat(this->State); }
  glm::vec3 operator()(glm::vec3 low, glm::vec3 high)
  {
    const float x = NextFloat(this->State);
    const float y = NextFloat(this->State);
    return low + (high - low) * glm::vec3(x, y, NextFloat(this->State));
  }

private:
  std::uint32_t State = 7;
};

enum class Hits
{
  No,
  Yes,
  Unsure ///< within rounding of an edge
};

/// Whether a segment meets a triangle.
Hits MeetsTriangle(glm::dvec3 from, glm::dvec3 to, const std::array<glm::vec3, 3>& corners)
{
  const glm::dvec3 a(corners[0]);
  const glm::dvec3 b(corners[1]);
  const glm::dvec3 c(corners[2]);
  const glm::dvec3 d = to - from;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double along = glm::dot(normal, d);
  const double t = glm::dot(normal, a - from) / along;
  const glm::dvec3 p = from + t * d;
  const double square = glm::dot(normal, normal);
  const double least = std::min({ t, 1.0 - t, glm::dot(glm::cross(c - b, p - b), normal) / square,
    glm::dot(glm::cross(a - c, p - c), normal) / square,
    glm::dot(glm::cross(b - a, p - a), normal) / square });
  return least > 1e-5 ? Hits::Yes : least > -1e-5 ? Hits::Unsure : Hits::No;
}

/// Whether it meets a sphere or a tube, by the distance of points on it.
Hits MeetsRound(glm::dvec3 from, glm::dvec3 to, const RoundShape& shape)
{
  constexpr int Steps = 400;
  const glm::dvec3 a(shape.A);
  const glm::dvec3 axis = glm::dvec3(shape.B) - a;
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= Steps; ++i)
  {
    const glm::dvec3 p = from + (double(i) / Steps) * (to - from) - a;
    const double at = glm::dot(p, axis) / std::max(glm::dot(axis, axis), 1e-30);
    nearest = std::min(nearest, glm::length(p - std::clamp(at, 0.0, 1.0) * axis));
  }
  const double ratio = nearest / shape.RadiusA;
  return ratio < .999 ? Hits::Yes : ratio < 1.001 ? Hits::Unsure : Hits::No;
}

/// Whether something is between a point and the point of surface 0 that `sample` selects.
Hits FindOccluder(const Scene& scene, glm::dvec3 from, glm::dvec3 to)
{
  Hits found = Hits::No;
  for (std::size_t i = 1; i < scene.Surfaces.size(); ++i)
  {
    const Surface& surface = scene.Surfaces[i];
    for (std::uint32_t k = 0; k < surface.GetNumberOfPrimitives(); ++k)
    {
      const Hits hits = surface.IsRound() ? MeetsRound(from, to, surface.GetRoundShape(k))
                                          : MeetsTriangle(from, to, surface.GetPoints(k));
      if (hits == Hits::Yes)
      {
        return hits;
      }
      found = hits == Hits::Unsure ? hits : found;
    }
  }
  return found;
}

struct Comparison
{
  int Visible = 0;
  int Hidden = 0;
  int Wrong = 0;
};

/// Compares single samples and packets of them at random points, of which `place` returns position and normal, with
/// intersections of the segments.
template <typename Place>
Comparison Compare(const Scene& scene, const Place& place)
{
  const RayScene rays(scene, 1);
  const Illumination light(rays, {});
  const EmitterTree tree(FindEmissiveSurfaces(scene, EmitterThreshold, 0).Bright);
  Comparison result;
  Random random;
  for (std::uint32_t i = 0; i < Samples; i += 16)
  {
    LightReceiver receivers[16];
    Hits expected[16];
    for (int k = 0; k < 16; ++k)
    {
      LightReceiver& at = receivers[k];
      std::tie(at.Position, at.Normals) = place(random);
      at.Sample = { random(0.f, 1.f), random(0.f, 1.f) };
      const glm::vec3 from = at.Position + RayOriginOffset(at.Position) * at.Normals.Geometric;
      const EmitterTree::Sample sample = tree.SampleDirection(from, at.Normals.Shading, at.Sample);
      const glm::dvec3 to =
        glm::dvec3(from) + double(sample.Distance) * glm::dvec3(sample.Direction);
      expected[k] = sample.Density > 0.f ? FindOccluder(scene, from, to) : Hits::Yes;
    }
    for (const std::uint32_t count : { 1u, 7u, 16u })
    {
      long long traced = 0;
      glm::vec3 found[16];
      light.SampleLights(receivers, count, found, traced);
      for (std::uint32_t k = 0; k < count; ++k)
      {
        const bool isLit = found[k].x > 0.f;
        result.Visible += isLit ? 1 : 0;
        result.Hidden += isLit ? 0 : 1;
        result.Wrong += expected[k] != Hits::Unsure && isLit != (expected[k] == Hits::No) ? 1 : 0;
        EXPECT_LE(std::abs(found[k].y - .75f * found[k].x), 1e-5f * found[k].x);
      }
    }
  }
  return result;
}

std::pair<glm::vec3, SurfaceNormals> PlaceBelow(Random& random)
{
  return { random(glm::vec3(-3.f, -3.f, -1.f), glm::vec3(3.f, 3.f, 0.f)), SurfaceNormals(Up) };
}

void ExpectEqual(const Comparison& found)
{
  EXPECT_EQ(found.Wrong, 0);
  EXPECT_GT(found.Visible, Samples / 32);
  EXPECT_GT(found.Hidden, Samples / 32);
}

}

TEST(EmitterVisibility, MatchesIntersectionsWithTriangles)
{
  Scene scene = MakeTiltedPanel();
  Random random;
  for (int i = 0; i < 12; ++i)
  {
    const glm::vec3 corner = random(glm::vec3(-1.f, -1.f, .3f), glm::vec3(1.f, 1.f, 1.8f));
    AddRectangle(scene, corner, random(glm::vec3(-.5f), glm::vec3(.5f)),
      random(glm::vec3(-.5f), glm::vec3(.5f)));
  }
  AddBox(scene, { .5f, -.9f, 0.f }, { .9f, .4f, 1.1f });
  ExpectEqual(Compare(scene, PlaceBelow));
}

TEST(EmitterVisibility, MatchesIntersectionsWithSpheresTubesAndInstances)
{
  Scene scene = MakeTiltedPanel();
  Surface spheres;
  spheres.Positions = { { .1f, .2f, 1.2f }, { -.6f, 0.f, .8f } };
  spheres.Radii = { .15f, .3f };
  scene.Surfaces.push_back(spheres);
  Surface tube;
  tube.Positions = { { -1.5f, .6f, 1.1f }, { 1.5f, .3f, 1.3f } };
  tube.Segments = { { 0, 1 } };
  tube.Radii = { .1f };
  scene.Surfaces.push_back(tube);
  AddRectangle(scene, { 0.f, 0.f, 0.f }, { .4f, 0.f, 0.f }, { 0.f, .4f, .1f });
  auto instances = std::make_shared<SurfaceInstances>();
  instances->Transforms = { glm::dmat4x3(1.0), glm::dmat4x3(2.0) };
  instances->Transforms[0][3] = { -.5, -.7, 1.4 };
  instances->Transforms[1][3] = { .3, -.6, .9 };
  instances->Colors.assign(2, glm::u8vec4(255));
  instances->Ids = { 0, 1 };
  instances->Center = { .2, .2, .05 };
  instances->HalfSize = { .2, .2, .05 };
  instances->Radius = .3;
  scene.Surfaces.back().Instances = instances;
  ExpectEqual(Compare(scene, PlaceBelow));
}

// Much nearer to the emitter than the tolerance of the distance at which rays reach it.
TEST(EmitterVisibility, MatchesIntersectionsNextToTheEmitter)
{
  for (const float gap : { 2e-4f, 1e-3f })
  {
    Scene scene = MakeLevelPanel();
    AddRectangle(scene, { -.5f, -.5f, 2.f - gap }, { .6f, 0.f, 0.f }, { 0.f, 1.f, 0.f });
    AddRectangle(scene, { -.5f, -.5f, 2.f + gap }, { 1.f, 0.f, 0.f }, { 0.f, 1.f, 0.f });
    ExpectEqual(Compare(scene, PlaceBelow));
  }
}

// Rays nearly in the plane of a panel meet it far before or behind the sampled point.
TEST(EmitterVisibility, MatchesIntersectionsAtGrazingAngles)
{
  Scene scene = MakeTiltedPanel();
  const std::array<glm::vec3, 3> corners = scene.Surfaces[0].GetPoints(0);
  const glm::vec3 side(.8f, 0.f, .1f);
  const glm::vec3 other(0.f, .6f, -.05f);
  const glm::vec3 normal = glm::normalize(glm::cross(side, other));
  AddRectangle(scene, corners[0] - 1.5f * side - .002f * normal, 1.2f * side, other);
  ExpectEqual(Compare(scene, [&](Random& random) {
    const glm::vec3 at = corners[0] + random(-2.f, -.1f) * side + random(0.f, 1.f) * other +
      (random(0.f, 1.f) < .5f ? -1.f : 1.f) * random(.0005f, .02f) * normal;
    return std::make_pair(at, SurfaceNormals(glm::normalize(side)));
  }));
}

TEST(EmitterVisibility, IsThatOfTheLastOfCoincidentSurfaces)
{
  for (const bool isHidden : { false, true })
  {
    Scene scene = MakeLevelPanel();
    AddRectangle(scene, { -1.f, -1.f, 2.f }, { 2.f, 0.f, 0.f }, { 0.f, 2.f, 0.f });
    if (!isHidden)
    {
      std::swap(scene.Surfaces[0], scene.Surfaces[2]);
    }
    const RayScene rays(scene, 1);
    long long traced = 0;
    const float found =
      Illumination(rays, {}).EstimateSampledLight(glm::vec3(0.f), Up, .01, traced).Mean.x;
    EXPECT_EQ(found > 0.f, !isHidden);
  }
}

TEST(EmitterVisibility, IsNoneFromCulledSides)
{
  for (const bool isCulled : { false, true })
  {
    Scene scene = MakeTiltedPanel();
    scene.Surfaces[0].Frontfaces = !isCulled;
    scene.Surfaces[0].Backfaces = !isCulled;
    const Comparison found = Compare(scene, PlaceBelow);
    EXPECT_EQ(found.Visible > 0, !isCulled);
  }
}
