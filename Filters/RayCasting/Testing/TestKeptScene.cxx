// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// vtkPenumbraRayCaster::KeepScene: a moving camera extracts nothing again, and every image has the
// bits of a new ray caster, whatever was rendered before. TestSceneChanges and TestPropChanges
// change scenes that are kept.
#include "vtkPenumbraRayCaster.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCubeAxesActor.h"
#include "vtkDataArray.h"
#include "vtkElevationFilter.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkGlyph3DMapper.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkLineSource.h"
#include "vtkNew.h"
#include "vtkPenumbraIrradianceProvider.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <ostream>
#include <random>
#include <string>
#include <vector>

namespace
{

using Choice = std::function<void(vtkPenumbraRayCaster*)>;
using Image = std::vector<float>;

constexpr int Side = 32;

vtkSmartPointer<vtkActor> AddSphere(
  vtkRenderer* renderer, double x, double y, double z, double radius, int facets = 16)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(x, y, z);
  sphere->SetRadius(radius);
  sphere->SetThetaResolution(facets);
  sphere->SetPhiResolution(facets);
  sphere->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkNew<vtkElevationFilter> heights;
  heights->SetInputConnection(sphere->GetOutputPort());
  heights->SetLowPoint(x, y - radius, z);
  heights->SetHighPoint(x, y + radius, z);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(heights->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
  return actor;
}

/// Two spheres on a square, lit from the side. All coordinates are multiplied by `scale` and
/// shifted by `shift` along x.
vtkSmartPointer<vtkRenderer> MakeScene(double scale = 1.0, double shift = 0.0)
{
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetBackground(0.2, 0.3, 0.4);
  AddSphere(renderer, shift, 0.0, 0.0, 0.5 * scale);
  AddSphere(renderer, shift + 0.6 * scale, 0.3 * scale, 0.2 * scale, 0.3 * scale);
  vtkNew<vtkPlaneSource> square;
  square->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  square->SetOrigin(shift - scale, -0.5 * scale, -scale);
  square->SetPoint1(shift + scale, -0.5 * scale, -scale);
  square->SetPoint2(shift - scale, -0.5 * scale, scale);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(square->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPosition(shift + 3.0 * scale, 4.0 * scale, 2.0 * scale);
  light->SetFocalPoint(shift, 0.0, 0.0);
  renderer->AddLight(light);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(shift, 2.0 * scale, 6.0 * scale);
  camera->SetFocalPoint(shift, 0.0, 0.0);
  renderer->ResetCameraClippingRange();
  return renderer;
}

void Orbit(vtkRenderer* renderer, double angle)
{
  renderer->GetActiveCamera()->Azimuth(angle);
  renderer->ResetCameraClippingRange();
}

vtkSmartPointer<vtkPenumbraRayCaster> MakeCaster(vtkRenderer* renderer, const Choice& choose = {})
{
  auto caster = vtkSmartPointer<vtkPenumbraRayCaster>::New();
  caster->SetRenderer(renderer);
  caster->SetResolution(Side, Side);
  caster->KeepSceneOn();
  if (choose)
  {
    choose(caster);
  }
  return caster;
}

/// Returns the values of all arrays, with -1 instead of NaN.
Image Render(vtkPenumbraRayCaster* caster)
{
  caster->Update();
  vtkPointData* arrays = caster->GetOutput()->GetPointData();
  Image image;
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = arrays->GetArray(i);
    const int components = array->GetNumberOfComponents();
    for (vtkIdType j = 0; j < array->GetNumberOfValues(); ++j)
    {
      const double value = array->GetComponent(j / components, static_cast<int>(j % components));
      image.push_back(std::isnan(value) ? -1.f : static_cast<float>(value));
    }
  }
  return image;
}

/// Returns the values of the array `Color`.
Image RenderColors(vtkPenumbraRayCaster* caster)
{
  caster->Update();
  auto* color = vtkFloatArray::SafeDownCast(caster->GetOutput()->GetPointData()->GetArray("Color"));
  return { color->GetPointer(0), color->GetPointer(0) + color->GetNumberOfValues() };
}

int GetCount(vtkPenumbraRayCaster* caster, const char* name)
{
  return static_cast<int>(caster->GetStatistics()->GetArray(name)->GetComponent(0, 0));
}

int CountExtractions(vtkPenumbraRayCaster* caster)
{
  return GetCount(caster, "Scene/Extractions");
}

int CountChangedSurfaces(vtkPenumbraRayCaster* caster)
{
  return GetCount(caster, "Scene/ChangedSurfaces");
}

double FindLargestDifference(const Image& a, const Image& b)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    largest = std::max(largest, std::abs(double(a[i]) - b[i]));
  }
  return largest;
}

double RootMeanSquare(const Image& a, const Image& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += (double(a[i]) - b[i]) * (double(a[i]) - b[i]);
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

struct Row
{
  const char* Name;
  Choice Choose;
  std::function<void(vtkRenderer*)> Change = [](vtkRenderer*) {};
};

std::ostream& operator<<(std::ostream& os, const Row& row)
{
  return os << row.Name;
}

const Row Rows[] = {
  { "Plain", [](vtkPenumbraRayCaster*) {} },
  { "Parallel", [](vtkPenumbraRayCaster*) {},
    [](vtkRenderer* renderer) {
      renderer->GetActiveCamera()->ParallelProjectionOn();
      renderer->GetActiveCamera()->SetParallelScale(1.5);
    } },
  { "Translucent", [](vtkPenumbraRayCaster*) {},
    [](vtkRenderer* renderer) {
      AddSphere(renderer, 0.0, 0.0, 0.0, 0.7)->GetProperty()->SetOpacity(0.4);
    } },
  { "CoincidentSurfaces", [](vtkPenumbraRayCaster*) {},
    [](vtkRenderer* renderer) {
      AddSphere(renderer, 0.0, 0.0, 0.0, 0.5)->GetProperty()->SetSpecular(0.5);
    } },
  // Becomes dense, with other edges, when the camera moves away.
  { "DenseMesh", [](vtkPenumbraRayCaster*) {},
    [](vtkRenderer* renderer) { AddSphere(renderer, 0.0, 0.5, 0.0, 0.5, 66); } },
  { "Shadows", [](vtkPenumbraRayCaster* caster) { caster->ShadowsOn(); } },
  { "AmbientOcclusion",
    [](vtkPenumbraRayCaster* caster) {
      caster->AmbientOcclusionOn();
      caster->SetTolerance(0.05);
    } },
  { "GeometryArrays", [](vtkPenumbraRayCaster* caster) { caster->GeometryArraysOn(); } },
  { "PointRadius", [](vtkPenumbraRayCaster* caster) { caster->SetPointRadius(0.05); } },
};

class KeptScene : public testing::TestWithParam<Row>
{
};

TEST_P(KeptScene, HasTheBitsOfANewRayCaster)
{
  const vtkSmartPointer<vtkRenderer> renderer = MakeScene();
  GetParam().Change(renderer);
  const auto kept = MakeCaster(renderer, GetParam().Choose);
  for (int frame = 0; frame < 6; ++frame)
  {
    const Image image = Render(kept);
    EXPECT_EQ(CountExtractions(kept), frame == 0 ? 1 : 0) << frame;
    const auto fresh = MakeCaster(renderer, GetParam().Choose);
    EXPECT_EQ(Render(fresh), image) << frame;
    EXPECT_EQ(fresh->GetEstimatedError(), kept->GetEstimatedError()) << frame;
    Orbit(renderer, 25.0);
    renderer->GetActiveCamera()->Dolly(frame % 2 == 0 ? 0.8 : 1.2);
    renderer->ResetCameraClippingRange();
  }
}

INSTANTIATE_TEST_SUITE_P(Table, KeptScene, testing::ValuesIn(Rows),
  [](const testing::TestParamInfo<Row>& row) { return std::string(row.param.Name); });

}

TEST(RayCasterKeepScene, KeepsTheSceneOfAnOrbit)
{
  const vtkSmartPointer<vtkRenderer> renderer = MakeScene();
  const auto caster = MakeCaster(renderer);
  Render(caster);
  EXPECT_GT(caster->GetPhaseSeconds(vtkPenumbraRayCaster::BUILD), 0.0);
  for (int frame = 1; frame < 36; ++frame)
  {
    Orbit(renderer, 10.0);
    Render(caster);
    EXPECT_EQ(CountExtractions(caster), 0) << frame;
    EXPECT_EQ(CountChangedSurfaces(caster), 0) << frame;
  }
}

// Views of ParaView release the renderer after each image.
TEST(RayCasterKeepScene, KeepsTheSceneWithoutItsRenderer)
{
  const vtkSmartPointer<vtkRenderer> renderer = MakeScene();
  const vtkSmartPointer<vtkRenderer> other = MakeScene(0.7);
  const auto caster = MakeCaster(renderer);
  Render(caster);
  caster->SetRenderer(nullptr);
  caster->SetRenderer(renderer);
  Orbit(renderer, 10.0);
  EXPECT_EQ(Render(caster), Render(MakeCaster(renderer)));
  EXPECT_EQ(CountExtractions(caster), 0);
  caster->SetRenderer(other);
  EXPECT_EQ(Render(caster), Render(MakeCaster(other)));
  EXPECT_EQ(CountExtractions(caster), 1);
  caster->SetRenderer(nullptr);
  caster->SetTolerance(0.01);
  caster->SetRenderer(other);
  Render(caster);
  EXPECT_EQ(CountExtractions(caster), 1);
}

TEST(RayCasterKeepScene, IsOffByDefault)
{
  vtkNew<vtkPenumbraRayCaster> caster;
  EXPECT_FALSE(caster->GetKeepScene());
  const vtkSmartPointer<vtkRenderer> renderer = MakeScene();
  caster->SetRenderer(renderer);
  caster->SetResolution(Side, Side);
  for (int frame = 0; frame < 2; ++frame)
  {
    Render(caster);
    EXPECT_EQ(CountExtractions(caster), 1);
    Orbit(renderer, 10.0);
  }
}

TEST(RayCasterKeepScene, HasNoPhasesOutsideOfItsRange)
{
  vtkNew<vtkPenumbraRayCaster> caster;
  EXPECT_EQ(caster->GetPhaseSeconds(-1), 0.0);
  EXPECT_EQ(caster->GetPhaseSeconds(vtkPenumbraRayCaster::TRACING + 1), 0.0);
}

// Changes that leave the camera alone, in scenes with other unchanged actors.
TEST(RayCasterKeepScene, ExtractsOnlyWhatChanges)
{
  const vtkSmartPointer<vtkRenderer> renderer = MakeScene();
  const vtkSmartPointer<vtkActor> actor = AddSphere(renderer, -0.5, 0.2, 0.5, 0.2);
  const auto caster = MakeCaster(renderer);
  vtkNew<vtkSphereSource> finer;
  finer->SetRadius(0.1);
  finer->SetThetaResolution(40);
  struct
  {
    std::function<void()> Apply;
    int Extractions;
    int ChangedSurfaces;
    int ExtractionsAfterOrbit = 0;
  } const changes[] = {
    { [&] { actor->SetPosition(0.1, 0.0, 0.0); }, 0, 1 },
    { [&] { actor->VisibilityOff(); }, 0, 1 },
    { [&] { actor->VisibilityOn(); }, 0, 1 },
    { [&] { actor->GetProperty()->SetOpacity(0.5); }, 0, 1 },
    { [&] { actor->GetMapper()->ScalarVisibilityOff(); }, 0, 1 },
    { [&] { actor->GetProperty()->SetColor(1.0, 0.0, 0.0); }, 0, 1 },
    { [&] { actor->GetMapper()->SetInputConnection(finer->GetOutputPort()); }, 0, 1 },
    { [&] { finer->SetPhiResolution(30); }, 0, 1 },
    { [&] { renderer->GetLights()->GetNextItem()->SetIntensity(0.5); }, 0, 0 },
    { [&] { actor->GetProperty()->EdgeVisibilityOn(); }, 1, 0, 1 }, // a width in pixels
    { [&] { actor->GetProperty()->EdgeVisibilityOff(); }, 1, 0 },
    { [&] { actor->SetPosition(9.0, 0.0, 0.0); }, 1, 0, 1 }, // beside the camera
    { [&] { actor->SetPosition(0.0, 0.1, 0.0); }, 1, 0 },
    { [&] { renderer->RemoveActor(actor); }, 1, 0 },
    { [&] { renderer->AddActor(actor); }, 1, 0 },
    { [&] { caster->SetTolerance(0.01); }, 1, 0 },
    { [&] { caster->SetLightTolerance(0.02); }, 1, 0 },
    { [&] { caster->ShadowsOn(); }, 1, 0 },
    { [&] { caster->SetResolution(Side, Side - 8); }, 1, 0 },
  };
  Render(caster);
  renderer->GetLights()->InitTraversal();
  int i = 0;
  for (const auto& change : changes)
  {
    change.Apply();
    const Image after = Render(caster);
    EXPECT_EQ(CountExtractions(caster), change.Extractions) << i;
    EXPECT_EQ(CountChangedSurfaces(caster), change.ChangedSurfaces) << i;
    const auto fresh = MakeCaster(renderer, [&](vtkPenumbraRayCaster* other) {
      other->SetTolerance(caster->GetTolerance());
      other->SetLightTolerance(caster->GetLightTolerance());
      other->SetShadows(caster->GetShadows());
      other->SetResolution(caster->GetResolution());
    });
    EXPECT_EQ(Render(fresh), after) << i;
    Orbit(renderer, 1.0);
    Render(caster);
    EXPECT_EQ(CountExtractions(caster), change.ExtractionsAfterOrbit) << i;
    ++i;
  }
}

// Props that touch each other, of each kind that a kept scene may contain, change in random order.
TEST(RayCasterKeepScene, HasTheBitsOfANewRayCasterAfterRandomChanges)
{
  const vtkSmartPointer<vtkRenderer> renderer = MakeScene();
  std::vector<vtkSmartPointer<vtkActor>> actors;
  for (int i = 0; i < 12; ++i)
  {
    actors.push_back(
      AddSphere(renderer, 0.4 * (i % 4) - 0.6, 0.15 * (i / 4), 0.1 * (i % 3), 0.1 + 0.02 * i, 10));
  }
  vtkNew<vtkGlyph3DMapper> glyphs; // instances
  vtkNew<vtkSphereSource> places;
  places->SetRadius(0.7);
  glyphs->SetInputConnection(places->GetOutputPort());
  vtkNew<vtkSphereSource> glyph;
  glyph->SetRadius(0.05);
  glyphs->SetSourceConnection(glyph->GetOutputPort());
  actors[0]->SetMapper(glyphs);
  vtkNew<vtkLineSource> line; // a tube
  line->SetPoint1(-0.7, 0.4, 0.5);
  line->SetPoint2(0.7, 0.5, 0.5);
  vtkNew<vtkPolyDataMapper> lineMapper;
  lineMapper->SetInputConnection(line->GetOutputPort());
  actors[1]->SetMapper(lineMapper);
  for (int i = 2; i < 5; ++i) // coincident squares
  {
    vtkNew<vtkPlaneSource> square;
    square->SetOrigin(-0.5, -0.5 + 0.2 * (i % 2), 0.0);
    square->SetPoint1(0.5, -0.5 + 0.2 * (i % 2), 0.0);
    square->SetPoint2(-0.5, 0.5, 0.0);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(square->GetOutputPort());
    actors[i]->SetMapper(mapper);
    actors[i]->GetProperty()->SetColor(0.2 * i, 1.0 - 0.2 * i, 0.5);
  }
  const auto choose = [](vtkPenumbraRayCaster* caster) {
    caster->SetResolution(24, 24);
    caster->SetLineRadius(0.04);
    caster->ShadowsOn();
  };
  const auto kept = MakeCaster(renderer, choose);
  Render(kept);
  std::mt19937 random(7); // NOLINT(*-msc51-cpp): the same changes in each run
  const auto pick = [&](int count) { return static_cast<int>(random() % count); };
#ifdef __SANITIZE_ADDRESS__
  constexpr int Steps = 15;
#else
  constexpr int Steps = 60;
#endif
  int updates = 0;
  for (int step = 0; step < Steps; ++step)
  {
    const auto& actor = actors[pick(static_cast<int>(actors.size()))];
    const std::function<void()> changes[] = {
      [&] { actor->SetPosition(0.05 * pick(5), 0.05 * pick(3), 0.05 * pick(3)); },
      [&] { actor->SetVisibility(pick(2)); },
      [&] { actor->GetProperty()->SetOpacity(0.25 * (1 + pick(4))); },
      [&] { actor->GetProperty()->SetColor(pick(2), pick(2), 1.0); },
      [&] { actor->GetProperty()->SetBackfaceCulling(pick(2)); },
      [&] { actor->GetProperty()->SetInterpolation(pick(3)); },
      [&] { actor->RotateZ(90.0 * pick(4)); },
      [&] { actor->SetMapper(actors[pick(static_cast<int>(actors.size()))]->GetMapper()); },
      [&] { places->SetThetaResolution(4 + pick(6)); },
      [&] { renderer->GetActiveCamera()->Azimuth(5.0); },
    };
    for (int count = 1 + pick(3); count > 0; --count)
    {
      changes[pick(static_cast<int>(std::size(changes)))]();
    }
    const Image image = Render(kept);
    updates += CountExtractions(kept) == 0;
    EXPECT_EQ(Render(MakeCaster(renderer, choose)), image) << step;
  }
  EXPECT_GT(updates, Steps / 2);
}

// Nearer, inside the bounds, or with a higher zoom, rounded coordinates would be visible.
TEST(RayCasterKeepScene, FollowsTheCameraWherePrecisionRequiresIt)
{
  const vtkSmartPointer<vtkRenderer> renderer = MakeScene();
  vtkCamera* camera = renderer->GetActiveCamera();
  const auto kept = MakeCaster(renderer);
  const auto plain = MakeCaster(renderer);
  plain->KeepSceneOff();
  Render(kept);
  const std::vector<std::function<void()>> views = {
    [&] { camera->SetPosition(0.0, 0.2, 1.2); },
    [&] { camera->SetPosition(0.9, 0.2, 0.9); },
    [&] { camera->SetPosition(0.0, 20.0, 60.0); },
    [&] { camera->SetPosition(0.0, 200.0, 600.0); },
    [&] {
      camera->SetPosition(0.0, 2.0, 6.0);
      camera->SetViewAngle(1e-3);
    },
    [&] {
      camera->ParallelProjectionOn();
      camera->SetParallelScale(1e-5);
    },
  };
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    views[i]();
    renderer->ResetCameraClippingRange();
    const Image image = Render(kept);
    EXPECT_EQ(CountExtractions(kept), 1) << i;
    EXPECT_EQ(Render(plain), image) << i;
  }
}

// Lines, points and text have a size in pixels.
TEST(RayCasterKeepScene, ExtractsPropsThatDependOnTheCamera)
{
  const std::vector<std::function<void(vtkRenderer*)>> changes = {
    [](vtkRenderer* renderer) {
      AddSphere(renderer, 0.0, 0.0, 0.0, 0.7, 6)->GetProperty()->SetRepresentationToWireframe();
    },
    [](vtkRenderer* renderer) {
      AddSphere(renderer, 0.0, 0.0, 0.0, 0.7, 6)->GetProperty()->SetRepresentationToPoints();
    },
    [](vtkRenderer* renderer) {
      AddSphere(renderer, 0.0, 0.0, 0.0, 0.7, 6)->GetProperty()->EdgeVisibilityOn();
    },
    [](vtkRenderer* renderer) {
      vtkNew<vtkCubeAxesActor> axes;
      axes->SetBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
      axes->SetCamera(renderer->GetActiveCamera());
      renderer->AddActor(axes);
    },
  };
  for (std::size_t i = 0; i < changes.size(); ++i)
  {
    const vtkSmartPointer<vtkRenderer> renderer = MakeScene();
    changes[i](renderer);
    const auto kept = MakeCaster(renderer);
    for (int frame = 0; frame < 2; ++frame)
    {
      const Image image = Render(kept);
      EXPECT_EQ(CountExtractions(kept), 1) << i;
      const auto plain = MakeCaster(renderer);
      plain->KeepSceneOff();
      EXPECT_EQ(Render(plain), image) << i;
      Orbit(renderer, 10.0);
    }
  }
}

// The fixed origin changes only the rounding: at the nearest and farthest cameras, for tiny scenes
// and for scenes far from the world's origin, and with shadows.
TEST(RayCasterKeepScene, ChangesNoColorVisibly)
{
  struct Case
  {
    double Scale;
    double Shift;
    double Distance;
  };
  // The radius of the bounds is about 1.5.
  for (const Case& one : { Case{ 1.0, 0.0, 2.3 }, Case{ 1.0, 0.0, 6.0 }, Case{ 1.0, 0.0, 11.5 },
         Case{ 1e-6, 0.0, 3.0 }, Case{ 1e6, 0.0, 3.0 }, Case{ 1.0, 1e7, 3.0 } })
  {
    for (const bool shadows : { false, true })
    {
      const vtkSmartPointer<vtkRenderer> renderer = MakeScene(one.Scale, one.Shift);
      renderer->GetActiveCamera()->SetPosition(one.Shift + 0.3 * one.Distance * one.Scale,
        0.3 * one.Distance * one.Scale, 0.9 * one.Distance * one.Scale);
      renderer->ResetCameraClippingRange();
      const auto choose = [&](vtkPenumbraRayCaster* caster) {
        caster->SetShadows(shadows);
        caster->SetResolution(64, 64);
      };
      const auto fixed = MakeCaster(renderer, choose);
      const auto plain = MakeCaster(renderer, choose);
      plain->KeepSceneOff();
      const Image image = RenderColors(fixed);
      const Image expected = RenderColors(plain);
      EXPECT_LT(RootMeanSquare(image, expected), 1e-3)
        << one.Scale << " " << one.Shift << " " << one.Distance << " " << shadows;
      EXPECT_LT(FindLargestDifference(image, expected), shadows ? 0.05 : 1.0 / 255.0)
        << one.Scale << " " << one.Shift << " " << one.Distance << " " << shadows;
      // The origin was fixed.
      Orbit(renderer, 1.0);
      Render(fixed);
      EXPECT_EQ(CountExtractions(fixed), 0) << one.Scale << " " << one.Shift << " " << one.Distance;
    }
  }
}
