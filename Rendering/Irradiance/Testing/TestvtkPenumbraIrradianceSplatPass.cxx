// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares records splatted by OpenGL with the interpolation of the cache from the same records.
#include "vtkPenumbraIrradianceSplatPass.h"

#include "CollectionItems.h"

#include "../../ScreenSpace/Testing/OcclusionScene.h"
#include "vtkPenumbraIrradianceCache.h"
#include "vtkPenumbraRayCaster.h"

#include "vtkActorCollection.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkLight.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{

constexpr int ImageWidth = 96;
constexpr int ImageHeight = 72;

/// A scene with a cache that ray casting fills, and the arrays of the ray-cast image.
class CachedScene : public OcclusionScene
{
public:
  CachedScene()
    : OcclusionScene(ImageWidth, ImageHeight)
  {
    this->Renderer->SetBackground(0.0, 0.0, 0.0);
  }

  /// Ray casts the scene with ambient occlusion or with indirect light.
  void CastRays(bool light = false)
  {
    this->Caster->SetResolution(this->Width, this->Height);
    this->Caster->SetRenderer(this->Renderer);
    this->Caster->SetIrradianceProvider(this->Cache);
    this->Caster->SetAmbientOcclusion(!light);
    this->Caster->SetIndirectLight(light);
    this->Caster->SetAmbientOcclusionRadius(2.0);
    this->Caster->SetTolerance(.02);
    this->Caster->SetLightTolerance(.02);
    this->Caster->SetGeometryArrays(true);
    this->Caster->Update();
    if (light)
    {
      this->Cache->GetIrradianceRecords(this->Records);
    }
    else
    {
      this->Cache->GetRecords(this->Records);
    }
  }

  vtkPenumbraIrradianceSplatPass* Splat()
  {
    auto* pass = vtkPenumbraIrradianceSplatPass::AddTo(this->Renderer);
    pass->SetRecords(this->Records);
    this->Window->Render();
    pass->CopyResult(this->Result);
    return pass;
  }

  float SplatValue(const char* name, vtkIdType pixel, int channel = 0)
  {
    return static_cast<float>(
      this->Result->GetPointData()->GetArray(name)->GetComponent(pixel, channel));
  }

  float RayCastValue(const char* name, vtkIdType pixel, int channel = 0)
  {
    return static_cast<float>(
      this->Caster->GetOutput()->GetPointData()->GetArray(name)->GetComponent(pixel, channel));
  }

  /// Pixels whose 5 x 5 neighborhood lies in one plane: elsewhere a depth buffer does not define
  /// the normal.
  std::vector<vtkIdType> FindFlatPixels()
  {
    std::vector<vtkIdType> pixels;
    for (int y = 2; y < Height - 2; ++y)
    {
      for (int x = 2; x < Width - 2; ++x)
      {
        const vtkIdType here = x + static_cast<vtkIdType>(y) * Width;
        bool flat = this->RayCastValue("ObjectId", here) >= 0.f;
        for (int k = 0; k < 25 && flat; ++k)
        {
          const vtkIdType other = here + k % 5 - 2 + (k / 5 - 2) * static_cast<vtkIdType>(Width);
          flat = this->RayCastValue("ObjectId", other) == this->RayCastValue("ObjectId", here);
          for (int c = 0; c < 3; ++c)
          {
            flat = flat &&
              std::abs(this->RayCastValue("Normal", other, c) -
                this->RayCastValue("Normal", here, c)) < 1e-3f;
          }
        }
        if (flat)
        {
          pixels.push_back(here);
        }
      }
    }
    return pixels;
  }

  vtkNew<vtkPenumbraIrradianceCache> Cache;
  vtkNew<vtkPenumbraRayCaster> Caster;
  vtkNew<vtkPolyData> Records;
  vtkNew<vtkImageData> Result;
};

/// Difference between the images of the pass and of ray casting at flat pixels.
struct Difference
{
  double Rms = 0.0;
  double FractionAbove = 0.0; ///< fraction of the pixels that differ by more than 2/255
  std::size_t Pixels = 0;
};

template <typename Values>
Difference Compare(const std::vector<vtkIdType>& pixels, const Values& differenceAt)
{
  Difference result;
  result.Pixels = pixels.size();
  double square = 0.0;
  double above = 0.0;
  for (const vtkIdType pixel : pixels)
  {
    const double difference = differenceAt(pixel);
    square += difference * difference;
    above += std::abs(difference) > 2.0 / 255.0 ? 1.0 : 0.0;
  }
  const auto count = static_cast<double>(std::max<std::size_t>(pixels.size(), 1));
  result.Rms = std::sqrt(square / count);
  result.FractionAbove = above / count;
  return result;
}

Difference CompareOcclusion(CachedScene& scene)
{
  return Compare(scene.FindFlatPixels(), [&](vtkIdType pixel) {
    return scene.SplatValue("AmbientOcclusion", pixel) -
      scene.RayCastValue("AmbientOcclusion", pixel);
  });
}

/// Adds a floor, two walls and a table, all planar, viewed from above.
void AddRoom(CachedScene& scene, Vector at = { 0, 0, 0 })
{
  const auto wall = [&](Vector corner, Vector side, Vector other) {
    scene.AddWall({ corner[0] + at[0], corner[1] + at[1], corner[2] + at[2] }, side, other);
  };
  wall({ -4, -4, 0 }, { 8, 0, 0 }, { 0, 8, 0 });
  wall({ -4, 2, 0 }, { 8, 0, 0 }, { 0, 0, 3 });
  wall({ 2, -4, 0 }, { 0, 8, 0 }, { 0, 0, 3 });
  wall({ -1, -1, 1 }, { 1.5, 0, 0 }, { 0, 1.5, 0 });
  wall({ -1, -1, 0 }, { 1.5, 0, 0 }, { 0, 0, 1 });
  wall({ -1, -1, 0 }, { 0, 1.5, 0 }, { 0, 0, 1 });
  scene.SetCamera({ at[0] - 4, at[1] - 6, at[2] + 5 }, { at[0], at[1], at[2] + .5 });
}

/// Lights the scene by the sky only, through the cache.
void UseSky(CachedScene& scene)
{
  scene.Renderer->AutomaticLightCreationOff();
  vtkNew<vtkLight> dark; // without a light VTK would create a headlight
  dark->SetIntensity(0.0);
  scene.Renderer->AddLight(dark);
  for (vtkActor* actor : penumbra::GetItems<vtkActor>(scene.Renderer->GetActors()))
  {
    actor->GetProperty()->LightingOn();
    actor->GetProperty()->SetAmbient(0.0);
    actor->GetProperty()->SetColor(1.0, .6, .3);
  }
  scene.Caster->SetEnvironmentColor(.7, .8, 1.0);
  scene.Caster->SetAlbedo(.5);
  scene.Caster->SetBounces(2);
}

}

TEST(vtkPenumbraIrradianceSplatPass, MatchesTheCacheWithinTwoGrayLevels)
{
  CachedScene scene;
  AddRoom(scene);
  scene.CastRays();
  vtkPenumbraIrradianceSplatPass* pass = scene.Splat();

  const Difference difference = CompareOcclusion(scene);
  EXPECT_GT(difference.Pixels, ImageWidth * ImageHeight / 3);
  EXPECT_LT(difference.Rms, 1.5 / 255.0); // where no record is valid, the cache traces rays
  EXPECT_LT(difference.FractionAbove, .005);
  EXPECT_GT(pass->GetStatistics()->GetArray("Pixels/Interpolated")->GetComponent(0, 0), .99);
  EXPECT_EQ(pass->GetStatistics()->GetArray("Cache/Records")->GetComponent(0, 0),
    scene.Records->GetNumberOfPoints());
}

TEST(vtkPenumbraIrradianceSplatPass, MatchesTheCacheInParallelProjection)
{
  CachedScene scene;
  AddRoom(scene);
  scene.UseParallelProjection(true, 3.5);
  scene.CastRays();
  scene.Splat();

  const Difference difference = CompareOcclusion(scene);
  EXPECT_GT(difference.Pixels, ImageWidth * ImageHeight / 3);
  EXPECT_LT(difference.Rms, 1.5 / 255.0);
  // Where an invalid record has the largest weight, the cache traces rays, and the pass interpolates.
  EXPECT_LT(difference.FractionAbove, .01);
}

TEST(vtkPenumbraIrradianceSplatPass, MatchesTheCacheFarFromTheOrigin)
{
  CachedScene scene;
  AddRoom(scene, { 4e5, -7e5, 1e5 });
  scene.CastRays();
  scene.Splat();

  const Difference difference = CompareOcclusion(scene);
  EXPECT_LT(difference.Rms, 1.5 / 255.0);
}

TEST(vtkPenumbraIrradianceSplatPass, MatchesTheIrradianceOfTheCache)
{
  CachedScene scene;
  AddRoom(scene);
  UseSky(scene);
  scene.CastRays(true);
  scene.Splat();
  for (int channel = 0; channel < 3; ++channel)
  {
    const double reflectance = .5 * (channel == 0 ? 1.0 : channel == 1 ? .6 : .3);
    const Difference difference = Compare(scene.FindFlatPixels(), [&](vtkIdType pixel) {
      return scene.SplatValue("Irradiance", pixel, channel) / vtkMath::Pi() -
        scene.RayCastValue("Color", pixel, channel) / reflectance;
    });
    EXPECT_LT(difference.Rms, 1.5 / 255.0) << channel;
    EXPECT_LT(difference.FractionAbove, .02) << channel;
  }
}

TEST(vtkPenumbraIrradianceSplatPass, ReportsPixelsOfInvalidRecords)
{
  CachedScene scene;
  scene.AddWall({ -4, -4, 0 }, { 8, 0, 0 }, { 0, 8, 0 });
  scene.SetCamera({ 0, -1e-3, 5 }, { 0, 0, 0 });
  scene.UseParallelProjection(true, 2.5);
  scene.CastRays();
  ASSERT_GT(scene.Records->GetNumberOfPoints(), 0);
  // Two equal records, of which the second one is invalid.
  constexpr double Radius = 2.0;
  for (int i = 0; i < scene.Records->GetPointData()->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = scene.Records->GetPointData()->GetArray(i);
    array->InsertTuple(1,
      std::vector<double>(array->GetTuple(0), array->GetTuple(0) + array->GetNumberOfComponents())
        .data());
    array->SetNumberOfTuples(2);
  }
  scene.Records->GetPoints()->SetNumberOfPoints(2);
  for (int i = 0; i < 2; ++i)
  {
    scene.Records->GetPoints()->SetPoint(i, i == 0 ? -1.0 : 1.0, 0.0, 0.0);
    scene.Records->GetPointData()->GetArray("Radius")->SetComponent(i, 0, Radius);
    scene.Records->GetPointData()->GetArray("Serves")->SetComponent(i, 0, 1.0 - i);
  }
  scene.Records->Modified();
  vtkFieldData* statistics = scene.Splat()->GetStatistics();

  double interpolated = 0.0;
  double invalid = 0.0;
  for (int i = 0; i < ImageWidth * ImageHeight; ++i)
  {
    const double x = 5.0 * (i % ImageWidth + .5 - .5 * ImageWidth) / ImageHeight;
    const double y = 5.0 * (i / ImageWidth + .5 - .5 * ImageHeight) / ImageHeight;
    const double distances[] = { std::hypot(x + 1.0, y), std::hypot(x - 1.0, y) };
    interpolated += std::min(distances[0], distances[1]) < Radius ? 1.0 : 0.0;
    invalid += distances[1] < std::min(distances[0], Radius) ? 1.0 : 0.0;
  }
  const auto get = [&](const char* name) {
    return statistics->GetArray(name)->GetComponent(0, 0) * ImageWidth * ImageHeight;
  };
  EXPECT_NEAR(get("Pixels/Interpolated"), interpolated, .01 * interpolated);
  EXPECT_NEAR(get("Pixels/Invalid"), invalid, .02 * invalid);

  scene.Records->GetPointData()->GetArray("Serves")->SetComponent(1, 0, 1.0);
  scene.Records->Modified();
  statistics = scene.Splat()->GetStatistics();
  EXPECT_EQ(get("Pixels/Invalid"), 0.0);
}

TEST(vtkPenumbraIrradianceSplatPass, DarkensTheColorsOfItsDelegate)
{
  CachedScene scene;
  AddRoom(scene);
  scene.CastRays();
  scene.Window->Render();
  const std::vector<int> plain = scene.Image();
  vtkPenumbraIrradianceSplatPass* pass = scene.Splat();
  const std::vector<int> dark = scene.Image();
  pass->SetStrength(0.0);
  scene.Window->Render();
  EXPECT_EQ(scene.Image(), plain);
  for (vtkIdType pixel = 0; pixel < static_cast<vtkIdType>(ImageWidth) * ImageHeight; ++pixel)
  {
    const double open = 1.0 - scene.SplatValue("AmbientOcclusion", pixel);
    ASSERT_NEAR(dark[4 * pixel], open * plain[4 * pixel], 1.01) << pixel;
  }
}

TEST(vtkPenumbraIrradianceSplatPass, RendersTheDelegateWithoutRecords)
{
  OcclusionScene scene(64, 48);
  scene.AddFloor();
  scene.AddSphere({ 0, 0, .5 }, .5);
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0 });
  scene.Window->Render();
  const std::vector<int> plain = scene.Image();
  auto* pass = vtkPenumbraIrradianceSplatPass::AddTo(scene.Renderer);
  EXPECT_EQ(vtkPenumbraIrradianceSplatPass::AddTo(scene.Renderer), pass);
  scene.Window->Render();
  EXPECT_EQ(scene.Image(), plain);

  vtkNew<vtkPolyData> empty;
  pass->SetRecords(empty);
  const bool warnings = vtkObject::GetGlobalWarningDisplay() != 0;
  vtkObject::GlobalWarningDisplayOff();
  scene.Window->Render();
  vtkObject::SetGlobalWarningDisplay(warnings);
  EXPECT_EQ(scene.Image(), plain);
  EXPECT_EQ(pass->GetStatistics()->GetNumberOfArrays(), 0);
  vtkNew<vtkImageData> nothing;
  pass->CopyResult(nothing);
  EXPECT_EQ(nothing->GetNumberOfPoints(), 0);

  vtkPenumbraIrradianceSplatPass::RemoveFrom(scene.Renderer);
  EXPECT_EQ(scene.Renderer->GetPass(), nullptr);
  scene.Window->Render();
  EXPECT_EQ(scene.Image(), plain);
}
