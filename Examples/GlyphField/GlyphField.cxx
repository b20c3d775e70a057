// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Ray casts arrows of a vector field with ambient occlusion. The shape of the arrow is stored once,
// however many glyphs there are.
//   GlyphField IMAGE.png
#include "vtkPenumbraIrradianceCache.h"
#include "vtkPenumbraRayCaster.h"

#include <vtkActor.h>
#include <vtkArrowSource.h>
#include <vtkCamera.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageShiftScale.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

namespace
{

constexpr int Side = 10; ///< number of arrows along each axis

/// Fills `data` with a grid of points in the unit cube and the velocity of the
/// Arnold-Beltrami-Childress flow with its norm at each.
void MakeField(vtkPolyData* data)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> velocity;
  velocity->SetName("Velocity");
  velocity->SetNumberOfComponents(3);
  vtkNew<vtkFloatArray> speed;
  speed->SetName("Speed");
  for (int i = 0; i < Side * Side * Side; ++i)
  {
    const double p[3] = { (i % Side) / (Side - 1.0), (i / Side % Side) / (Side - 1.0),
      i / (Side * Side) / (Side - 1.0) };
    const double x = 5.0 * p[0];
    const double y = 5.0 * p[1];
    const double z = 5.0 * p[2];
    const double v[3] = { std::sqrt(3.0) * std::sin(z) + std::cos(y),
      std::sqrt(2.0) * std::sin(x) + std::sqrt(3.0) * std::cos(z),
      std::sin(y) + std::sqrt(2.0) * std::cos(x) };
    points->InsertNextPoint(p);
    velocity->InsertNextTuple(v);
    speed->InsertNextValue(static_cast<float>(std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])));
  }
  data->SetPoints(points);
  data->GetPointData()->SetVectors(velocity);
  data->GetPointData()->SetScalars(speed);
}

}

int main(int argc, char* argv[])
{
  vtkNew<vtkPolyData> field;
  MakeField(field);
  vtkNew<vtkArrowSource> arrow;
  arrow->SetShaftRadius(0.07);
  arrow->SetTipRadius(0.18);
  arrow->SetTipResolution(48);
  arrow->SetShaftResolution(48);
  vtkNew<vtkLookupTable> colors;
  colors->SetHueRange(0.62, 0.0);
  colors->SetSaturationRange(0.5, 0.65);
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(field);
  mapper->SetSourceConnection(arrow->GetOutputPort());
  mapper->SetOrientationArray("Velocity");
  mapper->SetScaleArray("Speed");
  mapper->SetScaleModeToScaleByMagnitude();
  mapper->SetScaleFactor(0.055);
  mapper->SetLookupTable(colors);
  mapper->SetScalarRange(0.0, 3.6);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->SetBackground(0.96, 0.95, 0.925);
  renderer->GetActiveCamera()->SetPosition(-1.3, -1.9, 1.75);
  renderer->GetActiveCamera()->SetFocalPoint(0.5, 0.5, 0.47);
  renderer->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
  renderer->ResetCameraClippingRange();

  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(700, 560);
  caster->SetIrradianceProvider(vtkNew<vtkPenumbraIrradianceCache>()); // faster than the default
  caster->SetAmbientOcclusion(true);
  caster->SetAmbientOcclusionRadius(0.3);
  caster->SetAmbientOcclusionStrength(1.0);
  caster->SetTolerance(0.05);
  caster->Update();
  std::cout << field->GetNumberOfPoints()
            << " arrows, estimated error: " << caster->GetEstimatedError() << "\n";

  vtkNew<vtkImageShiftScale> bytes;
  bytes->SetInputConnection(caster->GetOutputPort());
  bytes->SetScale(255.0);
  bytes->SetShift(0.5 / 255.0);
  bytes->SetOutputScalarTypeToUnsignedChar();
  bytes->ClampOverflowOn();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(bytes->GetOutputPort());
  writer->SetFileName(argc > 1 ? argv[1] : "GlyphField.png");
  writer->Write();
  return writer->GetErrorCode() == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
