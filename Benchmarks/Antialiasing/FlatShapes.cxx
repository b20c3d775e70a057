// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"

#include "vtkPenumbraRayCasterConstants.h"
#include "vtkRenderer.h"

namespace penumbra
{
namespace
{

constexpr int Size = 256;

struct FlatScene
{
  std::string Name;
  std::vector<Shape> Shapes;
  double RaysPerPixel; ///< target
  double Edge;         ///< target; 0: none
  double Worst;        ///< target; 0: none
};

}

void MeasureFlatShapes(Benchmark& benchmark)
{
  const glm::dvec2 middle(128.3, 127.6);
  const FlatScene scenes[] = {
    { "half-plane", HalfPlane(Size, Size), 1.02, 0.0005, 0.0 },
    { "disc", { Disc(middle, 100.0, 720) }, 1.02, 0.0005, 0.0 },
    { "discs of 0.05-0.5 px", SmallDiscs(Size, Size, 20), 1.12, 0.0, 0.01 },
    { "rods 0.08-0.4 px wide", Rods(Size, Size, 6), 1.12, 0.0, 0.01 },
    { "comb of slivers", Comb(Size, Size), 1.15, 0.002, 0.0 },
    { "star of 72 edges", { Star(middle, 60.0, 8.0, 72) }, 1.15, 0.002, 0.0 },
    { "star of 240 edges", { Star(middle, 60.0, 8.0, 240) }, 1.15, 0.002, 0.0 },
  };
  for (const FlatScene& scene : scenes)
  {
    const std::vector<double> shares = SharesOf(scene.Shapes, Size, Size);
    const std::vector<bool> isEdge = PartlyCoveredPixels(shares);
    vtkSmartPointer<vtkRenderer> renderer = RendererOf(scene.Shapes, Size, Size);
    const Answer answer = Cast(renderer, Size, Size,
      [](vtkPenumbraRayCaster* caster) { caster->SetTolerance(1.0 / 512.0); });
    const Errors errors = Judge(benchmark, scene.Name, answer, WhiteOnBlack(shares), isEdge, Size);
    ResultTable& table = benchmark.Results;
    const std::string count = std::to_string(errors.EdgePixels) + " edge pixels";
    table.Add(
      scene.Name, "rays per pixel", answer.RaysPerPixel, TargetKind::AtMost, scene.RaysPerPixel);
    table.Add(scene.Name, "edge RMSE", errors.Edge,
      scene.Edge > 0.0 ? TargetKind::AtMost : TargetKind::None, scene.Edge, count);
    table.Add(scene.Name, "worst pixel", errors.Worst,
      scene.Worst > 0.0 ? TargetKind::AtMost : TargetKind::None, scene.Worst);
    const Errors uniform = Compare(Cast(renderer, Size, Size,
                                     [](vtkPenumbraRayCaster* caster) {
                                       caster->GetConstants().CoverageMethod =
                                         penumbra::CoverageMethods::Uniform;
                                     })
                                     .Colors,
      WhiteOnBlack(shares), isEdge);
    table.Add(scene.Name, "edge RMSE of uniform 8x8", uniform.Edge, TargetKind::None);
  }
}

}
