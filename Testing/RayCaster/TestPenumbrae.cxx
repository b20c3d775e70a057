// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Penumbrae of lights with a size on a floor, against closed forms.
#include "ClosedForms/VisibleLight.h"
#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkDiskSource.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolygon.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

using namespace penumbra;

namespace
{

constexpr int Size = 160;
constexpr double Pi = 3.14159265358979323846;
constexpr double LightHeight = 4.0;
constexpr double LightRadius = 0.5;
constexpr double OccluderHeight = 2.0;
constexpr double CameraHeight = 10.0;
constexpr double Tolerance = 0.006;
constexpr double MaximumRmse = 0.005;

/// A floor, z = 0, under a light at height 4 and an occluder at height 2, seen from above through the occluder.
struct Scene
{
  vtkSmartPointer<vtkRenderer> Renderer = NewRenderer();
  vtkNew<vtkLight> Light;
  glm::dvec2 Center{ 0.0 }; ///< of the image, on the floor
  double Width = 2.0;       ///< of the image, on the floor

  explicit Scene(vtkPolyData* occluder)
  {
    vtkNew<vtkPlaneSource> floor;
    floor->SetOrigin(-20.0, -20.0, 0.0);
    floor->SetPoint1(20.0, -20.0, 0.0);
    floor->SetPoint2(-20.0, 20.0, 0.0);
    floor->Update();
    AddMesh(this->Renderer, floor->GetOutput(), true);
    // The camera looks through the culled side of the occluder, which casts a shadow nevertheless.
    vtkProperty* property = AddMesh(this->Renderer, occluder, true)->GetProperty();
    double normal[3];
    vtkPolygon::ComputeNormal(occluder->GetCell(0)->GetPoints(), normal);
    normal[2] > 0.0 ? property->FrontfaceCullingOn() : property->BackfaceCullingOn();
    this->Renderer->RemoveAllLights();
    this->Light->SetLightTypeToSceneLight();
    this->Light->SetPosition(0.0, 0.0, LightHeight);
    this->Light->SetFocalPoint(0.0, 0.0, 0.0);
    this->Light->SetPositional(true);
    this->Light->SetConeAngle(180.0);
    this->Light->SetExponent(0.0);
    this->Renderer->AddLight(this->Light);
  }

  vtkSmartPointer<vtkPenumbraRayCaster> Cast(
    const std::function<void(vtkPenumbraRayCaster*)>& choose = {}) const
  {
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(this->Center.x, this->Center.y, CameraHeight);
    camera->SetFocalPoint(this->Center.x, this->Center.y, 0.0);
    camera->SetViewUp(0.0, 1.0, 0.0);
    camera->SetViewAngle(2.0 * std::atan(0.5 * this->Width / CameraHeight) * 180.0 / Pi);
    camera->SetClippingRange(0.01, 1000.0);
    auto caster = vtkSmartPointer<vtkPenumbraRayCaster>::New();
    caster->SetRenderer(this->Renderer);
    caster->SetResolution(Size, Size);
    caster->ShadowsOn();
    caster->SetLightRadius(LightRadius);
    if (choose)
    {
      choose(caster);
    }
    caster->Update();
    return caster;
  }

  /// Point of the floor at image point (x, y).
  glm::dvec2 At(double x, double y) const
  {
    return this->Center + this->Width * (glm::dvec2(x, y) / static_cast<double>(Size) - 0.5);
  }
};

vtkSmartPointer<vtkPolyData> MakeHalfPlane()
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-100.0, -100.0, OccluderHeight);
  plane->SetPoint1(0.0, -100.0, OccluderHeight);
  plane->SetPoint2(-100.0, 100.0, OccluderHeight);
  plane->Update();
  return plane->GetOutput();
}

/// Rows of slats, whose shadows are two pixels wide and end between the corners of pixels.
constexpr double SlatWidth = 0.0125;
constexpr double SlatLength = 0.1;
const glm::dvec2 SlatAxis(std::cos(1.3), std::sin(1.3));
const glm::dvec2 AcrossSlats(-SlatAxis.y, SlatAxis.x);

vtkSmartPointer<vtkPolyData> MakeFence()
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> slats;
  for (int i = 0; i < 90 * 10; ++i)
  {
    const glm::dvec2 first =
      (i % 90 - 45) * 2.0 * SlatWidth * AcrossSlats + (i / 90 - 5) * 2.0 * SlatLength * SlatAxis;
    slats->InsertNextCell(4);
    for (const glm::dvec2 corner : { glm::dvec2(0.0, 0.0), glm::dvec2(SlatLength, 0.0),
           glm::dvec2(SlatLength, SlatWidth), glm::dvec2(0.0, SlatWidth) })
    {
      const glm::dvec2 p = first + corner.x * SlatAxis + corner.y * AcrossSlats;
      slats->InsertCellPoint(points->InsertNextPoint(p.x, p.y, OccluderHeight));
    }
  }
  vtkNew<vtkPolyData> fence;
  fence->SetPoints(points);
  fence->SetPolys(slats);
  return fence;
}

/// Returns true if a point of the floor is in the shadow that the fence casts of a point light.
bool IsBehindFence(glm::dvec2 p)
{
  const glm::dvec2 q = p * (LightHeight - OccluderHeight) / LightHeight;
  const double along = dot(q, SlatAxis) / (2.0 * SlatLength);
  const double across = dot(q, AcrossSlats) / (2.0 * SlatWidth);
  return along - std::floor(along) < 0.5 && across - std::floor(across) < 0.5;
}

constexpr double DiskRadius = 0.4;

vtkSmartPointer<vtkPolyData> MakeDisk()
{
  vtkNew<vtkDiskSource> disk;
  disk->SetInnerRadius(0.0);
  disk->SetOuterRadius(DiskRadius);
  disk->SetCircumferentialResolution(256);
  disk->Update();
  vtkSmartPointer<vtkPolyData> data = disk->GetOutput();
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    double x[3];
    data->GetPoint(i, x);
    data->GetPoints()->SetPoint(i, x[0], x[1], OccluderHeight);
  }
  return data;
}

double FractionOfSphereBeyondHalfPlane(glm::dvec2 p)
{
  const glm::dvec3 toLight = glm::dvec3(0.0, 0.0, LightHeight) - glm::dvec3(p, 0.0);
  const glm::dvec3 normal = glm::normalize(glm::dvec3(OccluderHeight, 0.0, p.x));
  const double radius = std::asin(LightRadius / glm::length(toLight));
  return ConeInHemisphere(radius, std::acos(glm::dot(normal, glm::normalize(toLight))));
}

double FractionOfDiskBeyondHalfPlane(glm::dvec2 p)
{
  // The shadow of the edge on the plane of the light.
  return DiskBeyondLine((p.x - p.x * LightHeight / OccluderHeight) / LightRadius);
}

double FractionOfDiskBeyondDisk(glm::dvec2 p)
{
  const double scale = LightHeight / OccluderHeight;
  const glm::dvec2 center = p * (1.0 - scale);
  return 1.0 -
    CommonAreaOfCircles(LightRadius, scale * DiskRadius, glm::length(center)) /
    (Pi * LightRadius * LightRadius);
}

/// Fraction of a sphere in front of a disk, by 128 x 128 strata of the cone of directions.
double FractionOfSphereBeyondDisk(glm::dvec2 p)
{
  const glm::dvec3 toLight = glm::dvec3(0.0, 0.0, LightHeight) - glm::dvec3(p, 0.0);
  const glm::dvec3 axis = glm::normalize(toLight);
  const glm::dvec3 side = glm::normalize(glm::cross(axis, glm::dvec3(0.3, 0.9, 0.1)));
  const glm::dvec3 up = glm::cross(axis, side);
  const double sine = LightRadius / glm::length(toLight);
  const double cap = 1.0 - std::sqrt(1.0 - sine * sine);
  constexpr int Strata = 128;
  int visible = 0;
  for (int i = 0; i < Strata * Strata; ++i)
  {
    const double cosine = 1.0 - cap * (i % Strata + 0.5) / Strata;
    const double angle = 2.0 * Pi * (i / Strata + 0.5) / Strata;
    const glm::dvec3 direction = cosine * axis +
      std::sqrt(1.0 - cosine * cosine) * (std::cos(angle) * side + std::sin(angle) * up);
    const glm::dvec2 hit = p + OccluderHeight / direction.z * glm::dvec2(direction);
    visible += glm::length(hit) > DiskRadius ? 1 : 0;
  }
  return visible / static_cast<double>(Strata * Strata);
}

using Fraction = double (*)(glm::dvec2);

struct Case
{
  const char* Name;
  bool IsDiskLight;
  bool IsDiskOccluder;
  Fraction Exact;
  int Stride; ///< between compared pixels
  double MaximumRays;
};

std::ostream& operator<<(std::ostream& os, const Case& test)
{
  return os << test.Name;
}

class Penumbra : public testing::TestWithParam<Case>
{
protected:
  Scene Make() const
  {
    Scene scene(GetParam().IsDiskOccluder ? MakeDisk() : MakeHalfPlane());
    scene.Light->SetConeAngle(GetParam().IsDiskLight ? 85.0 : 180.0);
    return scene;
  }
};

double GetShadowRays(vtkPenumbraRayCaster* caster)
{
  return caster->GetStatistics()->GetArray("Rays/Shadow")->GetComponent(0, 0);
}

}

TEST_P(Penumbra, MatchesClosedFormAtFewRays)
{
  Scene scene = this->Make();
  const auto choose = [](vtkPenumbraRayCaster* caster) {
    caster->SetTolerance(Tolerance);
    caster->SetLightTolerance(Tolerance);
  };
  const vtkSmartPointer<vtkPenumbraRayCaster> caster = scene.Cast(choose);
  vtkDataArray* colors = caster->GetOutput()->GetPointData()->GetArray("Color");
  vtkDataArray* errors = caster->GetOutput()->GetPointData()->GetArray("EstimatedError");
  double squares = 0.0;
  double elsewhereSquares = 0.0;
  double estimated = 0.0;
  int pixels = 0;
  int others = 0;
  const int stride = GetParam().Stride;
  for (int y = 0; y < Size; y += stride)
  {
    for (int x = 0; x < Size; x += stride)
    {
      double exact = 0.0;
      double low = 1.0;
      double high = 0.0;
      for (int i = 0; i < 4; ++i)
      {
        const glm::dvec2 p = scene.At(x + 0.25 + 0.5 * (i % 2), y + 0.25 + 0.5 * (i / 2));
        const double fraction = GetParam().Exact(p);
        low = std::min(low, fraction);
        high = std::max(high, fraction);
        exact += 0.25 * fraction * LightHeight / std::sqrt(LightHeight * LightHeight + dot(p, p));
      }
      const vtkIdType id = y * Size + x;
      const double square = std::pow(colors->GetComponent(id, 0) - exact, 2.0);
      const bool isPenumbra = high > 0.0 && low < 1.0;
      (isPenumbra ? squares : elsewhereSquares) += square;
      estimated += isPenumbra ? std::pow(errors->GetComponent(id, 0), 2.0) : 0.0;
      ++(isPenumbra ? pixels : others);
    }
  }
  const double rmse = std::sqrt(squares / pixels);
  const double estimate = std::sqrt(estimated / pixels);
  EXPECT_LE(rmse, MaximumRmse);
  EXPECT_LE(rmse, 1.2 * estimate);
  EXPECT_LE(estimate, 1.2 * Tolerance);
  EXPECT_LE(std::sqrt(elsewhereSquares / others), 0.002);

  // Pixels that are far from the penumbra.
  Scene far = this->Make();
  far.Center = GetParam().IsDiskOccluder ? glm::dvec2(0.0, 5.0) : glm::dvec2(5.0, 0.0);
  const double elsewhere = GetShadowRays(far.Cast(choose)) / (Size * Size);
  const double share = pixels / static_cast<double>(pixels + others);
  const double perPixel = GetShadowRays(caster) / (Size * Size);
  const double rays = (perPixel - elsewhere * (1.0 - share)) / share;
  EXPECT_LE(rays, GetParam().MaximumRays);
  EXPECT_LE(elsewhere, 1.1);
}

INSTANTIATE_TEST_SUITE_P(Cases, Penumbra,
  testing::Values(Case{ "SphereHalfPlane", false, false, FractionOfSphereBeyondHalfPlane, 1, 14.0 },
    Case{ "DiskHalfPlane", true, false, FractionOfDiskBeyondHalfPlane, 1, 14.0 },
    Case{ "DiskDisk", true, true, FractionOfDiskBeyondDisk, 1, 16.0 },
    Case{ "SphereDisk", false, true, FractionOfSphereBeyondDisk, 9, 16.0 }),
  [](const auto& test) { return std::string(test.param.Name); });

TEST(Penumbrae, AreMonotoneAcrossAHalfPlane)
{
  Scene scene(MakeHalfPlane());
  const vtkSmartPointer<vtkPenumbraRayCaster> caster = scene.Cast();
  vtkDataArray* colors = caster->GetOutput()->GetPointData()->GetArray("Color");
  double before = 0.0;
  for (int x = 0; x < Size; ++x)
  {
    double mean = 0.0;
    for (int y = 0; y < Size; ++y)
    {
      const double distance = glm::length(glm::dvec3(scene.At(x + 0.5, y + 0.5), LightHeight));
      mean += colors->GetComponent(y * Size + x, 0) * distance / LightHeight / Size;
    }
    EXPECT_GE(mean, before - 1e-4) << x;
    before = mean;
  }
  EXPECT_GT(before, 0.99);
}

TEST(Penumbrae, OfSmallLightsCoverTheEndsOfNarrowShadows)
{
  const Scene scene(MakeFence());
  const vtkSmartPointer<vtkPenumbraRayCaster> caster =
    scene.Cast([](vtkPenumbraRayCaster* narrow) { narrow->SetLightRadius(0.001); });
  double largest = 0.0;
  double squares = 0.0;
  for (int i = 0; i < Size * Size; ++i)
  {
    constexpr int Side = 24;
    double exact = 0.0;
    for (int k = 0; k < Side * Side; ++k)
    {
      const glm::dvec2 p =
        scene.At(i % Size + (k % Side + 0.5) / Side, i / Size + (k / Side + 0.5) / Side);
      exact += IsBehindFence(p)
        ? 0.0
        : LightHeight / std::sqrt(LightHeight * LightHeight + dot(p, p)) / (Side * Side);
    }
    const float color = caster->GetOutput()->GetScalarComponentAsFloat(i % Size, i / Size, 0, 0);
    largest = std::max(largest, std::abs(color - exact));
    squares += std::pow(color - exact, 2.0) / (Size * Size);
  }
  EXPECT_LE(largest, 0.1);
  EXPECT_LE(std::sqrt(squares), 0.01);
}

TEST(Penumbrae, DependNeitherOnThreadsNorOnTheRequestedExtent)
{
  Scene scene(MakeDisk());
  const auto get = [](vtkPenumbraRayCaster* caster, int x, int y) {
    return caster->GetOutput()->GetScalarComponentAsFloat(x, y, 0, 0);
  };
  const auto one = scene.Cast([](vtkPenumbraRayCaster* caster) { caster->SetNumberOfThreads(1); });
  const auto three =
    scene.Cast([](vtkPenumbraRayCaster* caster) { caster->SetNumberOfThreads(3); });
  const auto part = scene.Cast([](vtkPenumbraRayCaster* caster) {
    caster->UpdateInformation();
    const int extent[6] = { 70, 101, 60, 99, 0, 0 };
    caster->UpdateExtent(extent);
  });
  int differences = 0;
  for (int y = 0; y < Size; ++y)
  {
    for (int x = 0; x < Size; ++x)
    {
      differences += get(one, x, y) != get(three, x, y) ? 1 : 0;
      const bool isInside = x >= 70 && x <= 101 && y >= 60 && y <= 99;
      differences += isInside && get(one, x, y) != get(part, x, y) ? 1 : 0;
    }
  }
  EXPECT_EQ(differences, 0);
}

TEST(Penumbrae, OfSingleLightsReplaceThoseOfAll)
{
  Scene scene(MakeHalfPlane());
  const auto sum = [](vtkPenumbraRayCaster* caster) {
    int penumbra = 0;
    for (int x = 0; x < Size; ++x)
    {
      const float color = caster->GetOutput()->GetScalarComponentAsFloat(x, Size / 2, 0, 0);
      penumbra += color > 0.05f && color < 0.9f ? 1 : 0;
    }
    return penumbra;
  };
  const int all = sum(scene.Cast());
  const int wide = sum(
    scene.Cast([&](vtkPenumbraRayCaster* caster) { caster->SetLightRadius(scene.Light, 0.8); }));
  const int none = sum(
    scene.Cast([&](vtkPenumbraRayCaster* caster) { caster->SetLightRadius(scene.Light, 0.0); }));
  EXPECT_LE(none, 1);
  EXPECT_GT(all, 40);
  EXPECT_NEAR(wide, 1.6 * all, 8.0);
}

TEST(Penumbrae, RejectInvalidSizes)
{
  Scene scene(MakeHalfPlane());
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double size : { -1.0, std::nan(""), infinity })
  {
    for (const bool single : { false, true })
    {
      const auto caster = scene.Cast([&](vtkPenumbraRayCaster* target) {
        vtkObject::GlobalWarningDisplayOff();
        single ? target->SetLightRadius(scene.Light, size) : target->SetLightRadius(size);
      });
      EXPECT_TRUE(std::isnan(caster->GetEstimatedError())) << size;
    }
  }
  for (const double angle : { -1.0, std::nan(""), 180.5 })
  {
    const auto caster =
      scene.Cast([&](vtkPenumbraRayCaster* target) { target->SetLightAngle(angle); });
    EXPECT_TRUE(std::isnan(caster->GetEstimatedError())) << angle;
  }
  vtkObject::GlobalWarningDisplayOn();
}

namespace
{

/// Returns the warnings of a caster with a light of radius 0.5 at the height `height` over the floor.
std::vector<std::string> WarnAtHeight(double height, bool spot, bool shadows, float& center)
{
  Scene scene(MakeHalfPlane());
  scene.Light->SetPosition(0.3, 0.0, height);
  scene.Light->SetFocalPoint(0.3, 0.0, height - 1.0);
  scene.Light->SetConeAngle(spot ? 60.0 : 180.0);
  std::vector<std::string> warnings;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&warnings);
  observer->SetCallback([](vtkObject*, unsigned long, void* client, void* text) {
    const std::string warning = static_cast<const char*>(text);
    if (warning.find("contains") != std::string::npos) // not those of the tolerance
    {
      static_cast<std::vector<std::string>*>(client)->push_back(warning);
    }
  });
  const auto caster = scene.Cast([&](vtkPenumbraRayCaster* target) {
    target->SetShadows(shadows);
    target->AddObserver(vtkCommand::WarningEvent, observer);
  });
  caster->Modified();
  caster->Update(); // warns only once
  // The camera looks at the floor below the light, 0.3 from the center of the image.
  center = caster->GetOutput()->GetScalarComponentAsFloat(Size / 2 + 24, Size / 2, 0, 0);
  return warnings;
}

}

TEST(Penumbrae, OfLightsThatContainSurfacesWarnOnce)
{
  float color = 0.f;
  // Through the floor: the points inside the light are fully lit.
  std::vector<std::string> warnings = WarnAtHeight(0.3, false, true, color);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("The light at (0.3, 0, 0.3) with a radius of 0.5 contains or touches"),
    std::string::npos)
    << warnings[0];
  EXPECT_NEAR(color, 1.f, 0.01f);
  // Through the edge of the occluder
  EXPECT_EQ(WarnAtHeight(2.3, false, true, color).size(), 1u);
  // Next to them, without shadows, and disks, which have no inside
  EXPECT_TRUE(WarnAtHeight(4.0, false, true, color).empty());
  EXPECT_TRUE(WarnAtHeight(0.51, false, true, color).empty());
  EXPECT_TRUE(WarnAtHeight(0.3, false, false, color).empty());
  EXPECT_TRUE(WarnAtHeight(0.3, true, true, color).empty());
}
