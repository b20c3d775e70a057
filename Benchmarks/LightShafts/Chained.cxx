// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The paper's chained passes: two of 8 samples against one loop of 64, both at geometrically spaced
// distances.
#include "Benchmark.h"
#include "Occlusion/FrameClock.h"
#include "ShaftScene.h"
#include "vtkPenumbraShaftConstants.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace penumbra
{

namespace
{

/// Intensity of the directional light at which an opaque medium has the radiance 1.
constexpr double WholeSphere = 4.0 * glm::pi<double>();
constexpr int Frames = 7;

struct Chain
{
  int Steps;
  int Passes;
  double Seconds = 1e30;
  std::vector<double> Light{};
};

/// Returns the fastest of several frames, none of which is static.
void Measure(ShaftScene& scene, vtkLight* sun, Chain& chain, int frame)
{
  scene.Pass->GetConstants().Steps = chain.Steps;
  scene.Pass->GetConstants().Passes = chain.Passes;
  sun->SetPosition(0.1 + 1e-4 * frame, 1.0, 0.12);
  const double start = FrameSeconds();
  scene.Window->Render();
  scene.Window->WaitForCompletion();
  chain.Seconds = std::min(chain.Seconds, FrameSeconds() - start);
  chain.Light = scene.RenderWithPass();
}

}

void MeasureChained(ShaftBenchmark& benchmark)
{
  ShaftScene scene(1024, 768);
  scene.AddFloor(12.0);
  scene.AddSolids(14, 1);
  scene.Look({ 0.5, -11.0, 2.5 }, { 0.0, 0.0, 2.0 });
  const vtkSmartPointer<vtkLight> sun = scene.AddSun({ 0.1, 1.0, 0.12 });
  scene.SetMedium(0.12, 0.12);
  scene.Pass->SetEstimator(vtkPenumbraLightShaftPass::RADIAL);
  scene.Pass->GetConstants().Spacing = penumbra::ShaftSpacings::Geometric;
  scene.Pass->SetTolerance(1.0 / 1024.0); // a lit fraction for every pixel
  Chain chains[3] = { { 8, 2 }, { 64, 1 }, { 1, 1 } };
  for (int frame = 0; frame < Frames; ++frame)
  {
    for (Chain& chain : chains)
    {
      Measure(scene, sun, chain, frame);
    }
  }
  double squares = 0.0;
  for (std::size_t i = 0; i < chains[0].Light.size(); ++i)
  {
    squares += std::pow(WholeSphere * (chains[0].Light[i] - chains[1].Light[i]), 2);
  }
  const double error = std::sqrt(squares / static_cast<double>(chains[0].Light.size()));
  const double base = chains[2].Seconds;
  std::printf("  8x8 %.3f s, 64 %.3f s, 1 %.3f s\n", chains[0].Seconds, chains[1].Seconds, base);
  ResultTable& table = benchmark.Results;
  const std::string name = "chained 8x8 against one loop of 64, q^i, 1024x768";
  table.Add(name, "RMSE, 1/255", 255.0 * error, TargetKind::AtMost, 1.0);
  table.Add(name, "share of its cost, beyond that of 1 sample",
    (chains[0].Seconds - base) / (chains[1].Seconds - base), TargetKind::AtMost, 1.0 / 3.0);
}

}
