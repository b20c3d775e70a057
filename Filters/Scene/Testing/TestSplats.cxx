// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Splats of vtkPointGaussianMapper in the extracted scene.
#include "Import/SceneExtraction.h"
#include "Scene.h"
#include "Surface.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointGaussianMapper.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using penumbra::Scene;
using penumbra::Surface;

namespace
{

/// Two points, seen along the z axis.
class SplatsTest : public testing::Test
{
protected:
  void SetUp() override
  {
    vtkNew<vtkPoints> points;
    points->InsertNextPoint(0.0, 0.0, 0.0);
    points->InsertNextPoint(3.0, 0.0, 0.0);
    this->Data->SetPoints(points);
    this->Mapper->SetInputData(this->Data);
    this->Mapper->SetScaleFactor(0.5);
    this->Mapper->SetSplatShaderCode("if (dist2 > 1.0) { discard; }");
    vtkNew<vtkActor> actor;
    actor->SetMapper(this->Mapper);
    this->Renderer->AddActor(actor);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(0.0, 0.0, 10.0);
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetClippingRange(1.0, 100.0);
  }

  void SetScale(std::initializer_list<double> values)
  {
    vtkNew<vtkDoubleArray> scale;
    scale->SetName("Scale");
    for (const double value : values)
    {
      scale->InsertNextValue(value);
    }
    this->Data->GetPointData()->AddArray(scale);
    this->Mapper->SetScaleArray("Scale");
  }

  Scene Extract()
  {
    penumbra::ExtractionOptions options;
    options.Resolution[0] = options.Resolution[1] = 100;
    return penumbra::ExtractScene(this->Renderer, options);
  }

  /// Returns the extent of splat `i` along an axis, in world units.
  static double FindExtent(const Scene& scene, std::size_t i, int axis)
  {
    double low = 1e9;
    double high = -1e9;
    for (std::size_t k = 4 * i; k < 4 * i + 4; ++k)
    {
      const double x = scene.ToWorld(scene.Surfaces.at(0).Positions.at(k))[axis];
      low = std::min(low, x);
      high = std::max(high, x);
    }
    return high - low;
  }

  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkPolyData> Data;
  vtkNew<vtkPointGaussianMapper> Mapper;
};

}

TEST_F(SplatsTest, AreSquaresThatFaceAParallelCamera)
{
  this->SetScale({ 1.0, 2.0 });
  this->Renderer->GetActiveCamera()->ParallelProjectionOn();
  const Scene scene = this->Extract();
  ASSERT_EQ(scene.Surfaces.size(), 1u);
  EXPECT_TRUE(scene.Warnings.empty());
  EXPECT_EQ(scene.Surfaces[0].GetNumberOfPrimitives(), 4u);
  EXPECT_TRUE(scene.Surfaces[0].IsLineOrPoint);
  for (const std::size_t i : { 0u, 1u })
  {
    EXPECT_NEAR(FindExtent(scene, i, 0), 1.0 * (i + 1), 1e-5);
    EXPECT_NEAR(FindExtent(scene, i, 1), 1.0 * (i + 1), 1e-5);
    EXPECT_NEAR(FindExtent(scene, i, 2), 0.0, 1e-5);
  }
}

// The image of a small sphere at the angle a from the view axis is 1 / cos(a) times as long toward
// the axis as across.
TEST_F(SplatsTest, AreStretchedAwayFromTheViewAxis)
{
  const Scene scene = this->Extract();
  ASSERT_EQ(scene.Surfaces.size(), 1u);
  EXPECT_NEAR(FindExtent(scene, 0, 0), 1.0, 1e-5);
  EXPECT_NEAR(FindExtent(scene, 1, 0), std::hypot(1.0, 0.3), 1e-5);
  EXPECT_NEAR(FindExtent(scene, 1, 1), 1.0, 1e-5);
}

TEST_F(SplatsTest, WithInvalidRadiiAreSkippedWithOneWarning)
{
  this->SetScale({ 1.0, std::numeric_limits<double>::quiet_NaN() });
  const Scene scene = this->Extract();
  ASSERT_EQ(scene.Warnings.size(), 1u);
  EXPECT_NE(scene.Warnings[0].find("1 splats were skipped"), std::string::npos);
  ASSERT_EQ(scene.Surfaces.size(), 1u);
  EXPECT_EQ(scene.Surfaces[0].GetNumberOfPrimitives(), 2u);
}

// VTK uses the square of the radius.
TEST_F(SplatsTest, OfRadiusZeroAreEmptyAndSignsHaveNoEffect)
{
  this->SetScale({ 0.0, -1.0 });
  this->Renderer->GetActiveCamera()->ParallelProjectionOn();
  const Scene scene = this->Extract();
  ASSERT_EQ(scene.Surfaces.size(), 1u);
  EXPECT_TRUE(scene.Warnings.empty());
  EXPECT_EQ(scene.Surfaces[0].GetNumberOfPrimitives(), 2u);
  EXPECT_NEAR(FindExtent(scene, 0, 0), 1.0, 1e-5);
}

TEST_F(SplatsTest, IgnoreArraysOfWrongLengthWithOneWarning)
{
  this->SetScale({ 3.0 });
  this->Renderer->GetActiveCamera()->ParallelProjectionOn();
  const Scene scene = this->Extract();
  ASSERT_EQ(scene.Warnings.size(), 1u);
  EXPECT_NE(scene.Warnings[0].find("1 values for 2 points"), std::string::npos);
  EXPECT_NEAR(FindExtent(scene, 1, 0), 1.0, 1e-5);
}

TEST_F(SplatsTest, OfScaleZeroArePoints)
{
  this->Mapper->SetScaleFactor(0.0);
  const Scene scene = this->Extract();
  ASSERT_EQ(scene.Surfaces.size(), 1u);
  EXPECT_FALSE(scene.Surfaces[0].LitTexture);
  EXPECT_TRUE(scene.Surfaces[0].IsLineOrPoint);
}

TEST_F(SplatsTest, AreAtThePointsOfVertexCells)
{
  vtkNew<vtkCellArray> vertices;
  const vtkIdType second = 1;
  vertices->InsertNextCell(1, &second);
  this->Data->SetVerts(vertices);
  const Scene scene = this->Extract();
  ASSERT_EQ(scene.Surfaces.size(), 1u);
  EXPECT_EQ(scene.Surfaces[0].CellIds, std::vector<std::uint32_t>({ 1u, 1u }));
}

TEST_F(SplatsTest, AreAdditiveIfTheMapperIsEmissive)
{
  for (const bool emissive : { false, true })
  {
    this->Mapper->SetEmissive(emissive);
    EXPECT_EQ(this->Extract().Surfaces.at(0).IsAdditive, emissive);
  }
}
