// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Edges of translucent surfaces, translucent wireframes and lines whose order of drawing decides what is
// visible: tiles within the tolerance or above it with an estimate that says so, at a cost near that of
// opaque ones. The reference has up to 29 x 29 rays per pixel.
#include "BruteForce/StratifiedReference.h"
#include "Scenes/AccuracyScenes.h"
#include "Scenes/TestScene.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraRayCasterConstants.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

using namespace penumbra;

namespace
{

constexpr int Side = 48;
const glm::dvec3 ViewDirection(0.3, 0.5, -1.0);

using Style = std::function<void(vtkProperty*)>;

void ShowEdges(vtkProperty* property)
{
  property->EdgeVisibilityOn();
  property->SetEdgeColor(0.1, 0.2, 0.9);
  property->SetOpacity(0.5);
}

void ShowWireframe(vtkProperty* property)
{
  property->SetRepresentationToWireframe();
  property->SetOpacity(0.3);
}

void AddSphere(vtkRenderer* renderer, const Style& style, double x, int resolution)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(x, 0.0, 0.0);
  sphere->SetThetaResolution(resolution);
  sphere->SetPhiResolution(resolution);
  sphere->Update();
  vtkProperty* const property = AddMesh(renderer, sphere->GetOutput(), true)->GetProperty();
  property->SetColor(0.9, 0.6 + 0.3 * x, 0.4);
  style(property);
}

void AddPlane(vtkRenderer* renderer, const Style& style, double x, double opacity)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-0.5 + x, -0.5, -0.5);
  plane->SetPoint1(0.5 + x, -0.5, -0.2);
  plane->SetPoint2(-0.5 + x, 0.5, 0.3);
  plane->SetResolution(40, 40);
  plane->Update();
  vtkProperty* const property = AddMesh(renderer, plane->GetOutput(), true)->GetProperty();
  style(property);
  property->SetOpacity(opacity);
}

/// Wide lines whose normals point to the camera at one end and away from it at the other, with a light from beside:
/// their color changes abruptly where the normal is negated.
void AddNegatedLines(vtkRenderer* renderer)
{
  constexpr int Cells = 9;
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(Cells, Cells);
  plane->Update();
  vtkNew<vtkPolyData> mesh;
  mesh->ShallowCopy(plane->GetOutput());
  const glm::dvec3 beside = glm::normalize(glm::dvec3(0.96, -0.2, 0.188));
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 normal = beside + (i % 2 ? 0.5 : -0.5) * ViewDirection;
    normals->InsertNextTuple3(normal.x, normal.y, normal.z);
  }
  mesh->GetPointData()->SetNormals(normals);
  vtkProperty* const property = AddMesh(renderer, mesh, true)->GetProperty();
  property->SetRepresentationToWireframe();
  property->SetLineWidth(4.f);
  property->SetOpacity(0.6);
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPosition(beside.x, beside.y, beside.z);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  renderer->AddLight(light);
}

struct LineScene
{
  std::string Name;
  std::function<void(vtkRenderer*)> Build;
  double Budget; ///< rays per pixel
};

std::ostream& operator<<(std::ostream& os, const LineScene& scene)
{
  return os << scene.Name;
}

std::vector<LineScene> MakeScenes()
{
  std::vector<LineScene> scenes;
  for (const bool edges : { true, false })
  {
    const Style style = edges ? Style(ShowEdges) : Style(ShowWireframe);
    const std::string name = edges ? "Edges" : "Wireframe";
    scenes.push_back({ name + "OfASphere",
      [=](vtkRenderer* renderer) { AddSphere(renderer, style, 0.0, 40); }, 6.0 });
    scenes.push_back({ name + "OfIntersectingSpheres",
      [=](vtkRenderer* renderer) {
        AddSphere(renderer, style, 0.0, 24);
        AddSphere(renderer, style, 0.6, 40);
      },
      8.0 });
    scenes.push_back({ name + "OfAGyroid",
      [=](vtkRenderer* renderer) {
        style(AddMesh(renderer, MakeGyroid(5000, true), true)->GetProperty());
      },
      20.0 });
    scenes.push_back({ name + "BeforeAndBehindAnOpaqueSurface",
      [=](vtkRenderer* renderer) {
        AddSphere(renderer, style, 0.0, 32);
        AddPlane(renderer, style, 0.1, 1.0);
      },
      8.0 });
    scenes.push_back({ name + "OfCoincidentPlanes",
      [=](vtkRenderer* renderer) {
        AddPlane(renderer, style, 0.0, 0.4);
        AddPlane(renderer, style, 0.0, 0.6);
      },
      8.0 });
    scenes.push_back({ name + "InParallelProjection",
      [=](vtkRenderer* renderer) {
        AddSphere(renderer, style, 0.0, 40);
        AddPlane(renderer, style, 0.2, 0.6);
        renderer->GetActiveCamera()->ParallelProjectionOn();
      },
      8.0 });
  }
  scenes.push_back({ "WireframeWithNegatedNormals", AddNegatedLines, 4.0 });
  const Style opaque = [](vtkProperty* property) {
    ShowWireframe(property);
    property->SetOpacity(1.0);
  };
  scenes.push_back({ "HiddenLines",
    [=](vtkRenderer* renderer) {
      renderer->UseHiddenLineRemovalOn();
      AddSphere(renderer, opaque, 0.0, 24);
      AddSphere(renderer, opaque, 0.6, 40);
    },
    8.0 });
  scenes.push_back({ "HiddenLinesOfTranslucentSpheres",
    [=](vtkRenderer* renderer) {
      renderer->UseHiddenLineRemovalOn();
      AddSphere(renderer, ShowWireframe, 0.0, 24);
      AddSphere(renderer, ShowEdges, 0.6, 40);
    },
    8.0 });
  scenes.push_back({ "EdgesWithForcedOrder",
    [=](vtkRenderer* renderer) {
      AddSphere(renderer, ShowEdges, 0.0, 24);
      AddPlane(renderer, opaque, 0.1, 1.0);
      AddSphere(renderer, ShowEdges, 0.6, 40);
      renderer->GetActors()->GetLastActor()->ForceOpaqueOn();
      AddPlane(renderer, opaque, -0.1, 1.0);
    },
    8.0 });
  return scenes;
}

void BuildScene(const LineScene& scene, vtkRenderer* renderer)
{
  renderer->SetBackground(0.1, 0.2, 0.2);
  renderer->SetBackground2(0.4, 0.3, 0.1);
  renderer->GradientBackgroundOn();
  scene.Build(renderer);
  LookAlong(renderer, ViewDirection, { 0.0, 1.0, 0.0 }, Side, Side);
  renderer->GetActiveCamera()->Zoom(1.3);
}

}

class TranslucentLines : public ::testing::TestWithParam<LineScene>
{
};

namespace
{

/// Errors of an image against a reference.
struct Errors
{
  int Above = 0; ///< tiles above the tolerance
  int Tiles = 0;
  double Worst = 0.0; ///< largest error of a tile
  double Bias = 0.0;  ///< mean difference

  bool AreSmall(double tolerance) const
  {
    return 20 * this->Above <= this->Tiles && this->Worst <= 1.5 * tolerance &&
      std::abs(this->Bias) <= 2e-4;
  }
};

std::ostream& operator<<(std::ostream& os, const Errors& errors)
{
  return os << errors.Above << " of " << errors.Tiles << " tiles above, worst " << errors.Worst
            << ", bias " << errors.Bias;
}

/// Compares an image with n x n rays per pixel.
Errors CompareWithRays(vtkRenderer* renderer, const Answer& answer, double tolerance, int n)
{
  const Answer reference = Cast(renderer, Side, Side, [n](vtkPenumbraRayCaster* caster) {
    caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Uniform;
    caster->GetConstants().UniformSamples = n;
  });
  Errors errors;
  for (const TileAccuracy& tile : CompareTiles(answer, reference, Side))
  {
    errors.Worst = std::max(errors.Worst, tile.Error);
    errors.Above += tile.Error > tolerance;
    ++errors.Tiles;
  }
  for (std::size_t i = 0; i < answer.Colors.size(); ++i)
  {
    const glm::dvec3 d = answer.Colors[i] - reference.Colors[i];
    errors.Bias += (d.x + d.y + d.z) / 3.0 / (Side * Side);
  }
  return errors;
}

}

TEST_P(TranslucentLines, AreWithinTheTolerance)
{
  vtkNew<vtkRenderer> renderer;
  BuildScene(GetParam(), renderer);
  double tolerance = 0.0;
  const Answer answer = Cast(renderer, Side, Side,
    [&](vtkPenumbraRayCaster* caster) { tolerance = caster->GetTolerance(); });
  // Errors of the reference itself add to those of the image on average: fewer rays suffice if the sum is small.
  Errors errors = CompareWithRays(renderer, answer, tolerance, 13);
  if (!errors.AreSmall(tolerance))
  {
    errors = CompareWithRays(renderer, answer, tolerance, 29);
  }
  EXPECT_TRUE(errors.AreSmall(tolerance)) << errors;
  EXPECT_LE(answer.RaysPerPixel, GetParam().Budget);
}

TEST_P(TranslucentLines, AreIndependentOfThreadsAndUpdateExtent)
{
  vtkNew<vtkRenderer> renderer;
  BuildScene(GetParam(), renderer);
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(Side, Side);
  caster->SetNumberOfThreads(1);
  caster->Update();
  const auto getColors = [&] {
    return vtkFloatArray::SafeDownCast(caster->GetOutput()->GetPointData()->GetArray("Color"));
  };
  const std::vector<float> whole(
    getColors()->GetPointer(0), getColors()->GetPointer(0) + getColors()->GetNumberOfValues());
  caster->SetNumberOfThreads(3);
  int extent[6] = { 16, 47, 0, 31, 0, 0 };
  caster->UpdateExtent(extent);
  const std::size_t width = extent[1] - extent[0] + 1;
  for (int y = extent[2]; y <= extent[3]; ++y)
  {
    const float* const row = getColors()->GetPointer(0) + 4 * width * (y - extent[2]);
    EXPECT_TRUE(std::equal(row, row + 4 * width, whole.data() + 4 * (Side * y + extent[0]))) << y;
  }
}

INSTANTIATE_TEST_SUITE_P(RayCaster, TranslucentLines, ::testing::ValuesIn(MakeScenes()),
  [](const ::testing::TestParamInfo<LineScene>& row) { return row.param.Name; });
