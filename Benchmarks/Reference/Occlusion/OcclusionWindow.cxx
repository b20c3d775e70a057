// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionWindow.h"

#include "FrameClock.h"
#include "VTKSSAOPass.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkSSAOPass.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace penumbra
{

OcclusionWindow::OcclusionWindow(vtkRenderer* renderer, int width, int height)
  : Renderer(renderer)
{
  this->Window->SetOffScreenRendering(1);
  this->Window->SetMultiSamples(0);
  this->Window->SetSize(width, height);
  this->Window->AddRenderer(renderer);
}

OcclusionWindow::~OcclusionWindow()
{
  this->UseNone();
}

vtkPenumbraTemporalSSAOPass* OcclusionWindow::UsePenumbraPass(double radius)
{
  this->UseNone();
  this->Ours = vtkPenumbraTemporalSSAOPass::AddTo(this->Renderer);
  this->Ours->SetRadiusUnit(vtkPenumbraTemporalSSAOPass::WORLD);
  this->Ours->SetRadius(radius);
  return this->Ours;
}

void OcclusionWindow::UseVTKSSAOPass(double radius, unsigned int samples)
{
  this->UseNone();
  this->Renderer->SetPass(NewVTKSSAOPass(radius, samples));
}

void OcclusionWindow::UseNone()
{
  if (this->Ours)
  {
    vtkPenumbraTemporalSSAOPass::RemoveFrom(this->Renderer);
    this->Ours = nullptr;
  }
  else if (vtkRenderPass* pass = this->Renderer->GetPass())
  {
    pass->ReleaseGraphicsResources(this->Window);
    this->Renderer->SetPass(nullptr);
  }
}

double OcclusionWindow::Draw()
{
  const double start = FrameSeconds();
  this->Window->Render();
  this->Window->WaitForCompletion();
  return FrameSeconds() - start;
}

std::vector<float> OcclusionWindow::Array(const std::string& name)
{
  vtkNew<vtkImageData> image;
  this->Ours->CopyOcclusion(image);
  auto* array = vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray(name.c_str()));
  return { array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues() };
}

std::vector<float> OcclusionWindow::OcclusionFromBrightness()
{
  vtkNew<vtkUnsignedCharArray> bytes;
  const int* size = this->Window->GetSize();
  this->Window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, bytes);
  std::vector<float> values(static_cast<std::size_t>(bytes->GetNumberOfTuples()));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = 1.f - bytes->GetTypedComponent(static_cast<vtkIdType>(i), 0) / 255.f;
  }
  return values;
}

void WriteImage(const std::string& path, const std::vector<float>& values, double black)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(OcclusionWindow::Size[0], OcclusionWindow::Size[1], 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto* bytes = static_cast<unsigned char*>(image->GetScalarPointer());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    bytes[i] = static_cast<unsigned char>(255.0 * std::clamp(1.0 - values[i] / black, 0.0, 1.0));
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(image);
  writer->Write();
}

}
