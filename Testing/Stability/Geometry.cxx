// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Where the geometry itself is difficult: borders within one object, faces in one plane, cracks, sizes
// and distances far from 1, points that are no numbers. By the ray caster, lit by a headlight.
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
const char* const OpenGL = "OpenGL, 8 samples a pixel asked for (OSMesa gives 4)";

void OneSample(vtkPenumbraRayCaster* caster)
{
  caster->SetCoverageMethod(vtkPenumbraRayCaster::UNIFORM);
  caster->SetUniformSamples(1);
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

/// What remains of positions that somebody stored as floats, this far from the origin.
Mesh Rounded(vtkPolyData* mesh, double distance)
{
  return Deformed(
    mesh, [=](glm::dvec3 p) { return glm::dvec3(glm::vec3(p + distance)) - distance; });
}

Renderer Lit(const std::vector<Mesh>& meshes, glm::dvec3 direction)
{
  Renderer renderer = NewRenderer();
  for (const Mesh& mesh : meshes)
  {
    AddMesh(renderer, mesh, true)->GetProperty()->SetInterpolationToFlat();
  }
  LookAlong(renderer, direction, { 0.0, 0.0, 1.0 }, Size, Size);
  return renderer;
}

Frame Draw(vtkRenderer* renderer, Variant variant, const Choice& broken)
{
  return variant == Variant::Peer
    ? ByOpenGL(renderer, Size, Size, 8)
    : ByRays(renderer, Size, Size, variant == Variant::Ablated ? broken : Choice());
}

/// Against brute force.
ScenarioResult Judge(vtkRenderer* renderer, Variant variant, const Choice& broken)
{
  const Frame picture = Draw(renderer, variant, broken);
  std::vector<double> truth;
  for (const glm::dvec3& color :
    DrawByBruteForce(BruteForceOf(renderer, Size, Size), Size, Size, 12).Colors)
  {
    truth.push_back(color.y);
  }
  return { Rmse(picture.Values, truth), picture };
}

ScenarioResult SelfSilhouettes(Variant variant)
{
  return Judge(Lit({ Burr() }, { -.6, 1.0, -.4 }), variant, [](vtkPenumbraRayCaster* caster) {
    caster->SetCoverageMethod(vtkPenumbraRayCaster::SUBDIVISION);
    caster->SetTolerance(1.0);
  });
}

ScenarioResult Interpenetration(Variant variant)
{
  return Judge(
    Lit({ Burr(), Box({ .2, -.2, .1 }, { .9, .7, .5 }) }, { -.6, 1.0, -.4 }), variant, OneSample);
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
  return Judge(Lit({ mesh }, { -.3, 1.0, -.9 }), variant, OneSample);
}

/// Planks with gaps on a plane that is seen at 2 degrees.
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
  return Judge(renderer, variant, OneSample);
}

ScenarioResult WideAngle(Variant variant)
{
  std::vector<Mesh> boxes;
  for (int i = 0; i < 25; ++i)
  {
    boxes.push_back(Box({ i % 5 - 2.0, 1.5, i / 5 - 2.0 }, { .4, .3, .4 }));
  }
  const Renderer renderer = Lit(boxes, { 0.0, 1.0, 0.0 });
  renderer->GetActiveCamera()->SetPosition(.1, .2, .05);
  renderer->GetActiveCamera()->SetFocalPoint(.1, 1.0, .05);
  renderer->GetActiveCamera()->SetViewAngle(150.0);
  renderer->GetActiveCamera()->SetClippingRange(.05, 10.0);
  return Judge(renderer, variant, OneSample);
}

/// Strips side by side, each cut at other heights; behind them nothing. Broken: a tenth of a pixel apart.
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
        const glm::dvec2 place = glm::dvec2(12.0, -32.0) + x * along + y * up;
        corners[k] = points->InsertNextPoint(place.x, place.y, 0.0);
      }
      quads->InsertNextCell(4, corners);
    }
  }
  Mesh mesh = Mesh::New();
  mesh->SetPoints(points);
  mesh->SetPolys(quads);
  const Renderer renderer = NewRenderer();
  AddMesh(renderer, mesh, false);
  LookAtPicture(renderer, Size, Size);
  const Frame picture = Draw(renderer, variant, {});
  return { 1.0 - *std::min_element(picture.Values.begin(), picture.Values.end()), picture };
}

/// A disc in a plane of its own, as the picture of this size shows it.
Mesh Tilted(glm::dvec2 center, double apart)
{
  const glm::dvec3 middle(.5 * Size, .5 * Size, 0.0);
  const glm::dvec3 right = glm::normalize(glm::dvec3(.8, .1, -.5));
  const glm::dvec3 up = glm::normalize(glm::cross(glm::dvec3(.3, .2, 1.0), right));
  const Mesh disc = Deformed(MeshOf({ Disc(center, 28.0, 60) }),
    [&](glm::dvec3 p) { return middle + (p.x - middle.x) * right + (p.y - middle.y) * up; });
  return Rounded(disc, apart);
}

/// A white and a black disc in one plane, divided otherwise: one of the two is seen everywhere, whoever
/// comes first.
ScenarioResult CoplanarDuplicates(Variant variant)
{
  const double apart = variant == Variant::Ablated ? 1e6 : 0.0;
  const Mesh discs[] = { Tilted({ 32.3, 31.9 }, apart), Tilted({ 39.6, 26.8 }, apart) };
  Frame pictures[2];
  for (const int first : { 0, 1 })
  {
    const Renderer renderer = NewRenderer();
    for (const int each : { first, 1 - first })
    {
      AddMesh(renderer, discs[each], false)->GetProperty()->SetColor(each, each, each);
    }
    LookAtPicture(renderer, Size, Size);
    pictures[first] = Draw(renderer, variant, {});
  }
  const double middle = pictures[0].Values[32 * Size + 32];
  double largest = 0.0;
  for (const Frame& picture : pictures)
  {
    for (int y = 24; y < 40; ++y)
    {
      for (int x = 24; x < 40; ++x)
      {
        largest = std::max(largest, std::abs(picture.Values[y * Size + x] - middle));
      }
    }
  }
  return { largest, pictures[0] };
}

Renderer Placed(glm::dvec3 place, double scale, bool rounds)
{
  Mesh mesh = Deformed(Burr(), [=](glm::dvec3 p) { return scale * p + place; });
  if (rounds)
  {
    mesh = Rounded(mesh, 0.0);
  }
  const Renderer renderer = Lit({ mesh }, { -.6, 1.0, -.4 });
  const glm::dvec3 eye = place + scale * glm::dvec3(2.0, -3.4, 1.3);
  renderer->GetActiveCamera()->SetFocalPoint(place.x, place.y, place.z);
  renderer->GetActiveCamera()->SetPosition(eye.x, eye.y, eye.z);
  renderer->ResetCameraClippingRange();
  return renderer;
}

ScenarioResult FarFromOrigin(Variant variant)
{
  const Frame near = Draw(Placed(glm::dvec3(0.0), 1.0, false), variant, {});
  const Frame far = Draw(Placed({ 1e7, -2e7, 1e7 }, 1.0, variant == Variant::Ablated), variant, {});
  return { Rmse(near.Values, far.Values), far };
}

/// Occlusion with a radius from the bounds; broken: from the author's own unit.
std::function<ScenarioResult(Variant)> Units(double scale)
{
  return [scale](Variant variant) {
    const auto shaded = [&](double unit) {
      return ByRays(
        Placed(glm::dvec3(0.0), unit, false), Size, Size, [&](vtkPenumbraRayCaster* caster) {
          caster->AmbientOcclusionOn();
          caster->SetTolerance(1.0 / 64.0);
          caster->SetAmbientOcclusionRadius(variant == Variant::Ablated ? .2 : 0.0);
        });
    };
    const Frame picture = shaded(scale);
    return ScenarioResult{ Rmse(shaded(1.0).Values, picture.Values), picture };
  };
}

/// The mirrored scene under occlusion.
ScenarioResult Mirror(Variant variant)
{
  const auto shaded = [&](double side) {
    const Renderer renderer =
      Lit({ Deformed(Burr(), [=](glm::dvec3 p) { return glm::dvec3(side * p.x, p.y, p.z); }) },
        { side * -.6, 1.0, -.4 });
    if (variant == Variant::Peer)
    {
      return ByOpenGL(renderer, Size, Size, 8);
    }
    return ByRays(renderer, Size, Size, [&](vtkPenumbraRayCaster* caster) {
      caster->AmbientOcclusionOn();
      caster->SetTolerance(variant == Variant::Ablated ? .5 : 1.0 / 128.0);
    });
  };
  const Frame mirrored = shaded(-1.0);
  return { Rmse(Mirrored(shaded(1.0)).Values, mirrored.Values), mirrored };
}

/// A thing at 1 before a white wall at 999,999 that hides a black one at 1,000,000.
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
  const Frame picture =
    variant == Variant::Ours ? ByRays(renderer, Size, Size) : ByOpenGL(renderer, Size, Size, 8);
  // The near side of the box, at .95, is .2 wide.
  const double half = .5 * Size * .1 / .95 / std::tan(15.0 * std::acos(-1.0) / 180.0);
  std::vector<double> truth =
    SharesOf({ { glm::dvec2(.5 * Size),
               { glm::dvec2(.5 * Size - half), glm::dvec2(.5 * Size + half, .5 * Size - half),
                 glm::dvec2(.5 * Size + half), glm::dvec2(.5 * Size - half, .5 * Size + half) } } },
      Size, Size);
  for (double& value : truth)
  {
    value = 1.0 - .5 * value;
  }
  return { Rmse(picture.Values, truth), picture };
}

/// Points that are no numbers, and the cells around them left out by hand.
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
  const Renderer reference = Lit({ sound }, { -.6, 1.0, -.4 });
  const Renderer renderer = Lit({ damaged }, { -.6, 1.0, -.4 });
  renderer->SetActiveCamera(reference->GetActiveCamera());
  const Frame picture = Draw(renderer, variant, {});
  return { Rmse(picture.Values, Draw(reference, variant, {}).Values), picture };
}

/// From within a closed mesh: nothing but its walls.
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
  const Frame picture = Draw(renderer, variant, {});
  return { 1.0 - *std::min_element(picture.Values.begin(), picture.Values.end()), picture };
}

/// Rods behind a pane of glass.
ScenarioResult BehindGlass(Variant variant)
{
  const std::vector<Shape> rods = Rods(Size, Size, 4);
  const Renderer renderer = PictureOf(rods, Size, Size);
  vtkActor* glass = AddMesh(renderer, Box({ 32.0, 32.0, 20.0 }, { 100.0, 100.0, 0.0 }), false);
  glass->GetProperty()->SetOpacity(.5);
  glass->GetProperty()->SetColor(.4, .4, .4);
  const Frame picture = Draw(renderer, variant, [](vtkPenumbraRayCaster* caster) {
    caster->SetCoverageMethod(vtkPenumbraRayCaster::SUBDIVISION);
    caster->FindSmallObjectsOff();
  });
  std::vector<double> truth = SharesOf(rods, Size, Size);
  for (double& value : truth)
  {
    value = .5 * value + .5 * .4;
  }
  return { LargestDifference(picture.Values, truth), picture };
}

}

std::vector<Scenario> GeometryScenarios()
{
  const std::string sample = "refinement: one ray a pixel";
  const std::string rounded = "double precision: positions rounded to floats far from the origin";
  const std::string rays = "the tolerance of occlusion: 1/2";
  return {
    { "BordersWithinOneObject", "a burr, most of whose borders lie before itself", "still",
      Metric::Bias, .002, "borders from the mesh: [AA]'s case 3 knows borders of objects only",
      "[AA] no borders inside an object", OpenGL, SelfSilhouettes },
    { "Interpenetration", "a burr and a box through each other", "still", Metric::Bias, .004,
      sample, "", OpenGL, Interpenetration },
    { "NonManifoldEdge", "five sheets that meet in one edge", "still", Metric::Bias, .004, sample,
      "", OpenGL, NonManifoldEdge },
    { "GrazingPlanks", "40 planks with gaps, seen at 2 degrees", "still", Metric::Bias, .015,
      sample, "", OpenGL, GrazingPlanks },
    { "WideAngle", "25 boxes at 150 degrees", "still", Metric::Bias, .004, sample, "", OpenGL,
      WideAngle },
    { "TJunctions", "strips cut at other heights than their neighbours", "still", Metric::Leak,
      1e-3, "shared borders: the strips are a tenth of a pixel apart", "", OpenGL, TJunctions },
    { "InsideAClosedMesh", "a burr from within", "still", Metric::Leak, 1e-3, rounded, "", OpenGL,
      InsideAMesh },
    { "CoplanarDuplicates", "two discs in one slanted plane, added in either order", "still",
      Metric::MaximumDifference, .01, rounded, "", OpenGL, CoplanarDuplicates },
    { "BehindGlass", "rods behind a translucent pane", "still", Metric::MaximumDifference, .001,
      "case 4, and exact borders: [AA] as printed", "[AA] case 4 is left out", OpenGL,
      BehindGlass },
    { "FarFromTheOrigin", "a burr at 1e7", "still", Metric::Bias, .001, rounded,
      "[TSSAO] large scenes lose precision", OpenGL, FarFromOrigin },
    { "NearAndFar", "a box at 1 before walls at 999,999 and 1,000,000", "still", Metric::Bias, 1e-3,
      "distances without a depth buffer: OpenGL's 24 bits", "", OpenGL, NearAndFar },
    { "TinyUnit", "a burr of size 1e-6 under occlusion", "still", Metric::UnitIndependence, .008,
      "a radius from the bounds: .2", "[ISAO] distances in scene units", "", Units(1e-6) },
    { "HugeUnit", "a burr of size 1e6 under occlusion", "still", Metric::UnitIndependence, .008,
      "a radius from the bounds: .2", "[ISAO] distances in scene units", "", Units(1e6) },
    { "MirroredScene", "a burr under occlusion", "mirrored", Metric::Symmetry, .006, rays, "",
      OpenGL, Mirror },
    { "PointsThatAreNoNumbers", "a burr with every 40th point not a number", "still", Metric::Bias,
      .001, "leaving them out: 0 is put in their place", "", OpenGL, NotNumbers },
  };
}

}
