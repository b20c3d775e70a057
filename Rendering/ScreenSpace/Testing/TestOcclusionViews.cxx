// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The images of the occlusion pass for stereo types and for transforms of the camera, compared with
// windows without the pass and with monoscopic images.
#include "Frame/RendererMap.h"
#include "OcclusionScene.h"

#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkTransform.h"
#include "vtkVersion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>

namespace
{

using Pass = vtkPenumbraTemporalSSAOPass;

/// Colored spheres on a floor.
void BuildColoredSpheres(OcclusionScene& scene)
{
  scene.AddFloor()->GetProperty()->SetColor(0.9, 0.8, 0.7);
  for (int i = 0; i < 3; ++i)
  {
    scene.AddSphere({ 1.1 * i - 1.1, 0.3 * i, 0.45 }, 0.45)
      ->GetProperty()
      ->SetColor(0.5 + 0.2 * i, 1.0 - 0.3 * i, 0.6);
  }
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0.4 });
  scene.Renderer->GetActiveCamera()->SetEyeAngle(10.0);
}

int LargestDifference(const std::vector<int>& a, const std::vector<int>& b)
{
  int largest = a.size() == b.size() ? 0 : 256;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
  {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

/// Returns the fraction of pixels with a color that differs by more than `tolerance`.
double FractionOff(const std::vector<int>& a, const std::vector<int>& b, int tolerance)
{
  int off = a.size() == b.size() ? 0 : static_cast<int>(a.size());
  for (std::size_t i = 0; i + 3 < std::min(a.size(), b.size()); i += 4)
  {
    off += std::abs(a[i] - b[i]) > tolerance || std::abs(a[i + 1] - b[i + 1]) > tolerance ||
      std::abs(a[i + 2] - b[i + 2]) > tolerance;
  }
  return 4.0 * off / static_cast<double>(a.size());
}

/// A transform of the camera and the pass of an image of the spheres.
struct View
{
  double Strength = -1.0; ///< negative: without the pass
  int StereoType = 0;     ///< 0: none
  std::function<void(vtkCamera*)> SetCamera = [](vtkCamera*) {};
  bool Parallel = false;
};

std::vector<int> Draw(const View& view)
{
  OcclusionScene scene;
  BuildColoredSpheres(scene);
  if (view.Parallel)
  {
    scene.UseParallelProjection(true, 1.5);
  }
  view.SetCamera(scene.Renderer->GetActiveCamera());
  if (view.Strength >= 0.0)
  {
    scene.AddOcclusionPass(0.5)->SetStrength(view.Strength);
    scene.Pass->SetKernelName("march");
    if (view.Strength == 0.0)
    {
      scene.Pass->SetTolerance(0.1); // It need not converge, because it is not visible.
    }
  }
  if (view.StereoType)
  {
    scene.Window->SetStereoType(view.StereoType);
    scene.Window->StereoRenderOn();
  }
  scene.Window->Render();
  return scene.Image();
}

/// Moves the camera to an eye of a stereo view: VTK shears the view about the plane through the
/// focal point, which is the image of a camera beside it with an oblique frustum.
void MoveToEye(vtkCamera* camera, bool left)
{
  const double angle = vtkMath::RadiansFromDegrees(camera->GetEyeAngle() / 2.0);
  const double shift = camera->GetDistance() * std::tan(angle) * (left ? -1.0 : 1.0);
  double right[3];
  camera->OrthogonalizeViewUp();
  vtkMath::Cross(camera->GetDirectionOfProjection(), camera->GetViewUp(), right);
  vtkMath::Normalize(right);
  double position[3];
  double focus[3];
  for (int i = 0; i < 3; ++i)
  {
    position[i] = camera->GetPosition()[i] + shift * right[i];
    focus[i] = camera->GetFocalPoint()[i] + shift * right[i];
  }
  camera->SetPosition(position);
  camera->SetFocalPoint(focus);
  const double halfHeight =
    camera->GetDistance() * std::tan(vtkMath::RadiansFromDegrees(camera->GetViewAngle() / 2.0));
  camera->SetWindowCenter(-shift / (halfHeight * 160.0 / 120.0), 0.0);
}

constexpr int AllTypes[] = { VTK_STEREO_LEFT, VTK_STEREO_RIGHT, VTK_STEREO_ANAGLYPH,
  VTK_STEREO_RED_BLUE, VTK_STEREO_INTERLACED, VTK_STEREO_CHECKERBOARD, VTK_STEREO_DRESDEN,
  VTK_STEREO_SPLITVIEWPORT_HORIZONTAL };

TEST(OcclusionViews, KeepEveryStereoType)
{
  const std::vector<int> middle = Draw({});
  for (const int type : AllTypes)
  {
    SCOPED_TRACE(type);
    const std::vector<int> plain = Draw({ -1.0, type });
    EXPECT_GT(FractionOff(plain, middle, 20), 0.01);
    EXPECT_LE(LargestDifference(Draw({ 0.0, type }), plain), 2);
  }
}

TEST(OcclusionViews, ShowEachEyeAsACameraAtTheEye)
{
  for (const bool left : { true, false })
  {
    for (const double strength : { -1.0, 1.0 })
    {
      SCOPED_TRACE(strength);
      const View eye{ strength, 0, [&](vtkCamera* camera) { MoveToEye(camera, left); } };
      const std::vector<int> expected = Draw(eye);
      const std::vector<int> image = Draw({ strength, left ? VTK_STEREO_LEFT : VTK_STEREO_RIGHT });
      EXPECT_LE(FractionOff(image, expected, 4), strength > 0.0 ? 0.01 : 0.002);
    }
  }
}

/// Camera transforms that are not rigid.
std::vector<std::function<void(vtkCamera*)>> ObliqueTransforms()
{
  std::vector<std::function<void(vtkCamera*)>> transforms;
  const auto add = [&](bool viewTransform, int row, int column, double value) {
    transforms.push_back([=](vtkCamera* camera) {
      vtkNew<vtkMatrix4x4> matrix;
      matrix->SetElement(row, column, value);
      vtkNew<vtkTransform> transform;
      transform->SetMatrix(matrix);
      viewTransform ? camera->SetUserViewTransform(transform) : camera->SetUserTransform(transform);
    });
  };
  for (const bool viewTransform : { false, true })
  {
    add(viewTransform, 0, 1, 0.3);
    add(viewTransform, 1, 0, -0.3);
    add(viewTransform, 0, 0, 1.4);
    add(viewTransform, 0, 0, -1.0);
  }
  add(true, 0, 2, 0.1);
  add(true, 2, 2, 1.2);
  return transforms;
}

TEST(OcclusionViews, KeepTransformsOfTheCamera)
{
  for (const bool parallel : { false, true })
  {
    int index = 0;
    for (const auto& transform : ObliqueTransforms())
    {
      SCOPED_TRACE(index++);
      const std::vector<int> plain = Draw({ -1.0, 0, transform, parallel });
      const std::vector<int> image = Draw({ 0.0, 0, transform, parallel });
      EXPECT_LE(LargestDifference(image, plain), 2);
    }
  }
}

TEST(OcclusionViews, OccludeByWorldLengthsUnderTransformsOfTheCamera)
{
  // The occlusion of a floor beside a wall has a closed form in world coordinates.
  for (const char* kernel : { "march", "patch" })
  {
    const auto errorWith = [&](const std::function<void(vtkCamera*)>& transform) {
      OcclusionScene scene;
      scene.AddOcclusionPass(1.0)->SetKernelName(kernel);
      transform(scene.Renderer->GetActiveCamera());
      return RootMeanSquare(ErrorsBeforeAWall(scene));
    };
    const double expected = errorWith([](vtkCamera*) {});
    EXPECT_LT(expected, 0.07);
    for (const auto& transform : ObliqueTransforms())
    {
      EXPECT_NEAR(errorWith(transform), expected, 0.007) << kernel;
    }
  }
}

TEST(RendererMap, DropsTheStateOfDeletedRenderers)
{
  penumbra::RendererMap<std::shared_ptr<int>> states;
  vtkNew<vtkRenderer> kept;
  states.Get(kept) = std::make_shared<int>(1);
  auto deleted = vtkSmartPointer<vtkRenderer>::New();
  vtkRenderer* const address = deleted;
  states.Get(deleted, 2) = std::make_shared<int>(2);
  EXPECT_EQ(states.Find(deleted), nullptr); // the other eye
  const std::weak_ptr<int> state = *states.Find(deleted, 2);
  EXPECT_FALSE(state.expired());
  deleted = nullptr;
  EXPECT_EQ(states.Find(address, 2), nullptr); // also for a new renderer at this address
  EXPECT_EQ(*states.Get(kept), 1);
  EXPECT_TRUE(state.expired());
}

/// Lines as tubes and points as spheres, which a shader draws.
void AddImpostors(OcclusionScene& scene, bool spheres)
{
  const vtkSmartPointer<vtkActor> actor = scene.AddSphere({ 0.3, -1.2, 0.6 }, 0.5);
  vtkProperty* property = actor->GetProperty();
  property->SetColor(0.9, 0.4, 0.3);
  property->SetLineWidth(6.f);
  property->SetPointSize(9.f);
  if (spheres)
  {
    property->SetRepresentationToPoints();
    property->RenderPointsAsSpheresOn();
  }
  else
  {
    property->SetRepresentationToWireframe();
    property->RenderLinesAsTubesOn();
  }
}

TEST(OcclusionViews, KeepSpheresAndTubesOfShaders)
{
  if (vtkVersion::GetVTKMajorVersion() == 9 && vtkVersion::GetVTKMinorVersion() < 4)
  {
    GTEST_SKIP() << "This version of VTK has no shader for tubes on meshes with normals.";
  }
  for (const bool spheres : { true, false })
  {
    for (const int multiSamples : { 0, 4 })
    {
      const auto draw = [&](double strength) {
        OcclusionScene scene(160, 120, multiSamples);
        BuildColoredSpheres(scene);
        AddImpostors(scene, spheres);
        if (strength >= 0.0)
        {
          scene.AddOcclusionPass(0.5)->SetStrength(strength);
          scene.Pass->SetKernelName("march");
        }
        scene.Window->Render();
        return scene.Image();
      };
      SCOPED_TRACE(multiSamples);
      const std::vector<int> plain = draw(-1.0);
      EXPECT_GT(FractionOff(plain, Draw({}), 20), 0.01);
      // A sample of a pixel may belong to another primitive if depths of several are nearly equal.
      const std::vector<int> image = draw(0.0);
      EXPECT_LE(FractionOff(image, plain, 2), multiSamples > 0 ? 0.002 : 0.0);
      EXPECT_LE(LargestDifference(image, plain), multiSamples > 0 ? 40 : 2);
    }
  }
}

TEST(OcclusionViews, DarkenOverlappingViewportsByTheirOwnOcclusion)
{
  const auto draw = [](double strength, bool lower, bool upper) {
    OcclusionScene scene;
    BuildColoredSpheres(scene);
    vtkNew<vtkRenderer> second;
    OcclusionScene other;
    BuildColoredSpheres(other);
    vtkPropCollection* props = other.Renderer->GetViewProps();
    vtkCollectionSimpleIterator position;
    props->InitTraversal(position);
    while (vtkProp* prop = props->GetNextProp(position))
    {
      second->AddViewProp(prop);
    }
    second->SetActiveCamera(other.Renderer->GetActiveCamera());
    second->SetViewport(0.4, 0.3, 1.0, 1.0);
    scene.Renderer->SetViewport(0.0, 0.0, 0.7, 0.8);
    scene.Window->AddRenderer(second);
    if (!upper)
    {
      scene.Window->RemoveRenderer(second);
    }
    for (vtkRenderer* renderer : { scene.Renderer.Get(), second.Get() })
    {
      if (strength >= 0.0 && (renderer == second ? upper : lower))
      {
        auto* pass = Pass::AddTo(renderer);
        pass->SetRadiusUnit(Pass::WORLD);
        pass->SetRadius(0.5);
        pass->SetStrength(strength);
        pass->SetKernelName("march");
      }
    }
    scene.Window->Render();
    return scene.Image();
  };
  EXPECT_LE(LargestDifference(draw(0.0, true, true), draw(-1.0, true, true)), 2);
  // Where only one viewport is, and where the upper one covers the lower one.
  const std::vector<int> both = draw(1.0, true, true);
  const std::vector<int> onlyLower = draw(1.0, true, false);
  int off = 0;
  for (int j = 0; j < 96; ++j)
  {
    for (int i = 0; i < 112; ++i)
    {
      if (i < 64 || j < 36)
      {
        const std::size_t at = 4 * (static_cast<std::size_t>(j) * 160 + i);
        for (int c = 0; c < 3; ++c)
        {
          off += std::abs(both[at + c] - onlyLower[at + c]) > 2;
        }
      }
    }
  }
  EXPECT_EQ(off, 0);
}

}
