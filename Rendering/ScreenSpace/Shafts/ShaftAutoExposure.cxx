// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ShaftAutoExposure.h"

#include "Frame/ScreenSpaceConstants.h"
#include "Frame/Uniforms.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkPenumbraShaftBrightnessFS.h"
#include "vtkPenumbraShaftSceneColorLib.h"
#include "vtkPenumbraShaftSceneColorMSLib.h"
#include "vtkPixelBufferObject.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

/// Pixels per side of a cell, as cellSize in vtkPenumbraShaftBrightnessFS.glsl.
constexpr int CellSize = 16;

std::vector<float> ReadBuffer(vtkPixelBufferObject* buffer)
{
  std::vector<float> values(buffer->GetSize());
  buffer->Download1D(VTK_FLOAT, values.data(), buffer->GetSize(), 1, 0);
  return values;
}

/// Gain with which the mean scene plus the brightest in-scattered light reaches brightness 1. A
/// gain above 1 is reduced if the in-scattered light has little contrast, that is, no visible
/// shafts.
double ComputeTargetGain(const std::vector<float>& cells)
{
  double sum = 0.0;
  double count = 0.0;
  double minimum = VTK_DOUBLE_MAX;
  double maximum = 0.0;
  for (std::size_t at = 0; at + 3 < cells.size(); at += 4)
  {
    sum += cells[at];
    minimum = std::min<double>(minimum, cells[at + 1]);
    maximum = std::max<double>(maximum, cells[at + 2]);
    count += cells[at + 3];
  }
  if (!(count > 0.0) || !(maximum > 0.0))
  {
    return 1.0;
  }
  const double headroom = std::clamp(1.0 - sum / count, 1.0 / MaximumExposureGain, 1.0);
  const double contrast = (maximum - minimum) / maximum;
  const double gain = headroom / maximum;
  return std::clamp(
    gain > 1.0 ? std::pow(gain, contrast) : gain, 1.0 / MaximumExposureGain, MaximumExposureGain);
}

}

bool ShaftAutoExposure::Update(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  vtkTextureObject* shafts, const double* background, bool moving)
{
  static const std::string oneSample =
    Assemble(vtkPenumbraShaftBrightnessFS, { { "SceneColor", vtkPenumbraShaftSceneColorLib } });
  static const std::string manySamples =
    Assemble(vtkPenumbraShaftBrightnessFS, { { "SceneColor", vtkPenumbraShaftSceneColorMSLib } });
  const ScreenTransform& view = image.GetView();
  Allocate(this->Cells, window, (view.Width + CellSize - 1) / CellSize,
    (view.Height + CellSize - 1) / CellSize, 4);
  const bool many = image.GetSamples() > 1;
  vtkShaderProgram* program = this->Brightness.Ready(window, many ? manySamples : oneSample);
  {
    const ScopedRenderTarget renderTarget(window, image.GetFramebuffer(), { this->Cells });
    if (!program || !renderTarget.IsComplete())
    {
      return false;
    }
    float color[3] = { 0.f, 0.f, 0.f };
    if (background)
    {
      std::copy_n(background, 3, color);
    }
    SetPixelSize(program, "pixelSize", view.Width, view.Height);
    program->SetUniform3f("backgroundColor", color);
    program->SetUniformf("background", background ? 0.f : 1.f);
    this->Brightness.BindTexture("shafts", shafts);
    this->Brightness.BindTexture("depthBuffer", image.GetDepth());
    this->Brightness.BindTexture("colors", image.GetColor());
    if (many)
    {
      program->SetUniformi("sampleCount", image.GetSamples());
      this->Brightness.BindTexture("depthSamples", image.GetSampleDepth());
    }
    this->Brightness.Draw();
  }
  if (!moving || !(this->Gain > 0.0))
  {
    this->Pending.clear();
    this->AdaptTo(ReadBack(this->Cells));
    return true;
  }
  this->Pending.emplace_back().TakeReference(this->Cells->Download());
  if (this->Pending.size() > FramesUntilExposure)
  {
    this->AdaptTo(ReadBuffer(this->Pending.front()));
    this->Pending.pop_front();
  }
  return true;
}

void ShaftAutoExposure::AdaptTo(const std::vector<float>& cells)
{
  const double targetGain = ComputeTargetGain(cells);
  this->Gain = this->Gain > 0.0
    ? this->Gain * std::pow(targetGain / this->Gain, ExposureAdaptationRate)
    : targetGain;
}

void ShaftAutoExposure::Reset()
{
  this->Gain = 0.0;
  this->Pending.clear();
}

void ShaftAutoExposure::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Brightness.ReleaseGraphicsResources(window);
  Release(window, this->Cells);
  this->Reset();
}

}
