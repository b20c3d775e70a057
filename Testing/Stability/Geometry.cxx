// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Difficult geometry: edges within one object, coplanar faces, cracks, sizes and distances far from
// 1, and NaN points. Images by the ray caster, lit by a headlight.
#include "Frames.h"
#include "Scenario.h"

#include "BruteForce/BruteForce.h"
#include "ClosedForms/ExactCoverage.h"
#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCubeSource.h"
#include "vtkNew.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraRayCasterConstants.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

using Renderer = vtkSmartPointer<vtkRenderer>;
using Mesh = vtkSmartPointer<vtkPolyData>;

constexpr int Size = 64;
const char* const OpenGL = "OpenGL, 8 samples per pixel requested (OSMesa uses 4)";

void UseOneSample(vtkPenumbraRayCaster* caster)
{
  caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Uniform;
  caster->GetConstants().UniformSamples = 1;
}

Mesh Box(glm::dvec3 center, glm::dvec3 size)
{
  vtkNew<vtkCubeSource> cube;
  cube->SetCenter(center.x, center.y, center.z);
  cube->SetXLength(size.x);
  cube->SetYLength(size.y);
  cube->SetZLength(size.z);
  const Mesh box = DataOf(cube);
  box->GetPointData()->Initialize();
  return box;
}

/// Returns a mesh whose positions were rounded to floats at this distance from the origin.
Mesh RoundedToFloat(vtkPolyData* mesh, double distance)
{
  return Deformed(
    mesh, [=](glm::dvec3 p) { return glm::dvec3(glm::vec3(p + distance)) - distance; });
}

Renderer NewLitRenderer(const std::vector<Mesh>& meshes, glm::dvec3 direction)
{
  Renderer renderer = NewRenderer();
  for (const Mesh& mesh : meshes)
  {
    AddMesh(renderer, mesh, true)->GetProperty()->SetInterpolationToFlat();
  }
  LookAlong(renderer, direction, { 0.0, 0.0, 1.0 }, Size, Size);
  return renderer;
}

Frame Draw(vtkRenderer* renderer, Variant variant, const Choice& ablate)
{
  return variant == Variant::Peer
    ? ByOpenGL(renderer, Size, Size, 8)
    : ByRays(renderer, Size, Size, variant == Variant::Ablated ? ablate : Choice());
}

/// Renders the scene and returns the RMSE against a brute-force image.
ScenarioResult CompareWithBruteForce(vtkRenderer* renderer, Variant variant, const Choice& ablate)
{
  const Frame image = Draw(renderer, variant, ablate);
  std::vector<double> expected;
  for (const glm::dvec3& color :
    DrawByBruteForce(BruteForceOf(renderer, Size, Size), Size, Size, 12).Colors)
  {
    expected.push_back(color.y);
  }
  return { Rmse(image.Values, expected), image };
}

ScenarioResult SelfSilhouettes(Variant variant)
{
  return CompareWithBruteForce(
    NewLitRenderer({ Burr() }, { -.6, 1.0, -.4 }), variant, [](vtkPenumbraRayCaster* caster) {
      caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Subdivision;
    });
}

ScenarioResult Interpenetration(Variant variant)
{
  return CompareWithBruteForce(
    NewLitRenderer({ Burr(), Box({ .2, -.2, .1 }, { .9, .7, .5 }) }, { -.6, 1.0, -.4 }), variant,
    UseOneSample);
}

ScenarioResult NonManifoldEdge(Variant variant)
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, -1.0);
  points->InsertNextPoint(0.0, 0.0, 1.0);
  vtkNew<vtkCellArray> quads;
  for (int sheet = 0; sheet < 5; ++sheet)
  {
    const double angle = 1.3 * sheet + .2;
    const vtkIdType corner = points->InsertNextPoint(std::cos(angle), std::sin(angle), -1.0);
    points->InsertNextPoint(std::cos(angle), std::sin(angle), 1.0);
    const vtkIdType corners[4] = { 0, corner, corner + 1, 1 };
    quads->InsertNextCell(4, corners);
  }
  Mesh mesh = Mesh::New();
  mesh->SetPoints(points);
  mesh->SetPolys(quads);
  return CompareWithBruteForce(NewLitRenderer({ mesh }, { -.3, 1.0, -.9 }), variant, UseOneSample);
}

/// Planks with gaps in a plane that is seen at 2 degrees.
ScenarioResult GrazingPlanks(Variant variant)
{
  std::vector<Mesh> planks;
  for (int i = 0; i < 40; ++i)
  {
    planks.push_back(Box({ 0.0, .3 * i, 0.0 }, { 4.0, .15, 0.0 }));
  }
  const Renderer renderer = NewRenderer();
  for (const Mesh& plank : planks)
  {
    AddMesh(renderer, plank, false);
  }
  renderer->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
  renderer->GetActiveCamera()->SetPosition(0.0, -1.0, .22);
  renderer->GetActiveCamera()->SetFocalPoint(0.0, 2.0, .115);
  renderer->ResetCameraClippingRange();
  return CompareWithBruteForce(renderer, variant, UseOneSample);
}

ScenarioResult WideAngle(Variant variant)
{
  std::vector<Mesh> boxes;
  for (int i = 0; i < 25; ++i)
  {
    boxes.push_back(Box({ i % 5 - 2.0, 1.5, i / 5 - 2.0 }, { .4, .3, .4 }));
  }
  const Renderer renderer = NewLitRenderer(boxes, { 0.0, 1.0, 0.0 });
  renderer->GetActiveCamera()->SetPosition(.1, .2, .05);
  renderer->GetActiveCamera()->SetFocalPoint(.1, 1.0, .05);
  renderer->GetActiveCamera()->SetViewAngle(150.0);
  renderer->GetActiveCamera()->SetClippingRange(.05, 10.0);
  return CompareWithBruteForce(renderer, variant, UseOneSample);
}

/// Adjacent strips, each divided at different heights, in front of the background. Ablated: gaps of
/// a tenth of a pixel.
ScenarioResult TJunctions(Variant variant)
{
  const glm::dvec2 along(std::cos(.37), std::sin(.37));
  const glm::dvec2 up(-along.y, along.x);
  const double width = variant == Variant::Ablated ? 14.2 : 14.3;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> quads;
  for (int strip = 0; strip < 7; ++strip)
  {
    const int cuts = 3 + 4 * strip;
    for (int i = 0; i < cuts; ++i)
    {
      vtkIdType corners[4];
      for (int k = 0; k < 4; ++k)
      {
        const double x = 14.3 * strip + (k == 1 || k == 2 ? width : 0.0);
        const double y = 100.0 * (i + (k > 1)) / cuts;
        const glm::dvec2 position = glm::dvec2(12.0, -32.0) + x * along + y * up;
        corners[k] = points->InsertNextPoint(position.x, position.y, 0.0);
      }
      quads->InsertNextCell(4, corners);
    }
  }
  Mesh mesh = Mesh::New();
  mesh->SetPoints(points);
  mesh->SetPolys(quads);
  const Renderer renderer = NewRenderer();
  AddMesh(renderer, mesh, false);
  LookAtImage(renderer, Size, Size);
  const Frame image = Draw(renderer, variant, {});
  return { 1.0 - *std::min_element(image.Values.begin(), image.Values.end()), image };
}

/// A disk in a slanted plane, with its center in image coordinates. Positions are rounded to floats
/// at distance `distance` from the origin.
Mesh SlantedDisk(glm::dvec2 center, double distance)
{
  const glm::dvec3 middle(.5 * Size, .5 * Size, 0.0);
  const glm::dvec3 right = glm::normalize(glm::dvec3(.8, .1, -.5));
  const glm::dvec3 up = glm::normalize(glm::cross(glm::dvec3(.3, .2, 1.0), right));
  const Mesh disc = Deformed(MeshOf({ Disc(center, 28.0, 60) }),
    [&](glm::dvec3 p) { return middle + (p.x - middle.x) * right + (p.y - middle.y) * up; });
  return RoundedToFloat(disc, distance);
}

/// A white and a black disk in one plane with different triangulations: the later one of the two is
/// visible everywhere, in either order.
ScenarioResult CoplanarDuplicates(Variant variant)
{
  const double distance = variant == Variant::Ablated ? 1e6 : 0.0;
  const Mesh discs[] = { SlantedDisk({ 32.3, 31.9 }, distance),
    SlantedDisk({ 39.6, 26.8 }, distance) };
  const auto draw = [&](const std::vector<int>& order) {
    const Renderer renderer = NewRenderer();
    for (const int each : order)
    {
      AddMesh(renderer, discs[each], false)->GetProperty()->SetColor(each, each, each);
    }
    LookAtImage(renderer, Size, Size);
    return Draw(renderer, variant, {});
  };
  double largest = 0.0;
  Frame shown;
  for (const int last : { 1, 0 })
  {
    const Frame image = draw({ 1 - last, last });
    const Frame single = draw({ last });
    for (int y = 24; y < 40; ++y)
    {
      for (int x = 24; x < 40; ++x)
      {
        const int i = y * Size + x;
        largest = std::max(largest, std::abs(image.Values[i] - single.Values[i]));
      }
    }
    shown = last == 1 ? image : shown;
  }
  return { largest, shown };
}

Renderer RenderBurrAt(glm::dvec3 position, double scale, bool roundsToFloat)
{
  Mesh mesh = Deformed(Burr(), [=](glm::dvec3 p) { return scale * p + position; });
  if (roundsToFloat)
  {
    mesh = RoundedToFloat(mesh, 0.0);
  }
  const Renderer renderer = NewLitRenderer({ mesh }, { -.6, 1.0, -.4 });
  const glm::dvec3 eye = position + scale * glm::dvec3(2.0, -3.4, 1.3);
  renderer->GetActiveCamera()->SetFocalPoint(position.x, position.y, position.z);
  renderer->GetActiveCamera()->SetPosition(eye.x, eye.y, eye.z);
  renderer->ResetCameraClippingRange();
  return renderer;
}

ScenarioResult FarFromOrigin(Variant variant)
{
  const Frame near = Draw(RenderBurrAt(glm::dvec3(0.0), 1.0, false), variant, {});
  const Frame far =
    Draw(RenderBurrAt({ 1e7, -2e7, 1e7 }, 1.0, variant == Variant::Ablated), variant, {});
  return { Rmse(near.Values, far.Values), far };
}

/// Occlusion with a radius from the bounds. Ablated: a fixed radius in world units.
std::function<ScenarioResult(Variant)> Units(double scale)
{
  return [scale](Variant variant) {
    const auto shaded = [&](double unit) {
      return ByRays(
        RenderBurrAt(glm::dvec3(0.0), unit, false), Size, Size, [&](vtkPenumbraRayCaster* caster) {
          caster->AmbientOcclusionOn();
          caster->SetTolerance(1.0 / 64.0);
          caster->SetLightTolerance(caster->GetTolerance());
          caster->SetAmbientOcclusionRadius(variant == Variant::Ablated ? .2 : 0.0);
        });
    };
    const Frame image = shaded(scale);
    return ScenarioResult{ Rmse(shaded(1.0).Values, image.Values), image };
  };
}

/// A mirrored scene with ambient occlusion.
ScenarioResult Mirror(Variant variant)
{
  const auto shaded = [&](double side) {
    const Renderer renderer = NewLitRenderer(
      { Deformed(Burr(), [=](glm::dvec3 p) { return glm::dvec3(side * p.x, p.y, p.z); }) },
      { side * -.6, 1.0, -.4 });
    if (variant == Variant::Peer)
    {
      return ByOpenGL(renderer, Size, Size, 8);
    }
    return ByRays(renderer, Size, Size, [&](vtkPenumbraRayCaster* caster) {
      caster->AmbientOcclusionOn();
      caster->SetTolerance(variant == Variant::Ablated ? .5 : 1.0 / 128.0);
      caster->SetLightTolerance(caster->GetTolerance());
    });
  };
  const Frame mirrored = shaded(-1.0);
  return { Rmse(Mirrored(shaded(1.0)).Values, mirrored.Values), mirrored };
}

/// A box at distance 1 in front of a white wall at 999,999 that hides a black wall at 1,000,000.
ScenarioResult NearAndFar(Variant variant)
{
  const Renderer renderer = NewRenderer();
  const auto wall = [&](double distance, double color) {
    AddMesh(renderer, Box({ 0.0, distance, 0.0 }, { 4.0 * distance, 0.0, 4.0 * distance }), false)
      ->GetProperty()
      ->SetColor(color, color, color);
  };
  wall(999999.0, 1.0);
  wall(1e6, 0.0);
  AddMesh(renderer, Box({ 0.0, 1.0, 0.0 }, { .2, .1, .2 }), false)
    ->GetProperty()
    ->SetColor(.5, .5, .5);
  renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 0.0);
  renderer->GetActiveCamera()->SetFocalPoint(0.0, 1.0, 0.0);
  renderer->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
  renderer->GetActiveCamera()->SetClippingRange(.9, 1.1e6);
  const Frame image =
    variant == Variant::Ours ? ByRays(renderer, Size, Size) : ByOpenGL(renderer, Size, Size, 8);
  // The near side of the box is at distance 0.95 and is 0.2 wide.
  const double half = .5 * Size * .1 / .95 / std::tan(15.0 * std::acos(-1.0) / 180.0);
  std::vector<double> expected =
    SharesOf({ { glm::dvec2(.5 * Size),
               { glm::dvec2(.5 * Size - half), glm::dvec2(.5 * Size + half, .5 * Size - half),
                 glm::dvec2(.5 * Size + half), glm::dvec2(.5 * Size - half, .5 * Size + half) } } },
      Size, Size);
  for (double& value : expected)
  {
    value = 1.0 - .5 * value;
  }
  return { Rmse(image.Values, expected), image };
}

/// A mesh with NaN points, against a mesh without the cells of these points.
ScenarioResult NotNumbers(Variant variant)
{
  const double nan = variant == Variant::Ablated ? 0.0 : std::nan("");
  const Mesh whole = Burr();
  vtkIdType each = 0;
  const Mesh damaged =
    Deformed(whole, [&](glm::dvec3 p) { return ++each % 40 == 0 ? glm::dvec3(nan) : p; });
  vtkNew<vtkCellArray> kept;
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < whole->GetPolys()->GetNumberOfCells(); ++cell)
  {
    whole->GetPolys()->GetCellAtId(cell, corners);
    const vtkIdType* first = corners->GetPointer(0);
    if (std::none_of(first, first + corners->GetNumberOfIds(),
          [](vtkIdType id) { return (id + 1) % 40 == 0; }))
    {
      kept->InsertNextCell(corners);
    }
  }
  Mesh sound = Mesh::New();
  sound->SetPoints(whole->GetPoints());
  sound->SetPolys(kept);
  const Renderer reference = NewLitRenderer({ sound }, { -.6, 1.0, -.4 });
  const Renderer renderer = NewLitRenderer({ damaged }, { -.6, 1.0, -.4 });
  renderer->SetActiveCamera(reference->GetActiveCamera());
  const Frame image = Draw(renderer, variant, {});
  return { Rmse(image.Values, Draw(reference, variant, {}).Values), image };
}

/// The inside of a closed mesh: no background is visible. Ablated: every 100th cell is missing.
ScenarioResult InsideAMesh(Variant variant)
{
  const Renderer renderer = NewRenderer();
  const Mesh burr = Burr();
  if (variant == Variant::Ablated)
  {
    vtkNew<vtkCellArray> kept;
    vtkNew<vtkIdList> corners;
    for (vtkIdType cell = 0; cell < burr->GetPolys()->GetNumberOfCells(); ++cell)
    {
      burr->GetPolys()->GetCellAtId(cell, corners);
      if (cell % 100 != 0)
      {
        kept->InsertNextCell(corners);
      }
    }
    burr->SetPolys(kept);
  }
  AddMesh(renderer, burr, false);
  renderer->GetActiveCamera()->SetPosition(.02, .01, -.02);
  renderer->GetActiveCamera()->SetFocalPoint(.3, -.5, .7);
  renderer->GetActiveCamera()->SetViewAngle(110.0);
  renderer->GetActiveCamera()->SetClippingRange(.001, 10.0);
  const Frame image = Draw(renderer, variant, {});
  return { 1.0 - *std::min_element(image.Values.begin(), image.Values.end()), image };
}

/// Rods behind a pane of glass.
ScenarioResult BehindGlass(Variant variant)
{
  const std::vector<Shape> rods = Rods(Size, Size, 4);
  const Renderer renderer = RendererOf(rods, Size, Size);
  vtkActor* glass = AddMesh(renderer, Box({ 32.0, 32.0, 20.0 }, { 100.0, 100.0, 0.0 }), false);
  glass->GetProperty()->SetOpacity(.5);
  glass->GetProperty()->SetColor(.4, .4, .4);
  const Frame image = Draw(renderer, variant,
    [](vtkPenumbraRayCaster* caster) { caster->GetConstants().FindSmallObjects = false; });
  std::vector<double> expected = SharesOf(rods, Size, Size);
  for (double& value : expected)
  {
    value = .5 * value + .5 * .4;
  }
  return { LargestDifference(image.Values, expected), image };
}

}

std::vector<Scenario> GeometryScenarios()
{
  const std::string sample = "refinement: one ray per pixel";
  const std::string rounded = "double precision: positions rounded to floats far from the origin";
  const std::string rays = "tolerance of occlusion: 1/2";
  return {
    { "BordersWithinOneObject", "a burr, most of whose silhouettes lie in front of itself", "still",
      Metric::Bias, .002,
      "edges from the mesh: subdivision of [AA], whose case 3 finds edges between objects only",
      "[AA] no edges within an object", OpenGL, SelfSilhouettes },
    { "Interpenetration", "a burr and a box that intersect", "still", Metric::Bias, .004, sample,
      "", OpenGL, Interpenetration },
    { "NonManifoldEdge", "five sheets that share one edge", "still", Metric::Bias, .004, sample, "",
      OpenGL, NonManifoldEdge },
    { "GrazingPlanks", "40 planks with gaps, seen at 2 degrees", "still", Metric::Bias, .015,
      sample, "", OpenGL, GrazingPlanks },
    { "WideAngle", "25 boxes at a view angle of 150 degrees", "still", Metric::Bias, .004, sample,
      "", OpenGL, WideAngle },
    { "TJunctions", "strips divided at different heights than their neighbors", "still",
      Metric::Leak, 1e-3, "shared edges: gaps of a tenth of a pixel", "", OpenGL, TJunctions },
    { "InsideAClosedMesh", "a burr seen from inside", "still", Metric::Leak, 1e-3,
      "closed mesh: every 100th cell is missing", "", OpenGL, InsideAMesh },
    { "CoplanarDuplicates", "two disks in one slanted plane, the later one visible", "still",
      Metric::MaximumDifference, .01, rounded, "", OpenGL, CoplanarDuplicates },
    { "BehindGlass", "rods behind a translucent pane", "still", Metric::MaximumDifference, .001,
      "case 4: none", "[AA] case 4 is omitted", OpenGL, BehindGlass },
    { "FarFromTheOrigin", "a burr 1e7 units from the origin", "still", Metric::Bias, .001, rounded,
      "[TSSAO] large scenes lose precision", OpenGL, FarFromOrigin },
    { "NearAndFar", "a box at distance 1 in front of walls at 999,999 and 1,000,000", "still",
      Metric::Bias, 1e-3, "ray distances: a depth buffer of 24 bits (OpenGL)", "", OpenGL,
      NearAndFar },
    { "TinyUnit", "a burr of size 1e-6 with ambient occlusion", "still", Metric::UnitIndependence,
      .008, "radius from the bounds: 0.2 units", "[ISAO] distances in scene units", "",
      Units(1e-6) },
    { "HugeUnit", "a burr of size 1e6 with ambient occlusion", "still", Metric::UnitIndependence,
      .008, "radius from the bounds: 0.2 units", "[ISAO] distances in scene units", "",
      Units(1e6) },
    { "MirroredScene", "a burr with ambient occlusion", "mirrored", Metric::Symmetry, .006, rays,
      "", OpenGL, Mirror },
    { "PointsThatAreNoNumbers", "a burr with NaN in every 40th point", "still", Metric::Bias, .001,
      "skipping cells with NaN points: NaN replaced by 0", "", OpenGL, NotNumbers },
  };
}

}
