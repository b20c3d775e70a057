// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Where antialiasing fails: things smaller than pixels, borders that are no object's, borders in
// motion. Flat white shapes on black, against exact coverage.
#include "Frames.h"
#include "Scenario.h"

#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkMapper.h"
#include "vtkNew.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace penumbra
{

namespace
{

constexpr int Size = 96;
const char* const OpenGL = "OpenGL, 8 samples a pixel asked for (OSMesa gives 4)";

/// The subdivision of [AA] without its case 4, which the paper leaves out.
void AsPrinted(vtkPenumbraRayCaster* caster)
{
  caster->SetCoverageMethod(vtkPenumbraRayCaster::SUBDIVISION);
  caster->FindSmallObjectsOff();
}

void OneSample(vtkPenumbraRayCaster* caster)
{
  caster->SetCoverageMethod(vtkPenumbraRayCaster::UNIFORM);
  caster->SetUniformSamples(1);
}

Frame Draw(vtkRenderer* renderer, int width, int height, Variant variant, const Choice& broken)
{
  return variant == Variant::Peer
    ? ByOpenGL(renderer, width, height, 8)
    : ByRays(renderer, width, height, variant == Variant::Ablated ? broken : Choice());
}

Frame TruthOf(const std::vector<Shape>& shapes, int width = Size, int height = Size)
{
  return { width, height, SharesOf(shapes, width, height) };
}

using Shapes = std::function<std::vector<Shape>()>;

/// A still picture of shapes, by a measure of what it shows and what it should.
std::function<ScenarioResult(Variant)> Still(Shapes shapes, Choice broken,
  double (*measure)(const std::vector<double>&, const std::vector<double>&))
{
  return [=](Variant variant) {
    const Frame picture = Draw(PictureOf(shapes(), Size, Size), Size, Size, variant, broken);
    return ScenarioResult{ measure(picture.Values, TruthOf(shapes()).Values), picture };
  };
}

/// The camera moves by `step` pixels a frame, to the right.
std::function<ScenarioResult(Variant)> Pan(Shapes shapes, double step, int frames, Choice broken,
  double (*measure)(const std::vector<std::vector<double>>&))
{
  return [=](Variant variant) {
    const vtkSmartPointer<vtkRenderer> renderer = PictureOf(shapes(), Size, Size);
    std::vector<std::vector<double>> times;
    Frame picture;
    for (int frame = 0; frame < frames; ++frame)
    {
      picture = Draw(renderer, Size, Size, variant, broken);
      times.push_back(picture.Values);
      double* eye = renderer->GetActiveCamera()->GetPosition();
      double* target = renderer->GetActiveCamera()->GetFocalPoint();
      renderer->GetActiveCamera()->SetPosition(eye[0] + step, eye[1], eye[2]);
      renderer->GetActiveCamera()->SetFocalPoint(target[0] + step, target[1], target[2]);
    }
    return ScenarioResult{ measure(times), picture };
  };
}

/// Pixel by pixel against the truth, at positions that have nothing to do with one another.
ScenarioResult FastPan(Variant variant)
{
  double worst = 0.0;
  Frame picture;
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
    picture = Draw(PictureOf(shapes, Size, Size), Size, Size, variant, AsPrinted);
    worst = std::max(worst, CoverageMiss(picture.Values, TruthOf(shapes).Values));
  }
  return { worst, picture };
}

/// The whole of a leaf-like star is seen while the camera zooms: how much light it reflects to the eye
/// grows as the square of the scale.
ScenarioResult Zoom(Variant variant)
{
  std::vector<std::vector<double>> times;
  Frame picture;
  for (int frame = 0; frame < 8; ++frame)
  {
    const double scale = 1.0 + frame / 64.0;
    const vtkSmartPointer<vtkRenderer> renderer =
      PictureOf({ Star({ 48.2, 47.7 }, 38.0, 3.0, 96) }, Size, Size);
    renderer->GetActiveCamera()->SetParallelScale(.5 * Size / scale);
    picture = Draw(renderer, Size, Size, variant, OneSample);
    times.push_back(picture.Values);
    for (double& value : times.back())
    {
      value /= scale * scale;
    }
  }
  return { EnergyChange(times), picture };
}

ScenarioResult OddSizes(Variant variant)
{
  double worst = 0.0;
  Frame picture;
  for (const auto& [width, height] :
    { std::pair<int, int>(1, 1), { 1, 64 }, { 127, 3 }, { 33, 7 }, { 17, 16 }, { 61, 59 } })
  {
    const std::vector<Shape> shapes = { Disc(
      { .45 * width, .55 * height }, .4 * std::min(width, height), 48) };
    picture = Draw(PictureOf(shapes, width, height), width, height, variant, OneSample);
    worst =
      std::max(worst, LargestDifference(picture.Values, TruthOf(shapes, width, height).Values));
  }
  return { worst, picture };
}

/// Half of the picture behind a slanted border, by [AA]'s own subdivision: dropping the sub-pixels that
/// are undecided at the last level loses their light.
ScenarioResult PaperSubdivision(Variant variant)
{
  const Frame picture = ByRays(
    PictureOf(HalfPlane(Size, Size), Size, Size), Size, Size, [&](vtkPenumbraRayCaster* caster) {
      caster->SetCoverageMethod(vtkPenumbraRayCaster::SUBDIVISION);
      caster->SetMaximumLevel(variant == Variant::Ablated ? 0 : 3);
    });
  return { LargestDifference(picture.Values, TruthOf(HalfPlane(Size, Size)).Values), picture };
}

/// A chequerboard of cells of one mesh, turned: borders of colours, not of objects.
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
  LookAtPicture(renderer, Size, Size);
  const Frame picture = Draw(renderer, Size, Size, variant, [](vtkPenumbraRayCaster* caster) {
    AsPrinted(caster);
    caster->SetTolerance(1.0);
  });
  return { Rmse(picture.Values, TruthOf(white).Values), picture };
}

/// A picture, and the means of one of twice the size.
ScenarioResult TwoResolutions(Variant variant)
{
  std::vector<Shape> shapes = Rods(Size, Size, 4);
  const Frame small = Draw(PictureOf(shapes, Size, Size), Size, Size, variant, OneSample);
  for (Shape& shape : shapes)
  {
    shape.Center *= 2.0;
    for (glm::dvec2& corner : shape.Outline)
    {
      corner *= 2.0;
    }
  }
  const Frame large =
    Draw(PictureOf(shapes, 2 * Size, 2 * Size), 2 * Size, 2 * Size, variant, OneSample);
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
  const std::string printed = "case 4, and exact borders: [AA] as printed";
  const std::string sample = "exact borders: one ray a pixel";
  return {
    { "ThinRods", "rods 0.08 to 0.4 pixels wide", "still", Metric::CoverageMiss, 1e-4, printed,
      "[AA] case 4 is left out", OpenGL, Still(rods, AsPrinted, CoverageMiss) },
    { "ThinRodsSlowPan", "the same", "slow pan, 1/16 pixel a frame", Metric::Pop, .0626, printed,
      "[AA] case 4 is left out", OpenGL, Pan(rods, 1.0 / 16.0, 12, AsPrinted, Pop) },
    { "ThinRodsFastPan", "the same", "fast pan, 13 and 35 pixels a frame", Metric::CoverageMiss,
      1e-4, printed, "[AA] case 4 is left out", OpenGL, FastPan },
    { "Dust", "discs of 0.05 to 0.5 pixels", "still", Metric::CoverageMiss, 1e-4, printed,
      "[AA] case 4 is left out", OpenGL, Still(dust, AsPrinted, CoverageMiss) },
    { "DustSlowPan", "the same", "slow pan, 1/16 pixel a frame", Metric::Energy, 1e-4, printed,
      "[AA] case 4 is left out", OpenGL, Pan(dust, 1.0 / 16.0, 8, AsPrinted, EnergyChange) },
    { "GrateSlowPan", "a grate of 36 slivers", "slow pan, 1/16 pixel a frame", Metric::Energy, 1e-4,
      sample, "[AA] drops sub-pixels of case 3 at L_max", OpenGL,
      Pan(comb, 1.0 / 16.0, 8, OneSample, EnergyChange) },
    { "SliversInAPoint", "a star of 120 spikes", "still", Metric::CoverageMiss, 1e-4, sample,
      "[AA] drops sub-pixels of case 3 at L_max", OpenGL, Still(star, OneSample, CoverageMiss) },
    { "LeafZoom", "a leaf of 48 spikes", "zoom, 1/64 a frame", Metric::Energy, 1e-4, sample,
      "[AA] drops sub-pixels of case 3 at L_max", OpenGL, Zoom },
    { "SlantedBorder", "half of the picture, by [AA]'s subdivision to level 3", "still",
      Metric::MaximumDifference, .13, "levels: none", "[AA] drops sub-pixels of case 3 at L_max",
      "", PaperSubdivision },
    { "ColourJumpsWithinOneObject", "a chequerboard of cells of one mesh", "still", Metric::Bias,
      .006, "refinement by estimated error: [AA] as printed", "[AA] no borders inside an object",
      OpenGL, ColorJumps },
    { "StraightEdge", "half of the picture", "still", Metric::CoverageMiss, 1e-6, sample,
      "[AA] no exact coverage", OpenGL, Still(edge, OneSample, CoverageMiss) },
    { "OddSizes", "a disc in pictures of 1x1, 1x64, 127x3, 33x7, ...", "still",
      Metric::MaximumDifference, 1e-4, sample, "", OpenGL, OddSizes },
    { "TwoResolutions", "rods, and the same picture twice as large", "still", Metric::Resolution,
      1e-5, sample, "", OpenGL, TwoResolutions },
  };
}

}
