// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Flat shapes of one color against their exact coverage: bounds on the error and on the number of
// rays, at any position and scale and from any direction.
#include "BruteForce/ImageErrors.h"
#include "ClosedForms/ExactCoverage.h"
#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"

#include <gtest/gtest.h>

#include <limits>
#include <ostream>
#include <string>

using namespace penumbra;

namespace
{

constexpr int Size = 256;
constexpr double Unlimited = std::numeric_limits<double>::max();
const glm::dvec2 Middle(128.3, 127.6);

struct ShapesRow
{
  std::string Name;
  std::vector<Shape> Shapes;
  double RaysPerPixel;
  double Edge;  ///< RMSE over partly covered pixels
  double Worst; ///< largest error of a pixel
};

void PrintTo(const ShapesRow& row, std::ostream* out)
{
  *out << row.Name;
}

class FlatShapes : public testing::TestWithParam<ShapesRow>
{
};

const ShapesRow Rows[] = {
  { "HalfPlane", HalfPlane(Size, Size), 1.02, 0.0005, Unlimited },
  { "Disc", { Disc(Middle, 100.0, 720) }, 1.02, 0.0005, Unlimited },
  { "SmallDiscs", SmallDiscs(Size, Size, 20), 1.12, Unlimited, 0.01 },
  { "Rods", Rods(Size, Size, 6), 1.12, Unlimited, 0.01 },
  { "Comb", Comb(Size, Size), 1.15, 0.002, Unlimited },
  { "StarOf72Edges", { Star(Middle, 60.0, 8.0, 72) }, 1.15, 0.002, Unlimited },
  { "StarOf240Edges", { Star(Middle, 60.0, 8.0, 240) }, 1.15, 0.002, Unlimited },
};

/// Errors of unlit white shapes on black.
Errors Judge(const std::vector<glm::dvec3>& colors, const std::vector<double>& fractions)
{
  return Compare(colors, WhiteOnBlack(fractions), PartlyCoveredPixels(fractions));
}

}

TEST_P(FlatShapes, KeepBoundsOfErrorAndRays)
{
  const ShapesRow& row = GetParam();
  const Answer answer = Cast(RendererOf(row.Shapes, Size, Size), Size, Size,
    [](vtkPenumbraRayCaster* caster) { caster->SetTolerance(1.0 / 512.0); });
  const Errors errors = Judge(answer.Colors, SharesOf(row.Shapes, Size, Size));
  EXPECT_LE(answer.RaysPerPixel, row.RaysPerPixel);
  EXPECT_LE(errors.Edge, row.Edge);
  EXPECT_LE(errors.Worst, row.Worst)
    << "in pixel " << errors.WorstPixel % Size << ", " << errors.WorstPixel / Size;
}

TEST_P(FlatShapes, KeepBoundsOfErrorAtDefaultTolerance)
{
  const ShapesRow& row = GetParam();
  const Answer answer = Cast(RendererOf(row.Shapes, Size, Size), Size, Size);
  const Errors errors = Judge(answer.Colors, SharesOf(row.Shapes, Size, Size));
  EXPECT_LE(errors.Edge, row.Edge);
  EXPECT_LE(errors.Worst, row.Worst)
    << "in pixel " << errors.WorstPixel % Size << ", " << errors.WorstPixel / Size;
}

INSTANTIATE_TEST_SUITE_P(RayCaster, FlatShapes, testing::ValuesIn(Rows),
  [](const testing::TestParamInfo<ShapesRow>& row) { return row.param.Name; });

namespace
{

/// Placement of the shapes: world = Origin + Scale * image coordinates.
struct ShadingPoint
{
  std::string Name;
  double Scale;
  glm::dvec3 Origin;
};

void PrintTo(const ShadingPoint& place, std::ostream* out)
{
  *out << place.Name;
}

class PlacedShapes : public testing::TestWithParam<ShadingPoint>
{
};

/// RendererOf() with everything transformed by `place`, in the points or by the actor.
vtkSmartPointer<vtkRenderer> RendererAt(
  const ShadingPoint& place, const std::vector<Shape>& shapes, bool moveTheActor)
{
  vtkSmartPointer<vtkPolyData> mesh = MeshOf(shapes);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints() && !moveTheActor; ++i)
  {
    double x[3];
    mesh->GetPoint(i, x);
    mesh->GetPoints()->SetPoint(i, place.Origin.x + place.Scale * x[0],
      place.Origin.y + place.Scale * x[1], place.Origin.z + place.Scale * x[2]);
  }
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  vtkActor* actor = AddMesh(renderer, mesh, false);
  if (moveTheActor)
  {
    actor->SetPosition(place.Origin.x, place.Origin.y, place.Origin.z);
    actor->SetScale(place.Scale);
  }
  LookAtImage(renderer, Size, Size);
  vtkCamera* camera = renderer->GetActiveCamera();
  const glm::dvec3 center = place.Origin + place.Scale * glm::dvec3(0.5 * Size, 0.5 * Size, 0.0);
  camera->SetFocalPoint(center.x, center.y, center.z);
  camera->SetPosition(center.x, center.y, center.z + 100.0 * place.Scale);
  camera->SetParallelScale(0.5 * Size * place.Scale);
  camera->SetClippingRange(place.Scale, 200.0 * place.Scale);
  return renderer;
}

}

TEST_P(PlacedShapes, KeepBoundsOfErrorAtAnyPosition)
{
  std::vector<Shape> shapes = { Star({ 60.3, 60.9 }, 55.0, 8.0, 72),
    Disc({ 188.2, 66.6 }, 51.0, 90), Disc({ 66.4, 190.1 }, 0.3, 24),
    Star({ 190.7, 190.2 }, 60.0, 30.0, 24) };
  const std::vector<double> fractions = SharesOf(shapes, Size, Size);
  for (bool moveTheActor : { false, true })
  {
    const Answer answer = Cast(RendererAt(GetParam(), shapes, moveTheActor), Size, Size);
    const Errors errors = Judge(answer.Colors, fractions);
    EXPECT_LE(errors.Edge, 0.002) << "moved by its " << (moveTheActor ? "actor" : "points");
    EXPECT_LE(errors.Worst, 0.01) << "in pixel " << errors.WorstPixel % Size << ", "
                                  << errors.WorstPixel / Size << ", moved by its "
                                  << (moveTheActor ? "actor" : "points");
  }
}

INSTANTIATE_TEST_SUITE_P(RayCaster, PlacedShapes,
  testing::Values(ShadingPoint{ "MillimetersAtTenMillion", 1e-3, { 1e7, -1e7, 1e7 } },
    ShadingPoint{ "AMillionthInSize", 1e-6 / Size, { 0.0, 0.0, 0.0 } },
    ShadingPoint{ "AMillionthInSizeFarAway", 1e-6 / Size, { 1e-4, 1e-4, -1e-4 } },
    ShadingPoint{ "AMillionInSize", 1e6 / Size, { -3e6, 0.0, 1e5 } }),
  [](const testing::TestParamInfo<ShadingPoint>& row) { return row.param.Name; });

namespace
{

/// Projects a world point to image coordinates.
glm::dvec2 Seen(const BruteForceScene& scene, glm::dvec2 x)
{
  const glm::dvec4 clip = scene.Projection * glm::dvec4(x, 0.0, 1.0);
  return (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * double(Size);
}

}

TEST(FlatShapesAskew, MatchExactCoverageInBothProjections)
{
  const std::vector<Shape> shapes = { Star({ -1.1, 0.2 }, 0.9, 0.2, 60),
    Disc({ 1.0, -0.3 }, 0.9, 180), Disc({ 0.1, 1.1 }, 0.01, 24) };
  for (bool parallel : { false, true })
  {
    vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
    AddMesh(renderer, MeshOf(shapes), false);
    LookAlong(renderer, { 0.4, 0.5, -1.0 }, { 0.2, 1.0, 0.0 }, Size, Size);
    renderer->GetActiveCamera()->SetParallelProjection(parallel);
    const BruteForceScene scene = BruteForceOf(renderer, Size, Size);
    ExactCoverage coverage(Size, Size);
    for (const Shape& shape : shapes)
    {
      std::vector<glm::dvec2> outline;
      for (glm::dvec2 point : shape.Outline)
      {
        outline.push_back(Seen(scene, point));
      }
      coverage.AddPolygon(outline);
    }
    const Errors errors = Judge(Cast(renderer, Size, Size).Colors, coverage.GetShares());
    EXPECT_GT(errors.EdgePixels, 500u);
    EXPECT_LE(errors.Edge, 0.002) << (parallel ? "parallel" : "perspective");
    EXPECT_LE(errors.Worst, 0.01) << (parallel ? "parallel" : "perspective") << " in pixel "
                                  << errors.WorstPixel % Size << ", " << errors.WorstPixel / Size;
  }
}
