// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "AccuracyScenes.h"

#include "Adversaries.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkNew.h"
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
#include "vtkTransform.h"
#include "vtkVectorText.h"

#include <glm/glm.hpp>

#include <cmath>
#include <random>

namespace penumbra
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

class Random
{
public:
  /// Returns a number in [-1, 1).
  double operator()() { return this->Generator() * 0x1p-31 - 1.0; }
  glm::dvec3 Vector()
  {
    const double x = (*this)();
    const double y = (*this)();
    return { x, y, (*this)() };
  }

private:
  std::mt19937 Generator{ 7 };
};

vtkActor* Add(vtkRenderer* renderer, vtkPolyData* mesh, glm::dvec3 color = glm::dvec3(1.0))
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(color.r, color.g, color.b);
  if (!mesh->GetPointData()->GetNormals())
  {
    actor->GetProperty()->SetInterpolationToFlat();
  }
  renderer->AddActor(actor);
  return actor;
}

void Look(vtkRenderer* renderer, glm::dvec3 eye, glm::dvec3 target, double angle)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(eye.x, eye.y, eye.z);
  camera->SetFocalPoint(target.x, target.y, target.z);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetViewAngle(angle);
  renderer->ResetCameraClippingRange();
  renderer->SetBackground(0.2, 0.3, 0.4);
}

void AddSceneLight(vtkRenderer* renderer, glm::dvec3 position, double intensity = 1.0)
{
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPosition(position.x, position.y, position.z);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  light->SetIntensity(intensity);
  renderer->AddLight(light);
}

AccuracyScene MakeAdversary(const std::string& name, int primitives)
{
  return { name + std::to_string(primitives), [name, primitives](vtkRenderer* renderer) {
            vtkActor* actor = Add(renderer, FindAdversary(name)->Make(primitives));
            actor->GetProperty()->SetLineWidth(1.5f);
            Look(renderer, { 0.3, -4.5, 1.4 }, glm::dvec3(0.0), 26.0);
          } };
}

enum class View
{
  Outside,
  Inside,
  Wide,
  Tele
};

AccuracyScene MakeSoup(const std::string& name, int triangles, View view, bool shadows = false)
{
  return { name,
    [triangles, view](vtkRenderer* renderer) {
      Add(renderer, FindAdversary("Soup")->Make(triangles), { 0.9, 0.8, 0.6 });
      const glm::dvec3 eye = view == View::Tele ? glm::dvec3(500.0, -900.0, 300.0)
        : view == View::Outside                 ? glm::dvec3(1.0, -5.0, 1.5)
                                                : glm::dvec3(0.1, -0.05, 0.02);
      Look(renderer, eye, { 0.0, 0.0, 0.03 },
        view == View::Tele       ? 0.06
          : view == View::Wide   ? 120.0
          : view == View::Inside ? 60.0
                                 : 24.0);
      AddSceneLight(renderer, { 3.0, -4.0, 5.0 });
    },
    shadows };
}

vtkSmartPointer<vtkPolyData> MakeTriangles(const std::vector<glm::dvec3>& corners)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    points->InsertNextPoint(corners[i].x, corners[i].y, corners[i].z);
    if (i % 3 == 0)
    {
      cells->InsertNextCell(3);
    }
    cells->InsertCellPoint(static_cast<vtkIdType>(i));
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(cells);
  return mesh;
}

/// Pointed leaves of six triangles in all directions.
void BuildFoliage(vtkRenderer* renderer)
{
  Random random;
  std::vector<glm::dvec3> corners;
  for (int i = 0; i < 6000; ++i)
  {
    const glm::dvec3 base = glm::normalize(random.Vector()) * std::sqrt(0.5 + 0.5 * random());
    const glm::dvec3 along = 0.09 * glm::normalize(random.Vector());
    const glm::dvec3 side = 0.025 * glm::normalize(glm::cross(along, random.Vector()));
    for (int k = 0; k < 3; ++k)
    {
      const auto at = [&](int step, double sign) {
        return base + along * (step / 3.0) + sign * side * std::sin(Pi * step / 3.0);
      };
      for (const glm::dvec3& p :
        { at(k, -1.0), at(k + 1, -1.0), at(k + 1, 1.0), at(k, -1.0), at(k + 1, 1.0), at(k, 1.0) })
      {
        corners.push_back(p);
      }
    }
  }
  Add(renderer, MakeTriangles(corners), { 0.3, 0.7, 0.2 });
  AddSceneLight(renderer, { 3.0, -4.0, 5.0 });
  Look(renderer, { 0.5, -4.0, 1.0 }, glm::dvec3(0.0), 30.0);
}

void BuildText(vtkRenderer* renderer)
{
  for (int line = 0; line < 16; ++line)
  {
    vtkNew<vtkVectorText> text;
    text->SetText("Fractional visibility 0123456789");
    text->Update();
    vtkActor* actor = Add(renderer, text->GetOutput(), { 0.95, 0.9, 0.3 });
    actor->GetProperty()->LightingOff();
    actor->RotateX(90.0);
    actor->SetScale(0.02 + 0.005 * line);
    actor->SetPosition(-1.0, 0.0, 0.95 - 0.1 * line - 0.002 * line * line);
  }
  Look(renderer, { 0.2, -4.0, 0.3 }, glm::dvec3(0.0), 27.0);
}

/// Parallel bars, slightly narrower than pixels.
void BuildMoire(vtkRenderer* renderer, bool perspective)
{
  std::vector<glm::dvec3> corners;
  const int bars = perspective ? 400 : 150;
  for (int i = 0; i < bars; ++i)
  {
    const double x = 2.4 * (i - 0.5 * bars) / bars;
    const double width = 1.2 / bars;
    const glm::dvec3 a(x, perspective ? -1.0 : 0.0, -1.2);
    const glm::dvec3 b(x + 0.11, perspective ? 6.0 : 0.0, perspective ? -1.2 : 1.2);
    const glm::dvec3 side(width, 0.0, 0.0);
    for (const glm::dvec3& p : { a, a + side, b, a + side, b + side, b })
    {
      corners.push_back(p);
    }
  }
  Add(renderer, MakeTriangles(corners))->GetProperty()->LightingOff();
  perspective ? Look(renderer, { 0.1, -2.0, 0.0 }, { 0.0, 2.0, -0.8 }, 40.0)
              : Look(renderer, { 0.0, -5.0, 0.0 }, glm::dvec3(0.0), 26.0);
}

void AddCheckerboard(vtkRenderer* renderer, double size, int squares)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(squares, squares, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int i = 0; i < squares * squares; ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      image->SetScalarComponentFromDouble(
        i % squares, i / squares, 0, c, (i + i / squares) % 2 ? 240.0 : 20.0 + 20.0 * c);
    }
  }
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->InterpolateOff();
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-size, -size, -0.6);
  plane->SetPoint1(size, -size, -0.6);
  plane->SetPoint2(-size, size, -0.6);
  plane->Update();
  Add(renderer, plane->GetOutput())->SetTexture(texture);
}

vtkSmartPointer<vtkPolyData> MakeSphere(glm::dvec3 center, double radius, int resolution = 24)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(center.x, center.y, center.z);
  sphere->SetRadius(radius);
  sphere->SetThetaResolution(resolution);
  sphere->SetPhiResolution(resolution);
  sphere->Update();
  return sphere->GetOutput();
}

void BuildGlass(vtkRenderer* renderer)
{
  AddCheckerboard(renderer, 3.0, 16);
  Random random;
  for (int i = 0; i < 12; ++i)
  {
    const glm::dvec3 center = 0.7 * random.Vector();
    const glm::dvec3 color = 0.6 + 0.4 * random.Vector();
    vtkActor* actor = Add(renderer, MakeSphere(center, 0.35), color);
    actor->GetProperty()->SetOpacity(0.35);
  }
  for (int i = 0; i < 12; ++i)
  {
    const glm::dvec3 a = random.Vector();
    const glm::dvec3 u = 0.7 * random.Vector();
    const glm::dvec3 v = 0.7 * random.Vector();
    Add(renderer, MakeTriangles({ a, a + u, a + v }), { 0.5, 0.9, 0.8 })
      ->GetProperty()
      ->SetOpacity(0.3);
  }
  Look(renderer, { 1.0, -4.0, 1.6 }, glm::dvec3(0.0), 30.0);
}

void BuildHighlights(vtkRenderer* renderer)
{
  Random random;
  for (int i = 0; i < 60; ++i)
  {
    const glm::dvec3 center = random.Vector();
    vtkActor* actor = Add(renderer, MakeSphere(center, 0.12, 40), { 0.7, 0.3, 0.2 });
    actor->GetProperty()->SetSpecular(1.0);
    actor->GetProperty()->SetSpecularPower(300.0);
  }
  AddSceneLight(renderer, { 3.0, -4.0, 5.0 }, 8.0);
  AddSceneLight(renderer, { -3.0, -4.0, 1.0 }, 4.0);
  Look(renderer, { 0.5, -4.5, 1.0 }, glm::dvec3(0.0), 30.0);
}

/// A fractal terrain seen at a grazing angle; its far triangles are much smaller than pixels.
void BuildTerrain(vtkRenderer* renderer, bool smooth)
{
  constexpr int Side = 700;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (int j = 0; j < Side; ++j)
  {
    for (int i = 0; i < Side; ++i)
    {
      const glm::dvec2 p = 6.0 * glm::dvec2(i - 0.5 * Side, j) / double(Side);
      double z = 0.0;
      for (int k = 0; k < 7; ++k)
      {
        const double f = std::exp2(k);
        z += 0.18 / f * std::sin(f * (1.3 * p.x + 0.4 * p.y) + k) *
          std::cos(f * (1.1 * p.y - 0.5 * p.x) + 2.0 * k);
      }
      points->InsertNextPoint(p.x, p.y, z);
    }
  }
  for (vtkIdType j = 0; j + 1 < Side; ++j)
  {
    for (vtkIdType i = 0; i + 1 < Side; ++i)
    {
      const vtkIdType a = j * Side + i;
      const vtkIdType triangles[2][3] = { { a, a + 1, a + Side },
        { a + 1, a + Side + 1, a + Side } };
      cells->InsertNextCell(3, triangles[0]);
      cells->InsertNextCell(3, triangles[1]);
    }
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetPolys(cells);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(mesh);
  normals->SplittingOff();
  if (smooth)
  {
    normals->Update();
  }
  Add(renderer, smooth ? normals->GetOutput() : mesh.Get(), { 0.8, 0.7, 0.5 });
  AddSceneLight(renderer, { 3.0, 1.0, 5.0 });
  Look(renderer, { 0.0, -0.3, 0.55 }, { 0.0, 3.0, 0.0 }, 45.0);
}

void BuildWireframe(vtkRenderer* renderer)
{
  vtkActor* actor = Add(renderer, MakeGyroid(8000.0, false), { 0.3, 0.9, 0.5 });
  actor->GetProperty()->SetRepresentationToWireframe();
  actor->GetProperty()->SetLineWidth(0.7f);
  Look(renderer, { 0.8, -4.5, 1.4 }, glm::dvec3(0.0), 30.0);
}

void BuildField(vtkRenderer* renderer)
{
  AddCheckerboard(renderer, 12.0, 2);
  for (int i = 0; i < 18; ++i)
  {
    for (int j = 0; j < 18; ++j)
    {
      Add(renderer, MakeSphere({ 0.6 * (i - 9), 0.6 * j, -0.35 }, 0.22, 16),
        { 0.4 + 0.03 * i, 0.5, 0.9 - 0.03 * j });
    }
  }
  AddSceneLight(renderer, { 4.0, -2.0, 6.0 });
  Look(renderer, { 0.0, -3.0, 1.2 }, { 0.0, 2.0, -0.6 }, 40.0);
}

}

vtkSmartPointer<vtkPolyData> MakeGyroid(double triangles, bool smooth)
{
  constexpr double Periods = 2.0;
  // Measured with vtkFlyingEdges3D.
  const int side = std::max(static_cast<int>(std::sqrt(triangles / 14.0)), 8);
  vtkNew<vtkImageData> field;
  field->SetDimensions(side, side, side);
  field->SetOrigin(-1.0, -1.0, -1.0);
  field->SetSpacing(2.0 / (side - 1), 2.0 / (side - 1), 2.0 / (side - 1));
  field->AllocateScalars(VTK_FLOAT, 1);
  auto* values = static_cast<float*>(field->GetScalarPointer());
  for (int k = 0; k < side; ++k)
  {
    for (int j = 0; j < side; ++j)
    {
      for (int i = 0; i < side; ++i)
      {
        const glm::dvec3 p = Pi * Periods * (2.0 * glm::dvec3(i, j, k) / (side - 1.0) - 1.0);
        *values++ = static_cast<float>(std::sin(p.x) * std::cos(p.y) +
          std::sin(p.y) * std::cos(p.z) + std::sin(p.z) * std::cos(p.x));
      }
    }
  }
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(field);
  contour->SetValue(0, 0.0);
  contour->SetComputeNormals(smooth);
  contour->ComputeScalarsOff();
  contour->Update();
  return contour->GetOutput();
}

void BuildGyroid(vtkRenderer* renderer, double trianglesPerPixel, bool smooth, int side)
{
  Add(renderer, MakeGyroid(trianglesPerPixel * side * side, smooth), { 0.9, 0.85, 0.8 });
  Look(renderer, { 1.6, -4.2, 1.3 }, glm::dvec3(0.0), 30.0);
}

const std::vector<AccuracyScene>& GetAccuracyScenes()
{
  const auto makeGyroid = [](const std::string& name, double density, bool smooth) {
    return AccuracyScene{ name,
      [=](vtkRenderer* renderer) { BuildGyroid(renderer, density, smooth, AccuracyImageSide); } };
  };
  static const std::vector<AccuracyScene> all{
    makeGyroid("Gyroid0.1", 0.1, true),
    makeGyroid("Gyroid1", 1.0, true),
    makeGyroid("Gyroid3", 3.0, true),
    makeGyroid("Gyroid10", 10.0, true),
    makeGyroid("Gyroid30", 30.0, true),
    makeGyroid("FlatGyroid1", 1.0, false),
    makeGyroid("FlatGyroid10", 10.0, false),
    { "Terrain", [](vtkRenderer* r) { BuildTerrain(r, true); } },
    { "FlatTerrain", [](vtkRenderer* r) { BuildTerrain(r, false); } },
    MakeAdversary("Fan", 2000),
    MakeAdversary("UnsharedFan", 8000),
    MakeAdversary("Pole", 20000),
    MakeAdversary("SuperEllipsoid", 20000),
    MakeAdversary("Hair", 500),
    MakeAdversary("Hair", 5000),
    MakeAdversary("Streamlines", 2000),
    MakeAdversary("Clusters", 20000),
    { "Foliage", BuildFoliage },
    { "FoliageWithShadows", BuildFoliage, true },
    { "Text", BuildText },
    { "Moire", [](vtkRenderer* r) { BuildMoire(r, false); } },
    { "MoireToTheHorizon", [](vtkRenderer* r) { BuildMoire(r, true); } },
    { "Checkerboard",
      [](vtkRenderer* r) {
        AddCheckerboard(r, 12.0, 64);
        Look(r, { 0.1, -3.0, 0.4 }, { 0.0, 2.0, -0.6 }, 40.0);
      } },
    { "Glass", BuildGlass },
    { "Highlights", BuildHighlights },
    { "Wireframe", BuildWireframe },
    { "FieldWithShadows", BuildField, true },
    MakeSoup("Soup300", 300, View::Outside),
    MakeSoup("Soup3000", 3000, View::Outside),
    MakeSoup("Soup30000", 30000, View::Outside),
    MakeSoup("Soup100000", 100000, View::Outside),
    MakeSoup("Soup3000Inside", 3000, View::Inside),
    MakeSoup("Soup100000Inside", 100000, View::Inside),
    MakeSoup("Soup3000Wide", 3000, View::Wide),
    MakeSoup("Soup3000Tele", 3000, View::Tele),
    MakeSoup("Soup300WithShadows", 300, View::Outside, true),
    MakeSoup("Soup3000WithShadows", 3000, View::Outside, true),
    MakeSoup("Soup100000WithShadows", 100000, View::Outside, true),
  };
  return all;
}

}
