// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ShaftAutoExposure.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkPenumbraShaftBrightnessFS.h"
#include "vtkPenumbraShaftSceneColorLib.h"
#include "vtkPenumbraShaftSceneColorMSLib.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

constexpr int Cell = 16; ///< as in the shader

/// Of its way to what a picture asks for the gain goes this share with each picture.
constexpr double AdaptationRate = 0.1;

/// No brighter and no darker than this.
constexpr double LargestGain = 64.0;

/// The mean picture shall have room for the brightest light; darker light is made brighter only
/// where it shows shafts, differences that is.
double TargetGain(const std::vector<float>& cells)
{
  double sum = 0.0;
  double count = 0.0;
  double least = VTK_DOUBLE_MAX;
  double largest = 0.0;
  for (std::size_t at = 0; at + 3 < cells.size(); at += 4)
  {
    sum += cells[at];
    least = std::min<double>(least, cells[at + 1]);
    largest = std::max<double>(largest, cells[at + 2]);
    count += cells[at + 3];
  }
  if (!(count > 0.0) || !(largest > 0.0))
  {
    return 1.0;
  }
  const double room = std::clamp(1.0 - sum / count, 1.0 / LargestGain, 1.0);
  const double contrast = (largest - least) / largest;
  const double gain = room / largest;
  return std::clamp(gain > 1.0 ? std::pow(gain, contrast) : gain, 1.0 / LargestGain, LargestGain);
}

}

bool ShaftAutoExposure::Update(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  vtkTextureObject* shafts, const double* behind)
{
  static const std::string oneSample =
    Assemble(vtkPenumbraShaftBrightnessFS, { { "Picture", vtkPenumbraShaftSceneColorLib } });
  static const std::string manySamples =
    Assemble(vtkPenumbraShaftBrightnessFS, { { "Picture", vtkPenumbraShaftSceneColorMSLib } });
  const ScreenTransform& view = image.GetView();
  Allocate(this->Cells, window, (view.Width + Cell - 1) / Cell, (view.Height + Cell - 1) / Cell, 4);
  const bool many = image.GetSamples() > 1;
  vtkShaderProgram* program = this->Brightness.Ready(window, many ? manySamples : oneSample);
  {
    const ScopedRenderTarget target(window, image.GetFramebuffer(), { this->Cells });
    if (!program || !target.IsComplete())
    {
      return false;
    }
    const float size[2] = { 1.f / static_cast<float>(view.Width),
      1.f / static_cast<float>(view.Height) };
    float color[3] = { 0.f, 0.f, 0.f };
    if (behind)
    {
      std::copy_n(behind, 3, color);
    }
    program->SetUniform2f("pixelSize", size);
    program->SetUniform3f("behind", color);
    program->SetUniformf("background", behind ? 0.f : 1.f);
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
  const double wanted = TargetGain(ReadBack(this->Cells));
  this->Gain =
    this->Gain > 0.0 ? this->Gain * std::pow(wanted / this->Gain, AdaptationRate) : wanted;
  return true;
}

void ShaftAutoExposure::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Brightness.ReleaseGraphicsResources(window);
  if (this->Cells)
  {
    this->Cells->ReleaseGraphicsResources(window);
    this->Cells = nullptr;
  }
  this->Gain = 0.0;
}

}
