// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Adversaries.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace penumbra
{
namespace
{

constexpr double Pi = glm::pi<double>();

/// Collects the cells of one mesh.
class Builder
{
public:
  Builder()
  {
    this->Mesh->SetPoints(vtkNew<vtkPoints>());
    this->Mesh->GetPoints()->SetDataTypeToDouble();
    this->Mesh->SetPolys(vtkNew<vtkCellArray>());
    this->Mesh->SetLines(vtkNew<vtkCellArray>());
  }

  vtkIdType Point(glm::dvec3 p) { return this->Mesh->GetPoints()->InsertNextPoint(p.x, p.y, p.z); }
  void Polygon(const std::vector<vtkIdType>& corners)
  {
    this->Mesh->GetPolys()->InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.data());
  }
  void Triangle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c)
  {
    this->Polygon({ this->Point(a), this->Point(b), this->Point(c) });
  }
  void Line(const std::vector<glm::dvec3>& points)
  {
    vtkCellArray* lines = this->Mesh->GetLines();
    lines->InsertNextCell(static_cast<int>(points.size()));
    for (const glm::dvec3& p : points)
    {
      lines->InsertCellPoint(this->Point(p));
    }
  }

  /// Returns a point uniform in [-size, size]^3, identical on every platform.
  glm::dvec3 Random(double size)
  {
    const auto next = [&] { return size * (this->Generator() * 0x1p-31 - 1.0); };
    const double x = next();
    const double y = next();
    return { x, y, next() };
  }

  vtkSmartPointer<vtkPolyData> Take() { return this->Mesh; }

private:
  vtkSmartPointer<vtkPolyData> Mesh = vtkSmartPointer<vtkPolyData>::New();
  std::mt19937 Generator{ 1 };
};

vtkSmartPointer<vtkPolyData> Slivers(int n)
{
  Builder builder;
  for (int i = 0; i < n; ++i)
  {
    const glm::dvec3 middle = builder.Random(0.004);
    const glm::dvec3 along = builder.Random(0.02);
    builder.Triangle(middle - along, middle + along, middle + along + builder.Random(0.0005));
  }
  return builder.Take();
}

vtkSmartPointer<vtkPolyData> Clusters(int n)
{
  Builder builder;
  glm::dvec3 middle(0.0);
  for (int i = 0; i < n; ++i)
  {
    middle = i % 100 == 0 ? builder.Random(0.9) : middle;
    const auto corner = [&] { return middle + builder.Random(0.012); };
    const glm::dvec3 a = corner();
    const glm::dvec3 b = corner();
    builder.Triangle(a, b, corner());
  }
  return builder.Take();
}

vtkSmartPointer<vtkPolyData> Hair(int n)
{
  Builder builder;
  for (int i = 0; i < n; ++i)
  {
    const glm::dvec3 root = builder.Random(0.3);
    builder.Line({ root, root + builder.Random(0.7) });
  }
  return builder.Take();
}

vtkSmartPointer<vtkPolyData> Streamlines(int n)
{
  Builder builder;
  constexpr int Steps = 24;
  for (int i = 0; i < n; i += Steps)
  {
    std::vector<glm::dvec3> points{ builder.Random(0.8) };
    for (int k = 1; k < Steps; ++k)
    {
      const glm::dvec3 p = points.back();
      points.push_back(
        p + 0.04 * glm::dvec3(-p.y + 0.3 * std::sin(9.0 * p.z), p.x, 0.5 * std::cos(7.0 * p.x)));
    }
    builder.Line(points);
  }
  return builder.Take();
}

vtkSmartPointer<vtkPolyData> Soup(int n)
{
  Builder builder;
  for (int i = 0; i < n; ++i)
  {
    const glm::dvec3 a = builder.Random(0.9);
    const glm::dvec3 b = a + builder.Random(0.2);
    builder.Triangle(a, b, a + builder.Random(0.2));
  }
  return builder.Take();
}

glm::dvec3 OnCircle(int i, int n, double radius, double z)
{
  const double angle = 2.0 * Pi * i / n;
  return { radius * std::cos(angle), radius * std::sin(angle), z };
}

vtkSmartPointer<vtkPolyData> Fan(int n)
{
  Builder builder;
  const vtkIdType apex = builder.Point({ 0.01, 0.02, 0.3 });
  for (int i = 0; i < n; ++i)
  {
    builder.Point(OnCircle(i, n, 0.9, 0.05 * (i & 1)));
  }
  for (int i = 0; i < n; ++i)
  {
    builder.Polygon({ apex, 1 + i, 1 + (i + 1) % n });
  }
  return builder.Take();
}

vtkSmartPointer<vtkPolyData> UnsharedFan(int n)
{
  Builder builder;
  for (int i = 0; i < n; ++i)
  {
    builder.Triangle({ 0.01, 0.02, 0.3 }, OnCircle(i, n, 0.9, 0.05 * (i & 1)),
      OnCircle(i + 1, n, 0.9, 0.05 * ((i + 1) & 1)));
  }
  return builder.Take();
}

/// Adds the upper hemisphere of a sphere with n facets around, in eight rings.
vtkSmartPointer<vtkPolyData> Pole(int n)
{
  constexpr int Rings = 8;
  Builder builder;
  const int around = std::max(n / (2 * Rings), 3);
  const vtkIdType top = builder.Point({ 0.0, 0.0, 0.9 });
  for (int ring = 1; ring <= Rings; ++ring)
  {
    const double angle = 0.5 * Pi * ring / Rings;
    for (int i = 0; i < around; ++i)
    {
      builder.Point(OnCircle(i, around, 0.9 * std::sin(angle), 0.9 * std::cos(angle)));
    }
  }
  for (int i = 0; i < around; ++i)
  {
    const int j = (i + 1) % around;
    builder.Polygon({ top, 1 + i, 1 + j });
    for (int ring = 0; ring + 1 < Rings; ++ring)
    {
      const vtkIdType low = 1 + static_cast<vtkIdType>(ring) * around;
      builder.Polygon({ low + i, low + around + i, low + around + j });
      builder.Polygon({ low + i, low + around + j, low + j });
    }
  }
  return builder.Take();
}

/// Builds a superellipsoid (exponents 0.3 and 0.4) of n triangles, whose poles are nearly flat.
vtkSmartPointer<vtkPolyData> SuperEllipsoid(int n)
{
  const int side = std::max(static_cast<int>(std::sqrt(0.5 * n)), 4);
  const auto power = [](double x, double exponent) {
    return std::copysign(std::pow(std::abs(x), exponent), x);
  };
  Builder builder;
  for (int i = 0; i <= side; ++i)
  {
    const double phi = Pi * i / side - 0.5 * Pi;
    for (int j = 0; j < side; ++j)
    {
      const double theta = 2.0 * Pi * j / side;
      const double ring = power(std::cos(phi), 0.3);
      builder.Point(0.9 *
        glm::dvec3(ring * power(std::cos(theta), 0.4), ring * power(std::sin(theta), 0.4),
          power(std::sin(phi), 0.3)));
    }
  }
  for (vtkIdType i = 0; i < side; ++i)
  {
    for (vtkIdType j = 0; j < side; ++j)
    {
      const vtkIdType k = (j + 1) % side;
      builder.Polygon({ i * side + j, i * side + k, (i + 1) * side + k });
      builder.Polygon({ i * side + j, (i + 1) * side + k, (i + 1) * side + j });
    }
  }
  return builder.Take();
}

vtkSmartPointer<vtkPolyData> Comb(int n)
{
  Builder builder;
  std::vector<vtkIdType> corners;
  for (int i = 0; i + 2 < n; ++i)
  {
    corners.push_back(builder.Point({ 0.9 - 1.8 * i / n, i & 1 ? -0.7 : 0.8, 0.0 }));
  }
  corners.push_back(builder.Point({ -0.9, -0.9, 0.0 }));
  corners.push_back(builder.Point({ 0.9, -0.9, 0.0 }));
  builder.Polygon(corners);
  return builder.Take();
}

/// Builds a polygon of n random corners, whose sides intersect each other.
vtkSmartPointer<vtkPolyData> RandomPolygon(int n)
{
  Builder builder;
  std::vector<vtkIdType> corners;
  for (int i = 0; i < n; ++i)
  {
    const glm::dvec3 p = builder.Random(0.9);
    corners.push_back(builder.Point({ p.x, p.y, 0.0 }));
  }
  builder.Polygon(corners);
  return builder.Take();
}

/// Builds a flat disc of n triangles around its center.
vtkSmartPointer<vtkPolyData> Disc(int n)
{
  Builder builder;
  const vtkIdType center = builder.Point({ 0.01, 0.02, 0.3 });
  for (int i = 0; i < n; ++i)
  {
    builder.Point(OnCircle(i, n, 0.9, 0.0));
  }
  for (int i = 0; i < n; ++i)
  {
    builder.Polygon({ center, 1 + i, 1 + (i + 1) % n });
  }
  return builder.Take();
}

vtkSmartPointer<vtkPolyData> Copies(int n)
{
  Builder builder;
  for (int i = 0; i < n; ++i)
  {
    builder.Triangle({ -0.8, -0.7, 0.0 }, { 0.9, -0.5, 0.0 }, { 0.1, 0.8, 0.0 });
  }
  return builder.Take();
}

vtkSmartPointer<vtkPolyData> SmoothSheet(int n)
{
  return MakePlainMesh(n, 1.0);
}

void ShowWireframe(vtkProperty* property)
{
  property->SetRepresentationToWireframe();
}

void ShowEdges(vtkProperty* property)
{
  property->EdgeVisibilityOn();
}

}

vtkSmartPointer<vtkPolyData> MakePlainMesh(int n, double aspect)
{
  Builder builder;
  const int side = std::max(static_cast<int>(std::sqrt(0.5 * n)), 1);
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  for (int i = 0; i <= side; ++i)
  {
    for (int j = 0; j <= side; ++j)
    {
      const double x = 1.05 * aspect * (2.0 * j / side - 1.0);
      const double y = 1.05 * (2.0 * i / side - 1.0);
      builder.Point({ x, y, 0.1 * std::sin(5.0 * x) * std::cos(4.0 * y) });
      const glm::dvec3 normal =
        glm::normalize(glm::dvec3(-0.5 * std::cos(5.0 * x) * std::cos(4.0 * y),
          0.4 * std::sin(5.0 * x) * std::sin(4.0 * y), 1.0));
      normals->InsertNextTuple3(normal.x, normal.y, normal.z);
    }
  }
  for (vtkIdType i = 0; i < side; ++i)
  {
    for (vtkIdType j = 0; j < side; ++j)
    {
      const vtkIdType low = i * (side + 1) + j;
      const vtkIdType high = low + side + 1;
      builder.Polygon({ low, low + 1, high + 1 });
      builder.Polygon({ low, high + 1, high });
    }
  }
  const vtkSmartPointer<vtkPolyData> mesh = builder.Take();
  mesh->GetPointData()->SetNormals(normals);
  return mesh;
}

const std::vector<Adversary>& Adversaries()
{
  static const std::vector<Adversary> all{ { "Slivers", Slivers }, { "Clusters", Clusters },
    { "Hair", Hair }, { "Streamlines", Streamlines }, { "Soup", Soup }, { "Fan", Fan },
    { "UnsharedFan", UnsharedFan }, { "Pole", Pole }, { "SuperEllipsoid", SuperEllipsoid },
    { "Disc", Disc }, { "Comb", Comb }, { "RandomPolygon", RandomPolygon }, { "Copies", Copies },
    { "Wireframe", SmoothSheet, ShowWireframe }, { "Edges", SmoothSheet, ShowEdges } };
  return all;
}

const Adversary* FindAdversary(const std::string& name)
{
  const auto found = std::find_if(Adversaries().begin(), Adversaries().end(),
    [&](const Adversary& adversary) { return adversary.Name == name; });
  return found != Adversaries().end() ? &*found : nullptr;
}

vtkSmartPointer<vtkRenderer> NewAdversaryRenderer(vtkPolyData* mesh, double scale)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  if (!mesh->GetPointData()->GetNormals())
  {
    actor->GetProperty()->SetInterpolationToFlat();
  }
  actor->GetProperty()->SetLineWidth(2.f);
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->AddActor(actor);
  renderer->SetBackground(0.2, 0.3, 0.4);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(scale);
  camera->SetPosition(0.3, 0.4, 5.0);
  return renderer;
}

}
