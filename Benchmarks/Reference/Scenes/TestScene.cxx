// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TestScene.h"

#include "CollectionItems.h"

#include "ClosedForms/ExactCoverage.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <cmath>
#include <ctime>

namespace penumbra
{

vtkSmartPointer<vtkPolyData> MeshOf(const std::vector<Shape>& shapes)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  for (const Shape& shape : shapes)
  {
    const vtkIdType center = points->InsertNextPoint(shape.Center.x, shape.Center.y, 0.0);
    const vtkIdType count = static_cast<vtkIdType>(shape.Outline.size());
    for (vtkIdType i = 0; i < count; ++i)
    {
      points->InsertNextPoint(shape.Outline[i].x, shape.Outline[i].y, 0.0);
      const vtkIdType triangle[3] = { center, center + 1 + i, center + 1 + (i + 1) % count };
      triangles->InsertNextCell(3, triangle);
    }
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);
  return mesh;
}

vtkSmartPointer<vtkPolyData> Burr(int sides)
{
  const double pi = std::acos(-1.0);
  const int rings = 2 * sides / 3;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const auto insert = [&](double polar, double turn) {
    const double z = .5 * std::cos(polar);
    const double bump = 1.0 + .5 * std::sin(6.0 * turn) * std::sin(8.0 * z);
    const double side = .5 * std::sin(polar) * bump;
    return points->InsertNextPoint(side * std::cos(turn), side * std::sin(turn), z * bump);
  };
  vtkNew<vtkCellArray> triangles;
  const auto connect = [&](vtkIdType a, vtkIdType b, vtkIdType c) {
    const vtkIdType corners[3] = { a, b, c };
    triangles->InsertNextCell(3, corners);
  };
  const vtkIdType top = insert(0.0, 0.0);
  const vtkIdType bottom = insert(pi, 0.0);
  for (int ring = 1; ring < rings; ++ring)
  {
    for (int i = 0; i < sides; ++i)
    {
      const vtkIdType corner = insert(pi * ring / rings, 2.0 * pi * i / sides);
      const vtkIdType next = corner - i + (i + 1) % sides;
      if (ring == 1)
      {
        connect(top, corner, next);
      }
      else
      {
        connect(corner - sides, corner, next);
        connect(corner - sides, next, next - sides);
      }
      if (ring == rings - 1)
      {
        connect(bottom, next, corner);
      }
    }
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);
  return mesh;
}

vtkSmartPointer<vtkRenderer> NewRenderer()
{
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetBackground(0.0, 0.0, 0.0);
  return renderer;
}

vtkActor* AddMesh(vtkRenderer* renderer, vtkPolyData* mesh, bool lighting)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetLighting(lighting);
  renderer->AddActor(actor);
  return actor;
}

void LookAtImage(vtkRenderer* renderer, int width, int height)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(0.5 * width, 0.5 * height, 0.0);
  camera->SetPosition(0.5 * width, 0.5 * height, 100.0);
  camera->SetViewUp(0.0, 1.0, 0.0);
  camera->SetParallelScale(0.5 * height);
  camera->SetClippingRange(1.0, 200.0);
}

void LookAlong(vtkRenderer* renderer, glm::dvec3 direction, glm::dvec3 up, int width, int height)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetPosition(-direction.x, -direction.y, -direction.z);
  camera->SetViewUp(up.x, up.y, up.z);
  renderer->ResetCamera();
  // VTK fits the bounding sphere to the height of the view; a portrait image is narrower than that.
  if (width < height)
  {
    camera->Dolly(double(width) / height);
  }
  renderer->ResetCameraClippingRange();
}

vtkSmartPointer<vtkRenderer> RendererOf(const std::vector<Shape>& shapes, int width, int height)
{
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, MeshOf(shapes), false);
  LookAtImage(renderer, width, height);
  return renderer;
}

std::vector<double> SharesOf(const std::vector<Shape>& shapes, int width, int height)
{
  ExactCoverage coverage(width, height);
  for (const Shape& shape : shapes)
  {
    coverage.AddPolygon(shape.Outline);
  }
  return coverage.GetShares();
}

namespace
{

void Append(BruteForceScene& scene, vtkActor* actor)
{
  vtkPolyData* mesh = vtkPolyData::SafeDownCast(actor->GetMapper()->GetInputDataObject(0, 0));
  vtkMatrix4x4* place = actor->GetMatrix();
  const auto first = static_cast<std::uint32_t>(scene.Positions.size());
  vtkDataArray* normals = mesh->GetPointData()->GetNormals();
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double x[4] = { 0.0, 0.0, 0.0, 1.0 };
    mesh->GetPoint(i, x);
    place->MultiplyPoint(x, x);
    scene.Positions.emplace_back(x[0], x[1], x[2]);
    if (normals)
    {
      const double* n = normals->GetTuple3(i);
      scene.Normals.emplace_back(n[0], n[1], n[2]);
    }
  }
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < mesh->GetPolys()->GetNumberOfCells(); ++i)
  {
    mesh->GetPolys()->GetCellAtId(i, corners);
    for (vtkIdType k = 2; k < corners->GetNumberOfIds(); ++k)
    {
      scene.Triangles.emplace_back(first + static_cast<std::uint32_t>(corners->GetId(0)),
        first + static_cast<std::uint32_t>(corners->GetId(k - 1)),
        first + static_cast<std::uint32_t>(corners->GetId(k)));
    }
  }
}

}

BruteForceScene BruteForceOf(vtkRenderer* renderer, int width, int height)
{
  BruteForceScene scene;
  for (vtkActor* actor : GetItems<vtkActor>(renderer->GetActors()))
  {
    scene.Lighting = actor->GetProperty()->GetLighting();
    const double* color = actor->GetProperty()->GetDiffuseColor();
    scene.Color = { color[0], color[1], color[2] };
    Append(scene, actor);
  }
  const double* background = renderer->GetBackground();
  scene.Background = { background[0], background[1], background[2] };

  vtkCamera* camera = renderer->GetActiveCamera();
  vtkMatrix4x4* matrix =
    camera->GetCompositeProjectionTransformMatrix(double(width) / height, -1.0, 1.0);
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      scene.Projection[column][row] = matrix->GetElement(row, column);
    }
  }
  const double* eye = camera->GetPosition();
  const double* travel = camera->GetDirectionOfProjection();
  scene.Eye = { eye[0], eye[1], eye[2] };
  scene.LightTravel = { travel[0], travel[1], travel[2] };
  scene.Parallel = camera->GetParallelProjection();
  return scene;
}

Answer Cast(vtkRenderer* renderer, int width, int height,
  const std::function<void(vtkPenumbraRayCaster*)>& choose)
{
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(width, height);
  caster->SetNumberOfThreads(1);
  if (choose)
  {
    choose(caster);
  }
  const std::clock_t start = std::clock();
  caster->Update();
  Answer answer;
  answer.Seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;

  vtkPointData* data = caster->GetOutput()->GetPointData();
  vtkDataArray* colors = data->GetArray("Color");
  vtkDataArray* estimates = data->GetArray("EstimatedError");
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    answer.Colors.emplace_back(
      colors->GetComponent(i, 0), colors->GetComponent(i, 1), colors->GetComponent(i, 2));
    answer.Alphas.push_back(colors->GetComponent(i, 3));
    answer.Estimates.push_back(estimates ? estimates->GetComponent(i, 0) : 0.0);
  }
  answer.EstimatedError = caster->GetEstimatedError();
  if (vtkDataArray* rays = caster->GetStatistics()->GetArray("Rays/PerPixel"))
  {
    answer.RaysPerPixel = rays->GetComponent(0, 0);
  }
  return answer;
}

}
