// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Renders one actor with VTK's rasterizer and with ray tracing; the colors inside cells must agree.
#ifndef ShadingOfActor_h
#define ShadingOfActor_h

#include "RasterComparison.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkElevationFilter.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

/// Returns a sphere with large cells and smooth normals.
inline vtkSmartPointer<vtkPolyData> Sphere(int resolution = 8)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->Update();
  return source->GetOutput();
}

inline vtkSmartPointer<vtkPolyData> WithElevation(vtkPolyData* data)
{
  vtkNew<vtkElevationFilter> elevation;
  elevation->SetInputData(data);
  elevation->SetLowPoint(-.3, 0., -.5);
  elevation->SetHighPoint(.2, .1, .5);
  elevation->Update();
  return vtkPolyData::SafeDownCast(elevation->GetOutput());
}

/// Test fixture with one actor, seen from an asymmetric viewpoint.
class ActorShadingTest : public ::testing::Test
{
public:
  void SetMesh(vtkPolyData* data)
  {
    this->Mapper->SetInputData(data);
    this->Renderer()->GetActiveCamera()->SetViewUp(.1, 1.0, 0.0);
    this->SetMapper(this->Mapper);
  }

  void SetMapper(vtkMapper* mapper)
  {
    this->Actor->SetMapper(mapper);
    this->Renderer()->AddActor(this->Actor);
    this->Renderer()->GetActiveCamera()->SetPosition(1.0, .7, 1.3);
    this->Renderer()->ResetCamera();
  }

  void ExpectSameImage(int pixels = 500, double tolerance = 2.0)
  {
    const RasterComparison::Result result = this->Comparison.Compare();
    EXPECT_GE(result.Pixels, pixels);
    EXPECT_LE(result.Largest, tolerance)
      << result.Different << " of " << result.Pixels << " pixels differ; largest difference at "
      << result.Where[0] << ", " << result.Where[1];
    EXPECT_TRUE(result.Scene.Warnings.empty()) << result.Scene.Warnings.front();
  }

  vtkRenderer* Renderer() { return this->Comparison.Renderer; }
  vtkProperty* Property() { return this->Actor->GetProperty(); }

  RasterComparison Comparison;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkPolyDataMapper> Mapper;
};

#endif
