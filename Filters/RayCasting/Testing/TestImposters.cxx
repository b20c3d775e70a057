// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Spheres and cylinders with flat ends of vtkOpenGLSphereMapper and vtkOpenGLStickMapper. These
// classes are not in all builds of VTK: the tests pass the settings that are read from them.
// Testing/Features compares with VTK's images if the linked VTK has the classes.
#include "Embree/RayScene.h"
#include "Embree/RoundIntersection.h"
#include "Image/ImageRegion.h"
#include "RoundScene.h"
#include "Scene.h"
#include "Shading/Shading.h"
#include "Surface.h"
#include "Tessellation/SceneExtractionImposters.h"
#include "Tessellation/SceneExtractionLines.h"

#include "vtkDoubleArray.h"

#include <algorithm>
#include <limits>
#include <random>
#include <string>

using namespace penumbra_testing;
using penumbra::ImposterSettings;

namespace
{

struct Stick
{
  glm::dvec3 Center;
  glm::dvec3 Axis; ///< unit vector
  double Length;
  double Radius;
};

/// Four sticks that show both ends, one of which is seen along its axis.
const std::vector<Stick> FourSticks = { { { -1.0, 0.8, -5.0 }, { 0.0, 0.6, 0.8 }, 1.4, 0.4 },
  { { 1.0, 0.9, -6.0 }, { 0.8, 0.0, -0.6 }, 1.2, 0.5 },
  { { 0.0, 0.0, -5.5 }, { 0.0, 0.0, 1.0 }, 1.0, 0.5 },
  { { 0.5, -1.3, -5.0 }, { 0.96, 0.28, 0.0 }, 2.0, 0.2 } };

vtkSmartPointer<vtkDoubleArray> MakeArray(const char* name, int components)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  return array;
}

/// Returns the input of a stick mapper: a point for each stick, with the arrays Size and Axis.
vtkSmartPointer<vtkPolyData> MakeStickData(const std::vector<Stick>& sticks)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const auto sizes = MakeArray("Size", 3);
  const auto axes = MakeArray("Axis", 3);
  for (const Stick& stick : sticks)
  {
    points->InsertNextPoint(&stick.Center.x);
    sizes->InsertNextTuple3(stick.Length, stick.Radius, 0.0);
    axes->InsertNextTuple(&stick.Axis.x);
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(sizes);
  data->GetPointData()->AddArray(axes);
  return data;
}

const ImposterSettings StickSettings = { true, 0.0, "Size", "Axis" };

penumbra::DrawItem MakePrototype()
{
  penumbra::DrawItem prototype;
  prototype.Name = "Object 0";
  prototype.Property = vtkSmartPointer<vtkProperty>::New();
  prototype.Property->LightingOff();
  return prototype;
}

/// Returns a scene with the camera of RoundScene.
penumbra::Scene MakeScene(vtkPolyData* data, const ImposterSettings& settings)
{
  penumbra::Scene scene;
  scene.ViewCamera.Width = scene.ViewCamera.Height = Side;
  scene.ViewCamera.Center = glm::dvec2(0.5 * Side);
  scene.ViewCamera.PixelSize = 2.0 * std::tan(0.5 * ViewAngle * std::acos(-1.0) / 180.0) / Side;
  scene.ViewCamera.Near = 0.01;
  AddLinesAndPoints(MakeImposters(settings, data, MakePrototype(), {}, scene.Warnings), 1.0, scene);
  return scene;
}

/// Returns true if a ray passes through a stick: the part of the ray between the planes of the ends
/// comes nearer to the axis than the radius.
bool HitsStick(glm::dvec3 origin, glm::dvec3 direction, const Stick& stick)
{
  const double rise = glm::dot(direction, stick.Axis);
  const double height = glm::dot(origin - stick.Center, stick.Axis);
  double low = 0.0;
  double high = 1e6;
  if (std::abs(rise) > 1e-12)
  {
    const double a = (-0.5 * stick.Length - height) / rise;
    const double b = (0.5 * stick.Length - height) / rise;
    low = std::max(low, std::min(a, b));
    high = std::min(high, std::max(a, b));
  }
  else if (std::abs(height) > 0.5 * stick.Length)
  {
    return false;
  }
  const auto reject = [&](glm::dvec3 v) { return v - glm::dot(v, stick.Axis) * stick.Axis; };
  const glm::dvec3 slope = reject(direction);
  const double square = glm::dot(slope, slope);
  const double nearest =
    square > 0.0 ? -glm::dot(reject(origin - stick.Center), slope) / square : low;
  const double t = glm::clamp(nearest, low, std::max(low, high));
  return low <= high && glm::length(reject(origin + t * direction - stick.Center)) < stick.Radius;
}

}

TEST(Imposters, CoverOutlinesOfSticksExactly)
{
  const vtkSmartPointer<vtkPolyData> data = MakeStickData(FourSticks);
  const penumbra::Scene scene = MakeScene(data, StickSettings);
  ASSERT_TRUE(scene.Warnings.empty()) << scene.Warnings[0];
  const penumbra::RayScene rays(scene, 1);
  const penumbra::Shading shading(rays, false);
  const penumbra::CameraRayTracer tracer(rays, shading, scene.ViewCamera);
  const penumbra::RenderSettings settings;
  penumbra::ImageRegion region;
  region.High = glm::ivec2(Side);
  ASSERT_TRUE(RenderRegion(tracer, FindSceneEdges(scene, settings), settings, {}, region));
  std::vector<double> image;
  for (const glm::vec4& color : region.Colors)
  {
    image.push_back(color.r * color.a);
  }
  EXPECT_LT(region.Rays.Primary + region.Rays.Refinement, 1.05 * Side * Side);
  const double error = ComputeEdgeError(image, [](glm::dvec3 direction) {
    return std::any_of(FourSticks.begin(), FourSticks.end(),
      [&](const Stick& stick) { return HitsStick(glm::dvec3(0.0), direction, stick); });
  });
  RecordProperty("RMSE", std::to_string(error));
  EXPECT_LT(error, 1e-4);
}

TEST(Imposters, AreHitByTheRaysThatReachASticksInterior)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto draw = [&] { return glm::dvec3(uniform(random), uniform(random), uniform(random)); };
  int hits = 0;
  for (int repetition = 0; repetition < 400; ++repetition)
  {
    const Stick stick = { draw(), glm::normalize(draw()), 1.1 + uniform(random),
      0.3 * (1.1 + uniform(random)) };
    const vtkSmartPointer<vtkPolyData> data = MakeStickData({ stick });
    const penumbra::Scene scene = MakeScene(data, StickSettings);
    const penumbra::RayScene rays(scene, 1);
    penumbra::Ray packet[16];
    penumbra::Hit packetHits[16];
    bool occluded[16];
    for (penumbra::Ray& ray : packet)
    {
      ray.Origin = 4.0 * glm::normalize(draw());
      ray.Direction = glm::normalize(stick.Center + 0.8 * draw() - glm::dvec3(ray.Origin));
    }
    rays.Intersect16(packet, packetHits);
    rays.Occluded16(packet, occluded);
    for (int i = 0; i < 16; ++i)
    {
      // Rays within 1e-5 of the surface may be on either side after rounding.
      const glm::dvec3 origin(packet[i].Origin);
      const glm::dvec3 direction(packet[i].Direction);
      Stick smaller = stick;
      smaller.Radius -= 1e-5;
      smaller.Length -= 2e-5;
      const bool expected = HitsStick(origin, direction, smaller);
      Stick larger = stick;
      larger.Radius += 1e-5;
      larger.Length += 2e-5;
      if (expected != HitsStick(origin, direction, larger))
      {
        continue;
      }
      ASSERT_EQ(packetHits[i].IsHit(), expected) << repetition << " " << i;
      ASSERT_EQ(occluded[i], expected) << repetition << " " << i;
      if (!expected)
      {
        continue;
      }
      ++hits;
      const glm::dvec3 x =
        origin + static_cast<double>(packetHits[i].Distance) * direction - stick.Center;
      const double height = glm::dot(x, stick.Axis);
      const glm::dvec3 across = x - height * stick.Axis;
      const double side = glm::length(across) - stick.Radius;
      const double end = std::abs(height) - 0.5 * stick.Length;
      ASSERT_NEAR(std::max(side, end), 0.0, 1e-5) << "on the surface";
      if (std::abs(side - end) < 1e-3)
      {
        continue; // next to the rim
      }
      const glm::dvec3 expectedNormal = side > end ? across / glm::length(across)
        : height > 0.0                             ? stick.Axis
                                                   : -stick.Axis;
      const glm::dvec3 normal(rays.GetNormal(packet[i], packetHits[i]));
      ASSERT_NEAR(glm::dot(normal, expectedNormal), 1.0, 1e-4);
      ASSERT_LT(glm::dot(normal, direction), 1e-3);
    }
  }
  EXPECT_GT(hits, 1000);
}

TEST(Imposters, ReachAlongTheirAxis)
{
  const penumbra::RoundShape shape = { { 0.f, 0.f, 1.f }, { 0.f, 0.f, 3.f }, 0.5f, 0.5f, true };
  const penumbra::RoundIntersection along(shape, glm::dvec3(0.4, 0.0, 0.0), { 0.0, 0.0, 1.0 });
  ASSERT_TRUE(along.IsHit);
  EXPECT_EQ(along.Enter, 1.0);
  EXPECT_EQ(along.Leave, 3.0);
  EXPECT_FALSE(
    penumbra::RoundIntersection(shape, glm::dvec3(0.6, 0.0, 0.0), { 0.0, 0.0, 1.0 }).IsHit);
  const penumbra::RoundIntersection across(shape, glm::dvec3(-2.0, 0.0, 2.0), { 1.0, 0.0, 0.0 });
  ASSERT_TRUE(across.IsHit);
  EXPECT_NEAR(across.Enter, 1.5, 1e-12);
  EXPECT_NEAR(across.Leave, 2.5, 1e-12);
  const penumbra::RoundShape none = { { 0.f, 0.f, 1.f }, { 0.f, 0.f, 1.f }, 0.5f, 0.5f, true };
  EXPECT_FALSE(penumbra::RoundIntersection(none, glm::dvec3(0.0), { 0.0, 0.0, 1.0 }).IsHit);
}

TEST(Imposters, UseTheArraysOfTheMapper)
{
  const vtkSmartPointer<vtkPolyData> data = MakeCells(FiveCenters, {});
  const auto radii = MakeArray("R", 1);
  for (int i = 0; i < 5; ++i)
  {
    radii->InsertNextValue(0.1 * (i + 1));
  }
  data->GetPointData()->AddArray(radii);
  const penumbra::Scene scaled = MakeScene(data, { false, 0.3, "R", "" });
  ASSERT_EQ(scaled.Surfaces.size(), 1u);
  EXPECT_EQ(scaled.Surfaces[0].Radii, std::vector<float>({ 0.1f, 0.2f, 0.3f, 0.4f, 0.5f }));
  EXPECT_TRUE(scaled.Surfaces[0].Segments.empty());
  const penumbra::Scene uniform = MakeScene(data, { false, 0.3, "none", "" });
  EXPECT_EQ(uniform.Surfaces[0].Radii, std::vector<float>({ 0.3f }));
  EXPECT_TRUE(uniform.Warnings.empty());
  const penumbra::Scene sticks = MakeScene(MakeStickData(FourSticks), StickSettings);
  ASSERT_EQ(sticks.Surfaces.size(), 1u);
  EXPECT_TRUE(sticks.Surfaces[0].HasFlatEnds);
  const penumbra::RoundShape shape = sticks.Surfaces[0].GetRoundShape(3);
  EXPECT_NEAR(glm::distance(shape.A, glm::vec3(-0.46f, -1.58f, -5.f)), 0.f, 1e-6f);
  EXPECT_NEAR(glm::distance(shape.B, glm::vec3(1.46f, -1.02f, -5.f)), 0.f, 1e-6f);
  EXPECT_EQ(shape.RadiusA, 0.2f);
}

TEST(Imposters, KeepTheirSizeUnderATransform)
{
  penumbra::DrawItem prototype = MakePrototype();
  prototype.ToWorld = glm::dmat4(2.0);
  prototype.ToWorld[3] = glm::dvec4(1.0, 0.0, 0.0, 1.0);
  std::vector<std::string> warnings;
  const penumbra::DrawItem item = MakeImposters(StickSettings,
    MakeStickData({ { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, 2.0, 0.3 } }), prototype, {}, warnings);
  const double* a = item.Data->GetPoint(0);
  EXPECT_EQ(glm::dvec3(a[0], a[1], a[2]), glm::dvec3(3.0, -1.0, 0.0));
  const double* b = item.Data->GetPoint(1);
  EXPECT_EQ(glm::dvec3(b[0], b[1], b[2]), glm::dvec3(3.0, 1.0, 0.0));
}

TEST(Imposters, RejectInvalidArrays)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const vtkSmartPointer<vtkPolyData> data =
    MakeStickData({ FourSticks[0], { { 0.0, 0.0, -5.0 }, { 0.0, 0.0, 0.0 }, 1.0, 1.0 },
      { { 0.0, 0.0, -5.0 }, { 0.0, 0.0, 1.0 }, 1.0, -1.0 },
      { { 0.0, nan, -5.0 }, { 0.0, 0.0, 1.0 }, 1.0, 1.0 } });
  const penumbra::Scene scene = MakeScene(data, StickSettings);
  ASSERT_EQ(scene.Surfaces.size(), 1u);
  EXPECT_EQ(scene.Surfaces[0].GetNumberOfPrimitives(), 1u);
  ASSERT_EQ(scene.Warnings.size(), 1u);
  EXPECT_EQ(scene.Warnings[0],
    "Object 0: 3 sticks were skipped because their position, size or orientation is not valid.");
  const penumbra::Scene missing = MakeScene(data, { true, 0.0, "Size", "none" });
  EXPECT_TRUE(missing.Surfaces.empty());
  ASSERT_EQ(missing.Warnings.size(), 1u);
  EXPECT_EQ(missing.Warnings[0],
    "Object 0: the sticks were skipped because they need point arrays of their orientations and "
    "sizes.");

  const auto shorter = MakeArray("R", 1);
  shorter->InsertNextValue(1.0);
  data->GetPointData()->AddArray(shorter);
  const penumbra::Scene wrong = MakeScene(data, { false, 0.3, "R", "" });
  ASSERT_EQ(wrong.Warnings.size(), 1u);
  EXPECT_EQ(wrong.Warnings[0],
    "Object 0: the array R was ignored because it has 1 values of 1 components for 4 points.");
  const penumbra::Scene zero = MakeScene(data, { false, 0.0, "", "" });
  EXPECT_TRUE(zero.Surfaces.empty());
  ASSERT_EQ(zero.Warnings.size(), 1u);
}
