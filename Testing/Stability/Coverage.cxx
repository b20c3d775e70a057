// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Antialiasing: objects smaller than pixels, edges within an object, edges in motion. Flat white
// shapes on black are compared with exact coverage.
#include "Frames.h"
#include "Scenario.h"

#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkMapper.h"
#include "vtkNew.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraRayCasterConstants.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace penumbra
{

namespace
{

constexpr int Size = 96;
const char* const OpenGL = "OpenGL, 8 samples per pixel requested (OSMesa uses 4)";

/// Objects that no ray hits are not found: case 4, which [AA] omits.
void OmitCase4(vtkPenumbraRayCaster* caster)
{
  caster->GetConstants().FindSmallObjects = false;
}

void UseOneSample(vtkPenumbraRayCaster* caster)
{
  caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Uniform;
  caster->GetConstants().UniformSamples = 1;
}

Frame Draw(vtkRenderer* renderer, int width, int height, Variant variant, const Choice& ablate)
{
  return variant == Variant::Peer
    ? ByOpenGL(renderer, width, height, 8)
    : ByRays(renderer, width, height, variant == Variant::Ablated ? ablate : Choice());
}

Frame ExactCoverage(const std::vector<Shape>& shapes, int width = Size, int height = Size)
{
  return { width, height, SharesOf(shapes, width, height) };
}

using Shapes = std::function<std::vector<Shape>()>;

/// A static image of shapes, compared with exact coverage by a metric.
std::function<ScenarioResult(Variant)> Still(Shapes shapes, Choice ablate,
  double (*measure)(const std::vector<double>&, const std::vector<double>&))
{
  return [=](Variant variant) {
    const Frame image = Draw(RendererOf(shapes(), Size, Size), Size, Size, variant, ablate);
    return ScenarioResult{ measure(image.Values, ExactCoverage(shapes()).Values), image };
  };
}

/// The camera moves to the right by `step` pixels per frame.
std::function<ScenarioResult(Variant)> Pan(Shapes shapes, double step, int frames, Choice ablate,
  double (*measure)(const std::vector<std::vector<double>>&))
{
  return [=](Variant variant) {
    const vtkSmartPointer<vtkRenderer> renderer = RendererOf(shapes(), Size, Size);
    std::vector<std::vector<double>> times;
    Frame image;
    for (int frame = 0; frame < frames; ++frame)
    {
      image = Draw(renderer, Size, Size, variant, ablate);
      times.push_back(image.Values);
      double* eye = renderer->GetActiveCamera()->GetPosition();
      double* target = renderer->GetActiveCamera()->GetFocalPoint();
      renderer->GetActiveCamera()->SetPosition(eye[0] + step, eye[1], eye[2]);
      renderer->GetActiveCamera()->SetFocalPoint(target[0] + step, target[1], target[2]);
    }
    return ScenarioResult{ measure(times), image };
  };
}

/// Coverage of single frames at unrelated positions.
ScenarioResult FastPan(Variant variant)
{
  double worst = 0.0;
  Frame image;
  for (const double shift : { 0.0, -13.37, 21.93 })
  {
    std::vector<Shape> shapes = Rods(Size, Size, 5);
    for (Shape& shape : shapes)
    {
      shape.Center.x += shift;
      for (glm::dvec2& corner : shape.Outline)
      {
        corner.x += shift;
      }
    }
    image = Draw(RendererOf(shapes, Size, Size), Size, Size, variant, OmitCase4);
    worst = std::max(worst, CoverageMiss(image.Values, ExactCoverage(shapes).Values));
  }
  return { worst, image };
}

/// A star stays in view while the camera zooms. The sum of the image divided by the square of the
/// scale must be constant.
ScenarioResult Zoom(Variant variant)
{
  std::vector<std::vector<double>> times;
  Frame image;
  for (int frame = 0; frame < 8; ++frame)
  {
    const double scale = 1.0 + frame / 64.0;
    const vtkSmartPointer<vtkRenderer> renderer =
      RendererOf({ Star({ 48.2, 47.7 }, 38.0, 3.0, 96) }, Size, Size);
    renderer->GetActiveCamera()->SetParallelScale(.5 * Size / scale);
    image = Draw(renderer, Size, Size, variant, UseOneSample);
    times.push_back(image.Values);
    for (double& value : times.back())
    {
      value /= scale * scale;
    }
  }
  return { EnergyChange(times), image };
}

ScenarioResult OddSizes(Variant variant)
{
  double worst = 0.0;
  Frame image;
  for (const auto& [width, height] :
    { std::pair<int, int>(1, 1), { 1, 64 }, { 127, 3 }, { 33, 7 }, { 17, 16 }, { 61, 59 } })
  {
    const std::vector<Shape> shapes = { Disc(
      { .45 * width, .55 * height }, .4 * std::min(width, height), 48) };
    image = Draw(RendererOf(shapes, width, height), width, height, variant, UseOneSample);
    worst =
      std::max(worst, LargestDifference(image.Values, ExactCoverage(shapes, width, height).Values));
  }
  return { worst, image };
}

/// Half of the image behind a slanted edge, by the subdivision of [AA]. Dropping the subpixels that
/// are undecided at the last level would lose their light.
ScenarioResult PaperSubdivision(Variant variant)
{
  const Frame image = ByRays(
    RendererOf(HalfPlane(Size, Size), Size, Size), Size, Size, [&](vtkPenumbraRayCaster* caster) {
      caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Subdivision;
      caster->GetConstants().MaximumLevel = variant == Variant::Ablated ? 0 : 3;
    });
  return { LargestDifference(image.Values, ExactCoverage(HalfPlane(Size, Size)).Values), image };
}

/// A rotated checkerboard of cells of one mesh: edges between colors, not between objects.
ScenarioResult ColorJumps(Variant variant)
{
  std::vector<Shape> cells;
  std::vector<Shape> white;
  for (int i = 0; i < 100; ++i)
  {
    const auto at = [&](double x, double y) {
      return glm::dvec2(20.0, 9.0) + (i % 10 + x) * glm::dvec2(7.3, 2.1) +
        (i / 10 + y) * glm::dvec2(-1.1, 7.7);
    };
    cells.push_back({ at(.5, .5), { at(0, 0), at(1, 0), at(1, 1), at(0, 1) } });
    if ((i % 10 + i / 10) % 2)
    {
      white.push_back(cells.back());
    }
  }
  const vtkSmartPointer<vtkPolyData> mesh = MeshOf(cells);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPolys(); ++i)
  {
    const vtkIdType cell = i / 4;
    const double value = (cell % 10 + cell / 10) % 2 ? 255.0 : 0.0;
    colors->InsertNextTuple3(value, value, value);
  }
  mesh->GetCellData()->SetScalars(colors);
  const vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, mesh, false)->GetMapper()->ScalarVisibilityOn();
  LookAtImage(renderer, Size, Size);
  const Frame image = Draw(renderer, Size, Size, variant, [](vtkPenumbraRayCaster* caster) {
    caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Subdivision;
  });
  return { Rmse(image.Values, ExactCoverage(white).Values), image };
}

/// An image, and the 2x2 means of one with twice the resolution.
ScenarioResult TwoResolutions(Variant variant)
{
  std::vector<Shape> shapes = Rods(Size, Size, 4);
  const Frame small = Draw(RendererOf(shapes, Size, Size), Size, Size, variant, UseOneSample);
  for (Shape& shape : shapes)
  {
    shape.Center *= 2.0;
    for (glm::dvec2& corner : shape.Outline)
    {
      corner *= 2.0;
    }
  }
  const Frame large =
    Draw(RendererOf(shapes, 2 * Size, 2 * Size), 2 * Size, 2 * Size, variant, UseOneSample);
  return { Rmse(small.Values, Halved(large).Values), small };
}

}

std::vector<Scenario> CoverageScenarios()
{
  const Shapes rods = [] { return Rods(Size, Size, 6); };
  const Shapes dust = [] { return SmallDiscs(Size, Size, 12); };
  const Shapes comb = [] { return Comb(Size, Size); };
  const Shapes star = [] { return std::vector<Shape>{ Star({ 48.2, 47.7 }, 44.0, 6.0, 240) }; };
  const Shapes edge = [] { return HalfPlane(Size, Size); };
  const std::string withoutCase4 = "case 4: none";
  const std::string sample = "exact edges: one ray per pixel";
  return {
    { "ThinRods", "rods 0.08 to 0.4 pixels wide", "still", Metric::CoverageMiss, 1e-4, withoutCase4,
      "[AA] case 4 is omitted", OpenGL, Still(rods, OmitCase4, CoverageMiss) },
    { "ThinRodsSlowPan", "the same", "slow pan, 1/16 pixel per frame", Metric::Pop, .0626,
      withoutCase4, "[AA] case 4 is omitted", OpenGL, Pan(rods, 1.0 / 16.0, 12, OmitCase4, Pop) },
    { "ThinRodsFastPan", "the same", "fast pan, 13 and 35 pixels per frame", Metric::CoverageMiss,
      1e-4, withoutCase4, "[AA] case 4 is omitted", OpenGL, FastPan },
    { "Dust", "disks of 0.05 to 0.5 pixels", "still", Metric::CoverageMiss, 1e-4, withoutCase4,
      "[AA] case 4 is omitted", OpenGL, Still(dust, OmitCase4, CoverageMiss) },
    { "DustSlowPan", "the same", "slow pan, 1/16 pixel per frame", Metric::Energy, 1e-4,
      withoutCase4, "[AA] case 4 is omitted", OpenGL,
      Pan(dust, 1.0 / 16.0, 8, OmitCase4, EnergyChange) },
    { "GrateSlowPan", "a comb of 36 slivers", "slow pan, 1/16 pixel per frame", Metric::Energy,
      1e-4, sample, "[AA] drops sub-pixels of case 3 at L_max", OpenGL,
      Pan(comb, 1.0 / 16.0, 8, UseOneSample, EnergyChange) },
    { "SliversInAPoint", "a star of 120 spikes", "still", Metric::CoverageMiss, 1e-4, sample,
      "[AA] drops sub-pixels of case 3 at L_max", OpenGL, Still(star, UseOneSample, CoverageMiss) },
    { "LeafZoom", "a leaf of 48 spikes", "zoom, 1/64 per frame", Metric::Energy, 1e-4, sample,
      "[AA] drops sub-pixels of case 3 at L_max", OpenGL, Zoom },
    { "SlantedBorder", "half of the image, by the subdivision of [AA] to level 3", "still",
      Metric::MaximumDifference, .13, "levels of subdivision: none",
      "[AA] drops sub-pixels of case 3 at L_max", "", PaperSubdivision },
    { "ColourJumpsWithinOneObject", "a checkerboard of cells of one mesh", "still", Metric::Bias,
      1e-4, "exact areas of cells: subdivision of [AA]", "[AA] no edges within an object", OpenGL,
      ColorJumps },
    { "StraightEdge", "half of the image", "still", Metric::CoverageMiss, 1e-6, sample,
      "[AA] no exact coverage", OpenGL, Still(edge, UseOneSample, CoverageMiss) },
    { "OddSizes", "a disk in images of 1x1, 1x64, 127x3, 33x7, ... pixels", "still",
      Metric::MaximumDifference, 1e-4, sample, "", OpenGL, OddSizes },
    { "TwoResolutions", "rods, and the same image with twice the resolution", "still",
      Metric::Resolution, 1e-5, sample, "", OpenGL, TwoResolutions },
  };
}

}
