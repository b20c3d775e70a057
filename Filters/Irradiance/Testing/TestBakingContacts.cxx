// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares baked values with closed forms at points that lie on other polygons. At the foot of a
// wall, the limit of the occlusion is 1/2 on both sides; in the corner of two walls it is 3/4.
#include "vtkPenumbraIrradianceFilter.h"

#include "SphereOnFloor.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkMath.h"
#include "vtkPoints.h"
#include "vtkTransform.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace penumbra_testing;

namespace
{

/// A mesh of rectangles whose points are not shared with other rectangles, with coordinates that
/// are easy to test, and its place in the world.
class Rectangles
{
public:
  /// Adds a rectangle of n x n squares, whose normal is cross(u, v).
  void Add(glm::dvec3 origin, glm::dvec3 u, glm::dvec3 v, int n)
  {
    const auto first = static_cast<vtkIdType>(this->Points.size());
    for (int j = 0; j <= n; ++j)
    {
      for (int i = 0; i <= n; ++i)
      {
        this->Points.push_back(origin + (u * double(i) + v * double(j)) / double(n));
        this->Normals.push_back(glm::normalize(glm::cross(u, v)));
      }
    }
    for (int j = 0; j < n; ++j)
    {
      for (int i = 0; i < n; ++i)
      {
        const vtkIdType corner = first + j * (n + 1) + i;
        const vtkIdType corners[] = { corner, corner + 1, corner + n + 2, corner + n + 1 };
        this->Cells->InsertNextCell(4, corners);
        this->Centers.push_back(origin + (u * (i + .5) + v * (j + .5)) / double(n));
      }
    }
  }

  /// Adds the walls and the top of a unit box that stands on z = 0.
  void AddBox(int n)
  {
    this->Add({ -.5, -.5, 0.0 }, { 1.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 }, n);
    this->Add({ .5, -.5, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 }, n);
    this->Add({ .5, .5, 0.0 }, { -1.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 }, n);
    this->Add({ -.5, .5, 0.0 }, { 0.0, -1.0, 0.0 }, { 0.0, 0.0, 1.0 }, n);
    this->Add({ -.5, -.5, 1.0 }, { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, n);
  }

  vtkSmartPointer<vtkPolyData> MakeMesh(vtkTransform* place) const
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const glm::dvec3& point : this->Points)
    {
      points->InsertNextPoint(place->TransformPoint(&point.x));
    }
    const auto mesh = vtkSmartPointer<vtkPolyData>::New();
    mesh->SetPoints(points);
    mesh->SetPolys(this->Cells);
    return mesh;
  }

  std::vector<glm::dvec3> Points;
  std::vector<glm::dvec3> Normals; ///< per point
  std::vector<glm::dvec3> Centers; ///< per cell

private:
  vtkNew<vtkCellArray> Cells;
};

/// Places in the world in which rounding puts points on either side of the polygons they touch.
std::vector<vtkSmartPointer<vtkTransform>> MakePlaces()
{
  std::vector<vtkSmartPointer<vtkTransform>> places(3);
  for (auto& place : places)
  {
    place = vtkSmartPointer<vtkTransform>::New();
  }
  places[1]->RotateZ(31.0);
  places[1]->RotateX(74.0);
  places[1]->RotateY(-17.0);
  places[2]->Translate(4e5, -5e6, 120.0);
  places[2]->RotateWXYZ(123.0, .3, -.8, .5);
  places[2]->Scale(250.0, 250.0, 250.0);
  return places;
}

constexpr double Tolerance = .004;

vtkSmartPointer<vtkDataArray> Bake(vtkPolyData* mesh, int quantity, bool onCells = false,
  const std::function<void(vtkPenumbraIrradianceFilter*)>& prepare = {})
{
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(mesh);
  filter->SetQuantity(quantity);
  filter->SetOnCells(onCells);
  filter->SetRadius(VTK_DOUBLE_MAX);
  filter->SetTolerance(Tolerance);
  filter->SetAlbedo(0.0);
  if (prepare)
  {
    prepare(filter);
  }
  filter->Update();
  vtkDataSetAttributes* attributes = GetPolyData(filter)->GetPointData();
  if (onCells)
  {
    attributes = GetPolyData(filter)->GetCellData();
  }
  return attributes->GetArray(attributes->GetNumberOfArrays() - 1);
}

/// Expected occlusion, or a negative number if it is not checked.
using Occlusion = std::function<double(glm::dvec3 point, glm::dvec3 normal)>;

/// Occlusion and irradiance at the points of a shape in one place.
struct BakedShape
{
  vtkSmartPointer<vtkDataArray> Occlusion;
  vtkSmartPointer<vtkDataArray> Irradiance;
};

/// Bakes a shape in all places.
std::vector<BakedShape> BakePlaces(const Rectangles& shape)
{
  std::vector<BakedShape> baked;
  for (const auto& place : MakePlaces())
  {
    const auto mesh = shape.MakeMesh(place);
    baked.push_back({ Bake(mesh, vtkPenumbraIrradianceFilter::AMBIENT_OCCLUSION),
      Bake(mesh, vtkPenumbraIrradianceFilter::IRRADIANCE) });
  }
  return baked;
}

/// Checks the points with an expected value: occlusion and irradiance, in all places.
void CheckPoints(const Rectangles& shape, const std::vector<BakedShape>& baked, int count,
  const Occlusion& expected)
{
  for (const auto& [occlusion, irradiance] : baked)
  {
    int checked = 0;
    for (std::size_t i = 0; i < shape.Points.size(); ++i)
    {
      const glm::dvec3 p = shape.Points[i];
      const double value = expected(p, shape.Normals[i]);
      if (value >= 0.0)
      {
        ++checked;
        EXPECT_NEAR(occlusion->GetComponent(i, 0), value, 5.0 * Tolerance)
          << p.x << " " << p.y << " " << p.z;
        EXPECT_NEAR(irradiance->GetComponent(i, 0) / vtkMath::Pi(), 1.0 - value, 5.0 * Tolerance)
          << p.x << " " << p.y << " " << p.z;
      }
    }
    EXPECT_EQ(checked, count);
  }
}

void CheckPoints(const Rectangles& shape, int count, const Occlusion& expected)
{
  CheckPoints(shape, BakePlaces(shape), count, expected);
}

Rectangles MakeBoxOnFloor(int n)
{
  Rectangles shape;
  shape.AddBox(n);
  shape.Add({ -2.0, -2.0, 0.0 }, { 4.0, 0.0, 0.0 }, { 0.0, 4.0, 0.0 }, 4 * n);
  return shape;
}

double GetOcclusionAtFoot(glm::dvec3 p, glm::dvec3 normal)
{
  return p.z == 0.0 && normal.z == 0.0 ? .5 : -1.0;
}

/// A box of small squares on a floor, baked once for several tests.
struct FineBoxOnFloor
{
  static constexpr int Divisions = 4;
  Rectangles Shape = MakeBoxOnFloor(Divisions);
  std::vector<BakedShape> Baked = BakePlaces(Shape);

  static const FineBoxOnFloor& Get()
  {
    static const FineBoxOnFloor box;
    return box;
  }
};

}

TEST(BakingContacts, FootOfBoxIsHalfOccluded)
{
  CheckPoints(MakeBoxOnFloor(1), 4 * 2, GetOcclusionAtFoot);
  const FineBoxOnFloor& box = FineBoxOnFloor::Get();
  CheckPoints(box.Shape, box.Baked, 4 * (FineBoxOnFloor::Divisions + 1), GetOcclusionAtFoot);
}

TEST(BakingContacts, PointOfFloorUnderWallOfBoxIsMeanOfBothSides)
{
  // Inside of the box the floor is occluded, outside its occlusion is 1/2.
  const auto isOnEdge = [](double x, double y) {
    return std::abs(std::abs(x) - .5) < 1e-9 && std::abs(y) < .4;
  };
  const FineBoxOnFloor& box = FineBoxOnFloor::Get();
  CheckPoints(box.Shape, box.Baked, 4 * 3, [&](glm::dvec3 p, glm::dvec3 normal) {
    const bool isChecked =
      p.z == 0.0 && normal.z == 1.0 && (isOnEdge(p.x, p.y) || isOnEdge(p.y, p.x));
    return isChecked ? .75 : -1.0;
  });
}

TEST(BakingContacts, CornerOfRoomIsThreeQuartersOccluded)
{
  for (const int n : { 1, 3 })
  {
    Rectangles room;
    room.Add({ 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, n);
    room.Add({ 0.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 }, n);
    room.Add({ 0.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 }, { 1.0, 0.0, 0.0 }, n);
    CheckPoints(
      room, 3, [](glm::dvec3 p, glm::dvec3) { return p == glm::dvec3(0.0) ? .75 : -1.0; });
  }
}

TEST(BakingContacts, AcuteAndObtuseEdgesMatchClosedForm)
{
  // The occlusion next to a long wall at the angle a to the floor is (1 + cos a) / 2.
  for (const double degrees : { 10.0, 45.0, 135.0, 170.0 })
  {
    const double angle = vtkMath::RadiansFromDegrees(degrees);
    Rectangles shape;
    shape.Add({ 0.0, -5.0, 0.0 }, { 3.0, 0.0, 0.0 }, { 0.0, 10.0, 0.0 }, 3);
    shape.Add({ 0.0, -5.0, 0.0 }, { 0.0, 10.0, 0.0 },
      { 3.0 * std::cos(angle), 0.0, 3.0 * std::sin(angle) }, 3);
    CheckPoints(shape, 2 * 2, [&](glm::dvec3 p, glm::dvec3) {
      return p.x == 0.0 && p.z == 0.0 && std::abs(p.y) < 4.0 ? .5 * (1.0 + std::cos(angle)) : -1.0;
    });
  }
}

TEST(BakingContacts, DirectLightReachesFootOfBox)
{
  const Rectangles shape = MakeBoxOnFloor(6);
  const glm::dvec3 light = glm::normalize(glm::dvec3(2.0, .7, 1.5));
  for (const auto& place : MakePlaces())
  {
    for (const double angle : { 0.0, 2.0 })
    {
      const auto values = Bake(shape.MakeMesh(place), vtkPenumbraIrradianceFilter::DIRECT_LIGHT,
        false, [&](vtkPenumbraIrradianceFilter* filter) {
          const double* toward = place->TransformVector(&light.x);
          filter->AddLight(toward[0], toward[1], toward[2], 0.0);
          filter->SetLightAngle(angle);
        });
      for (std::size_t i = 0; i < shape.Points.size(); ++i)
      {
        const glm::dvec3 normal = shape.Normals[i];
        if (shape.Points[i].z == 0.0 && normal.z == 0.0)
        {
          EXPECT_NEAR(values->GetComponent(i, 0), std::max(glm::dot(normal, light), 0.0), 1e-3);
        }
      }
    }
  }
}

TEST(BakingContacts, CellsWhoseCentersAreUnderWallsMatchClosedForm)
{
  // A thin wall stands on the centers of cells: 1/2 on both sides. Those under the wall of a closed
  // box are occluded on one side.
  for (const bool isBox : { false, true })
  {
    Rectangles shape;
    shape.Add({ -3.0, -3.0, 0.0 }, { 6.0, 0.0, 0.0 }, { 0.0, 6.0, 0.0 }, 3);
    shape.Add({ 0.0, -9.0, 0.0 }, { 0.0, 18.0, 0.0 }, { 0.0, 0.0, 9.0 }, 1);
    if (isBox)
    {
      shape.Add({ 0.0, -9.0, 9.0 }, { -9.0, 0.0, 0.0 }, { 0.0, 18.0, 0.0 }, 1);
      shape.Add({ -9.0, -9.0, 0.0 }, { 0.0, 18.0, 0.0 }, { 0.0, 0.0, 9.0 }, 1);
      shape.Add({ -9.0, -9.0, 0.0 }, { 9.0, 0.0, 0.0 }, { 0.0, 0.0, 9.0 }, 1);
      shape.Add({ -9.0, 9.0, 0.0 }, { 9.0, 0.0, 0.0 }, { 0.0, 0.0, 9.0 }, 1);
    }
    for (const auto& place : MakePlaces())
    {
      const auto values =
        Bake(shape.MakeMesh(place), vtkPenumbraIrradianceFilter::AMBIENT_OCCLUSION, true);
      for (int j = 0; j < 3; ++j)
      {
        EXPECT_NEAR(values->GetComponent(3 * j + 1, 0), isBox ? .75 : .5, 5.0 * Tolerance) << j;
      }
    }
  }
}

TEST(BakingContacts, SurroundingsTouchPointsOfInput)
{
  Rectangles box;
  box.AddBox(4);
  Rectangles floor;
  floor.Add({ -2.0, -2.0, 0.0 }, { 4.0, 0.0, 0.0 }, { 0.0, 4.0, 0.0 }, 1);
  for (const auto& place : MakePlaces())
  {
    const auto surroundings = floor.MakeMesh(place);
    const auto values = Bake(box.MakeMesh(place), vtkPenumbraIrradianceFilter::AMBIENT_OCCLUSION,
      false, [&](vtkPenumbraIrradianceFilter* filter) { filter->SetInputData(1, surroundings); });
    for (std::size_t i = 0; i < box.Points.size(); ++i)
    {
      if (box.Points[i].z == 0.0)
      {
        EXPECT_NEAR(values->GetComponent(i, 0), .5, 5.0 * Tolerance);
      }
    }
  }
}

TEST(BakingContacts, PointsCountOnceByMethod)
{
  const Rectangles shape = MakeBoxOnFloor(4);
  for (const bool onCells : { false, true })
  {
    const std::string kind = onCells ? "Cells/" : "Points/";
    for (const int quantity : { vtkPenumbraIrradianceFilter::AMBIENT_OCCLUSION,
           vtkPenumbraIrradianceFilter::IRRADIANCE, vtkPenumbraIrradianceFilter::DIRECT_LIGHT })
    {
      vtkNew<vtkPenumbraIrradianceFilter> filter;
      filter->SetInputData(shape.MakeMesh(vtkNew<vtkTransform>()));
      filter->SetOnCells(onCells);
      filter->SetQuantity(quantity);
      filter->AddLight(1.0, 2.0, 3.0, 0.0);
      filter->SetTolerance(.03);
      filter->Update();
      double sum = 0.0;
      for (const char* method : { "Interpolated", "Denoised", "BruteForce", "Unused", "NotFinite" })
      {
        sum += GetStatistic(filter, (kind + method).c_str());
      }
      EXPECT_EQ(sum, GetStatistic(filter, (kind + "Total").c_str())) << quantity;
    }
  }
}
