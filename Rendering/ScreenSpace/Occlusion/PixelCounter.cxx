// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PixelCounter.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkPenumbraCountPixelsFS.h"
#include "vtkPenumbraViewLib.h"
#include "vtkShaderProgram.h"

namespace penumbra
{

namespace
{

/// Width and height of the blocks of vtkPenumbraCountPixelsFS, in pixels.
constexpr int BlockSide = 16;

}

HistoryCounts PixelCounter::Count(
  vtkOpenGLRenderWindow* window, const DelegateImage& image, const Inputs& inputs)
{
  HistoryCounts counts;
  const int* size = image.GetViewport() + 2;
  for (vtkSmartPointer<vtkTextureObject>& texture : this->Counts)
  {
    Allocate(texture, window, (size[0] + BlockSide - 1) / BlockSide,
      (size[1] + BlockSide - 1) / BlockSide, 4);
  }
  static const std::string source =
    Assemble(vtkPenumbraCountPixelsFS, { { "ViewLib", vtkPenumbraViewLib } });
  vtkShaderProgram* program = this->CountBlocks.Ready(window, source);
  {
    const ScopedRenderTarget target(
      window, image.GetFramebuffer(), { this->Counts[0], this->Counts[1] });
    if (!program || !target.IsComplete())
    {
      return counts;
    }
    image.GetView().SetUniforms(program);
    program->SetUniform2i("imageSize", size);
    program->SetUniform2i("imageOrigin", image.GetMargin());
    program->SetUniformf("newWeight", static_cast<float>(inputs.NewWeight));
    program->SetUniformf(
      "invalidatedWeight", static_cast<float>(inputs.InvalidationWeight + inputs.NewWeight));
    program->SetUniformf("convergedWeight", static_cast<float>(inputs.ConvergedWeight));
    program->SetUniformf("hasMovedActors", inputs.MovedActors ? 1.f : 0.f);
    this->CountBlocks.BindTexture("eyeDepths", inputs.EyeDepths);
    this->CountBlocks.BindTexture("history", inputs.History);
    this->CountBlocks.BindTexture(
      "movedActors", inputs.MovedActors ? inputs.MovedActors : inputs.History);
    this->CountBlocks.Draw();
  }
  const std::vector<float> fates = ReadBack(this->Counts[0]);
  const std::vector<float> others = ReadBack(this->Counts[1]);
  for (std::size_t i = 0; i < fates.size(); i += 4)
  {
    counts.Surface += static_cast<long long>(fates[i]);
    counts.Kept += static_cast<long long>(fates[i + 1]);
    counts.Disoccluded += static_cast<long long>(fates[i + 2]);
    counts.Invalidated += static_cast<long long>(fates[i + 3]);
    counts.ActorMotion += static_cast<long long>(others[i]);
    counts.Converged += static_cast<long long>(others[i + 1]);
  }
  return counts;
}

void PixelCounter::ReleaseGraphicsResources(vtkWindow* window)
{
  this->CountBlocks.ReleaseGraphicsResources(window);
  Release(window, this->Counts[0], this->Counts[1]);
}

}
