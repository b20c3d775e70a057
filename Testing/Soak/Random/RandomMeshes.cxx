// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RandomMeshes.h"

#include "Scenes/AccuracyScenes.h"
#include "Scenes/Adversaries.h"
#include "Scenes/TestScene.h"

#include "vtkArrowSource.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkConeSource.h"
#include "vtkCubeSource.h"
#include "vtkCylinderSource.h"
#include "vtkDiskSource.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"
#include "vtkSphereSource.h"
#include "vtkStripper.h"
#include "vtkSuperquadricSource.h"
#include "vtkTriangleFilter.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVectorText.h"

#include <limits>

namespace penumbra_soak
{
namespace
{

template <typename Source>
vtkSmartPointer<vtkPolyData> Update(Source* source)
{
  source->Update();
  return source->GetOutput();
}

vtkSmartPointer<vtkPolyData> MakeRound(Random& random, std::string& name)
{
  switch (random.Below(5))
  {
    case 0:
    {
      name = "superquadric";
      vtkNew<vtkSuperquadricSource> source;
      source->SetToroidal(random.Chance(0.5));
      source->SetPhiRoundness(random.Between(0.1, 3.0));
      source->SetThetaRoundness(random.Between(0.1, 3.0));
      source->SetThetaResolution(8 + 4 * random.Below(8));
      source->SetPhiResolution(8 + 4 * random.Below(8));
      return Update(source.Get());
    }
    case 1:
    {
      name = "cone";
      vtkNew<vtkConeSource> source;
      source->SetResolution(3 + random.Below(60));
      source->SetCapping(random.Chance(0.7));
      return Update(source.Get());
    }
    case 2:
    {
      name = "cylinder";
      vtkNew<vtkCylinderSource> source;
      source->SetResolution(3 + random.Below(60));
      source->SetCapping(random.Chance(0.5));
      return Update(source.Get());
    }
    case 3:
    {
      name = "arrow";
      vtkNew<vtkArrowSource> source;
      source->SetTipResolution(3 + random.Below(40));
      source->SetShaftResolution(3 + random.Below(40));
      return Update(source.Get());
    }
    default:
    {
      name = "sphere";
      vtkNew<vtkSphereSource> source;
      source->SetThetaResolution(3 + random.Below(60));
      source->SetPhiResolution(3 + random.Below(60));
      return Update(source.Get());
    }
  }
}

vtkSmartPointer<vtkPolyData> MakeFlat(Random& random, std::string& name)
{
  switch (random.Below(4))
  {
    case 0:
    {
      name = "plane";
      vtkNew<vtkPlaneSource> source;
      source->SetResolution(1 + random.Below(20), 1 + random.Below(20));
      return Update(source.Get());
    }
    case 1:
    {
      name = "disk";
      vtkNew<vtkDiskSource> source;
      source->SetInnerRadius(random.Between(0.0, 0.4));
      source->SetCircumferentialResolution(3 + random.Below(50));
      return Update(source.Get());
    }
    case 2:
    {
      name = "text";
      vtkNew<vtkVectorText> source;
      source->SetText(random.Pick({ "Rb", "8%", "gA&", "O" }));
      return Update(source.Get());
    }
    default:
    {
      name = "cube";
      vtkNew<vtkCubeSource> source;
      return Update(source.Get());
    }
  }
}

/// Lines, vertices and polygons over random points.
vtkSmartPointer<vtkPolyData> MakeMixed(Random& random, std::string& name)
{
  name = "mixed cells";
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  const int count = 4 + random.Below(40);
  for (int i = 0; i < count; ++i)
  {
    const glm::dvec3 p = 0.6 * random.Vector();
    points->InsertNextPoint(p.x, p.y, p.z);
  }
  mesh->SetPoints(points);
  const auto insert = [&](vtkCellArray* cells, int size) {
    cells->InsertNextCell(size);
    for (int i = 0; i < size; ++i)
    {
      cells->InsertCellPoint(random.Below(count));
    }
  };
  vtkNew<vtkCellArray> cells[3];
  for (int i = 0; i < 1 + count / 4; ++i)
  {
    insert(cells[0], 1);
    insert(cells[1], 2 + random.Below(4));
    insert(cells[2], 3);
  }
  mesh->SetVerts(random.Chance(0.5) ? cells[0].Get() : nullptr);
  mesh->SetLines(random.Chance(0.6) ? cells[1].Get() : nullptr);
  mesh->SetPolys(random.Chance(0.7) ? cells[2].Get() : nullptr);
  return mesh;
}

/// Invalid and degenerate meshes, which may not crash anything.
vtkSmartPointer<vtkPolyData> MakeDegenerate(Random& random, std::string& name)
{
  vtkSmartPointer<vtkPolyData> mesh = MakeMixed(random, name);
  const vtkIdType point = random.Below(static_cast<int>(mesh->GetNumberOfPoints()));
  switch (random.Below(5))
  {
    case 0:
      name = "no cells";
      return vtkSmartPointer<vtkPolyData>::New();
    case 1:
      name = "NaN point";
      mesh->GetPoints()->SetPoint(point, 0.0, std::numeric_limits<double>::quiet_NaN(), 0.0);
      break;
    case 2:
      name = "infinite point";
      mesh->GetPoints()->SetPoint(point, std::numeric_limits<double>::infinity(), 0.0, 0.0);
      break;
    case 3:
      name = "flattened";
      for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
      {
        double* p = mesh->GetPoint(i);
        mesh->GetPoints()->SetPoint(i, p[0], 1e-7 * p[1], 0.3 * p[0]);
      }
      break;
    default:
      name = "coincident points";
      for (vtkIdType i = 1; i < mesh->GetNumberOfPoints(); i += 2)
      {
        mesh->GetPoints()->SetPoint(i, mesh->GetPoint(i - 1));
      }
      break;
  }
  return mesh;
}

/// Meshes that are expensive or dense.
RandomMesh MakeAdversarial(Random& random)
{
  RandomMesh mesh;
  mesh.Arbitrary = true;
  if (random.Chance(0.3))
  {
    mesh.Name = "gyroid";
    mesh.Data = penumbra::MakeGyroid(random.Scale(1000.0, 60000.0), random.Chance(0.6));
    return mesh;
  }
  const std::vector<penumbra::Adversary>& all = penumbra::Adversaries();
  const penumbra::Adversary& adversary = all[random.Below(static_cast<int>(all.size()))];
  mesh.Name = adversary.Name;
  mesh.Data = adversary.Make(static_cast<int>(random.Scale(20.0, 4000.0)));
  return mesh;
}

}

RandomMesh MakeRandomMesh(Random& random, bool difficult)
{
  RandomMesh mesh;
  if (difficult && random.Chance(0.5))
  {
    if (random.Chance(0.7))
    {
      return MakeAdversarial(random);
    }
    mesh.Arbitrary = true;
    mesh.Data = MakeDegenerate(random, mesh.Name);
    return mesh;
  }
  switch (random.Below(8))
  {
    case 0:
      mesh.Name = "burr";
      mesh.Data = penumbra::Burr(6 + random.Below(40));
      break;
    case 1:
      mesh.Data = MakeMixed(random, mesh.Name);
      return mesh;
    case 2:
    case 3:
      mesh.Data = MakeFlat(random, mesh.Name);
      break;
    default:
      mesh.Data = MakeRound(random, mesh.Name);
      break;
  }
  const int conversion = random.Below(6);
  if (conversion == 0)
  {
    vtkNew<vtkPolyDataNormals> normals;
    normals->SetInputData(mesh.Data);
    normals->SetSplitting(random.Chance(0.5));
    normals->SetFeatureAngle(random.Between(10.0, 90.0));
    normals->SetComputeCellNormals(random.Chance(0.3));
    mesh.Data = Update(normals.Get());
    mesh.Name += " with normals";
  }
  else if (conversion == 1)
  {
    mesh.Data->GetPointData()->SetNormals(nullptr);
    mesh.Name += " without normals";
  }
  else if (conversion == 2)
  {
    vtkNew<vtkTriangleFilter> triangles;
    triangles->SetInputData(mesh.Data);
    vtkNew<vtkStripper> strips;
    strips->SetInputConnection(triangles->GetOutputPort());
    mesh.Data = Update(strips.Get());
    mesh.Name += " in strips";
  }
  return mesh;
}

void AddRandomArrays(Random& random, vtkPolyData* mesh)
{
  const bool cells = random.Chance(0.3) && mesh->GetNumberOfCells() > 0;
  const vtkIdType count = cells ? mesh->GetNumberOfCells() : mesh->GetNumberOfPoints();
  vtkDataSetAttributes* data = mesh->GetPointData();
  if (cells)
  {
    data = mesh->GetCellData();
  }
  if (random.Chance(0.4))
  {
    const int components = 1 + random.Below(4);
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetName("colors");
    colors->SetNumberOfComponents(components);
    for (vtkIdType i = 0; i < count * components; ++i)
    {
      colors->InsertNextValue(static_cast<unsigned char>(random.Below(256)));
    }
    data->SetScalars(colors);
    return;
  }
  vtkNew<vtkFloatArray> values;
  values->SetName("values");
  const glm::dvec3 direction = random.Direction();
  for (vtkIdType i = 0; i < count; ++i)
  {
    double value = random.Unit();
    if (!cells)
    {
      const double* p = mesh->GetPoint(i);
      value = 0.5 + glm::dot(direction, glm::dvec3(p[0], p[1], p[2]));
    }
    values->InsertNextValue(static_cast<float>(value));
  }
  data->SetScalars(values);
}

vtkSmartPointer<vtkImageData> MakeRandomImage(Random& random)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  const int components = random.Pick({ 1, 3, 3, 4 });
  const int width = 2 + random.Below(63);
  const int height = 2 + random.Below(63);
  const int field = 1 + random.Below(8);
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, components);
  const glm::dvec3 colors[2] = { random.Color(), random.Color() };
  for (int j = 0; j < height; ++j)
  {
    for (int i = 0; i < width; ++i)
    {
      for (int c = 0; c < components; ++c)
      {
        const double value = c < 3 ? colors[(i / field + j / field) % 2][c] : 1.0;
        image->SetScalarComponentFromDouble(i, j, 0, c, std::floor(255.0 * value));
      }
    }
  }
  return image;
}

}
