// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Every scene here is drawn by VTK's rasteriser too: inside cells both agree to 2/255.
#include "Shading.h"

#include "RasterComparison.h"
#include "SceneExtraction.h"

#include "vtkActor.h"
#include "vtkAssembly.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositePolyDataMapper.h"
#include "vtkCubeSource.h"
#include "vtkDataSetMapper.h"
#include "vtkDoubleArray.h"
#include "vtkElevationFilter.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkGlyph3DMapper.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLookupTable.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPlane.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPointDataToCellData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkTexture.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace penumbra;

namespace
{

/// A sphere of large cells, with smooth normals.
vtkSmartPointer<vtkPolyData> Sphere(int resolution = 8)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->Update();
  return source->GetOutput();
}

vtkSmartPointer<vtkPolyData> WithElevation(vtkPolyData* data)
{
  vtkNew<vtkElevationFilter> elevation;
  elevation->SetInputData(data);
  elevation->SetLowPoint(-.3, 0., -.5);
  elevation->SetHighPoint(.2, .1, .5);
  elevation->Update();
  return vtkPolyData::SafeDownCast(elevation->GetOutput());
}

/// One actor seen from a side that no symmetry favours.
class ShadingOfActor : public ::testing::Test
{
public:
  void Show(vtkPolyData* data)
  {
    this->Mapper->SetInputData(data);
    this->Actor->SetMapper(this->Mapper);
    this->Renderer()->AddActor(this->Actor);
    this->Renderer()->GetActiveCamera()->SetPosition(1.0, .7, 1.3);
    this->Renderer()->GetActiveCamera()->SetViewUp(.1, 1.0, 0.0);
    this->Renderer()->ResetCamera();
  }

  void ExpectSamePicture(int pixels = 500, double tolerance = 2.0)
  {
    const RasterComparison::Result result = this->Pictures.Compare();
    EXPECT_GE(result.Pixels, pixels);
    EXPECT_LE(result.Largest, tolerance)
      << result.Different << " of " << result.Pixels << " pixels differ, most at "
      << result.Where[0] << ", " << result.Where[1];
    EXPECT_TRUE(result.Scene.Warnings.empty()) << result.Scene.Warnings.front();
  }

  vtkRenderer* Renderer() { return this->Pictures.Renderer; }
  vtkProperty* Property() { return this->Actor->GetProperty(); }

  RasterComparison Pictures;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkPolyDataMapper> Mapper;
};

}

TEST_F(ShadingOfActor, IsVTKsWhenSmooth)
{
  this->Show(Sphere());
  this->Property()->SetColor(.9, .5, .2);
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsWhenFlat)
{
  this->Show(Sphere());
  this->Property()->SetInterpolationToFlat();
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsWithoutNormals)
{
  vtkNew<vtkCubeSource> cube;
  cube->Update();
  cube->GetOutput()->GetPointData()->SetNormals(nullptr);
  this->Show(cube->GetOutput());
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsWithNormalsOfCells)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(Sphere());
  normals->ComputePointNormalsOff();
  normals->ComputeCellNormalsOn();
  normals->Update();
  normals->GetOutput()->GetPointData()->SetNormals(nullptr);
  this->Show(normals->GetOutput());
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsWithAmbientLightAndHighlight)
{
  this->Show(Sphere());
  this->Property()->SetAmbient(.2);
  this->Property()->SetAmbientColor(.1, .9, .4);
  this->Property()->SetDiffuse(.6);
  this->Property()->SetSpecular(.5);
  this->Property()->SetSpecularColor(1.0, .8, .1);
  this->Property()->SetSpecularPower(15.0);
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsWithoutLighting)
{
  this->Show(Sphere());
  this->Property()->SetAmbient(.3);
  this->Property()->SetDiffuse(.6);
  this->Property()->SetColor(.9, .5, .2);
  this->Property()->LightingOff();
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsWithColorsOfPoints)
{
  this->Show(WithElevation(Sphere()));
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsWithColorsOfCells)
{
  vtkNew<vtkPointDataToCellData> cells;
  cells->SetInputData(WithElevation(Sphere()));
  cells->PassPointDataOff();
  cells->Update();
  this->Show(vtkPolyData::SafeDownCast(cells->GetOutput()));
  this->Property()->SetInterpolationToFlat();
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsWhenScalarsAreInterpolatedBeforeMapping)
{
  this->Show(WithElevation(Sphere()));
  this->Mapper->InterpolateScalarsBeforeMappingOn();
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(256);
  table->Build();
  this->Mapper->SetLookupTable(table);
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsWithALogarithmicTableAndNaN)
{
  vtkSmartPointer<vtkPolyData> data = WithElevation(Sphere());
  data->GetPointData()->GetScalars()->SetComponent(5, 0, std::nan(""));
  this->Show(data);
  vtkNew<vtkLookupTable> table;
  table->SetScaleToLog10();
  table->SetNanColor(.9, .1, .9, 1.0);
  this->Mapper->SetLookupTable(table);
  this->Mapper->SetScalarRange(.05, 1.0);
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsWithCategories)
{
  vtkSmartPointer<vtkPolyData> data = Sphere();
  vtkNew<vtkDoubleArray> kinds;
  kinds->SetName("kinds");
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    kinds->InsertNextValue(i % 5);
  }
  data->GetCellData()->SetScalars(kinds);
  this->Show(data);
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(3);
  for (int i = 0; i < 3; ++i)
  {
    table->SetTableValue(i, i == 0, i == 1, i == 2);
    table->SetAnnotation(vtkVariant(2 * i), "kind");
  }
  table->SetIndexedLookup(true);
  this->Mapper->SetLookupTable(table);
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsInsideWithABackfaceProperty)
{
  this->Show(Sphere());
  this->Property()->SetFrontfaceCulling(true);
  vtkNew<vtkProperty> back;
  back->SetColor(.1, .8, .3);
  back->SetSpecular(.4);
  back->SetSpecularPower(4.0);
  this->Actor->SetBackfaceProperty(back);
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsWhenMirrored)
{
  this->Show(Sphere());
  this->Actor->SetScale(-1.0, 1.2, .8);
  this->Actor->RotateX(20.0);
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsUnderALightKit)
{
  this->Show(Sphere());
  this->Property()->SetSpecular(.3);
  this->Property()->SetSpecularPower(8.0);
  vtkNew<vtkLight> key;
  key->SetLightTypeToCameraLight();
  key->SetPosition(1.0, 1.0, .5);
  key->SetColor(1.0, .8, .7);
  key->SetIntensity(.8);
  vtkNew<vtkLight> fill;
  fill->SetLightTypeToSceneLight();
  fill->SetPosition(-3.0, 1.0, 2.0);
  fill->SetIntensity(.5);
  vtkNew<vtkLight> off;
  off->SwitchOff();
  this->Renderer()->AddLight(key);
  this->Renderer()->AddLight(fill);
  this->Renderer()->AddLight(off);
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsUnderPositionalLightsAndSpots)
{
  this->Show(Sphere());
  this->Property()->SetSpecular(.3);
  this->Property()->SetSpecularPower(8.0);
  vtkNew<vtkLight> lamp;
  lamp->PositionalOn();
  lamp->SetPosition(2.0, 1.0, .5);
  lamp->SetConeAngle(100.0);
  lamp->SetAttenuationValues(.5, .2, .1);
  vtkNew<vtkLight> spot;
  spot->PositionalOn();
  spot->SetPosition(0.0, 1.5, 2.0);
  spot->SetFocalPoint(.1, .2, 0.0);
  spot->SetConeAngle(12.0);
  spot->SetExponent(3.0);
  spot->SetColor(.2, .3, 1.0);
  this->Renderer()->AddLight(lamp);
  this->Renderer()->AddLight(spot);
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsUnderAParallelCamera)
{
  this->Show(Sphere());
  this->Renderer()->GetActiveCamera()->ParallelProjectionOn();
  this->Renderer()->GetActiveCamera()->SetWindowCenter(.2, -.1);
  this->Property()->SetInterpolationToFlat();
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsInHighlightsUnderAParallelCamera)
{
  this->Show(Sphere());
  this->Renderer()->GetActiveCamera()->ParallelProjectionOn();
  this->Property()->SetSpecular(.5);
  this->Property()->SetSpecularPower(6.0);
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPosition(3.0, 1.0, 2.0);
  this->Renderer()->AddLight(light);
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsOffCentreWithAHorizontalAngle)
{
  this->Show(Sphere());
  this->Renderer()->GetActiveCamera()->SetWindowCenter(.2, -.1);
  this->Renderer()->GetActiveCamera()->UseHorizontalViewAngleOn();
  this->Renderer()->GetActiveCamera()->Roll(20.0);
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsOverAGradient)
{
  this->Show(Sphere());
  this->Renderer()->GradientBackgroundOn();
  this->Renderer()->SetBackground2(.9, .1, .1);
  this->Property()->SetOpacity(.3);
  this->Property()->BackfaceCullingOn();
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsWithATexture)
{
  vtkNew<vtkPlaneSource> plane;
  plane->Update();
  this->Show(plane->GetOutput());
  vtkNew<vtkImageData> image;
  image->SetDimensions(4, 3, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (vtkIdType i = 0; i < 36; ++i)
  {
    image->GetPointData()->GetScalars()->SetComponent(i / 3, i % 3, (i * 67) % 256);
  }
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->InterpolateOn();
  this->Actor->SetTexture(texture);
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsWithATextureThatRepeatsOrStopsWithoutInterpolation)
{
  vtkNew<vtkPlaneSource> plane;
  plane->Update();
  vtkDataArray* coordinates = plane->GetOutput()->GetPointData()->GetTCoords();
  for (vtkIdType i = 0; i < 4; ++i)
  {
    coordinates->SetTuple2(i, 2.3 * (i % 2) - .7, 1.9 * (i / 2) - .4);
  }
  this->Show(plane->GetOutput());
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (vtkIdType i = 0; i < 18; ++i)
  {
    image->GetPointData()->GetScalars()->SetComponent(i / 3, i % 3, (i * 67) % 256);
  }
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  this->Actor->SetTexture(texture);
  for (const bool repeat : { true, false })
  {
    texture->SetRepeat(repeat);
    texture->SetEdgeClamp(!repeat);
    // Centres of pixels on the border of two texels may fall to either.
    const RasterComparison::Result result = this->Pictures.Compare();
    EXPECT_GE(result.Pixels, 1000);
    EXPECT_LE(result.Different, .02 * result.Pixels) << repeat;
  }
}

TEST_F(ShadingOfActor, IsVTKsOnConcavePolygonsAndStrips)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> values;
  const double corners[6][2] = { { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } };
  for (int i = 0; i < 6; ++i)
  {
    points->InsertNextPoint(corners[i][0], corners[i][1], 0.0);
    values->InsertNextValue((i * 5) % 7);
  }
  for (int i = 0; i < 6; ++i)
  {
    points->InsertNextPoint(2.2 + .5 * (i / 2), i % 2, .2 * i);
    values->InsertNextValue((i * 3) % 7);
  }
  vtkNew<vtkCellArray> polygons;
  const vtkIdType polygon[6] = { 0, 1, 2, 3, 4, 5 };
  polygons->InsertNextCell(6, polygon);
  vtkNew<vtkCellArray> strips;
  const vtkIdType strip[6] = { 6, 7, 8, 9, 10, 11 };
  strips->InsertNextCell(6, strip);
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(polygons);
  data->SetStrips(strips);
  data->GetPointData()->SetScalars(values);
  this->Show(data);
  this->Mapper->SetScalarRange(0.0, 6.0);
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsInOneColorFromFieldData)
{
  vtkSmartPointer<vtkPolyData> data = Sphere();
  vtkNew<vtkDoubleArray> values;
  values->SetName("time");
  values->InsertNextValue(.1);
  values->InsertNextValue(.7);
  data->GetFieldData()->AddArray(values);
  this->Show(data);
  this->Mapper->SetScalarModeToUseFieldData();
  this->Mapper->SelectColorArray("time");
  this->Mapper->SetFieldDataTupleId(1);
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsInColorsStoredAsBytes)
{
  vtkSmartPointer<vtkPolyData> data = Sphere();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    colors->InsertNextTuple3((i * 37) % 256, (i * 91) % 256, (i * 13) % 256);
  }
  data->GetPointData()->SetScalars(colors);
  this->Show(data);
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsBehindClippingPlanes)
{
  this->Show(Sphere(6));
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(.1, 0.0, 0.0);
  plane->SetNormal(-1.0, .3, -.2);
  this->Mapper->AddClippingPlane(plane);
  this->ExpectSamePicture(300);
}

TEST_F(ShadingOfActor, IsVTKsInAnAssemblyOfTransformedParts)
{
  this->Show(Sphere());
  this->Renderer()->RemoveActor(this->Actor);
  vtkNew<vtkAssembly> inner;
  inner->AddPart(this->Actor);
  inner->RotateY(30.0);
  inner->SetScale(.7, 1.0, 1.1);
  vtkNew<vtkAssembly> outer;
  outer->AddPart(inner);
  outer->AddPosition(.1, .05, 0.0);
  this->Renderer()->AddActor(outer);
  this->ExpectSamePicture(300);
}

namespace
{

/// Lines of some width across the picture.
vtkSmartPointer<vtkPolyData> Lines(bool normals)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkFloatArray> directions;
  directions->SetNumberOfComponents(3);
  vtkNew<vtkDoubleArray> values;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      points->InsertNextPoint(j, i * .8 + .2 * j, .1 * i * j);
      directions->InsertNextTuple3(.3 * j - .3, .2 * i, 1.0);
      values->InsertNextValue(i + j);
    }
    const vtkIdType line[3] = { 3 * i, 3 * i + 1, 3 * i + 2 };
    cells->InsertNextCell(3, line);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(cells);
  data->GetPointData()->SetScalars(values);
  if (normals)
  {
    data->GetPointData()->SetNormals(directions);
  }
  return data;
}

}

TEST_F(ShadingOfActor, IsVTKsOnLines)
{
  this->Show(Lines(false));
  this->Mapper->SetScalarRange(0.0, 4.0);
  this->Property()->SetLineWidth(9.0);
  // Without multisampling OpenGL interpolates along rows or columns of pixels, not along the line.
  this->ExpectSamePicture(300, 5.0);
}

TEST_F(ShadingOfActor, IsVTKsOnLinesWithNormals)
{
  this->Show(Lines(true));
  this->Mapper->ScalarVisibilityOff();
  this->Property()->SetLineWidth(9.0);
  this->ExpectSamePicture(300);
}

TEST_F(ShadingOfActor, IsVTKsOnWireframes)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(2, 2);
  plane->Update();
  this->Show(plane->GetOutput());
  this->Property()->SetRepresentationToWireframe();
  this->Property()->SetLineWidth(9.0);
  // Lines that meet in a corner overlap differently: most pixels must agree.
  const RasterComparison::Result result = this->Pictures.Compare();
  EXPECT_GE(result.Pixels, 1000);
  EXPECT_LE(result.Different, .06 * result.Pixels);
}

TEST_F(ShadingOfActor, IsVTKsOnWireframesWithoutNormals)
{
  vtkNew<vtkCubeSource> cube;
  cube->Update();
  cube->GetOutput()->GetPointData()->SetNormals(nullptr);
  this->Show(cube->GetOutput());
  this->Property()->SetRepresentationToWireframe();
  this->Property()->SetLineWidth(9.0);
  const RasterComparison::Result result = this->Pictures.Compare();
  EXPECT_GE(result.Pixels, 1000);
  EXPECT_LE(result.Different, .06 * result.Pixels);
}

TEST_F(ShadingOfActor, IsVTKsOnPoints)
{
  this->Show(WithElevation(Sphere()));
  this->Property()->SetRepresentationToPoints();
  this->Property()->SetPointSize(7.0);
  this->ExpectSamePicture(100);
}

TEST_F(ShadingOfActor, IsVTKsWithVisibleEdgesAndVertices)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(3, 3);
  plane->Update();
  this->Show(plane->GetOutput());
  this->Property()->EdgeVisibilityOn();
  this->Property()->SetEdgeColor(.9, .2, .1);
  this->Property()->SetLineWidth(5.0);
  this->Property()->VertexVisibilityOn();
  this->Property()->SetVertexColor(.1, .9, .2);
  this->Property()->SetPointSize(9.0);
  // VTK draws of edges at a border the inner half only.
  const RasterComparison::Result result = this->Pictures.Compare();
  EXPECT_GE(result.Pixels, 1000);
  EXPECT_LE(result.Different, .2 * result.Pixels);
}

TEST_F(ShadingOfActor, IsVTKsOnGlyphs)
{
  vtkNew<vtkPlaneSource> points;
  points->SetResolution(2, 2);
  vtkNew<vtkElevationFilter> values;
  values->SetInputConnection(points->GetOutputPort());
  values->SetLowPoint(-.5, -.5, 0.0);
  values->SetHighPoint(.5, .6, 0.0);
  values->Update();
  vtkNew<vtkDoubleArray> directions;
  directions->SetName("directions");
  directions->SetNumberOfComponents(3);
  for (int i = 0; i < 9; ++i)
  {
    directions->InsertNextTuple3(1.0 - .3 * i, .2 * i, .5 - .1 * i);
  }
  values->GetOutput()->GetPointData()->AddArray(directions);
  for (const int mode : { vtkGlyph3DMapper::DIRECTION, vtkGlyph3DMapper::ROTATION })
  {
    vtkNew<vtkCubeSource> cube;
    cube->SetXLength(2.0);
    vtkNew<vtkGlyph3DMapper> mapper;
    mapper->SetInputData(values->GetOutput());
    mapper->SetSourceConnection(cube->GetOutputPort());
    mapper->SetOrientationArray("directions");
    mapper->SetOrientationMode(mode);
    mapper->SetScaleArray("directions");
    mapper->SetScaleModeToScaleByMagnitude();
    mapper->SetScaleFactor(.15);
    this->Actor->SetMapper(mapper);
    this->Actor->SetScale(1.0, 1.2, .9);
    this->Renderer()->AddActor(this->Actor);
    this->Renderer()->GetActiveCamera()->SetPosition(1.0, .7, 1.3);
    this->Renderer()->ResetCamera();
    this->ExpectSamePicture(300);
    mapper->ScalarVisibilityOff();
    this->Property()->SetColor(.8, .6, .1);
    this->ExpectSamePicture(300);
  }
}

TEST_F(ShadingOfActor, IsVTKsOnBlocksOfTheirOwnLook)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned int i = 0; i < 4; ++i)
  {
    vtkNew<vtkCubeSource> cube;
    cube->SetCenter(i % 2 * 1.2, i / 2 * 1.2, 0.0);
    cube->Update();
    vtkNew<vtkDoubleArray> values;
    values->SetName("values");
    for (vtkIdType k = 0; k < 24; ++k)
    {
      values->InsertNextValue(k / 24.0);
    }
    cube->GetOutput()->GetPointData()->AddArray(values);
    blocks->SetBlock(i, cube->GetOutput());
  }
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  vtkNew<vtkCompositePolyDataMapper> mapper;
  mapper->SetInputDataObject(blocks);
  mapper->SetCompositeDataDisplayAttributes(attributes);
  const double color[3] = { .9, .3, .2 };
  mapper->SetBlockColor(2, color);
  mapper->SetBlockVisibility(3, false);
  mapper->SetBlockOpacity(1, .5);
  this->Property()->BackfaceCullingOn(); // VTK blends faces in any order
  this->Actor->SetMapper(mapper);
  this->Property()->SetColor(.2, .6, .9);
  this->Renderer()->AddActor(this->Actor);
  this->Renderer()->GetActiveCamera()->SetPosition(1.0, .7, 1.3);
  this->Renderer()->ResetCamera();
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsOnTheSurfaceOfAGrid)
{
  vtkNew<vtkImageData> grid;
  grid->SetDimensions(4, 3, 3);
  vtkNew<vtkDoubleArray> values;
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    values->InsertNextValue((i * 7) % 11);
  }
  grid->GetPointData()->SetScalars(values);
  vtkNew<vtkDataSetMapper> mapper;
  mapper->SetInputData(grid);
  mapper->SetScalarRange(0.0, 10.0);
  this->Actor->SetMapper(mapper);
  this->Renderer()->AddActor(this->Actor);
  this->Renderer()->GetActiveCamera()->SetPosition(1.0, .7, 1.3);
  this->Renderer()->ResetCamera();
  this->ExpectSamePicture();
}

TEST_F(ShadingOfActor, IsVTKsOnBlocksWithScalarsOfTheirOwn)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned int i = 0; i < 2; ++i)
  {
    vtkNew<vtkCubeSource> cube;
    cube->SetCenter(i * 1.2, 0.0, 0.0);
    cube->Update();
    vtkNew<vtkDoubleArray> values;
    values->SetName("values");
    for (vtkIdType k = 0; k < 24; ++k)
    {
      values->InsertNextValue(k / 24.0);
    }
    cube->GetOutput()->GetPointData()->SetScalars(values);
    blocks->SetBlock(i, cube->GetOutput());
  }
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  vtkNew<vtkCompositePolyDataMapper> mapper;
  mapper->SetInputDataObject(blocks);
  mapper->SetCompositeDataDisplayAttributes(attributes);
  attributes->SetBlockScalarVisibility(blocks->GetBlock(1), false);
  this->Actor->SetMapper(mapper);
  this->Renderer()->AddActor(this->Actor);
  this->Renderer()->GetActiveCamera()->SetPosition(1.0, .7, 1.3);
  this->Renderer()->ResetCamera();
  this->ExpectSamePicture();
}

namespace
{

/// A floor and a small square above it, under one light from straight above.
Scene FloorUnderSquare(float opacity)
{
  Scene scene;
  scene.Eye.Position = { 0.0, -3.0, 3.0 };
  for (const float height : { 0.f, 1.f })
  {
    const float side = height > 0.f ? .5f : 2.f;
    Surface square;
    square.Positions = { { -side, -side, height }, { side, -side, height }, { side, side, height },
      { -side, side, height } };
    square.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
    square.Front.Opacity = height > 0.f ? opacity : 1.f;
    square.Front.Ambient = .1f;
    scene.Surfaces.push_back(square);
  }
  Light light;
  light.Direction = { 0.f, 0.f, -1.f };
  scene.Lights.push_back(light);
  return scene;
}

/// What the floor looks like at (x, y).
float Floor(const Scene& scene, bool shadows, float x, float y, long long& rays)
{
  const RayScene traced(scene, 1);
  const Shading shading(traced, shadows);
  const Ray ray{ { x, y, .5f }, { 0.f, 0.f, -1.f } };
  return shading.Shade(ray, traced.Intersect(ray), rays).Color.r;
}

}

TEST(Shading, CastsShadowsWhereAsked)
{
  long long rays = 0;
  Scene scene = FloorUnderSquare(1.f);
  EXPECT_FLOAT_EQ(Floor(scene, false, .1f, .2f, rays), 1.1f);
  EXPECT_EQ(rays, 0);
  EXPECT_FLOAT_EQ(Floor(scene, true, .1f, .2f, rays), .1f);
  EXPECT_FLOAT_EQ(Floor(scene, true, .6f, .2f, rays), 1.1f);
  EXPECT_EQ(rays, 2);
  scene.Lights[0].CastsShadow = false;
  EXPECT_FLOAT_EQ(Floor(scene, true, .1f, .2f, rays), 1.1f);
  scene.Lights[0].CastsShadow = true;
  scene.Lights[0].Kind = Light::Kinds::Positional;
  scene.Lights[0].Position = { 0.f, 0.f, .5f }; // below the square
  EXPECT_GT(Floor(scene, true, .1f, .2f, rays), .8f);
}

TEST(Shading, LetsLightThroughTranslucentSurfacesAndLines)
{
  long long rays = 0;
  Scene scene = FloorUnderSquare(.25f);
  EXPECT_NEAR(Floor(scene, true, .1f, .2f, rays), .85f, 1e-6);
  scene.Surfaces[1].Front.Opacity = 1.f;
  scene.Surfaces[1].ScreenSpace = true;
  EXPECT_NEAR(Floor(scene, true, .1f, .2f, rays), 1.1f, 1e-6);
}

TEST(Shading, KnowsWhereOneSampleServesATriangle)
{
  Scene scene = FloorUnderSquare(1.f);
  const auto isConstant = [&](bool shadows) {
    const RayScene rays(scene, 1);
    return Shading(rays, shadows).IsConstantPerTriangle(0);
  };
  EXPECT_TRUE(isConstant(false));
  EXPECT_FALSE(isConstant(true));
  scene.Surfaces[0].Front.Specular = .5f;
  EXPECT_FALSE(isConstant(false));
  scene.Lights[0].Headlight = true; // lit without a view ray
  EXPECT_TRUE(isConstant(false));
  scene.Lights[0].Headlight = false;
  scene.Surfaces[0].Front.Specular = 0.f;
  scene.Lights[0].Kind = Light::Kinds::Positional;
  EXPECT_FALSE(isConstant(false));
  scene.Surfaces[0].Front.Lighting = false;
  EXPECT_TRUE(isConstant(true));
  scene.Surfaces[0].PointColors.resize(4, glm::u8vec4(255));
  EXPECT_FALSE(isConstant(false));
}

TEST(Shading, SurvivesNormalsOfNoLengthAndNoNumber)
{
  Scene scene = FloorUnderSquare(1.f);
  long long rays = 0;
  for (const float bad : { 0.f, std::nanf(""), std::numeric_limits<float>::infinity() })
  {
    scene.Surfaces[0].Normals.assign(4, glm::vec3(bad));
    EXPECT_FLOAT_EQ(Floor(scene, false, .1f, .2f, rays), 1.1f) << bad;
  }
}
