// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The light shaft pass in windows with several samples per pixel.
#include "ShaftScene.h"
#include "vtkPenumbraMedium.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPenumbraTemporalSSAOPass.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace
{

constexpr int Width = 64;
constexpr int Height = 48;

/// Red and blue of dark solids before bright haze, with `scale` times as many pixels in x and y.
/// `passes` may add further passes.
std::vector<double> Draw(int scale, int samples, const Vector& extinctions,
  const std::function<void(vtkRenderer*)>& passes = nullptr)
{
  ShaftScene scene(Width * scale, Height * scale);
  scene.Window->SetMultiSamples(samples);
  scene.AddFloor(12.0);
  scene.AddSolids(8, 3);
  scene.AddSun({ 0.2, 1.0, 0.32 })->SetIntensity(12.0);
  scene.Look({ 0.5, -11.0, 2.5 }, { 0.0, 0.0, 2.0 });
  scene.SetMedium(0.06, 0.06);
  scene.Pass->GetMedium()->SetExtinctionColor(extinctions[0], extinctions[1], extinctions[2]);
  if (passes)
  {
    passes(scene.Renderer);
  }
  scene.Window->Render();
  vtkNew<vtkUnsignedCharArray> bytes;
  scene.Window->GetRGBACharPixelData(0, 0, scene.Width - 1, scene.Height - 1, 0, bytes);
  std::vector<double> values;
  for (vtkIdType i = 0; i < bytes->GetNumberOfTuples(); ++i)
  {
    values.push_back(bytes->GetTypedComponent(i, 0) / 255.0);
    values.push_back(bytes->GetTypedComponent(i, 2) / 255.0);
  }
  return values;
}

/// Mean of each block of `factor` x `factor` pixels, and whether the block contains an edge.
struct Reference
{
  std::vector<double> Means;
  std::vector<bool> Edges;
};

Reference Reduce(const std::vector<double>& large, int factor)
{
  Reference reference;
  for (int i = 0; i < 2 * Width * Height; ++i)
  {
    double sum = 0.0;
    double least = 1.0;
    double largest = 0.0;
    for (int k = 0; k < factor * factor; ++k)
    {
      const int x = factor * (i / 2 % Width) + k % factor;
      const int y = factor * (i / 2 / Width) + k / factor;
      const double value = large[2 * (static_cast<std::size_t>(y) * Width * factor + x) + i % 2];
      sum += value;
      least = std::min(least, value);
      largest = std::max(largest, value);
    }
    reference.Means.push_back(sum / (factor * factor));
    reference.Edges.push_back(largest - least > 0.1);
  }
  return reference;
}

double ErrorOfEdges(const std::vector<double>& values, const Reference& reference)
{
  double squares = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    if (reference.Edges[i])
    {
      squares += (values[i] - reference.Means[i]) * (values[i] - reference.Means[i]);
      ++count;
    }
  }
  EXPECT_GT(count, 100);
  return std::sqrt(squares / count);
}

}

TEST(ShaftMultisamples, SmoothEdgesBeforeHaze)
{
  for (const Vector& extinctions : { Vector{ 1.0, 1.0, 1.0 }, Vector{ 1.0, 1.5, 2.0 } })
  {
    const Reference reference = Reduce(Draw(8, 0, extinctions), 8);
    const double one = ErrorOfEdges(Draw(1, 0, extinctions), reference);
    EXPECT_LT(ErrorOfEdges(Draw(1, 4, extinctions), reference), 0.45 * one);
    // Drivers may round the number of samples up.
    EXPECT_LT(ErrorOfEdges(Draw(1, 2, extinctions), reference), 0.8 * one);
  }
}

TEST(ShaftMultisamples, SmoothEdgesAfterAmbientOcclusion)
{
  const Vector gray{ 1.0, 1.0, 1.0 };
  const auto occlude = [](vtkRenderer* renderer) {
    vtkPenumbraTemporalSSAOPass::AddTo(renderer)->SetStrength(0.0);
  };
  const Reference reference = Reduce(Draw(8, 0, gray), 8);
  const double one = ErrorOfEdges(Draw(1, 0, gray), reference);
  EXPECT_LT(ErrorOfEdges(Draw(1, 4, gray, occlude), reference), 0.45 * one);
}

TEST(ShaftMultisamples, DrawEachSampleOnceIfMultisamplingIsOff)
{
  ShaftScene scene(Width, Height);
  scene.Window->SetMultiSamples(4);
  scene.AddFloor(12.0);
  scene.AddSun({ 0.2, 1.0, 0.32 })->SetIntensity(4.0);
  scene.Look({ 0.5, -11.0, 2.5 }, { 0.0, 0.0, 2.0 });
  scene.SetMedium(0.06, 0.06);
  const auto mean = [&scene]() {
    scene.Window->Render();
    vtkNew<vtkUnsignedCharArray> bytes;
    scene.Window->GetRGBACharPixelData(0, 0, Width - 1, Height - 1, 0, bytes);
    double sum = 0.0;
    for (vtkIdType i = 0; i < bytes->GetNumberOfTuples(); ++i)
    {
      sum += bytes->GetTypedComponent(i, 0) / 255.0;
    }
    return sum / static_cast<double>(bytes->GetNumberOfTuples());
  };
  const double expected = mean();
  constexpr unsigned int multisample = 0x809D; // GL_MULTISAMPLE
  static_cast<vtkOpenGLRenderWindow*>(scene.Window.Get())->GetState()->vtkglDisable(multisample);
  EXPECT_NEAR(mean(), expected, 0.01);
}
