// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes whose borders lie where no edge at the corners of a pixel leads: every tile either keeps the
// tolerance or says that it does not. The truth is 32 x 32 samples in every pixel.
#include "vtkPenumbraRayCaster.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMinimalStandardRandomSequence.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace
{

class Random
{
public:
  double operator()()
  {
    this->Sequence->Next();
    return this->Sequence->GetValue();
  }

private:
  vtkNew<vtkMinimalStandardRandomSequence> Sequence;
};

vtkActor* Add(vtkRenderer* renderer, vtkPolyData* data)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToFlat();
  renderer->AddActor(actor);
  return actor;
}

/// Points at different depths, each 2 pixels wide.
void AddPoints(vtkRenderer* renderer)
{
  Random random;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (int i = 0; i < 1500; ++i)
  {
    const double x = random();
    const double y = random();
    const vtkIdType id = points->InsertNextPoint(x, y, random());
    cells->InsertNextCell(1, &id);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(cells);
  Add(renderer, data)->GetProperty()->SetPointSize(2.0f);
  renderer->GetActiveCamera()->ParallelProjectionOn();
}

/// Flat spheres that pass through each other.
void AddSpheres(vtkRenderer* renderer)
{
  Random random;
  for (int i = 0; i < 30; ++i)
  {
    vtkNew<vtkSphereSource> sphere;
    const double x = random();
    const double y = random();
    sphere->SetCenter(x, y, random());
    sphere->SetRadius(0.15 + 0.15 * random());
    sphere->SetThetaResolution(12);
    sphere->SetPhiResolution(12);
    sphere->Update();
    const double red = random();
    const double green = random();
    Add(renderer, sphere->GetOutput())->GetProperty()->SetColor(red, green, random());
  }
}

/// Triangles given by three points each.
vtkActor* AddTriangles(vtkRenderer* renderer, vtkPoints* points)
{
  vtkNew<vtkCellArray> cells;
  for (vtkIdType i = 0; i + 2 < points->GetNumberOfPoints(); i += 3)
  {
    const vtkIdType ids[3] = { i, i + 1, i + 2 };
    cells->InsertNextCell(3, ids);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  return Add(renderer, data);
}

/// Small sheets that face the eye, one behind the other.
void AddSheets(vtkRenderer* renderer)
{
  Random random;
  for (int i = 0; i < 300; ++i)
  {
    vtkNew<vtkPoints> points;
    const double x = random();
    const double y = random();
    const double z = i / 300.0;
    for (int corner = 0; corner < 3; ++corner)
    {
      const double dx = 0.3 * (random() - 0.5);
      points->InsertNextPoint(x + dx, y + 0.3 * (random() - 0.5), z);
    }
    const double red = random();
    const double green = random();
    AddTriangles(renderer, points)->GetProperty()->SetColor(red, green, random());
  }
}

/// Random triangles.
void AddSoup(vtkRenderer* renderer)
{
  Random random;
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 300; ++i)
  {
    const double x = random();
    const double y = random();
    const double z = random();
    for (int corner = 0; corner < 3; ++corner)
    {
      const double dx = 0.3 * (random() - 0.5);
      const double dy = 0.3 * (random() - 0.5);
      points->InsertNextPoint(x + dx, y + dy, z + 0.3 * (random() - 0.5));
    }
  }
  AddTriangles(renderer, points);
}

struct SceneRow
{
  std::string Name;
  std::function<void(vtkRenderer*)> Fill;
  double ViewAngle = 30.0;
};

const SceneRow Rows[] = {
  { "PointsAtDifferentDepths", AddPoints },
  { "SpheresThroughEachOther", AddSpheres },
  { "SheetsFacingTheEye", AddSheets },
  { "TrianglesThroughEachOther", AddSoup },
  { "TrianglesUnderATinyAngle", AddSoup, 0.001 },
};

std::ostream& operator<<(std::ostream& os, const SceneRow& row)
{
  return os << row.Name;
}

std::string NameOf(const ::testing::TestParamInfo<SceneRow>& row)
{
  return row.param.Name;
}

std::vector<float> Copy(vtkPenumbraRayCaster* caster, const char* name)
{
  vtkPointData* data = caster->GetOutput()->GetPointData();
  auto* array = vtkFloatArray::SafeDownCast(data->GetArray(name));
  return std::vector<float>(array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues());
}

class HardScenes : public ::testing::TestWithParam<SceneRow>
{
};

}

TEST_P(HardScenes, NoTileErrsByMoreThanItSays)
{
  const int Side = getenv("SIDE") ? atoi(getenv("SIDE")) : 96;
  const int Samples = getenv("SAMPLES") ? atoi(getenv("SAMPLES")) : 32;
  constexpr int Tile = 16;
  vtkNew<vtkRenderer> renderer;
  GetParam().Fill(renderer);
  renderer->SetBackground(0.2, 0.3, 0.4);
  renderer->ResetCamera();
  vtkCamera* camera = renderer->GetActiveCamera();
  const auto halfWidth = [&]()
  { return std::tan(vtkMath::RadiansFromDegrees(0.5 * camera->GetViewAngle())); };
  const double before = halfWidth();
  camera->SetViewAngle(GetParam().ViewAngle);
  camera->Dolly(halfWidth() / before);
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(Side, Side);
  caster->Update();
  const std::vector<float> colors = Copy(caster, "Color");
  const std::vector<float> errors = Copy(caster, "EstimatedError");
  const double rays = caster->GetStatistics()->GetArray("Rays/PerPixel")->GetTuple1(0);
  caster->SetCoverageMethod(vtkPenumbraRayCaster::UNIFORM);
  caster->SetUniformSamples(Samples);
  caster->Update();
  const std::vector<float> truth = Copy(caster, "Color");

  int dishonest = 0;
  int over = 0;
  int tiles = 0;
  double worst = 0.0;
  double worstBelieved = 0.0;
  std::vector<std::pair<double, int>> pix;
  for (int ty = 0; ty < Side; ty += Tile)
  {
    for (int tx = 0; tx < Side; tx += Tile)
    {
      double squares = 0.0;
      double believed = 0.0;
      for (int i = 0; i < Tile * Tile; ++i)
      {
        const std::size_t pixel = (ty + i / Tile) * Side + tx + i % Tile;
        double most = 0;
        for (int c = 0; c < 3; ++c)
        {
          const double d = colors[4 * pixel + c] - truth[4 * pixel + c];
          squares += d * d / 3.0;
          most = std::max(most, std::abs(d));
        }
        believed += static_cast<double>(errors[pixel]) * errors[pixel];
        pix.emplace_back(most, pixel);
      }
      const double error = std::sqrt(squares / (Tile * Tile));
      const double estimate = std::sqrt(believed / (Tile * Tile));
      ++tiles;
      over += error > 1.0 / 256.0;
      dishonest += error > 1.0 / 256.0 && estimate < 1. / 256;
      if (error > worst)
      {
        worst = error;
        worstBelieved = estimate;
      }
    }
  }
  std::sort(pix.rbegin(), pix.rend());
  for (int i = 0; i < 8; ++i)
    printf("  (%d,%d) %g est %g\n", pix[i].second % Side, pix[i].second / Side, pix[i].first, errors[pix[i].second]);
  printf("%s: worst %g believed %g over %d dishonest %d of %d rays %g est %g\n", GetParam().Name.c_str(),
    worst, worstBelieved, over, dishonest, tiles, rays, caster->GetEstimatedError());
  EXPECT_EQ(dishonest, 0) << "worst " << worst << ", believed " << worstBelieved << " there";
}

INSTANTIATE_TEST_SUITE_P(RayCaster, HardScenes, ::testing::ValuesIn(Rows), NameOf);
