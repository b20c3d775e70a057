// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A textured quad seen at grazing angles: tiles within the tolerance, and few rays. The references
// are uniform rays and, for stripes, the exact mean over each pixel.
#include "BruteForce/StratifiedReference.h"
#include "Scenes/TestScene.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraRayCasterConstants.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkTexture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

using namespace penumbra;

namespace
{

constexpr int Side = 64;

/// Adds the unit square with a texture of `texels` x `texels` colors, each black or white.
vtkActor* AddTexturedSquare(
  vtkRenderer* renderer, int texels, bool interpolate, const std::function<bool(int, int)>& isWhite)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(texels, texels, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int j = 0; j < texels; ++j)
  {
    for (int i = 0; i < texels; ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        image->SetScalarComponentFromDouble(i, j, 0, k, isWhite(i, j) ? 255 : 0);
      }
    }
  }
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->SetInterpolate(interpolate);
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(0, 0, 0);
  plane->SetPoint1(1, 0, 0);
  plane->SetPoint2(0, 1, 0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(plane->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetTexture(texture);
  actor->GetProperty()->LightingOff();
  renderer->AddActor(actor);
  return actor;
}

/// Returns the number of tiles whose error exceeds the tolerance although the estimate does not.
int CountWrongTiles(const Answer& answer, const Answer& reference, double tolerance, int& above)
{
  int wrong = 0;
  for (const TileAccuracy& tile : CompareTiles(answer, reference, Side))
  {
    above += tile.Error > tolerance;
    wrong += tile.Error > tolerance && tile.Estimate < tile.Error;
  }
  return wrong;
}

}

TEST(TextureFootprints, AreWithinTheToleranceAtGrazingAngles)
{
  for (const bool interpolate : { false, true })
  {
    for (const double opacity : { 1.0, 0.6 })
    {
      SCOPED_TRACE(interpolate);
      SCOPED_TRACE(opacity);
      vtkNew<vtkRenderer> renderer;
      renderer->SetBackground(0.2, 0.3, 0.4);
      vtkActor* const actor = AddTexturedSquare(
        renderer, 128, interpolate, [](int i, int j) { return (i / 2 + j / 2) % 2 == 0; });
      actor->GetProperty()->SetOpacity(opacity);
      vtkCamera* const camera = renderer->GetActiveCamera();
      camera->SetPosition(0.45, -0.1, 0.12);
      camera->SetFocalPoint(0.5, 0.5, 0.0);
      camera->SetViewUp(0, 0, 1);
      camera->SetViewAngle(40.0);
      renderer->ResetCameraClippingRange();
      double tolerance = 0.0;
      const Answer answer = Cast(renderer, Side, Side,
        [&](vtkPenumbraRayCaster* caster) { tolerance = caster->GetTolerance(); });
      const Answer reference = Cast(renderer, Side, Side, [](vtkPenumbraRayCaster* caster) {
        caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Uniform;
        caster->GetConstants().UniformSamples = 64;
      });
      int above = 0;
      const int wrong = CountWrongTiles(answer, reference, tolerance, above);
      EXPECT_EQ(wrong, 0);
      EXPECT_LE(above, 0);
      EXPECT_LE(answer.RaysPerPixel, 5.0);
    }
  }
}

TEST(TextureFootprints, AverageStripesExactly)
{
  // In parallel projection, stripes of texels of a width that no pixel is a multiple of.
  constexpr int texels = 150;
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddTexturedSquare(renderer, texels, false, [](int i, int) { return i % 3 == 0; })->SetScale(Side);
  LookAtImage(renderer, Side, Side);
  const Answer answer = Cast(renderer, Side, Side);
  double squares = 0.0;
  for (int i = 0; i < Side; ++i)
  {
    double expected = 0.0;
    for (int texel = 0; texel < texels; texel += 3)
    {
      const double low = std::max<double>(i, static_cast<double>(texel) * Side / texels);
      const double high = std::min<double>(i + 1, (texel + 1.0) * Side / texels);
      expected += std::max(high - low, 0.0);
    }
    for (int j = 0; j < Side; ++j)
    {
      const double d = answer.Colors[static_cast<std::size_t>(j) * Side + i].g - expected;
      squares += d * d;
    }
  }
  EXPECT_LE(std::sqrt(squares / (Side * Side)), 5e-4); // the diagonal is sampled
  EXPECT_LE(answer.RaysPerPixel, 2.0);
}

TEST(TextureFootprints, AverageInterpolatedDotsExactly)
{
  // Every third texel of every third row is white, so that the texture is a product of periodic tents.
  constexpr int texels = 150;
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddTexturedSquare(renderer, texels, true, [](int i, int j) {
    return i % 3 == 0 && j % 3 == 0;
  })->SetScale(Side);
  LookAtImage(renderer, Side, Side);
  const Answer answer = Cast(renderer, Side, Side);
  // Integral of a tent at 0 from -1 to x.
  const auto integrate = [](double x) {
    const double d = 1.0 - std::abs(std::clamp(x, -1.0, 1.0));
    return x < 0.0 ? 0.5 * d * d : 1.0 - 0.5 * d * d;
  };
  double means[Side] = {};
  for (int i = 0; i < Side; ++i)
  {
    const double low = static_cast<double>(i) * texels / Side;
    const double high = (i + 1.0) * texels / Side;
    for (int texel = 0; texel <= texels; texel += 3)
    {
      means[i] += (integrate(high - texel - 0.5) - integrate(low - texel - 0.5)) / (high - low);
    }
  }
  double worst = 0.0;
  for (int j = 0; j < Side; ++j)
  {
    for (int i = 0; i < Side; ++i)
    {
      const double d =
        answer.Colors[static_cast<std::size_t>(j) * Side + i].g - means[i] * means[j];
      worst = std::max(worst, std::abs(i - j) <= 1 ? 0.0 : std::abs(d)); // the diagonal is sampled
    }
  }
  EXPECT_LE(worst, 1e-5);
  EXPECT_LE(answer.RaysPerPixel, 2.0);
}

TEST(TextureFootprints, AverageStripesToTheHorizonExactly)
{
  // Stripes across the view, of rows of texels, on a plane in perspective.
  constexpr int texels = 256;
  constexpr double Height = 0.1;
  vtkNew<vtkRenderer> renderer;
  AddTexturedSquare(renderer, texels, false, [](int, int j) {
    return j % 2 == 0;
  })->SetScale(10.0, 1.0, 1.0);
  vtkCamera* const camera = renderer->GetActiveCamera();
  camera->SetPosition(5.0, -0.2, Height);
  camera->SetFocalPoint(5.0, 1.0, Height);
  camera->SetViewUp(0, 0, 1);
  camera->SetViewAngle(40.0);
  renderer->ResetCameraClippingRange();
  const Answer answer = Cast(renderer, Side, Side);
  const double slope = std::tan(20.0 * std::acos(-1.0) / 180.0) / (0.5 * Side); // per pixel
  // Image coordinate at which the ray meets the plane at a distance from the camera.
  const auto project = [&](double distance) { return 0.5 * Side - Height / distance / slope; };
  int compared = 0;
  for (int i = 0; i < Side; ++i)
  {
    if (i < project(0.2) || i + 1 > project(1.2))
    {
      continue;
    }
    double expected = 0.0;
    for (int texel = 0; texel < texels; texel += 2)
    {
      const double low = std::max<double>(i, project(0.2 + texel / double(texels)));
      const double high = std::min<double>(i + 1, project(0.2 + (texel + 1.0) / texels));
      expected += std::max(high - low, 0.0);
    }
    EXPECT_NEAR(answer.Colors[static_cast<std::size_t>(i) * Side + Side / 4].g, expected, 1e-4);
    ++compared;
  }
  EXPECT_GE(compared, 15);
}
