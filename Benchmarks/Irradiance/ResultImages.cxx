// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ResultImages.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <functional>

namespace penumbra
{
namespace
{

constexpr double FullColor = .05; ///< difference of occlusion

unsigned char ToByte(double value)
{
  return static_cast<unsigned char>(255.0 * std::clamp(value, 0.0, 1.0) + .5);
}

/// Adds the mesh in plain colors, shifted to the right by `right` times its width.
void Add(vtkRenderer* renderer, vtkPolyData* mesh, double right,
  const std::function<glm::dvec3(vtkIdType)>& colorAt)
{
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 color = colorAt(i);
    colors->InsertNextTuple3(ToByte(color.x), ToByte(color.y), ToByte(color.z));
  }
  vtkNew<vtkPolyData> copy;
  copy->CopyStructure(mesh);
  copy->GetPointData()->SetScalars(colors);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(copy);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  const double* bounds = mesh->GetBounds();
  actor->SetPosition(-right * (bounds[1] - bounds[0]), 0.0, 0.0); // the view is from behind
  renderer->AddActor(actor);
}

}

void WriteImage(const std::string& path, int width, const std::vector<glm::dvec3>& colors)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(width, static_cast<int>(colors.size()) / width, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* bytes = static_cast<unsigned char*>(image->GetScalarPointer());
  for (const glm::dvec3& color : colors)
  {
    for (int c = 0; c < 3; ++c)
    {
      *bytes++ = ToByte(color[c]);
    }
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(path.c_str());
  writer->Write();
}

void WriteBakings(const std::string& path, vtkPolyData* baked, vtkPolyData* other)
{
  vtkDataArray* one = baked->GetPointData()->GetArray("AmbientOcclusion");
  vtkDataArray* two = other->GetPointData()->GetArray("AmbientOcclusion");
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.62, 0.68, 0.74);
  Add(renderer, baked, 0.0, [&](vtkIdType i) { return glm::dvec3(1.0 - one->GetComponent(i, 0)); });
  Add(
    renderer, other, 1.05, [&](vtkIdType i) { return glm::dvec3(1.0 - two->GetComponent(i, 0)); });
  Add(renderer, baked, 2.1, [&](vtkIdType i) {
    const double more = (one->GetComponent(i, 0) - two->GetComponent(i, 0)) / FullColor;
    const double rest = 1.0 - std::min(std::abs(more), 1.0);
    return more > 0.0 ? glm::dvec3(.9, .9 * rest, .9 * rest) : glm::dvec3(.9 * rest, .9 * rest, .9);
  });
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Azimuth(180.0);         // armadillo.off faces -z
  renderer->GetActiveCamera()->ParallelProjectionOn(); // so that all three look the same
  renderer->GetActiveCamera()->Zoom(2.2);

  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetTolerance(.01);
  caster->SetResolution(960, 420);
  caster->Update();
  vtkDataArray* colors = caster->GetOutput()->GetPointData()->GetArray("Color");
  std::vector<glm::dvec3> image;
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    image.emplace_back(
      colors->GetComponent(i, 0), colors->GetComponent(i, 1), colors->GetComponent(i, 2));
  }
  WriteImage(path, 960, image);
}

}
