// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FeatureProps.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositePolyDataMapper.h"
#include "vtkCubeSource.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkImageProperty.h"
#include "vtkImageSlice.h"
#include "vtkImageSliceMapper.h"
#include "vtkLight.h"
#include "vtkLookupTable.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkTextProperty.h"
#include "vtkTexture.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVersionMacros.h"

#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 0)
#include "vtkCompositePolyDataMapper2.h"
#endif

#include <cmath>

vtkSmartPointer<vtkPolyData> MakeSphere(int resolution)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(resolution);
  sphere->SetPhiResolution(resolution);
  return Make(sphere.Get());
}

vtkSmartPointer<vtkPolyData> MakeCube()
{
  vtkNew<vtkCubeSource> cube;
  return Make(cube.Get());
}

vtkSmartPointer<vtkPolyData> MakePlane(int resolution)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(resolution, resolution);
  return Make(plane.Get());
}

vtkActor* Add(vtkRenderer* renderer, vtkPolyData* data)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.9, 0.6, 0.3);
  renderer->AddActor(actor);
  return actor;
}

void Look(vtkRenderer* renderer)
{
  renderer->GetActiveCamera()->SetPosition(1.0, 0.8, 2.0);
  renderer->GetActiveCamera()->SetFocalPoint(0.0, 0.0, 0.0);
  renderer->ResetCamera();
}

void AddElevation(vtkPolyData* data)
{
  vtkNew<vtkFloatArray> scalars;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    scalars->InsertNextValue(static_cast<float>(data->GetPoint(i)[1] + 0.5));
  }
  data->GetPointData()->SetScalars(scalars);
}

vtkSmartPointer<vtkImageData> MakeImage(int width, int height, int components)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, components);
  for (int j = 0; j < height; ++j)
  {
    for (int i = 0; i < width; ++i)
    {
      const bool odd = (i * 8 / width + j * 8 / height) % 2 == 1;
      auto* c = static_cast<unsigned char*>(image->GetScalarPointer(i, j, 0));
      const int color[4] = { odd ? 230 : 40, 255 * i / width, 255 * j / height, odd ? 255 : 120 };
      for (int k = 0; k < components; ++k)
      {
        c[k] = static_cast<unsigned char>(color[k]);
      }
    }
  }
  return image;
}

vtkTexture* AddTexture(vtkActor* actor, vtkImageData* image)
{
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->InterpolateOn();
  actor->SetTexture(texture);
  actor->GetProperty()->SetColor(1.0, 1.0, 1.0);
  return texture;
}

vtkActor* AddWrapped(vtkRenderer* renderer)
{
  vtkSmartPointer<vtkPolyData> plane = MakePlane();
  vtkDataArray* coordinates = plane->GetPointData()->GetTCoords();
  for (vtkIdType i = 0; i < 4; ++i)
  {
    coordinates->SetTuple2(
      i, 3.0 * coordinates->GetComponent(i, 0) - 1.0, 3.0 * coordinates->GetComponent(i, 1) - 1.0);
  }
  return Add(renderer, plane);
}

vtkSmartPointer<vtkPolyData> MakeTube(int around)
{
  constexpr int Sides = 12;
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(2);
  vtkNew<vtkCellArray> cells;
  for (int i = 0; i < 2 * Sides; ++i)
  {
    const double turn = static_cast<double>(i / 2) / Sides;
    const double angle = 6.283185307179586 * (turn + 0.15);
    points->InsertNextPoint(0.5 * std::sin(angle), i % 2 - 0.5, 0.5 * std::cos(angle));
    const double along = 0.9 * (i % 2);
    coordinates->InsertNextTuple2(around == 0 ? turn : along, around == 0 ? along : turn);
    if (i % 2 == 0)
    {
      const vtkIdType next = (i + 2) % (2 * Sides);
      const vtkIdType quad[4] = { i, next, next + 1, i + 1 };
      cells->InsertNextCell(4, quad);
    }
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetPointData()->SetTCoords(coordinates);
  return data;
}

vtkSmartPointer<vtkPolyData> MakePolyline()
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(9);
  for (int i = 0; i < 9; ++i)
  {
    lines->InsertCellPoint(points->InsertNextPoint(0.2 * i, i % 2 == 0 ? 0.0 : 0.6, 0.0));
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(lines);
  return data;
}

vtkSmartPointer<vtkPolyData> MakePointGrid()
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  for (int i = 0; i < 16; ++i)
  {
    vertices->InsertNextCell(1);
    vertices->InsertCellPoint(points->InsertNextPoint(i % 4, i / 4, 0.0));
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetVerts(vertices);
  return data;
}

void AddBlocks(vtkRenderer* renderer)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned int i = 0; i < 4; ++i)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(1.2 * (i % 2), 1.2 * (i / 2), 0.0);
    sphere->SetThetaResolution(24);
    sphere->SetPhiResolution(24);
    blocks->SetBlock(i, Make(sphere.Get()));
  }
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  vtkNew<vtkCompositePolyDataMapper> mapper;
#else
  vtkNew<vtkCompositePolyDataMapper2> mapper;
#endif
  mapper->SetInputDataObject(blocks);
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  mapper->SetCompositeDataDisplayAttributes(attributes);
  const double blue[3] = { 0.2, 0.4, 0.9 };
  attributes->SetBlockColor(blocks->GetBlock(1), blue);
  attributes->SetBlockVisibility(blocks->GetBlock(2), false);
  attributes->SetBlockOpacity(blocks->GetBlock(3), 0.4);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
}

void AddBlockWithoutScalars(vtkRenderer* renderer)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakePlane());
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.3);
  sphere->SetThetaResolution(24);
  blocks->SetBlock(1, Make(sphere.Get()));
  vtkNew<vtkDoubleArray> values;
  values->SetName("Values");
  for (vtkIdType i = 0; i < MakePlane()->GetNumberOfPoints(); ++i)
  {
    values->InsertNextValue(static_cast<double>(i % 3));
  }
  vtkPolyData::SafeDownCast(blocks->GetBlock(0))->GetPointData()->AddArray(values);
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  vtkNew<vtkCompositePolyDataMapper> mapper;
#else
  vtkNew<vtkCompositePolyDataMapper2> mapper;
#endif
  mapper->SetInputDataObject(blocks);
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray("Values");
  mapper->SetScalarRange(0.0, 2.0);
  vtkNew<vtkLookupTable> table;
  table->SetNanColor(0.9, 0.2, 0.7, 1.0);
  mapper->SetLookupTable(table);
  mapper->SetColorMissingArraysWithNanColor(true);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
}

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
void AddTexturedBlock(vtkRenderer* renderer)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakePlane());
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  vtkNew<vtkCompositePolyDataMapper> mapper;
  mapper->SetInputDataObject(blocks);
  mapper->SetCompositeDataDisplayAttributes(attributes);
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(MakeImage(32, 32));
  texture->InterpolateOn();
  attributes->SetBlockTexture(blocks->GetBlock(0), texture);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
}
#endif

void AddGhosts(vtkRenderer* renderer)
{
  vtkSmartPointer<vtkPolyData> plane = MakePlane(8);
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  for (vtkIdType i = 0; i < plane->GetNumberOfCells(); ++i)
  {
    ghosts->InsertNextValue(i % 3 == 0 ? vtkDataSetAttributes::HIDDENCELL
        : i % 3 == 1                   ? vtkDataSetAttributes::DUPLICATECELL
                                       : 0);
  }
  plane->GetCellData()->AddArray(ghosts);
  Add(renderer, plane);
}

void AddPhysicallyBased(vtkRenderer* renderer, bool texture, bool headlight)
{
  vtkNew<vtkPlaneSource> source;
  for (int i = 0; i < 9; ++i)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(1.1 * (i % 3), 1.1 * (i / 3), 0.0);
    sphere->SetThetaResolution(48);
    sphere->SetPhiResolution(48);
    vtkActor* actor = Add(renderer, Make(sphere.Get()));
    if (texture && i % 2 == 0)
    {
      actor->GetMapper()->RemoveAllInputs();
      source->SetOrigin(1.1 * (i % 3) - 0.5, 1.1 * (i / 3) - 0.5, 0.0);
      source->SetPoint1(1.1 * (i % 3) + 0.5, 1.1 * (i / 3) - 0.5, 0.0);
      source->SetPoint2(1.1 * (i % 3) - 0.5, 1.1 * (i / 3) + 0.5, 0.0);
      vtkNew<vtkPolyData> plane;
      plane->DeepCopy(Make(source.Get()));
      vtkPolyDataMapper::SafeDownCast(actor->GetMapper())->SetInputData(plane);
      vtkNew<vtkTexture> image;
      image->SetInputData(MakeImage(64, 64));
      image->InterpolateOn();
      image->UseSRGBColorSpaceOn();
      actor->GetProperty()->SetBaseColorTexture(image);
      actor->GetProperty()->SetColor(1.0, 1.0, 1.0);
    }
    actor->GetProperty()->SetInterpolationToPBR();
    actor->GetProperty()->SetMetallic(0.5 * (i % 3));
    actor->GetProperty()->SetRoughness(0.1 + 0.4 * (i / 3));
  }
  if (!headlight)
  {
    vtkNew<vtkLight> light;
    light->SetPosition(3.0, 5.0, 6.0);
    light->SetFocalPoint(1.0, 1.0, 0.0);
    light->SetColor(1.0, 0.9, 0.8);
    renderer->AddLight(light);
    vtkNew<vtkLight> positional;
    positional->SetPositional(true);
    positional->SetConeAngle(90.0);
    positional->SetPosition(-2.0, 1.0, 3.0);
    positional->SetIntensity(0.6);
    renderer->AddLight(positional);
  }
}

void AddSlice(vtkRenderer* renderer, bool cropped)
{
  vtkNew<vtkImageData> volume;
  volume->SetDimensions(20, 16, 12);
  volume->SetSpacing(1.0, 1.2, 0.8);
  volume->AllocateScalars(VTK_FLOAT, 1);
  for (int k = 0; k < 12; ++k)
  {
    for (int j = 0; j < 16; ++j)
    {
      for (int i = 0; i < 20; ++i)
      {
        volume->SetScalarComponentFromDouble(
          i, j, k, 0, 50.0 + 40.0 * std::sin(0.7 * i) * std::cos(0.5 * j + 0.3 * k));
      }
    }
  }
  for (int axis = 0; axis < (cropped ? 1 : 3); ++axis)
  {
    vtkNew<vtkImageSliceMapper> mapper;
    mapper->SetInputData(volume);
    mapper->SetOrientation(axis);
    mapper->SetSliceNumber(5 + axis);
    if (cropped)
    {
      mapper->SetOrientationToZ();
      mapper->CroppingOn();
      mapper->SetCroppingRegion(3, 15, 2, 12, 0, 11);
      mapper->BorderOn();
    }
    vtkNew<vtkImageSlice> slice;
    slice->SetMapper(mapper);
    slice->GetProperty()->SetColorWindow(80.0);
    slice->GetProperty()->SetColorLevel(50.0);
    if (cropped)
    {
      vtkNew<vtkLookupTable> table;
      table->SetRange(10.0, 90.0);
      table->Build();
      slice->GetProperty()->SetLookupTable(table);
      slice->GetProperty()->UseLookupTableScalarRangeOn();
      slice->GetProperty()->SetInterpolationTypeToNearest();
    }
    renderer->AddViewProp(slice);
  }
  Look(renderer);
}

void AddAxesLayer(vtkRenderWindow* window, vtkProp* prop)
{
  vtkNew<vtkRenderer> layer;
  layer->SetLayer(1);
  layer->InteractiveOff();
  layer->SetViewport(0.0, 0.0, 0.4, 0.4);
  layer->AddViewProp(prop);
  layer->GetActiveCamera()->SetPosition(1.0, 0.8, 2.0);
  layer->ResetCamera();
  window->SetNumberOfLayers(2);
  window->AddRenderer(layer);
}

void StyleText(vtkTextProperty* property)
{
  property->SetFontSize(24);
  property->SetColor(1.0, 1.0, 0.6);
}

void SetGradient(vtkRenderer* renderer)
{
  renderer->GradientBackgroundOn();
  renderer->SetBackground(0.1, 0.2, 0.6);
  renderer->SetBackground2(0.9, 0.8, 0.3);
  Add(renderer, MakeSphere());
}
