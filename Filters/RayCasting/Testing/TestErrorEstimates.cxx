// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Error estimates in scenes that were not used to choose constants, a subset of the benchmark
// `accuracy`. The reference has jittered samples and estimates its own error.
#include "BruteForce/StratifiedReference.h"
#include "Scenes/AccuracyScenes.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraRayCasterConstants.h"

#include "vtkActor.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCleanPolyData.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkParametricBoy.h"
#include "vtkParametricFunctionSource.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkTexture.h"
#include "vtkUnsignedCharArray.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

using namespace penumbra;

class ErrorEstimates : public ::testing::TestWithParam<std::string>
{
};

TEST_P(ErrorEstimates, ExceedTheErrorsAboveTheTolerance)
{
  constexpr int Side = AccuracyImageSide;
  const auto& scenes = GetAccuracyScenes();
  const auto scene = std::find_if(scenes.begin(), scenes.end(),
    [](const AccuracyScene& candidate) { return candidate.Name == GetParam(); });
  ASSERT_NE(scene, scenes.end());
  vtkNew<vtkRenderer> renderer;
  scene->Build(renderer);
  double tolerance = 0.0;
  const Answer answer = Cast(renderer, Side, Side, [&](vtkPenumbraRayCaster* caster) {
    caster->SetShadows(scene->Shadows);
    tolerance = caster->GetTolerance();
  });
  const StratifiedReference reference = DrawStratified(renderer, Side, Side, 10, scene->Shadows);
  const std::vector<TileAccuracy> tiles = CompareTiles(answer, reference, Side);
  std::size_t above = 0;
  for (const TileAccuracy& tile : tiles)
  {
    above += tile.Error > tolerance && tile.Estimate < tile.Error ? 1 : 0;
  }
  EXPECT_LE(20 * above, tiles.size());
}

INSTANTIATE_TEST_SUITE_P(RayCaster, ErrorEstimates,
  ::testing::Values(
    "Foliage", "FoliageWithShadows", "Checkerboard", "Glass", "FlatTerrain", "Soup300WithShadows"),
  [](const ::testing::TestParamInfo<std::string>& row) { return row.param; });

namespace
{

/// Spheres that touch and cover the whole image.
void AddSpheres(vtkRenderer* renderer)
{
  for (int i = 0; i < 25; ++i)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(0.8 * (i % 5), 0.8 * (i / 5), 0.1 * (i % 3));
    sphere->SetRadius(0.6);
    sphere->SetThetaResolution(16);
    sphere->SetPhiResolution(16);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(sphere->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    renderer->AddActor(actor);
  }
  renderer->GetActiveCamera()->ParallelProjectionOn();
  renderer->ResetCamera();
  renderer->GetActiveCamera()->SetParallelScale(1.4);
}

/// Returns the largest RMS of `EstimatedError` of 16 x 16 pixels of a square image of 64 pixels.
double FindLargestTileError(vtkImageData* image)
{
  vtkDataArray* errors = image->GetPointData()->GetArray("EstimatedError");
  double squares[16] = {};
  for (int p = 0; p < 64 * 64; ++p)
  {
    const double error = errors->GetComponent(p, 0);
    squares[p / 64 / 16 * 4 + p % 64 / 16] += error * error / 256.0;
  }
  return std::sqrt(*std::max_element(squares, squares + 16));
}

}

TEST(ErrorWarnings, AgreeWithTheEstimatedErrorOfTiles)
{
  int cases[2] = {}; // warnings, images without one
  for (const double tolerance : { 0.3, 0.1, 1e-4 })
  {
    for (const bool occlusion : { false, true })
    {
      if (occlusion && tolerance < 0.1)
      {
        continue; // too many rays
      }
      SCOPED_TRACE("tolerance " + std::to_string(tolerance) + (occlusion ? " with occlusion" : ""));
      vtkNew<vtkRenderer> renderer;
      AddSpheres(renderer);
      vtkNew<vtkPenumbraRayCaster> caster;
      caster->SetRenderer(renderer);
      caster->SetResolution(64, 64);
      caster->SetTolerance(tolerance);
      caster->SetAmbientOcclusion(occlusion);
      std::string warnings;
      vtkNew<vtkCallbackCommand> observer;
      observer->SetClientData(&warnings);
      observer->SetCallback([](vtkObject*, unsigned long, void* data, void* text) {
        *static_cast<std::string*>(data) += static_cast<const char*>(text);
      });
      caster->AddObserver(vtkCommand::WarningEvent, observer);
      caster->Update();
      const double light = occlusion ? caster->GetEffectiveLightTolerance() : 0.0;
      const bool missed = FindLargestTileError(caster->GetOutput()) > std::hypot(tolerance, light);
      EXPECT_EQ(warnings.find("Increase Tolerance.") != std::string::npos, missed && !occlusion)
        << warnings;
      EXPECT_EQ(warnings.empty(), !missed) << warnings;
      ++cases[missed ? 0 : 1];
      caster->GetConstants().ToleranceProperty = "Accuracy";
      caster->GetConstants().ToleranceValue = 0.75;
      caster->Modified();
      warnings.clear();
      caster->Update();
      EXPECT_EQ(warnings.find("The tolerance of 0.75 was") != std::string::npos, missed);
      EXPECT_EQ(warnings.find("Increase"), warnings.find("Increase Accuracy.")) << warnings;
    }
  }
  EXPECT_GT(cases[0], 0);
  EXPECT_GT(cases[1], 0);
}

TEST(TextureOutlines, HaveReliableErrorEstimates)
{
  constexpr int Texels = 12;
  vtkNew<vtkImageData> image;
  image->SetDimensions(Texels, Texels, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int i = 0; i < Texels * Texels; ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      image->SetScalarComponentFromDouble(
        i % Texels, i / Texels, 0, c, (i % Texels + i / Texels) % 2 ? 250.0 : 30.0);
    }
  }
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->InterpolateOff();
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.3, 0.8, 0.3);
  for (int i = 0; i < 12; ++i)
  {
    vtkNew<vtkPlaneSource> plane;
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(plane->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->SetTexture(texture);
    actor->GetProperty()->LightingOff();
    actor->RotateZ(10.0 + 7.0 * i);
    actor->RotateX(5.0 * i);
    actor->SetPosition(1.4 * (i % 4), 1.4 * (i / 4), 0.0);
    renderer->AddActor(actor);
  }
  renderer->ResetCamera();
  constexpr int Side = 160;
  double tolerance = 0.0;
  const Answer answer = Cast(renderer, Side, Side, [&](vtkPenumbraRayCaster* caster) {
    caster->SetTolerance(1.0 / 512.0);
    tolerance = caster->GetTolerance();
  });
  const StratifiedReference reference = DrawStratified(renderer, Side, Side, 16, false);
  double worst = 0.0;
  for (const TileAccuracy& tile : CompareTiles(answer, reference, Side))
  {
    worst = std::max(worst, tile.Error > tile.Estimate ? tile.Error : 0.0);
  }
  EXPECT_LE(worst, 1.5 * tolerance);
}

TEST(UnsteadyNormals, AreSampledToTheTolerance)
{
  // Boy's surface has one side only: normals are opposite in a band of triangles.
  vtkNew<vtkParametricBoy> boy;
  vtkNew<vtkParametricFunctionSource> source;
  source->SetParametricFunction(boy);
  source->SetUResolution(120);
  source->SetVResolution(120);
  source->GenerateNormalsOff();
  source->SetScalarModeToNone();
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(clean->GetOutputPort());
  normals->SplittingOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->GetActiveCamera()->SetPosition(1.0, 0.8, 2.0);
  renderer->ResetCamera();
  constexpr int Side = 256;
  double tolerance = 0.0;
  const Answer answer = Cast(renderer, Side, Side,
    [&](vtkPenumbraRayCaster* caster) { tolerance = caster->GetTolerance(); });
  const StratifiedReference reference = DrawStratified(renderer, Side, Side, 12, false);
  int far = 0;
  double worst = 0.0;
  for (std::size_t i = 0; i < answer.Colors.size(); ++i)
  {
    const double error = std::abs(answer.Colors[i].x - reference.Colors[i].x);
    worst = std::max(worst, error);
    far += error > 0.1;
  }
  EXPECT_EQ(far, 0) << "worst: " << worst;
  std::size_t above = 0;
  const std::vector<TileAccuracy> tiles = CompareTiles(answer, reference, Side);
  for (const TileAccuracy& tile : tiles)
  {
    above += tile.Error > tolerance && tile.Estimate < tile.Error ? 1 : 0;
  }
  EXPECT_LE(20 * above, tiles.size());
}

TEST(ColorsOfWires, AreAveragedOverEachSegment)
{
  // Colors that change within less than a pixel along segments that cover small parts of it.
  const vtkSmartPointer<vtkPolyData> mesh = MakeGyroid(20000.0, false);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    const auto random = static_cast<std::uint32_t>(i) * 2654435761u;
    colors->InsertNextTuple3(random >> 24, random >> 16 & 255u, random >> 8 & 255u);
  }
  mesh->GetPointData()->SetScalars(colors);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetRepresentationToWireframe();
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetLineWidth(1.5f);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Zoom(1.5);
  constexpr int Side = 48;
  double tolerance = 0.0;
  const Answer answer = Cast(renderer, Side, Side, [&](vtkPenumbraRayCaster* caster) {
    caster->SetTolerance(1.0 / 512.0);
    tolerance = caster->GetTolerance();
  });
  const StratifiedReference reference = DrawStratified(renderer, Side, Side, 24, false);
  for (const TileAccuracy& tile : CompareTiles(answer, reference, Side))
  {
    EXPECT_LE(tile.Error, std::max(tolerance, tile.Estimate));
  }
}

namespace
{

/// Spheres with a diameter of one pixel in a plane before the image: one at a random place in each cell of a grid.
/// World coordinates are pixels.
class SpherePlane
{
public:
  static constexpr double Radius = 0.5;
  static constexpr double OcclusionRadius = 3.0;

  SpherePlane(int width, int height, double spacing)
    : Spacing(spacing),
      Cells(static_cast<int>(width / spacing) + 1, static_cast<int>(height / spacing) + 1),
      Random(7)
  {
    for (int i = 0; i < this->Cells.x * this->Cells.y; ++i)
    {
      const glm::dvec3 cell(i % this->Cells.x, i / this->Cells.x, 0.0);
      const glm::dvec3 offset(this->Draw(), this->Draw(), this->Draw());
      this->Centers.push_back(spacing * (cell + 0.25 + 0.5 * offset));
    }
  }

  const std::vector<glm::dvec3>& GetCenters() const { return this->Centers; }

  /// Returns the mean of 1 - occlusion over `side` x `side` jittered camera rays, one hemisphere ray each; misses
  /// are black.
  double DrawPixel(int x, int y, int side)
  {
    double sum = 0.0;
    for (int i = 0; i < side * side; ++i)
    {
      const glm::dvec3 origin(
        x + (i % side + this->Draw()) / side, y + (i / side + this->Draw()) / side, 100.0);
      const glm::dvec3 down(0.0, 0.0, -1.0);
      int sphere = -1;
      const double distance = this->Find(origin, down, 200.0, -1, sphere);
      if (sphere >= 0)
      {
        const glm::dvec3 point = origin + distance * down;
        const glm::dvec3 normal = (point - this->Centers[sphere]) / Radius;
        int occluder = -1;
        this->Find(point, this->DrawDirection(normal), OcclusionRadius, sphere, occluder);
        sum += occluder < 0 ? 1.0 : 0.0;
      }
    }
    return sum / (side * side);
  }

private:
  double Draw() { return this->Random() * 0x1p-32; }

  /// Returns a direction with a density in proportion to its cosine: a point of the unit sphere around the tip of
  /// the normal.
  glm::dvec3 DrawDirection(glm::dvec3 normal)
  {
    const double z = 1.0 - 2.0 * this->Draw();
    const double angle = 6.283185307179586 * this->Draw();
    const double r = std::sqrt(1.0 - z * z);
    return glm::normalize(normal + glm::dvec3(r * std::cos(angle), r * std::sin(angle), z));
  }

  /// Returns the distance of the first sphere along a ray, except `own`, and its index in `sphere`.
  double Find(glm::dvec3 origin, glm::dvec3 direction, double end, int own, int& sphere) const
  {
    const glm::ivec2 at(glm::floor(glm::dvec2(origin) / this->Spacing));
    const int reach =
      own < 0 ? 1 : static_cast<int>(std::ceil((OcclusionRadius + Radius) / this->Spacing));
    const glm::ivec2 low = glm::max(at - reach, 0);
    const glm::ivec2 high = glm::min(at + reach, this->Cells - 1);
    double nearest = end;
    for (int y = low.y; y <= high.y; ++y)
    {
      for (int x = low.x; x <= high.x; ++x)
      {
        const int i = y * this->Cells.x + x;
        const glm::dvec3 offset = this->Centers[i] - origin;
        const double along = glm::dot(offset, direction);
        const double square = Radius * Radius - glm::dot(offset, offset) + along * along;
        const double distance = along - std::sqrt(std::max(square, 0.0));
        if (i != own && square > 0.0 && distance > 0.0 && distance < nearest)
        {
          nearest = distance;
          sphere = i;
        }
      }
    }
    return nearest;
  }

  const double Spacing;
  const glm::ivec2 Cells;
  std::vector<glm::dvec3> Centers;
  std::mt19937 Random;
};

}

TEST(ScatteredTiles, HaveReliableEstimatesOfOcclusionOnSpheresOfOnePixel)
{
  constexpr int Width = 64;
  constexpr int Height = 48;
  constexpr int Side = 32; // of the grids of camera rays of the reference
  for (const double spacing : { 1.6, 2.2 })
  {
    SpherePlane plane(Width, Height, spacing);
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> vertices;
    for (const glm::dvec3& center : plane.GetCenters())
    {
      const vtkIdType id = points->InsertNextPoint(center.x, center.y, center.z);
      vertices->InsertNextCell(1, &id);
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetVerts(vertices);
    const vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
    AddMesh(renderer, data, false);
    LookAtImage(renderer, Width, Height);
    double limit = 0.0;
    const Answer answer = Cast(renderer, Width, Height, [&](vtkPenumbraRayCaster* caster) {
      caster->SetPointRadius(SpherePlane::Radius);
      caster->SetAmbientOcclusion(true);
      caster->SetAmbientOcclusionRadius(SpherePlane::OcclusionRadius);
      caster->SetLightTolerance(0.01);
      limit = std::hypot(caster->GetTolerance(), caster->GetLightTolerance());
    });
    StratifiedReference reference;
    for (int i = 0; i < Width * Height; ++i)
    {
      const double first = plane.DrawPixel(i % Width, i / Width, Side);
      const double second = plane.DrawPixel(i % Width, i / Width, Side);
      reference.Colors.emplace_back(0.5 * (first + second));
      reference.SquaredErrors.push_back(0.25 * (first - second) * (first - second));
    }
    for (const TileAccuracy& tile : CompareTiles(answer, reference, Width))
    {
      EXPECT_LE(tile.Error, limit) << spacing;
      EXPECT_LE(tile.Estimate, limit) << spacing;
      EXPECT_LE(tile.Error, 1.1 * tile.Estimate) << spacing;
    }
  }
}

// Nothing occludes the triangles, so that occlusion changes no pixel.
TEST(ScatteredTiles, DoNotIncludeTheCornersOfSurfaces)
{
  constexpr int Side = 128;
  std::vector<Shape> triangles;
  for (int i = 0; i < 16; ++i)
  {
    const glm::dvec2 center(16.0 + 32.0 * (i % 4), 16.0 + 32.0 * (i / 4));
    const double angle = 0.4 * i;
    const glm::dmat2 turn(std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle));
    const glm::dvec2 outline[3] = { { 8.0 + 0.3 * i, 0.0 }, { -14.0, 5.0 }, { -14.0, -5.0 } };
    triangles.push_back({ center, {} });
    for (const glm::dvec2& corner : outline)
    {
      triangles.back().Outline.push_back(center + turn * corner);
    }
  }
  const vtkSmartPointer<vtkRenderer> renderer = RendererOf(triangles, Side, Side);
  const auto cast = [&](bool occlusion) {
    return Cast(renderer, Side, Side,
      [&](vtkPenumbraRayCaster* caster) { caster->SetAmbientOcclusion(occlusion); });
  };
  const Answer plain = cast(false);
  const Answer lit = cast(true);
  for (int i = 0; i < Side * Side; ++i)
  {
    EXPECT_NEAR(lit.Colors[i].x, plain.Colors[i].x, 1e-5) << i % Side << ", " << i / Side;
  }
}

TEST(StratifiedReference, BlendsEdgesAndTheirFacesAsOneLayer)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(8.0, 8.0, 0.0);
  plane->SetPoint1(40.0, 8.0, 0.0);
  plane->SetPoint2(8.0, 40.0, 0.0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(plane->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(0.2, 0.4, 0.6);
  actor->GetProperty()->SetOpacity(0.5);
  actor->GetProperty()->EdgeVisibilityOn();
  actor->GetProperty()->SetEdgeColor(1.0, 0.0, 0.0);
  actor->GetProperty()->SetLineWidth(6.f);
  const vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  renderer->SetBackground(0.0, 0.0, 1.0);
  renderer->AddActor(actor);
  LookAtImage(renderer, 48, 48);
  const StratifiedReference reference = DrawStratified(renderer, 48, 48, 4, false);
  const auto check = [&](int x, int y, glm::dvec3 expected) {
    const glm::dvec3 found = reference.Colors[y * 48 + x];
    EXPECT_NEAR(glm::length(found - expected), 0.0, 1e-5) << x << ", " << y;
  };
  check(2, 2, { 0.0, 0.0, 1.0 });
  check(24, 24, { 0.1, 0.2, 0.8 });
  check(24, 9, { 0.5, 0.0, 0.5 }); // half of the edge lies on the face
  check(24, 6, { 0.5, 0.0, 0.5 });
}
