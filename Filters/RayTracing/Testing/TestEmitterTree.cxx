// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Sampled emitters against form factors, against solid angles, and against gathering by chance.
#include "Embree/RayScene.h"
#include "Execution/AvailableMemory.h"
#include "Lights/EmissiveSurfaces.h"
#include "Lights/EmitterTree.h"
#include "Scenes/Solids.h"
#include "Shading/HemisphereSampling.h"
#include "Shading/Illumination.h"
#include "Shading/OwenSobolSequence.h"
#include "Surface.h"

#include "vtkNew.h"
#include "vtkPenumbraBruteForceIrradiance.h"

#include <glm/gtc/constants.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

using namespace penumbra;

namespace
{

constexpr double Pi = glm::pi<double>();
const glm::vec3 Up(0.f, 0.f, 1.f);

void MakeBlack(Scene& scene)
{
  for (Surface& surface : scene.Surfaces)
  {
    surface.Front.DiffuseColor = glm::vec3(0.f);
  }
}

/// Turns the last surface into an emitter.
void MakeEmitter(Scene& scene, glm::vec3 radiance)
{
  Material& material = scene.Surfaces.back().Front;
  material.Ambient = std::max({ radiance.x, radiance.y, radiance.z });
  material.AmbientColor = radiance / material.Ambient;
  material.DiffuseColor = glm::vec3(0.f);
}

/// Adds a rectangle of 2 n^2 triangles.
void AddGrid(Scene& scene, glm::vec3 corner, glm::vec3 side, glm::vec3 other, int n)
{
  Surface surface;
  for (int j = 0; j <= n; ++j)
  {
    for (int i = 0; i <= n; ++i)
    {
      surface.Positions.push_back(
        corner + float(i) / float(n) * side + float(j) / float(n) * other);
    }
  }
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < n; ++i)
    {
      const auto at = static_cast<unsigned int>(j * (n + 1) + i);
      const auto width = static_cast<unsigned int>(n + 1);
      surface.Triangles.emplace_back(at, at + 1, at + width + 1);
      surface.Triangles.emplace_back(at, at + width + 1, at + width);
    }
  }
  scene.Surfaces.push_back(surface);
}

vtkPenumbraIrradianceProvider::Light ComputeIrradiance(
  const Scene& scene, glm::dvec3 point, double tolerance, glm::dvec3 normal = { 0.0, 0.0, 1.0 })
{
  const RayScene rays(scene, 1);
  vtkNew<vtkPenumbraBruteForceIrradiance> provider;
  provider->BeginIrradiance(Illumination(rays, {}), tolerance);
  return provider->Irradiance(&point.x, &normal.x, tolerance);
}

/// Solid angle of a sphere, or of a triangle (Van Oosterom and Strackee 1983).
double ComputeSolidAngle(const Emitter& emitter, glm::dvec3 point)
{
  const glm::dvec3 a = glm::dvec3(emitter.Corners[0]) - point;
  if (emitter.Radius > 0.f)
  {
    const double sine = emitter.Radius / glm::length(a);
    return 2.0 * Pi * (1.0 - std::sqrt(1.0 - sine * sine));
  }
  const glm::dvec3 b = glm::dvec3(emitter.Corners[1]) - point;
  const glm::dvec3 c = glm::dvec3(emitter.Corners[2]) - point;
  const double la = glm::length(a);
  const double lb = glm::length(b);
  const double lc = glm::length(c);
  return 2.0 *
    std::atan2(std::abs(glm::dot(a, glm::cross(b, c))),
      la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la);
}

/// Irradiance at the origin, facing +z, from a rectangle of radiance 1 at height h that spans x in
/// [0, a] and y in [0, b] (form factor of a differential element and a parallel rectangle).
double BelowRectangleCorner(double a, double b, double h)
{
  const double x = std::hypot(a, h);
  const double y = std::hypot(b, h);
  return .5 * (a / x * std::atan(b / x) + b / y * std::atan(a / y));
}

double BelowRectangle(double x0, double x1, double y0, double y1, double h)
{
  const auto corner = [&](double x, double y) {
    return std::copysign(1.0, x * y) * BelowRectangleCorner(std::abs(x), std::abs(y), h);
  };
  return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}

}

TEST(EmitterTree, ReturnsTheDensityOfItsSamples)
{
  std::vector<Emitter> emitters;
  std::uint32_t random = 1;
  for (std::uint32_t i = 0; i < 37; ++i)
  {
    const auto next = [&random]() { return 2.f * NextFloat(random) - 1.f; };
    Emitter emitter;
    const glm::vec3 center(3.f * next(), 3.f * next(), 1.f + next());
    emitter.Corners.fill(center);
    if (i % 3 == 0)
    {
      emitter.Radius = .1f;
    }
    else
    {
      emitter.Corners[1] += .3f * glm::vec3(next(), next(), next());
      emitter.Corners[2] += .3f * glm::vec3(next(), next(), next());
    }
    emitter.Strength = 1.5f + next();
    emitter.Color[i % 2] = 0.f;
    emitter.Primitive = i;
    emitters.push_back(emitter);
  }
  const EmitterTree tree(emitters);
  const glm::vec3 point(.1f, -.2f, -1.f);
  const OwenSobolSequence samples(7);
  // The mean of the inverse density is the solid angle of all emitters.
  double angle = 0.0;
  constexpr int Count = 1 << 16;
  for (std::uint32_t i = 0; i < Count; ++i)
  {
    const EmitterTree::Sample sample = tree.SampleDirection(point, Up, samples.At(i));
    if (sample.Density > 0.f)
    {
      EXPECT_GT(sample.Direction.z, 0.f);
      EXPECT_NEAR(tree.ComputeDensity(point, Up, sample.Direction, sample.Distance,
                    sample.Target->Surface, sample.Target->Primitive) /
          sample.Density,
        1.f, 1e-3f);
      angle += 1.0 / sample.Density;
    }
  }
  angle /= Count;
  double reference = 0.0;
  for (const Emitter& emitter : emitters)
  {
    reference += ComputeSolidAngle(emitter, point);
  }
  EXPECT_NEAR(angle / reference, 1.0, .01);
}

TEST(EmitterTree, SamplesASubdividedPanelAsWellAsAWholeOne)
{
  double errors[2];
  for (const int i : { 0, 1 })
  {
    Scene scene;
    AddGrid(scene, { -.5f, -.3f, 1.f }, { .9f, 0.f, 0.f }, { 0.f, .6f, 0.f }, i == 0 ? 1 : 30);
    MakeEmitter(scene, glm::vec3(1.f));
    const EmitterTree tree(FindEmissiveSurfaces(scene, 0.0, 0).Bright);
    constexpr std::uint32_t Samples = 16;
    constexpr std::uint32_t Trials = 400;
    double squares = 0.0;
    for (std::uint32_t seed = 0; seed < Trials; ++seed)
    {
      const OwenSobolSequence samples(seed);
      double sum = 0.0;
      for (std::uint32_t k = 0; k < Samples; ++k)
      {
        const EmitterTree::Sample sample = tree.SampleDirection(glm::vec3(0.f), Up, samples.At(k));
        sum += sample.Direction.z / sample.Density / Samples;
      }
      squares += std::pow(sum - BelowRectangle(-.5, .4, -.3, .3, 1.0), 2.0) / Trials;
    }
    errors[i] = std::sqrt(squares);
  }
  EXPECT_LT(errors[0], .002);
  EXPECT_LT(errors[1], 1.2 * errors[0]);
}

TEST(EmitterTree, IgnoresEmittersWithoutLight)
{
  Emitter emitter;
  emitter.Corners = { glm::vec3(0.f, 0.f, 1.f), glm::vec3(1.f, 0.f, 1.f),
    glm::vec3(0.f, 1.f, 1.f) };
  for (const float strength :
    { 0.f, -1.f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity() })
  {
    emitter.Strength = strength;
    EXPECT_TRUE(EmitterTree({ emitter }).IsEmpty());
  }
  emitter.Strength = 1.f;
  emitter.Color.y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(EmitterTree({ emitter, emitter }).IsEmpty());
  emitter.Corners[2] = emitter.Corners[1]; // without area
  EXPECT_TRUE(EmitterTree({ emitter }).IsEmpty());
  EXPECT_EQ(EmitterTree().SampleDirection(glm::vec3(0.f), Up, glm::vec2(.5f)).Density, 0.f);
}

TEST(SampledLight, MatchesFormFactorOfRectangle)
{
  for (const int n : { 1, 32 })
  {
    Scene scene;
    AddFloor(scene, 10.f);
    MakeBlack(scene);
    AddGrid(scene, { -.3f, -.2f, 1.f }, { .6f, 0.f, 0.f }, { 0.f, .4f, 0.f }, n);
    MakeEmitter(scene, { 10.f, 5.f, 1.f });
    for (int i = 0; i < 10; ++i)
    {
      const double x = .3 * i;
      const double reference = 10.0 * BelowRectangle(-.3 - x, .3 - x, -.2 - .1, .2 - .1, 1.0);
      const auto light = ComputeIrradiance(scene, { x, .1, 0.0 }, .005);
      EXPECT_NEAR(light.Value[0], reference, .02) << n << " at " << x;
      EXPECT_NEAR(light.Value[1], .5 * light.Value[0], 1e-4);
      EXPECT_NEAR(light.Value[2], .1 * light.Value[0], 1e-4);
    }
  }
}

TEST(SampledLight, MatchesFormFactorOfDiskAndSphere)
{
  for (const bool round : { false, true })
  {
    Scene scene;
    AddFloor(scene, 10.f);
    MakeBlack(scene);
    if (round)
    {
      Surface sphere;
      sphere.Positions = { { 0.f, 0.f, 1.f } };
      sphere.Radii = { .25f };
      scene.Surfaces.push_back(sphere);
    }
    else
    {
      AddDisc(scene, .25f, 1.f);
    }
    MakeEmitter(scene, glm::vec3(20.f));
    for (int i = 0; i < 8; ++i)
    {
      const double d = .25 * i;
      const double r2 = .25 * .25;
      const double v = 1.0 + d * d + r2;
      const double disk = .5 * (1.0 - (1.0 + d * d - r2) / std::sqrt(v * v - 4.0 * d * d * r2));
      const double sphere = r2 / std::pow(1.0 + d * d, 1.5);
      EXPECT_NEAR(ComputeIrradiance(scene, { d, 0.0, 0.0 }, .005).Value[0],
        20.0 * Pi * (round ? sphere : disk), .03)
        << d;
    }
  }
}

TEST(SampledLight, MatchesGatheringByChanceBehindAnOccluder)
{
  Scene scene;
  AddFloor(scene, 10.f);
  AddRectangle(scene, { -1.f, -1.f, .5f }, { 1.1f, 0.f, 0.f }, { 0.f, 2.f, 0.f });
  MakeBlack(scene);
  AddRectangle(scene, { -.5f, -.4f, 1.f }, { 1.f, 0.f, 0.f }, { 0.f, .8f, .2f });
  MakeEmitter(scene, glm::vec3(4.f));
  const RayScene rays(scene, 1);
  const OwenSobolSequence directions(3);
  for (int i = 0; i < 8; ++i)
  {
    const glm::vec3 point(.1f * static_cast<float>(i) - .1f, .05f, 0.f);
    double sum = 0.0;
    constexpr int Count = 1 << 16;
    for (std::uint32_t k = 0; k < Count; ++k)
    {
      const glm::vec2 u = directions.At(k);
      const Ray ray =
        Illumination::SpawnRay(point, Up, DiskToHemisphere(SampleUniformDiskConcentric(u.x, u.y)));
      sum += rays.Intersect(ray).Surface == 2 ? 4.0 : 0.0;
    }
    EXPECT_NEAR(ComputeIrradiance(scene, point, .004).Value[0], Pi * sum / Count, .015) << i;
  }
}

TEST(SampledLight, IsExactNextToAnEmitterThatStandsOnTheFloor)
{
  // The emitter touches the receiver: sampling by area alone would have an infinite variance there.
  Scene scene;
  AddFloor(scene, 100.f);
  MakeBlack(scene);
  AddRectangle(scene, { 0.f, -.5f, 0.f }, { 0.f, 1.f, 0.f }, { 0.f, 0.f, 1.f });
  MakeEmitter(scene, glm::vec3(1.f));
  for (const double d : { .002, .02, .2 })
  {
    // Integral over the parallel edges (Lambert): floor edge and top edge of the emitter.
    const double c = std::hypot(1.0, d);
    const double reference = std::atan(.5 / d) - d / c * std::atan(.5 / c);
    EXPECT_NEAR(ComputeIrradiance(scene, { d, 0.0, 0.0 }, .005).Value[0], reference, .02) << d;
  }
}

TEST(SampledLight, DoesNotPassThroughCoincidentSurfaces)
{
  // An emitter in the plane of a ceiling that is drawn over it, and one that is below.
  Scene scene;
  AddFloor(scene, 10.f);
  AddRectangle(scene, { -2.f, -2.f, .9f }, { 4.f, 0.f, 0.f }, { 0.f, 4.f, 0.f });
  MakeBlack(scene);
  AddRectangle(scene, { -.5f, -.5f, 1.f }, { 1.f, 0.f, 0.f }, { 0.f, 1.f, 0.f });
  MakeEmitter(scene, glm::vec3(10.f));
  EXPECT_EQ(ComputeIrradiance(scene, { 0.0, 0.0, 0.0 }, .01).Value[0], 0.0);
}

TEST(SampledLight, IsMultipliedByTheTransmittanceOfPanes)
{
  Scene scene;
  AddFloor(scene, 10.f);
  AddRectangle(scene, { -9.f, -9.f, .5f }, { 18.f, 0.f, 0.f }, { 0.f, 18.f, 0.f });
  scene.Surfaces.back().Front.Opacity = .4f;
  MakeBlack(scene);
  AddRectangle(scene, { -.5f, -.5f, 1.f }, { 1.f, 0.f, 0.f }, { 0.f, 1.f, 0.f });
  MakeEmitter(scene, glm::vec3(10.f));
  const double reference = 6.0 * BelowRectangle(-.5, .5, -.5, .5, 1.0);
  EXPECT_NEAR(ComputeIrradiance(scene, { 0.0, 0.0, 0.0 }, .005).Value[0], reference, .02);
}

TEST(SampledLight, FindsAnEmitterOfOneTenThousandthOfTheWalls)
{
  Scene scene;
  AddBox(scene, glm::vec3(-1.f), glm::vec3(1.f));
  MakeBlack(scene);
  AddRectangle(scene, { -.01f, -.01f, .99f }, { .02f, 0.f, 0.f }, { 0.f, .02f, 0.f });
  MakeEmitter(scene, glm::vec3(1e4f));
  for (int i = 0; i < 10; ++i)
  {
    const double x = .09 * i;
    const double reference = 1e4 * BelowRectangle(-.01 - x, .01 - x, -.01, .01, 1.99);
    const auto light = ComputeIrradiance(scene, { x, 0.0, -1.0 }, .005);
    EXPECT_NEAR(light.Value[0], reference, .02) << x;
    EXPECT_LE(light.Rays, 2000);
  }
}

namespace
{

struct ShadowedPoints
{
  int Penumbra = 0; ///< partly shadowed
  int Wrong = 0;    ///< off by more than twice the tolerance and four times the estimate
};

/// Lights 2,000 points on a floor below edges of half-planes or wires at height 1, under a panel or a sphere at height
/// 2 with an extent of `Size`. `wire`: width relative to it, 0: a half-plane. `n`: the panel has 2 n^2 triangles.
ShadowedPoints CountShadowEdges(bool isSphere, float wire, int n = 1)
{
  constexpr float Size = .2f;
  constexpr int Edges = 40;
  constexpr int Points = 50;
  constexpr int Side = 64;
  const float begin = .25f * wire * Size;
  const float width = wire > 0.f ? 2.f * begin : 50.f;
  ShadowedPoints counts;
  for (int edge = 0; edge < Edges; ++edge)
  {
    const float angle = 2.f * static_cast<float>(Pi) * (edge + .3f) / Edges;
    const glm::vec3 across(std::cos(angle), std::sin(angle), 0.f);
    const glm::vec3 along(-across.y, across.x, 0.f);
    const glm::vec3 center(.3f, -.2f, 2.f);
    Scene scene;
    AddRectangle(scene, Up + begin * across - 50.f * along, 100.f * along, -width * across);
    MakeBlack(scene);
    if (isSphere)
    {
      Surface sphere;
      sphere.Positions = { center };
      sphere.Radii = { .5f * Size };
      scene.Surfaces.push_back(sphere);
    }
    else
    {
      AddGrid(scene, center - glm::vec3(.5f * Size, .5f * Size, 0.f), { Size, 0.f, 0.f },
        { 0.f, Size, 0.f }, n);
    }
    MakeEmitter(scene, glm::vec3(1e4f));
    const RayScene rays(scene, 1);
    const Illumination light(rays, {});
    for (int i = 0; i < Points; ++i)
    {
      const glm::vec3 point = 1.4f * Size * (static_cast<float>(i) / Points - .5f) * across -
        glm::vec3(center.x, center.y, 0.f);
      double exact = 0.0;
      double unshadowed = 0.0;
      for (int k = 0; k < Side * Side; ++k)
      {
        const glm::vec2 u = (glm::vec2(k % Side, k / Side) + .5f) / static_cast<float>(Side);
        glm::vec3 direction = center + Size * glm::vec3(u - .5f, 0.f) - point;
        double value = 1.0;
        if (isSphere)
        {
          const glm::vec3 to = center - point;
          const float sine = .5f * Size / glm::length(to);
          const float below = u.x * (1.f - std::sqrt(1.f - sine * sine));
          const float side = std::sqrt(below * (2.f - below));
          const float turn = 2.f * static_cast<float>(Pi) * u.y;
          direction = FrameFromNormal(glm::normalize(to)) *
            glm::vec3(side * std::cos(turn), side * std::sin(turn), 1.f - below);
          value = direction.z;
        }
        else
        {
          const double square = glm::dot(direction, direction);
          value = direction.z * direction.z / (square * square);
        }
        unshadowed += value;
        const float beyond = glm::dot(point + direction / direction.z, across) - begin;
        exact += beyond > 0.f || beyond < -width ? value : 0.0;
      }
      counts.Penumbra += exact > 0.0 && exact < unshadowed ? 1 : 0;
      long long count = 0;
      const double solid = isSphere ? 2.0 * Pi *
          (1.0 - std::sqrt(1.0 - .25 * Size * Size / glm::dot(center - point, center - point)))
                                    : Size * Size;
      const double scale = 1e4 / Pi * solid / (Side * Side);
      const double tolerance = .01 * unshadowed * scale;
      const Illumination::SampledLight found =
        light.EstimateSampledLight(point, Up, tolerance, count);
      const double off = std::abs(found.Mean.x - exact * scale);
      counts.Wrong += off > std::max(2.0 * tolerance, 4.0 * found.Error) ? 1 : 0;
    }
  }
  return counts;
}

}

TEST(SampledLight, FindsShadowEdgesThatHideLittleOfPanels)
{
  for (const int n : { 1, 30 })
  {
    const ShadowedPoints counts = CountShadowEdges(false, 0.f, n);
    EXPECT_GT(counts.Penumbra, 1700);
    EXPECT_EQ(counts.Wrong, 0) << n;
  }
}

// A hexagon in the outline of a sphere leaves 3 % of it outside each side.
TEST(SampledLight, FindsShadowEdgesThatHideLittleOfSpheres)
{
  const ShadowedPoints counts = CountShadowEdges(true, 0.f);
  EXPECT_GT(counts.Penumbra, 1400);
  EXPECT_LE(counts.Wrong, .006 * counts.Penumbra);
}

// A ball that covers a quarter of the emitter hides none of its outline.
TEST(SampledLight, FindsBallsInFrontOfEmitters)
{
  constexpr int Side = 64;
  for (const bool isSphere : { false, true })
  {
    Scene scene;
    const glm::vec3 center(0.f, 0.f, 2.f);
    const double radius = isSphere ? .025 : .05 / std::sqrt(Pi);
    AddFloor(scene, 10.f);
    AddSphere(scene, { 0.0, 0.0, 1.0 }, radius, 40);
    MakeBlack(scene);
    if (isSphere)
    {
      Surface sphere;
      sphere.Positions = { center };
      sphere.Radii = { .1f };
      scene.Surfaces.push_back(sphere);
    }
    else
    {
      AddGrid(scene, { -.1f, -.1f, 2.f }, { .2f, 0.f, 0.f }, { 0.f, .2f, 0.f }, 1);
    }
    MakeEmitter(scene, glm::vec3(1e4f));
    const RayScene rays(scene, 1);
    const Illumination light(rays, {});
    int wrong = 0;
    for (int i = 0; i < 400; ++i)
    {
      const glm::vec3 point(
        .001f * static_cast<float>(i % 20 - 10), .001f * static_cast<float>(i / 20 - 10), 0.f);
      long long count = 0;
      double exact = 0.0;
      double unshadowed = 0.0;
      for (int k = 0; k < Side * Side; ++k)
      {
        const glm::vec2 u =
          2.f * (glm::vec2(k % Side, k / Side) + .5f) / static_cast<float>(Side) - 1.f;
        const bool isInside = !isSphere || glm::dot(u, u) <= 1.f;
        const glm::vec3 direction = glm::normalize(center + .1f * glm::vec3(u, 0.f) - point);
        const glm::vec3 to = glm::vec3(0.f, 0.f, 1.f) - point;
        const bool isHidden = glm::length(glm::cross(direction, to)) < radius;
        unshadowed += isInside ? 1.0 : 0.0;
        exact += isInside && !isHidden ? 1.0 : 0.0;
      }
      const double whole = 1e4 * (isSphere ? .0025 : .01 / Pi);
      const Illumination::SampledLight found =
        light.EstimateSampledLight(point, Up, .01 * whole, count);
      const double off = std::abs(found.Mean.x - whole * exact / unshadowed);
      wrong += off > std::max(.03 * whole, 4.0 * found.Error) ? 1 : 0;
    }
    EXPECT_LE(wrong, 24) << isSphere; // all of 8 stratified rays miss the ball
  }
}

// The light that a ray finds is that of the emitter that its weight belongs to.
TEST(SampledLight, IsExactNextToMuchStrongerEmitters)
{
  Scene scene;
  AddFloor(scene, 10.f);
  MakeBlack(scene);
  double whole = 0.0;
  for (const float radiance : { 1e4f, 1e2f, 1e4f })
  {
    const float x = .3f * static_cast<float>(scene.Surfaces.size() - 2);
    AddGrid(scene, { x - .05f, -.05f, 3.f }, { .1f, 0.f, 0.f }, { 0.f, .1f, 0.f }, 1);
    MakeEmitter(scene, glm::vec3(radiance));
    whole += radiance * .01 * 9.0 / (Pi * std::pow(9.0 + x * x, 2.0));
  }
  const RayScene rays(scene, 1);
  const Illumination light(rays, {});
  for (int i = 0; i < 2000; ++i)
  {
    const glm::vec3 point(
      1e-4f * static_cast<float>(i % 50), 1e-4f * static_cast<float>(i / 50), 0.f);
    long long count = 0;
    const Illumination::SampledLight found =
      light.EstimateSampledLight(point, Up, .01 * whole, count);
    ASSERT_NEAR(found.Mean.x, whole, std::max(.03 * whole, 4.0 * found.Error)) << i;
    ASSERT_LT(count, 100) << i;
  }
}

// The first rays are as visible as each other. If all of them are toward emitters of one color, the light of the others
// would be missed.
TEST(SampledLight, OfTwoColorsHasBoth)
{
  const glm::vec3 positions[] = { { -1.f, .2f, 3.f }, { .8f, -.5f, 2.5f } };
  for (const float weak : { .5f, .1f, .05f })
  {
    for (const bool isWeakFirst : { true, false })
    {
      Scene scene;
      AddFloor(scene, 10.f);
      MakeBlack(scene);
      glm::dvec3 exact(0.0);
      for (const int i : { 0, 1 })
      {
        const bool isWeak = (i == 0) == isWeakFirst;
        const glm::vec3 radiance =
          1e4f * (isWeak ? weak * glm::vec3(0.f, 1.f, .5f) : glm::vec3(1.f, 0.f, 0.f));
        const glm::vec3 at = positions[i];
        AddGrid(scene, at - glm::vec3(.05f, .05f, 0.f), { .1f, 0.f, 0.f }, { 0.f, .1f, 0.f }, 1);
        MakeEmitter(scene, radiance);
        exact +=
          glm::dvec3(radiance) * (.01 * at.z * at.z / (Pi * std::pow(glm::dot(at, at), 2.0)));
      }
      const RayScene rays(scene, 1);
      const Illumination light(rays, {});
      const double tolerance = .01 * exact.x;
      int wrong = 0;
      long long sum = 0;
      for (int i = 0; i < 2000; ++i)
      {
        const glm::vec3 point(
          1e-4f * static_cast<float>(i % 50), 1e-4f * static_cast<float>(i / 50), 0.f);
        long long count = 0;
        const Illumination::SampledLight found =
          light.EstimateSampledLight(point, Up, tolerance, count);
        const double limit = std::max(3.0 * tolerance, 4.0 * static_cast<double>(found.Error));
        const glm::dvec3 off = glm::abs(glm::dvec3(found.Mean) - exact);
        wrong += std::max(off.x, off.y) > limit ? 1 : 0;
        sum += count;
      }
      EXPECT_EQ(wrong, 0) << weak << " " << isWeakFirst;
      EXPECT_LE(sum, 70 * 2000) << weak << " " << isWeakFirst;
    }
  }
}

TEST(SampledLight, MissesSomeWiresNarrowerThanHalfOfTheEmitter)
{
  // Widths relative to the emitter, and fractions of points with a wrong value and estimate: panel, sphere.
  const double rows[][3] = { { 0.5, 0.0, 0.002 }, { 0.25, 0.012, 0.004 }, { 0.125, 0.13, 0.12 },
    { 0.0625, 0.28, 0.39 } };
  for (const auto& [width, panel, sphere] : rows)
  {
    for (const bool isSphere : { false, true })
    {
      const ShadowedPoints counts = CountShadowEdges(isSphere, static_cast<float>(width));
      EXPECT_GT(counts.Penumbra, 1400) << width;
      EXPECT_LE(counts.Wrong, (isSphere ? sphere : panel) * counts.Penumbra) << width;
    }
  }
}

TEST(EmissiveSurfaces, StoreOnlyEmittersThatAreUsed)
{
  Scene scene;
  AddGrid(scene, glm::vec3(0.f), glm::vec3(1.f, 0.f, 0.f), glm::vec3(0.f, 1.f, 0.f), 10);
  MakeEmitter(scene, glm::vec3(1.f));
  AddGrid(scene, glm::vec3(0.f, 0.f, 1.f), glm::vec3(0.1f, 0.f, 0.f), glm::vec3(0.f, 0.1f, 0.f), 3);
  MakeEmitter(scene, glm::vec3(100.f));
  // 200 triangles of area 1 and radiance 1 and 18 of area 0.01 and radiance 100, in a box whose sides
  // have an area of 6.
  const EmissiveSurfaces few = FindEmissiveSurfaces(scene, 2.0, 200);
  EXPECT_NEAR(few.MeanRadiance, (1.0 + 0.01 * 100.0) / 6.0, 1e-5);
  EXPECT_EQ(few.Bright.size() + few.Dim.size(), 218u);
  const EmissiveSurfaces bright = FindEmissiveSurfaces(scene, 10.0, 199);
  ASSERT_EQ(bright.Bright.size(), 18u);
  EXPECT_EQ(bright.Bright[0].Surface, 1u);
  EXPECT_EQ(bright.Bright[17].Primitive, 17u);
  EXPECT_TRUE(bright.Dim.empty());
  EXPECT_TRUE(bright.HasMoreDim);
  const EmissiveSurfaces all = FindEmissiveSurfaces(scene, 10.0, 200);
  EXPECT_EQ(all.Dim.size(), 200u);
  EXPECT_FALSE(all.HasMoreDim);
  setenv("PENUMBRA_AVAILABLE_MEMORY", "1e-3", 1);
  EXPECT_THROW(FindEmissiveSurfaces(scene, 10.0, 8), InsufficientMemory);
  EXPECT_NO_THROW(FindEmissiveSurfaces(scene, 1e6, 8));
  unsetenv("PENUMBRA_AVAILABLE_MEMORY");
}
