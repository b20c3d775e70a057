// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Random scenes of boxes and thin plates with coarse and fine polygons, against rays in double
// precision that are intersected with every face. No value may come from a parallel, hidden or
// opposite surface.
// The environment variable PENUMBRA_SEED is added to the seeds.
#include "vtkPenumbraIrradianceFilter.h"

#include "BruteForce/PathTracer.h"
#include "SphereOnFloor.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkMath.h"
#include "vtkPoints.h"
#include "vtkTransform.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <random>
#include <vector>

using namespace penumbra_testing;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Mesh of quadrilaterals; the points of a face are not shared with other faces.
class RandomScene
{
public:
  explicit RandomScene(unsigned int seed)
    : Random(seed)
  {
  }

  double Draw(double low, double high)
  {
    return low + (high - low) * (this->Random() / 4294967296.0);
  }
  int DrawInt(int low, int high)
  {
    return low + static_cast<int>(this->Random() % (high - low + 1));
  }

  /// Adds a face of n x n quadrilaterals with the normal cross(u, v).
  void AddFace(glm::dvec3 origin, glm::dvec3 u, glm::dvec3 v, int n)
  {
    const auto first = this->Points->GetNumberOfPoints();
    penumbra::Panel panel;
    this->Place->TransformPoint(&origin.x, &panel.Corner.x);
    this->Place->TransformVector(&u.x, &panel.Side.x);
    this->Place->TransformVector(&v.x, &panel.Other.x);
    this->Panels.push_back(panel);
    for (int k = 0; k < (n + 1) * (n + 1); ++k)
    {
      const glm::dvec3 at =
        origin + (u * double(k % (n + 1)) + v * double(k / (n + 1))) / double(n);
      double x[3];
      this->Place->TransformPoint(&at.x, x);
      this->Points->InsertNextPoint(x);
    }
    for (int k = 0; k < n * n; ++k)
    {
      const vtkIdType corner = first + k / n * (n + 1) + k % n;
      const vtkIdType corners[] = { corner, corner + 1, corner + n + 2, corner + n + 1 };
      this->Cells->InsertNextCell(4, corners);
    }
  }

  /// Adds the faces of a box with subdivisions of its own.
  void AddBox(glm::dvec3 low, glm::dvec3 size)
  {
    const glm::dvec3 x(size.x, 0.0, 0.0);
    const glm::dvec3 y(0.0, size.y, 0.0);
    const glm::dvec3 z(0.0, 0.0, size.z);
    const int n = this->DrawInt(0, 4) == 0 ? this->DrawInt(4, 9) : this->DrawInt(1, 3);
    this->AddFace(low, y, x, n);
    this->AddFace(low, x, z, n);
    this->AddFace(low, z, y, n);
    this->AddFace(low + z, x, y, n);
    this->AddFace(low + y, z, x, n);
    this->AddFace(low + x, y, z, n);
  }

  void AddBoxes(int count)
  {
    for (int i = 0; i < count; ++i)
    {
      const glm::dvec3 low(this->Draw(-2.0, 2.0), this->Draw(-2.0, 2.0), this->Draw(0.0, 2.0));
      this->AddBox(
        low, { this->Draw(.2, 1.5), this->Draw(.2, 1.5), std::exp(this->Draw(std::log(.02), .3)) });
    }
  }

  /// Adds parallel plates that face the same or opposite sides at small distances.
  void AddPlates(int count)
  {
    double height = 0.0;
    for (int i = 0; i < count; ++i)
    {
      const glm::dvec3 origin(this->Draw(-1.0, 0.0), this->Draw(-1.0, 0.0), height);
      const glm::dvec3 u(this->Draw(1.0, 2.0), 0.0, 0.0);
      const glm::dvec3 v(0.0, this->Draw(1.0, 2.0), 0.0);
      const bool isUp = this->DrawInt(0, 2) > 0;
      this->AddFace(origin, isUp ? u : v, isUp ? v : u, this->DrawInt(1, 6));
      height += std::exp(this->Draw(std::log(.005), 0.0));
    }
  }

  /// Adds boxes on top of each other.
  void AddStack(int count)
  {
    double height = 0.0;
    for (int i = 0; i < count; ++i)
    {
      const double thickness = std::exp(this->Draw(std::log(.05), 0.0));
      this->AddBox({ this->Draw(-1.0, 0.0), this->Draw(-1.0, 0.0), height },
        { this->Draw(1.0, 1.7), this->Draw(1.0, 1.7), thickness });
      height += thickness;
    }
  }

  void Rotate()
  {
    this->Place->RotateWXYZ(
      this->Draw(0.0, 360.0), this->Draw(-1.0, 1.0), this->Draw(-1.0, 1.0), this->Draw(-1.0, 1.0));
  }

  vtkSmartPointer<vtkPolyData> MakeMesh() const
  {
    const auto mesh = vtkSmartPointer<vtkPolyData>::New();
    mesh->SetPoints(this->Points);
    mesh->SetPolys(this->Cells);
    return mesh;
  }

  std::vector<penumbra::Panel> Panels; ///< the faces

private:
  std::mt19937 Random;
  vtkNew<vtkTransform> Place;
  vtkNew<vtkPoints> Points;
  vtkNew<vtkCellArray> Cells;
};

/// Returns the occlusion of all cells.
std::vector<double> ComputeReference(
  const std::vector<penumbra::Panel>& panels, vtkPolyData* mesh, double radius)
{
  std::vector<double> values;
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    glm::dvec3 x[4];
    for (int k = 0; k < 4; ++k)
    {
      mesh->GetPoint(mesh->GetCell(i)->GetPointId(k), &x[k].x);
    }
    const glm::dvec3 normal = glm::normalize(glm::cross(x[1] - x[0], x[3] - x[0]));
    const glm::dvec3 above = .25 * (x[0] + x[1] + x[2] + x[3]) + 1e-5 * normal;
    values.push_back(penumbra::ComputePanelOcclusion(panels, above, normal, radius, 32));
  }
  return values;
}

constexpr double Tolerance = .01;

/// Squared errors of the cells of several scenes.
struct Errors
{
  double Squares = 0.0;
  double Count = 0.0;

  void Add(vtkPolyData* mesh, double radius, int quantity, const std::vector<double>& reference,
    const char* what, unsigned int seed)
  {
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputData(mesh);
    filter->SetOnCells(true);
    filter->SetQuantity(quantity);
    filter->SetRadius(std::isinf(radius) ? VTK_DOUBLE_MAX : radius);
    filter->SetTolerance(Tolerance);
    filter->SetAlbedo(0.0);
    filter->Update();
    const bool isOcclusion = quantity == vtkPenumbraIrradianceFilter::AMBIENT_OCCLUSION;
    vtkDataArray* values =
      GetPolyData(filter)->GetCellData()->GetArray(isOcclusion ? "AmbientOcclusion" : "Irradiance");
    ASSERT_NE(values, nullptr);
    for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
    {
      const double value = values->GetComponent(i, 0);
      const double error = (isOcclusion ? value : 1.0 - value / vtkMath::Pi()) - reference[i];
      this->Squares += error * error;
      this->Count += 1.0;
      EXPECT_LE(std::abs(error), 5.0 * Tolerance)
        << what << " seed " << seed << " cell " << i << " of " << values->GetNumberOfTuples()
        << " radius " << radius << ": " << value << ", reference " << reference[i];
    }
  }
};

using SceneFunction = std::function<void(RandomScene&)>;

void CheckScenes(const char* what, unsigned int count, const SceneFunction& fill)
{
  const char* offset = std::getenv("PENUMBRA_SEED");
  Errors errors;
  for (unsigned int i = 0; i < count; ++i)
  {
    const unsigned int seed = i + (offset ? static_cast<unsigned int>(std::atoi(offset)) : 0u);
    RandomScene scene(seed);
    if (i % 2 == 1)
    {
      scene.Rotate();
    }
    fill(scene);
    const auto mesh = scene.MakeMesh();
    const double radius = i % 3 == 2 ? 1.0 : Infinity;
    const std::vector<double> reference = ComputeReference(scene.Panels, mesh, radius);
    errors.Add(mesh, radius, vtkPenumbraIrradianceFilter::AMBIENT_OCCLUSION, reference, what, seed);
    if (std::isinf(radius))
    {
      errors.Add(mesh, radius, vtkPenumbraIrradianceFilter::IRRADIANCE, reference, what, seed);
    }
  }
  EXPECT_LE(std::sqrt(errors.Squares / errors.Count), Tolerance) << what;
}

}

TEST(BakingScenes, CellsOfBoxesMatchBruteForce)
{
  CheckScenes("boxes", 8, [](RandomScene& scene) { scene.AddBoxes(scene.DrawInt(2, 15)); });
}

TEST(BakingScenes, CellsOfParallelPlatesMatchBruteForce)
{
  CheckScenes("plates", 8, [](RandomScene& scene) { scene.AddPlates(scene.DrawInt(2, 8)); });
}

TEST(BakingScenes, CellsOfStackedBoxesMatchBruteForce)
{
  CheckScenes("stack", 6, [](RandomScene& scene) { scene.AddStack(scene.DrawInt(2, 6)); });
}

TEST(BakingScenes, CoarsePolygonsBesideFineOnesMatchBruteForce)
{
  // The mean distance of points is that of the fine floor.
  CheckScenes("mixed", 4, [](RandomScene& scene) {
    scene.AddPlates(4);
    scene.AddBoxes(2);
    scene.AddFace({ 3.0, -1.0, 0.0 }, { 2.0, 0.0, 0.0 }, { 0.0, 2.0, 0.0 }, 20);
  });
}

TEST(BakingScenes, LowPlateAboveFineFloorMatchesBruteForce)
{
  // The plate is lower than most rays of a record that is beside it.
  CheckScenes("floor", 3, [](RandomScene& scene) {
    scene.AddFace({ -3.0, -3.0, 0.0 }, { 6.0, 0.0, 0.0 }, { 0.0, 6.0, 0.0 }, 30);
    scene.AddFace({ scene.Draw(-2.0, -1.0), scene.Draw(-2.0, -1.0), scene.Draw(.02, .2) },
      { scene.Draw(.3, 2.0), 0.0, 0.0 }, { 0.0, scene.Draw(.3, 2.0), 0.0 }, 1);
    scene.AddBox({ 1.0, 1.0, 0.0 }, { scene.Draw(.2, 1.0), 1.0, scene.Draw(.02, .4) });
  });
}
