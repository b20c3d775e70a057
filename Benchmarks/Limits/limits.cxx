// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Cost of worst-case scenes: CPU seconds at n, 2 n and 4 n primitives, the exponent of their
// growth, rays per pixel, and the estimated remaining error.
#include "Scenes/Adversaries.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPenumbraIrradianceFilter.h"
#include "vtkPenumbraRayCaster.h"

#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>

namespace
{

struct Options
{
  std::string Only;
  int Primitives = 1000;
  int Side = 256;
  bool Occlusion = false;
  bool Bake = false;
};

struct Cost
{
  double Seconds = 0.0;
  double RaysPerPixel = 0.0;
  double Error = 0.0;
};

double CpuSeconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

Cost Draw(vtkPolyData* mesh, const Options& options)
{
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(penumbra::NewAdversaryRenderer(mesh, 1.0));
  caster->SetResolution(options.Side, options.Side);
  caster->SetNumberOfThreads(1);
  if (options.Occlusion)
  {
    caster->AmbientOcclusionOn();
    caster->SetIrradianceProvider(vtkNew<vtkPenumbraBruteForceIrradiance>());
  }
  const double start = CpuSeconds();
  caster->Update();
  return { CpuSeconds() - start, caster->GetStatistics()->GetArray("Rays/PerPixel")->GetTuple1(0),
    caster->GetEstimatedError() };
}

Cost Bake(vtkPolyData* mesh)
{
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(mesh);
  filter->SetNumberOfThreads(1);
  const double start = CpuSeconds();
  filter->Update();
  return { CpuSeconds() - start, 0.0, 0.0 };
}

}

int main(int count, char** arguments)
{
  Options options;
  for (int i = 1; i < count; ++i)
  {
    const std::string name = arguments[i];
    const char* value = i + 1 < count ? arguments[i + 1] : "";
    options.Occlusion = options.Occlusion || name == "--occlusion";
    options.Bake = options.Bake || name == "--bake";
    options.Only = name == "--only" ? value : options.Only;
    options.Primitives = name == "--primitives" ? std::atoi(value) : options.Primitives;
    options.Side = name == "--side" ? std::atoi(value) : options.Side;
  }
  for (const penumbra::Adversary& adversary : penumbra::Adversaries())
  {
    if (!options.Only.empty() && adversary.Name != options.Only)
    {
      continue;
    }
    double before = 0.0;
    for (int factor = 1; factor <= 4; factor *= 2)
    {
      const int n = factor * options.Primitives;
      const auto mesh = adversary.Make(n);
      const Cost cost = options.Bake ? Bake(mesh) : Draw(mesh, options);
      std::printf("%-16s %8d  %8.3f s  n^%5.2f  %8.2f rays/pixel  error %.5f\n",
        adversary.Name.c_str(), n, cost.Seconds,
        before > 0.0 ? std::log2(cost.Seconds / before) : 0.0, cost.RaysPerPixel, cost.Error);
      std::fflush(stdout);
      before = cost.Seconds;
    }
  }
  return 0;
}
