// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A field of glyphs on a grid with arrays of scale, orientation, source index, mask and color.
#ifndef penumbra_GlyphField_h
#define penumbra_GlyphField_h

#include "vtkPenumbraRayCaster.h"

#include "vtkActor.h"
#include "vtkArrowSource.h"
#include "vtkCamera.h"
#include "vtkDoubleArray.h"
#include "vtkGlyph3DMapper.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"

#include <cmath>

namespace penumbra_testing
{

/// Returns a number in [0, 1) for each combination of arguments.
inline double Noise(int i, int k)
{
  const double x = std::sin(12.9898 * i + 78.233 * k + 1.0) * 43758.5453;
  return x - std::floor(x);
}

/// Returns the points `first` to `end` of a grid with `width` points per row and spacing 1.
inline vtkSmartPointer<vtkPolyData> MakeGlyphPoints(int first, int end, int width)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> arrays[5];
  const char* const names[5] = { "scale", "direction", "source", "mask", "value" };
  const int components[5] = { 3, 3, 1, 1, 1 };
  auto data = vtkSmartPointer<vtkPolyData>::New();
  for (int k = 0; k < 5; ++k)
  {
    arrays[k]->SetName(names[k]);
    arrays[k]->SetNumberOfComponents(components[k]);
    data->GetPointData()->AddArray(arrays[k]);
  }
  for (int i = first; i < end; ++i)
  {
    points->InsertNextPoint(
      i % width + 0.3 * Noise(i, 0), i / width + 0.3 * Noise(i, 1), 0.5 * Noise(i, 2));
    arrays[0]->InsertNextTuple3(0.5 + 0.5 * Noise(i, 3), 0.5 + 0.5 * Noise(i, 4), 0.7);
    arrays[1]->InsertNextTuple3(
      2.0 * Noise(i, 5) - 1.0, 2.0 * Noise(i, 6) - 1.0, 2.0 * Noise(i, 7) - 1.0);
    arrays[2]->InsertNextValue(i % 2);
    arrays[3]->InsertNextValue(i % 7 == 3 ? 0.0 : 1.0);
    arrays[4]->InsertNextValue(Noise(i, 8));
  }
  data->SetPoints(points);
  data->GetPointData()->SetActiveScalars("value");
  return data;
}

struct GlyphField
{
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkPenumbraRayCaster> Caster;
  vtkNew<vtkSphereSource> Sphere; ///< 840 triangles
  vtkNew<vtkArrowSource> Arrow;

  GlyphField()
  {
    this->Sphere->SetThetaResolution(30);
    this->Sphere->SetPhiResolution(16);
    this->Arrow->SetShaftResolution(360);
    this->Arrow->SetTipResolution(360);
    this->Caster->SetRenderer(this->Renderer);
    this->Caster->SetResolution(160, 120);
    this->Renderer->SetBackground(0.1, 0.2, 0.3);
  }

  /// Adds glyphs with all arrays. Mappers with few glyphs are drawn as copied triangles, others as
  /// instances.
  vtkGlyph3DMapper* Add(vtkPolyData* points)
  {
    vtkNew<vtkGlyph3DMapper> mapper;
    mapper->SetInputData(points);
    mapper->SetSourceConnection(0, this->Sphere->GetOutputPort());
    mapper->SetSourceConnection(1, this->Arrow->GetOutputPort());
    mapper->SourceIndexingOn();
    mapper->SetSourceIndexArray("source");
    mapper->SetScaleArray("scale");
    mapper->SetScaleModeToScaleByVectorComponents();
    mapper->SetOrientationArray("direction");
    mapper->MaskingOn();
    mapper->SetMaskArray("mask");
    mapper->SetScalarRange(0.0, 1.0);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetSpecular(0.3);
    actor->GetProperty()->SetSpecularPower(20.0);
    this->Renderer->AddActor(actor);
    return mapper;
  }

  /// Sets the camera to see a field of `width` columns and rows obliquely.
  void SetCamera(int width)
  {
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(0.5 * width, -0.7 * width, 0.8 * width);
    camera->SetFocalPoint(0.5 * width, 0.45 * width, 0.0);
    camera->SetViewUp(0.0, 0.0, 1.0);
    this->Renderer->ResetCameraClippingRange();
  }

  /// Sets the camera to see few glyphs, whose triangles are larger than pixels. The field is moved
  /// by `shift` along each axis.
  void SetCloseCamera(int width, double shift = 0.0)
  {
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    const double center = 0.5 * width + shift;
    camera->SetPosition(center, center - 1.5, shift + 2.0);
    camera->SetFocalPoint(center, center, shift + 0.2);
    camera->SetViewUp(0.0, 0.0, 1.0);
    this->Renderer->ResetCameraClippingRange();
  }
};

}
#endif
