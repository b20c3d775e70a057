// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SkyScenes.h"

#include "Benchmark.h"
#include "BruteForce/PathTracer.h"
#include "Room.h"
#include "Scenes/Solids.h"
#include "Scenes/TestScene.h"
#include "Surface.h"

#include "vtkActor.h"
#include "vtkAppendPolyData.h"
#include "vtkCell.h"
#include "vtkCubeSource.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPLYReader.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkTriangleFilter.h"

#include <glm/gtc/constants.hpp>

#include <functional>
#include <stdexcept>

namespace penumbra
{
namespace
{

constexpr double Pi = glm::pi<double>();
constexpr float Albedo = .5f;
constexpr int Bounces = 2;

/// Height of the head, which stands in the middle of the plane.
constexpr double HeadHeight = .8;

/// A floor of side 2 around the origin, a red wall on the left and a blue wall at the back.
std::vector<Panel> MakeCorner()
{
  const glm::dvec3 dark(0.0);
  return { { { -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, glm::dvec3(.9), dark },
    { { -1, -1, 0 }, { 0, 2, 0 }, { 0, 0, 1 }, { 1.0, .2, .1 }, dark },
    { { -1, 1, 0 }, { 2, 0, 0 }, { 0, 0, 1 }, { .1, .2, 1.0 }, dark } };
}

/// The corner with boxes.
std::vector<Panel> MakeBoxes()
{
  std::vector<Panel> panels = MakeCorner();
  AddPanels(panels, { -.7, .1, 0.0 }, { -.1, .6, .6 }, glm::dvec3(1.0));
  AddPanels(panels, { .1, -.5, 0.0 }, { .6, .0, .25 }, { .2, .9, .3 });
  AddPanels(panels, { .3, .3, 0.0 }, { .6, .7, .4 }, { 1.0, .9, .2 });
  return panels;
}

const glm::dvec3 Eye(1.6, -2.6, 1.6);
const glm::dvec3 Target(-.1, .1, .3);
constexpr double ViewAngle = 38.0;
const glm::dvec3 HeadColor(1.0, .8, .6);

void Look(Scene& scene)
{
  LookAt(scene, Eye, Target, ViewAngle, SkyImageSize, SkyImageSize);
}

/// Moves and scales y up to z up: bottom at z = 0, height `height`, centered at (x, y).
glm::dvec3 Place(vtkPolyData* mesh, const double p[3], double height, glm::dvec2 center)
{
  double b[6];
  mesh->GetBounds(b);
  const double scale = height / (b[3] - b[2]);
  return { center.x + scale * (p[0] - .5 * (b[0] + b[1])),
    center.y - scale * (p[2] - .5 * (b[4] + b[5])), scale * (p[1] - b[2]) };
}

/// Returns the mesh with the points moved by Place().
vtkSmartPointer<vtkPolyData> PlaceMesh(vtkPolyData* mesh, double height, glm::dvec2 center)
{
  auto placed = vtkSmartPointer<vtkPolyData>::New();
  placed->DeepCopy(mesh);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double p[3];
    mesh->GetPoint(i, p);
    const glm::dvec3 q = Place(mesh, p, height, center);
    placed->GetPoints()->SetPoint(i, q.x, q.y, q.z);
  }
  placed->GetPoints()->Modified();
  return placed;
}

/// The head on the plane, with point normals.
vtkSmartPointer<vtkPolyData> PlaceHead(vtkPolyData* head)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(PlaceMesh(head, HeadHeight, { 0.0, 0.0 }));
  normals->SplittingOff();
  normals->Update();
  return normals->GetOutput();
}

MeasuredSky MakeMapSky(const std::string& name,
  const std::function<glm::dvec3(double longitude, double sine, int i, int row)>& radiance)
{
  constexpr int Width = 64;
  constexpr int Height = 32;
  vtkNew<vtkImageData> image;
  image->SetDimensions(Width, Height, 1);
  image->AllocateScalars(VTK_FLOAT, 3);
  double sum = 0.0;
  for (int row = 0; row < Height; ++row)
  {
    const double low = -std::cos(Pi * row / Height);
    const double high = -std::cos(Pi * (row + 1) / Height);
    for (int i = 0; i < Width; ++i)
    {
      const glm::dvec3 color = radiance(2.0 * Pi * (i + .5) / Width, .5 * (low + high), i, row);
      for (int c = 0; c < 3; ++c)
      {
        image->SetScalarComponentFromDouble(i, row, 0, c, color[c]);
      }
      sum += .5 * (high - low) / Width * std::max({ color.x, color.y, color.z });
    }
  }
  MeasuredSky sky;
  sky.Name = name;
  sky.Environment = vtkSmartPointer<vtkPenumbraEnvironment>::New();
  sky.Environment->SetImage(image);
  sky.Environment->SetUp(0.0, 0.0, 1.0);
  sky.MeanRadiance = sum;
  return sky;
}

}

vtkSmartPointer<vtkPolyData> ReadHead(const LightBenchmark& benchmark)
{
  const std::string file = benchmark.Data + "/head.ply";
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  if (reader->GetOutput()->GetNumberOfPoints() == 0)
  {
    throw std::runtime_error(file + ": cannot be read.");
  }
  return reader->GetOutput();
}

Scene MakeBoxScene()
{
  Scene scene;
  AddSurfaces(scene, MakeBoxes());
  Look(scene);
  return scene;
}

Scene MakeHeadScene(vtkPolyData* head)
{
  Scene scene;
  AddSurfaces(scene, MakeCorner());
  const vtkSmartPointer<vtkPolyData> mesh = PlaceHead(head);
  Surface surface;
  vtkDataArray* vectors = mesh->GetPointData()->GetNormals();
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double p[3];
    double n[3];
    mesh->GetPoint(i, p);
    vectors->GetTuple(i, n);
    surface.Positions.emplace_back(p[0], p[1], p[2]);
    surface.Normals.emplace_back(n[0], n[1], n[2]);
  }
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    vtkCell* cell = mesh->GetCell(i);
    surface.Triangles.emplace_back(cell->GetPointId(0), cell->GetPointId(1), cell->GetPointId(2));
  }
  surface.Front.DiffuseColor = HeadColor;
  scene.Surfaces.push_back(surface);
  Look(scene);
  return scene;
}

vtkSmartPointer<vtkRenderer> MakeBoxRenderer()
{
  return MakeRenderer(MakeBoxes(), Eye, Target, ViewAngle);
}

vtkSmartPointer<vtkRenderer> MakeHeadRenderer(vtkPolyData* head)
{
  vtkSmartPointer<vtkRenderer> renderer = MakeRenderer(MakeCorner(), Eye, Target, ViewAngle);
  vtkProperty* property = AddMesh(renderer, PlaceHead(head), true)->GetProperty();
  property->SetInterpolationToPhong();
  property->SetDiffuseColor(HeadColor.x, HeadColor.y, HeadColor.z);
  return renderer;
}

vtkSmartPointer<vtkPolyData> MakeBakedMesh(vtkPolyData* head)
{
  vtkNew<vtkAppendPolyData> all;
  vtkNew<vtkPlaneSource> floor;
  floor->SetOrigin(-1.0, -1.0, 0.0);
  floor->SetPoint1(1.0, -1.0, 0.0);
  floor->SetPoint2(-1.0, 1.0, 0.0);
  floor->SetResolution(60, 60);
  all->AddInputConnection(floor->GetOutputPort());
  // The wall does not touch the floor: points on both have no hemisphere of their own.
  vtkNew<vtkPlaneSource> wall;
  wall->SetOrigin(-1.0, 1.01, 0.0);
  wall->SetPoint1(1.0, 1.01, 0.0);
  wall->SetPoint2(-1.0, 1.01, 1.0);
  wall->SetResolution(60, 30);
  all->AddInputConnection(wall->GetOutputPort());
  all->AddInputData(PlaceMesh(head, HeadHeight, { 0.0, 0.0 }));
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(all->GetOutputPort());
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(triangles->GetOutputPort());
  normals->SplittingOff();
  normals->ConsistencyOff();
  normals->Update();
  return normals->GetOutput();
}

MeasuredSky MakeColoredSky()
{
  return MakeMapSky("colored environment map", [](double longitude, double sine, int, int) {
    const double up = .5 + .5 * sine;
    const glm::dvec3 hue(.5 + .5 * std::cos(longitude), .5 + .5 * std::cos(longitude + 2.0),
      .5 + .5 * std::cos(longitude + 4.0));
    return 1.2 * ((1.0 - up) * hue + up * glm::dvec3(.15, .35, 1.1));
  });
}

MeasuredSky MakeSunSky()
{
  return MakeMapSky("sun of 1e5 in a blue sky", [](double, double sine, int i, int row) {
    return i == 44 && row == 24 ? glm::dvec3(1e5, .9e5, .7e5)
                                : (sine > 0.0 ? glm::dvec3(.2, .4, 1.0) : glm::dvec3(.3));
  });
}

IlluminationSettings MakeIlluminationSettings(const MeasuredSky& sky)
{
  IlluminationSettings settings;
  settings.Environment = sky.Color;
  settings.Map = sky.Environment ? sky.Environment->GetMap() : nullptr;
  settings.Albedo = Albedo;
  settings.Bounces = Bounces;
  return settings;
}

}
