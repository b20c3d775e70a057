// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Opacity, and the alpha of images without background, against closed forms and each other.
#include "BruteForce/ImageErrors.h"
#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace penumbra;

namespace
{

constexpr int Size = 96;

class Opacity : public testing::TestWithParam<double>
{
};

/// A disk with a smaller star in front of it. World x and y are image coordinates.
struct Stack
{
  std::vector<Shape> Back = { Disc({ 47.3, 48.9 }, 40.0, 60) };
  std::vector<Shape> Front = { Star({ 50.1, 46.2 }, 30.0, 12.0, 14) };
};

void AddFlat(vtkRenderer* renderer, const std::vector<Shape>& shapes, double z, glm::dvec3 color,
  double opacity)
{
  vtkActor* actor = AddMesh(renderer, MeshOf(shapes), false);
  actor->SetPosition(0.0, 0.0, z);
  actor->GetProperty()->SetColor(color.x, color.y, color.z);
  actor->GetProperty()->SetOpacity(opacity);
}

/// Lit spheres with highlights that intersect and hide each other, and a thin line.
vtkSmartPointer<vtkRenderer> Spheres(double opacity)
{
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  const glm::dvec3 colors[] = { { 1.0, 1.0, 1.0 }, { 0.9, 0.2, 0.1 }, { 0.1, 0.3, 0.8 } };
  for (int i = 0; i < 3; ++i)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetThetaResolution(16 + 8 * i);
    sphere->SetPhiResolution(12 + 6 * i);
    sphere->SetCenter(0.45 * i, 0.1 * i, -0.4 * i);
    sphere->Update();
    vtkProperty* property = AddMesh(renderer, sphere->GetOutput(), true)->GetProperty();
    property->SetColor(colors[i].x, colors[i].y, colors[i].z);
    property->SetOpacity(i == 1 ? 1.0 : opacity);
    property->SetSpecular(0.4);
  }
  LookAlong(renderer, { -0.3, 0.2, -1.0 }, { 0.0, 1.0, 0.0 }, Size, Size);
  return renderer;
}

/// Compares the image without background, composited over black and white, with direct renders.
void ExpectComposes(vtkRenderer* renderer)
{
  const Answer bare =
    Cast(renderer, Size, Size, [](vtkPenumbraRayCaster* caster) { caster->BackgroundOff(); });
  for (double background : { 0.0, 1.0 })
  {
    renderer->SetBackground(background, background, background);
    const Answer direct = Cast(renderer, Size, Size);
    for (std::size_t i = 0; i < bare.Colors.size(); ++i)
    {
      const glm::dvec3 over = bare.Alphas[i] * bare.Colors[i] + (1.0 - bare.Alphas[i]) * background;
      const glm::dvec3 difference = glm::abs(over - direct.Colors[i]);
      EXPECT_LE(std::max(std::max(difference.x, difference.y), difference.z), 1.0 / 255.0)
        << "pixel " << i % Size << ", " << i / Size << " over " << background;
    }
  }
}

}

TEST_P(Opacity, OfFlatShapesBecomesAlpha)
{
  const double opacity = GetParam();
  const Stack stack;
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddFlat(renderer, stack.Back, 0.0, { 1.0, 0.5, 0.0 }, opacity);
  LookAtImage(renderer, Size, Size);
  const Answer answer =
    Cast(renderer, Size, Size, [](vtkPenumbraRayCaster* caster) { caster->BackgroundOff(); });
  const std::vector<double> fractions = SharesOf(stack.Back, Size, Size);
  for (std::size_t i = 0; i < fractions.size(); ++i)
  {
    EXPECT_NEAR(answer.Alphas[i], opacity * fractions[i], 0.002)
      << "pixel " << i % Size << ", " << i / Size;
    if (answer.Alphas[i] > 0.0)
    {
      EXPECT_NEAR(answer.Colors[i].x, 1.0, 1e-4); // straight alpha: the color is not darkened
      EXPECT_NEAR(answer.Colors[i].y, 0.5, 1e-4);
    }
  }
}

TEST_P(Opacity, OfOverlappingShapesBlendsTheirColors)
{
  const double opacity = GetParam();
  const Stack stack;
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddFlat(renderer, stack.Front, 10.0, { 1.0, 0.0, 0.0 }, opacity);
  AddFlat(renderer, stack.Back, 0.0, { 0.0, 1.0, 0.0 }, 0.6);
  renderer->SetBackground(0.0, 0.0, 1.0);
  LookAtImage(renderer, Size, Size);
  const Answer answer = Cast(renderer, Size, Size);
  const std::vector<double> front = SharesOf(stack.Front, Size, Size);
  const std::vector<double> back = SharesOf(stack.Back, Size, Size);
  for (std::size_t i = 0; i < front.size(); ++i)
  {
    // The star lies within the disk, so every pixel is a sum of three kinds of area.
    const double red = opacity * front[i];
    const double green = 0.6 * (back[i] - opacity * front[i]);
    const glm::dvec3 expected(red, green, 1.0 - red - green);
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(answer.Colors[i][c], expected[c], 0.002)
        << "pixel " << i % Size << ", " << i / Size << ", channel " << c;
    }
  }
}

TEST_P(Opacity, GivesAnAlphaThatCompositesOverAnyBackground)
{
  ExpectComposes(Spheres(GetParam()));

  const Stack stack;
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddFlat(renderer, stack.Front, 10.0, { 1.0, 0.2, 0.3 }, GetParam());
  AddFlat(renderer, stack.Back, 0.0, { 0.4, 1.0, 0.1 }, 0.99);
  AddFlat(renderer, SmallDiscs(Size, Size, 8), 20.0, { 0.4, 0.1, 1.0 }, GetParam());
  LookAtImage(renderer, Size, Size);
  ExpectComposes(renderer);
}

TEST_P(Opacity, OfManyLayersMultiplies)
{
  const double opacity = GetParam();
  const Stack stack;
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  for (int i = 0; i < 10; ++i)
  {
    AddFlat(renderer, stack.Back, 2.0 * i, { 1.0, 1.0, 1.0 }, opacity);
  }
  LookAtImage(renderer, Size, Size);
  const Answer answer = Cast(renderer, Size, Size);
  const std::vector<double> fractions = SharesOf(stack.Back, Size, Size);
  for (std::size_t i = 0; i < fractions.size(); ++i)
  {
    EXPECT_NEAR(answer.Colors[i].x, fractions[i] * (1.0 - std::pow(1.0 - opacity, 10.0)), 0.004)
      << "pixel " << i % Size << ", " << i / Size;
  }
}

TEST_P(Opacity, OfCoincidentFacesCountsOnce)
{
  const double opacity = GetParam();
  const Shape disc = Disc({ 0.0, 0.0 }, 1.0, 60);
  Shape other = disc; // the same as a fan around another point
  other.Center = { 0.31, -0.17 };
  for (const glm::dvec3& direction : { glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(0.4, 0.5, -0.7) })
  {
    for (bool parallel : { false, true })
    {
      Answer answers[3];
      for (int i = 0; i < 3; ++i)
      {
        vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
        AddFlat(renderer, { disc }, 0.0, glm::dvec3(1.0), opacity);
        if (i > 0)
        {
          AddFlat(renderer, { i == 1 ? disc : other }, 0.0, glm::dvec3(1.0), opacity);
        }
        renderer->GetActiveCamera()->SetParallelProjection(parallel);
        LookAlong(renderer, direction, { 0.0, 1.0, 0.0 }, Size, Size);
        answers[i] = Cast(renderer, Size, Size);
      }
      for (std::size_t i = 0; i < answers[0].Colors.size(); ++i)
      {
        EXPECT_NEAR(answers[1].Colors[i].x, answers[0].Colors[i].x, 0.004)
          << "pixel " << i % Size << ", " << i / Size << (parallel ? ", parallel" : "");
        EXPECT_NEAR(answers[2].Colors[i].x, answers[0].Colors[i].x, 0.004)
          << "pixel " << i % Size << ", " << i / Size << (parallel ? ", parallel" : "")
          << ", with another triangulation";
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(RayCaster, Opacity, testing::Values(0.01, 0.3, 0.99, 1.0));
