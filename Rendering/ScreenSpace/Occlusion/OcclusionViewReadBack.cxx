// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What OcclusionViewState reads back from the graphics card.
#include "Frame/BackgroundDepth.h"
#include "OcclusionViewState.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <limits>

namespace penumbra
{

namespace
{

vtkFloatArray* AddArray(vtkImageData* image, const char* name)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  image->GetPointData()->AddArray(array);
  return array;
}

}

std::vector<float> OcclusionViewState::ReadMeans() const
{
  const std::vector<float> depths = ReadBack(this->Depth.GetCurrent());
  const std::vector<float> history = ReadBack(this->History.GetTexture());
  std::vector<float> values(depths.size(), -1.f);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    // Pixels in the margin have no weight.
    if (depths[i] < BackgroundDepth && history[2 * i + 1] > 0.f)
    {
      values[i] = history[2 * i] / history[2 * i + 1];
    }
  }
  return values;
}

HistoryCounts OcclusionViewState::CountPixels()
{
  if (!this->Estimates)
  {
    return {};
  }
  PixelCounter::Inputs inputs;
  inputs.EyeDepths = this->Depth.GetCurrent();
  inputs.History = this->History.GetTexture();
  inputs.MovedActors = this->HasActorMotion ? this->Motion.GetTarget() : nullptr;
  inputs.NewWeight = this->NewSamples > 0 ? this->DisocclusionSamples : 0;
  inputs.InvalidationWeight = this->MovedNeighborWeight;
  inputs.ConvergedWeight = this->Converged
    ? 0.0
    : this->Settings.Constants.SpatialConvergence * this->Settings.Constants.MaximumWeight;
  return this->Counter.Count(this->Window, this->Image, inputs);
}

void OcclusionViewState::CopyTo(vtkImageData* image) const
{
  const int* size = this->Image.GetViewport() + 2;
  image->SetDimensions(size[0], size[1], 1);
  vtkFloatArray* occlusions = AddArray(image, "AmbientOcclusion");
  vtkFloatArray* depths = AddArray(image, "Depth");
  vtkFloatArray* convergences = AddArray(image, "Convergence");
  if (!this->Estimates)
  {
    return;
  }
  const std::vector<float> eyeDepths = ReadBack(this->Depth.GetCurrent());
  const std::vector<float> history = ReadBack(this->History.GetTexture());
  const std::vector<float> result = ReadBack(this->Estimates);
  const ScreenTransform& view = this->Depth.GetView();
  for (int j = 0; j < size[1]; ++j)
  {
    for (int i = 0; i < size[0]; ++i)
    {
      const std::size_t at = static_cast<std::size_t>(j + this->Image.GetMargin()[1]) * view.Width +
        i + this->Image.GetMargin()[0];
      const vtkIdType target = static_cast<vtkIdType>(j) * size[0] + i;
      const bool empty = eyeDepths[at] >= BackgroundDepth;
      const double depth = eyeDepths[at] * view.Unit;
      occlusions->SetValue(target, empty ? 0.f : result[at]);
      depths->SetValue(
        target, empty ? std::numeric_limits<float>::infinity() : static_cast<float>(depth));
      convergences->SetValue(target,
        empty ? 1.f
              : std::min(
                  static_cast<float>(history[2 * at + 1] / this->Settings.Constants.MaximumWeight),
                  1.f));
    }
  }
}

}
