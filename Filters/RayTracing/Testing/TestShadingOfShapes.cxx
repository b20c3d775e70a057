// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares polygons, lines, points, glyphs, composite data, assemblies and clipping planes with
// VTK's rasterizer.
#include "ShadingOfActor.h"
#include "Surface.h"

#include "vtkAssembly.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositePolyDataMapper.h"
#include "vtkCubeSource.h"
#include "vtkDataSetMapper.h"
#include "vtkDoubleArray.h"
#include "vtkElevationFilter.h"
#include "vtkFloatArray.h"
#include "vtkGlyph3DMapper.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPlane.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVersionMacros.h"

TEST_F(ActorShadingTest, MatchesVTKForConcavePolygonsAndStrips)
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
  this->SetMesh(data);
  this->Mapper->SetScalarRange(0.0, 6.0);
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKWithClippingPlanes)
{
  this->SetMesh(Sphere(6));
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(.1, 0.0, 0.0);
  plane->SetNormal(-1.0, .3, -.2);
  this->Mapper->AddClippingPlane(plane);
  this->ExpectSameImage(300);
}

TEST_F(ActorShadingTest, MatchesVTKForAssemblyOfTransformedParts)
{
  this->SetMesh(Sphere());
  this->Renderer()->RemoveActor(this->Actor);
  vtkNew<vtkAssembly> inner;
  inner->AddPart(this->Actor);
  inner->RotateY(30.0);
  inner->SetScale(.7, 1.0, 1.1);
  vtkNew<vtkAssembly> outer;
  outer->AddPart(inner);
  outer->AddPosition(.1, .05, 0.0);
  this->Renderer()->AddActor(outer);
  this->ExpectSameImage(300);
}

namespace
{

/// Returns wide lines across the image.
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

/// VTK approximates the normals of spheres near their outlines. Other colors differ by more than 200.
constexpr double SphereTolerance = 60.0;

/// A row of points with colors of a number of components; each twice, with different colors, if `twice`.
vtkSmartPointer<vtkPolyData> ColoredPoints(int components, bool twice)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(components);
  for (vtkIdType i = 0; i < (twice ? 8 : 4); ++i)
  {
    points->InsertNextPoint(.3 * static_cast<double>(i % 4), 0.0, 0.0);
    cells->InsertNextCell(1, &i);
    const double color[] = { i < 4 ? 20.0 : 250.0, 60.0 * static_cast<double>(i % 4),
      i < 4 ? 30.0 : 220.0, 150.0 };
    colors->InsertNextTuple(color);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetVerts(cells);
  data->GetPointData()->SetScalars(colors);
  return data;
}

}

TEST_F(ActorShadingTest, MatchesVTKForLines)
{
  this->SetMesh(Lines(false));
  this->Mapper->SetScalarRange(0.0, 4.0);
  this->Property()->SetLineWidth(9.0);
  // Without multisampling OpenGL interpolates along rows or columns of pixels, not along the line.
  this->ExpectSameImage(300, 5.0);
}

TEST_F(ActorShadingTest, MatchesVTKForLinesWithNormals)
{
  this->SetMesh(Lines(true));
  this->Mapper->ScalarVisibilityOff();
  this->Property()->SetLineWidth(9.0);
  this->ExpectSameImage(300);
}

TEST_F(ActorShadingTest, MatchesVTKForWireframes)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(2, 2);
  plane->Update();
  this->SetMesh(plane->GetOutput());
  this->Property()->SetRepresentationToWireframe();
  this->Property()->SetLineWidth(9.0);
  // Lines that meet at a vertex overlap differently, so only most pixels must agree.
  const RasterComparison::Result result = this->Comparison.Compare();
  EXPECT_GE(result.Pixels, 1000);
  EXPECT_LE(result.Different, .06 * result.Pixels);
}

TEST_F(ActorShadingTest, MatchesVTKForWireframesWithoutNormals)
{
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 0)
  GTEST_SKIP() << "This version of VTK lights such lines differently.";
#endif
  vtkNew<vtkCubeSource> cube;
  cube->Update();
  cube->GetOutput()->GetPointData()->SetNormals(nullptr);
  this->SetMesh(cube->GetOutput());
  this->Property()->SetRepresentationToWireframe();
  this->Property()->SetLineWidth(9.0);
  const RasterComparison::Result result = this->Comparison.Compare();
  EXPECT_GE(result.Pixels, 1000);
  EXPECT_LE(result.Different, .06 * result.Pixels);
}

TEST_F(ActorShadingTest, MatchesVTKForPoints)
{
  this->SetMesh(WithElevation(Sphere()));
  this->Property()->SetRepresentationToPoints();
  this->Property()->SetPointSize(7.0);
  this->ExpectSameImage(100);
}

TEST_F(ActorShadingTest, MatchesVTKWithVisibleEdgesAndVertices)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(3, 3);
  plane->Update();
  this->SetMesh(plane->GetOutput());
  this->Property()->EdgeVisibilityOn();
  this->Property()->SetEdgeColor(.9, .2, .1);
  this->Property()->SetLineWidth(5.0);
  this->Property()->VertexVisibilityOn();
  this->Property()->SetVertexColor(.1, .9, .2);
  this->Property()->SetPointSize(9.0);
  // VTK draws only the inner half of silhouette edges.
  const RasterComparison::Result result = this->Comparison.Compare();
  EXPECT_GE(result.Pixels, 1000);
  EXPECT_LE(result.Different, .2 * result.Pixels);
}

TEST_F(ActorShadingTest, MatchesVTKForVerticesInThePlaceOfPoints)
{
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 0)
  GTEST_SKIP() << "This version of VTK shows the points instead.";
#endif
  this->Property()->SetPointSize(20.0);
  // VTK's depth peeling shows the largest red, green and blue: those of the vertices.
  this->Property()->SetVertexColor(1.0, .8, 1.0);
  this->Property()->VertexVisibilityOn();
  this->Renderer()->UseDepthPeelingOn();
  this->Renderer()->SetOcclusionRatio(0.0);
  this->Comparison.Window->SetAlphaBitPlanes(1);
  for (const int representation : { VTK_POINTS, VTK_SURFACE })
  {
    this->Property()->SetRepresentation(representation);
    for (const int components : { 3, 4 }) // opaque and translucent points, opaque vertices
    {
      this->SetMesh(ColoredPoints(components, false));
      this->Property()->RenderPointsAsSpheresOff();
      this->ExpectSameImage(300);
      this->Property()->RenderPointsAsSpheresOn();
      this->ExpectSameImage(300, SphereTolerance);
    }
  }
}

TEST_F(ActorShadingTest, MatchesVTKForPointsInOnePlace)
{
  this->SetMesh(ColoredPoints(3, true));
  this->Property()->SetPointSize(20.0);
  this->ExpectSameImage(300);
  this->Property()->RenderPointsAsSpheresOn();
  this->ExpectSameImage(300, SphereTolerance);
}

TEST_F(ActorShadingTest, MatchesVTKForGlyphs)
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
    this->Actor->SetScale(1.0, 1.2, .9);
    this->SetMapper(mapper);
    this->ExpectSameImage(300);
    mapper->ScalarVisibilityOff();
    this->Property()->SetColor(.8, .6, .1);
    this->ExpectSameImage(300);
  }
}

TEST_F(ActorShadingTest, MatchesVTKForInstancedGlyphs)
{
  vtkNew<vtkPlaneSource> points;
  points->SetResolution(11, 11);
  points->SetOrigin(-1.0, -1.0, 0.0);
  points->SetPoint1(1.0, -1.0, 0.0);
  points->SetPoint2(-1.0, 1.0, 0.0);
  vtkNew<vtkElevationFilter> values;
  values->SetInputConnection(points->GetOutputPort());
  values->SetLowPoint(-1.0, -1.0, 0.0);
  values->SetHighPoint(1.0, 1.2, 0.0);
  values->Update();
  vtkNew<vtkDoubleArray> directions;
  directions->SetName("directions");
  directions->SetNumberOfComponents(3);
  for (int i = 0; i < 144; ++i)
  {
    directions->InsertNextTuple3(1.01 - .005 * i, .6 + .01 * (i % 12), -.505 + .01 * i);
  }
  values->GetOutput()->GetPointData()->AddArray(directions);
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(values->GetOutput());
  mapper->SetSourceData(Sphere(30)); // 1,680 triangles
  mapper->SetOrientationArray("directions");
  mapper->SetScaleArray("directions");
  mapper->SetScaleModeToScaleByVectorComponents();
  mapper->SetScaleFactor(.3);
  this->Actor->SetScale(1.0, 1.2, .9);
  this->SetMapper(mapper);
  this->Property()->SetSpecular(.4);
  this->Property()->SetSpecularPower(10.0);
  this->ExpectSameImage(200);
  const RasterComparison::Result result = this->Comparison.Compare();
  ASSERT_EQ(result.Scene.Surfaces.size(), 1u);
  EXPECT_TRUE(result.Scene.Surfaces[0].Instances);
}

namespace
{

// vtkCompositePolyDataMapper has per-block attributes since VTK 9.3.
using Attributes = vtkCompositeDataDisplayAttributes;
template <typename Mapper>
auto SetAttributes(Mapper* mapper, Attributes* attributes, int)
  -> decltype(mapper->SetCompositeDataDisplayAttributes(attributes), bool())
{
  mapper->SetCompositeDataDisplayAttributes(attributes);
  return true;
}
template <typename Mapper>
bool SetAttributes(Mapper*, Attributes*, long)
{
  return false;
}
template <typename BlockAttributes>
auto HideScalars(BlockAttributes* attributes, vtkDataObject* block, int)
  -> decltype(attributes->SetBlockScalarVisibility(block, false))
{
  attributes->SetBlockScalarVisibility(block, false);
}
template <typename BlockAttributes>
void HideScalars(BlockAttributes*, vtkDataObject*, long)
{
}

/// Returns cubes in rows of two, with the array "values".
vtkSmartPointer<vtkMultiBlockDataSet> CubeBlocks(unsigned int count)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (unsigned int i = 0; i < count; ++i)
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
  return blocks;
}

}

TEST_F(ActorShadingTest, MatchesVTKForBlocksWithDisplayAttributes)
{
  const auto blocks = CubeBlocks(4);
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  vtkNew<vtkCompositePolyDataMapper> mapper;
  mapper->SetInputDataObject(blocks);
  if (!SetAttributes(mapper.Get(), attributes, 0))
  {
    GTEST_SKIP() << "The composite mapper of this version of VTK has no per-block attributes.";
  }
  const double color[3] = { .9, .3, .2 };
  attributes->SetBlockColor(blocks->GetBlock(1), color);
  attributes->SetBlockVisibility(blocks->GetBlock(2), false);
  attributes->SetBlockOpacity(blocks->GetBlock(0), .5);
  this->Property()->BackfaceCullingOn(); // VTK blends faces in any order
  this->Property()->SetColor(.2, .6, .9);
  this->SetMapper(mapper);
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKForSurfaceOfGrid)
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
  this->SetMapper(mapper);
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKForBlocksWithDifferentScalars)
{
  const auto blocks = CubeBlocks(2);
  for (unsigned int i = 0; i < 2; ++i)
  {
    vtkDataSet::SafeDownCast(blocks->GetBlock(i))->GetPointData()->SetActiveScalars("values");
  }
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  vtkNew<vtkCompositePolyDataMapper> mapper;
  mapper->SetInputDataObject(blocks);
  if (!SetAttributes(mapper.Get(), attributes, 0))
  {
    GTEST_SKIP() << "The composite mapper of this version of VTK has no per-block attributes.";
  }
  HideScalars(attributes.Get(), blocks->GetBlock(1), 0);
  this->SetMapper(mapper);
  this->ExpectSameImage();
}
