// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Glyphs as instances against the same glyphs as copied triangles.
#include "GlyphField.h"
#include "Scene.h"
#include "Surface.h"

#include "Embree/RayScene.h"
#include "Image/ImageRegion.h"
#include "Import/SceneExtraction.h"
#include "SceneBounds.h"
#include "Shading/Shading.h"
#include "Vector/InstanceCopies.h"

#include "vtkActorCollection.h"
#include "vtkImageData.h"
#include "vtkLight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace penumbra_testing;
using penumbra::Hit;
using penumbra::Ray;
using penumbra::Scene;
using penumbra::Surface;

namespace
{

constexpr int Width = 25; // the fewest columns that are drawn as instances
constexpr int ImageWidth = 160;
constexpr int ImageHeight = 120;

/// A field that is drawn as instances, and the same as copies.
struct Fields
{
  GlyphField Instances;
  GlyphField Copies;
  vtkGlyph3DMapper* Whole;
  std::vector<vtkGlyph3DMapper*> Parts;

  explicit Fields(int width = Width)
  {
    const int count = width * width;
    this->Whole = this->Instances.Add(MakeGlyphPoints(0, count, width));
    constexpr int Part = 48;
    for (int first = 0; first < count; first += Part)
    {
      this->Parts.push_back(
        this->Copies.Add(MakeGlyphPoints(first, std::min(first + Part, count), width)));
    }
    for (GlyphField* field : { &this->Instances, &this->Copies })
    {
      field->SetCamera(width);
    }
  }
};

int CountInstances(const Scene& scene)
{
  std::size_t count = 0;
  for (const Surface& surface : scene.Surfaces)
  {
    count += surface.Instances ? surface.Instances->GetCount() : 0;
  }
  return static_cast<int>(count);
}

Scene Extract(vtkRenderer* renderer)
{
  penumbra::ExtractionOptions options;
  options.Resolution[0] = ImageWidth;
  options.Resolution[1] = ImageHeight;
  return penumbra::ExtractScene(renderer, options);
}

/// Renders a scene without the ray caster's decisions about it.
penumbra::ImageRegion Render(const Scene& scene, bool shadows = false, int samples = 0)
{
  const penumbra::RayScene rays(scene, 1);
  const penumbra::Shading shading(rays, shadows);
  const penumbra::CameraRayTracer tracer(rays, shading, scene.ViewCamera);
  penumbra::RenderSettings settings;
  settings.Integration.Shadows = shadows;
  settings.Integration.Rasterize = false; // copies would be rasterized, instances are traced
  if (samples > 0)
  {
    settings.Integration.Method = penumbra::CoverageMethods::Uniform;
    settings.Integration.UniformSamples = samples;
  }
  penumbra::ImageRegion image;
  image.High = { ImageWidth, ImageHeight };
  EXPECT_TRUE(
    penumbra::RenderRegion(tracer, penumbra::FindSceneEdges(scene, settings), settings, {}, image));
  return image;
}

/// Expects that a scene and the same with copied triangles have the same image, except for rounding
/// in `outliers` pixels.
void ExpectSameImage(const Scene& scene, int outliers, bool shadows = false)
{
  ASSERT_GT(CountInstances(scene), 0);
  Scene copied = scene;
  penumbra::CopyInstances(copied.Surfaces);
  const penumbra::ImageRegion a = Render(scene, shadows);
  const penumbra::ImageRegion b = Render(copied, shadows);
  int different = 0;
  float largest = 0.f;
  for (std::size_t i = 0; i < a.Colors.size(); ++i)
  {
    const glm::vec4 d = glm::abs(a.Colors[i] - b.Colors[i]);
    const float difference = std::max({ d.x, d.y, d.z, d.w });
    different += difference > 1e-4f ? 1 : 0;
    largest = std::max(largest, difference);
  }
  EXPECT_LE(different, outliers) << "largest difference " << largest;
}

}

TEST(Instances, HaveThePositionsOfCopies)
{
  Fields fields;
  const Scene instances = Extract(fields.Instances.Renderer);
  const Scene parts = Extract(fields.Copies.Renderer);
  EXPECT_EQ(CountInstances(instances), Width * Width - (Width * Width + 3) / 7);
  EXPECT_EQ(CountInstances(parts), 0);
  ASSERT_EQ(instances.Surfaces.size(), 2u);
  // The surfaces of the parts alternate between the two shapes.
  for (std::size_t shape = 0; shape < 2; ++shape)
  {
    const Surface& whole = instances.Surfaces[shape];
    std::uint32_t next = 0;
    for (std::size_t part = shape; part < parts.Surfaces.size(); part += 2)
    {
      const Surface& copies = parts.Surfaces[part];
      for (std::uint32_t i = 0; i < copies.GetNumberOfPrimitives(); i += 7)
      {
        ASSERT_EQ(whole.GetPoints(next + i), copies.GetPoints(i));
        ASSERT_EQ(whole.GetTriangleColor(next + i), copies.GetTriangleColor(i));
      }
      next += static_cast<std::uint32_t>(copies.GetNumberOfPrimitives());
    }
    EXPECT_EQ(next, whole.GetNumberOfPrimitives());
  }
  EXPECT_DOUBLE_EQ(
    penumbra::ComputeSceneDiagonal(instances), penumbra::ComputeSceneDiagonal(parts));
}

TEST(Instances, AreHitLikeCopies)
{
  Fields fields;
  const Scene scene = Extract(fields.Instances.Renderer);
  Scene copied = scene;
  penumbra::CopyInstances(copied.Surfaces);
  ASSERT_EQ(CountInstances(copied), 0);
  const penumbra::RayScene rays(scene, 1);
  const penumbra::RayScene expected(copied, 1);
  const auto box = penumbra::ComputeInstanceBounds(scene.Surfaces[0]);
  int different = 0;
  int hits = 0;
  int occlusions = 0;
  Ray packet[16];
  for (int i = 0; i < 20000; ++i)
  {
    const auto random = [&](int k) {
      return glm::vec3(Noise(i, 10 + k), Noise(i, 20 + k), Noise(i, 30 + k));
    };
    Ray ray;
    ray.Origin = box.Low + (box.High - box.Low) * random(0);
    ray.Direction = random(1) - 0.5f;
    const Hit a = rays.Intersect(ray);
    const Hit b = expected.Intersect(ray);
    const bool isSame = a.Surface == b.Surface && a.Primitive == b.Primitive &&
      a.Distance == b.Distance && a.U == b.U && a.V == b.V;
    different += isSame ? 0 : 1;
    hits += a.IsHit() ? 1 : 0;
    ray.Far = 0.05f * glm::length(box.High - box.Low);
    EXPECT_EQ(rays.Occluded(ray), rays.Intersect(ray).IsHit());
    occlusions += rays.Occluded(ray) != expected.Occluded(ray) ? 1 : 0;
    packet[i % 16] = ray;
    if (i % 16 == 15)
    {
      Hit found[16];
      bool occluded[16];
      rays.Intersect16(packet, found);
      rays.Occluded16(packet, occluded);
      for (int k = 0; k < 16; ++k)
      {
        EXPECT_EQ(found[k].Primitive, rays.Intersect(packet[k]).Primitive);
        EXPECT_EQ(occluded[k], found[k].IsHit());
      }
    }
  }
  EXPECT_GT(hits, 5000);
  EXPECT_LE(different, 5);
  EXPECT_LE(occlusions, 1);
}

TEST(Instances, LookLikeCopies)
{
  Fields fields;
  fields.Instances.SetCloseCamera(Width);
  ExpectSameImage(Extract(fields.Instances.Renderer), 4);
}

TEST(Instances, CastAndReceiveShadowsLikeCopies)
{
  Fields fields;
  fields.Instances.SetCloseCamera(Width);
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->PositionalOff();
  light->SetPosition(1.0, -1.0, 2.0);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  fields.Instances.Renderer->AddLight(light);
  ExpectSameImage(Extract(fields.Instances.Renderer), 20, true);
}

TEST(Instances, LookLikeCopiesOnBothSidesOfTheCamera)
{
  Fields fields;
  vtkRenderer* renderer = fields.Instances.Renderer;
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(0.5 * Width, 0.5 * Width, 0.4);
  camera->SetFocalPoint(0.5 * Width + 1.0, 0.5 * Width + 0.3, 0.3);
  renderer->ResetCameraClippingRange();
  ExpectSameImage(Extract(renderer), 4);
  // A near plane through glyphs, which are then clipped copies.
  camera->SetClippingRange(0.9, 100.0);
  const Scene cut = Extract(renderer);
  EXPECT_GT(cut.Surfaces.size(), 2u);
  ExpectSameImage(cut, 20);
}

TEST(Instances, LookLikeCopiesInParallelProjection)
{
  Fields fields;
  fields.Instances.SetCloseCamera(Width);
  vtkCamera* camera = fields.Instances.Renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(0.8);
  ExpectSameImage(Extract(fields.Instances.Renderer), 4);
}

TEST(Instances, LookLikeCopiesFarFromTheOrigin)
{
  Fields fields;
  fields.Instances.SetCloseCamera(Width, 1e6);
  fields.Instances.Renderer->GetActors()->GetLastActor()->SetPosition(1e6, 1e6, 1e6);
  fields.Instances.Renderer->ResetCameraClippingRange();
  ExpectSameImage(Extract(fields.Instances.Renderer), 20);
}

TEST(Instances, MeetTheToleranceIfSmallerThanPixels)
{
  Fields fields;
  const Scene scene = Extract(fields.Instances.Renderer);
  const penumbra::ImageRegion image = Render(scene);
  const penumbra::ImageRegion expected = Render(scene, false, 16); // 16 x 16 samples per pixel
  double squares = 0.0;
  for (std::size_t i = 0; i < image.Colors.size(); ++i)
  {
    const glm::vec4 d = image.Colors[i] - expected.Colors[i];
    squares += glm::dot(d, d) / 4.0;
  }
  EXPECT_LE(std::sqrt(squares / static_cast<double>(image.Colors.size())), 1.0 / 256.0);
}

TEST(Instances, AreCopiedIfFlatOrNotFinite)
{
  GlyphField field;
  vtkSmartPointer<vtkPolyData> points = MakeGlyphPoints(0, Width * Width, Width);
  vtkDataArray* scale = points->GetPointData()->GetArray("scale");
  scale->SetTuple3(0, 0.5, 0.5, 0.0); // vtkGlyph3DMapper replaces 0 by 1e-10
  scale->SetTuple3(2, 0.5, 0.0, 0.0);
  points->GetPoints()->SetPoint(4, std::nan(""), 0.0, 0.0);
  scale->SetTuple3(6, -0.5, 0.5, 0.7); // mirrored
  field.Add(points);
  field.SetCloseCamera(Width);
  vtkCamera* camera = field.Renderer->GetActiveCamera();
  camera->SetPosition(0.0, -1.0, 2.0);
  camera->SetFocalPoint(2.0, 0.2, 0.0);
  camera->SetClippingRange(0.1, 100.0);
  const Scene scene = Extract(field.Renderer);
  ASSERT_GE(scene.Surfaces.size(), 3u);
  std::size_t total = 0;
  std::size_t copied = 0;
  for (const Surface& surface : scene.Surfaces)
  {
    total += surface.Instances ? surface.Instances->GetCount() : 0;
    for (std::size_t i = 0; i < (surface.Instances ? 0 : surface.CellIds.size()); ++i)
    {
      EXPECT_TRUE(surface.CellIds[i] == 0 || surface.CellIds[i] == 2);
      ++copied;
    }
  }
  EXPECT_EQ(total, static_cast<std::size_t>(Width * Width - Width * Width / 7 - 3));
  EXPECT_GT(copied, 0u);
  ExpectSameImage(scene, 20);
}

TEST(Instances, BlendTranslucentColors)
{
  GlyphField field;
  vtkGlyph3DMapper* mapper = field.Add(MakeGlyphPoints(0, Width * Width, Width));
  mapper->ScalarVisibilityOff();
  field.Renderer->GetActors()->GetLastActor()->GetProperty()->SetOpacity(0.5);
  field.SetCloseCamera(Width);
  const Scene scene = Extract(field.Renderer);
  ASSERT_GT(CountInstances(scene), 0);
  EXPECT_TRUE(scene.Surfaces.front().IsTranslucent());
  ExpectSameImage(scene, 30);
}

TEST(Instances, AreKeptWhileTheCameraMoves)
{
  Fields fields;
  fields.Instances.Caster->SetKeepScene(true);
  fields.Instances.Caster->SetResolution(ImageWidth / 4, ImageHeight / 4);
  for (const double angle : { 0.0, 6.0 })
  {
    fields.Instances.Renderer->GetActiveCamera()->Azimuth(angle);
    fields.Instances.Caster->Update();
    vtkNew<vtkPenumbraRayCaster> other;
    other->SetRenderer(fields.Instances.Renderer);
    other->SetResolution(ImageWidth / 4, ImageHeight / 4);
    other->SetKeepScene(true);
    other->Update();
    vtkDataArray* a = fields.Instances.Caster->GetOutput()->GetPointData()->GetArray("Color");
    vtkDataArray* b = other->GetOutput()->GetPointData()->GetArray("Color");
    for (vtkIdType i = 0; i < a->GetNumberOfTuples(); ++i)
    {
      ASSERT_EQ(a->GetComponent(i, 0), b->GetComponent(i, 0));
    }
  }
}
