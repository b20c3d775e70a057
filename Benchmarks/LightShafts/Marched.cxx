// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The marched reference: a half-plane keeps light from straight above off one side, the medium has a
// flat top; in closed form, by the ray caster, by POV-Ray's media.
#include "Benchmark.h"
#include "vtkPenumbraMedium.h"
#include "vtkPenumbraRayCaster.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPNGReader.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <vector>

namespace penumbra
{

namespace
{

constexpr int Side = 256;
constexpr double Pi = 3.14159265358979324;
// The medium fills -1 < x < 4, |y| < 3, -3 < z < 2; the half-plane is x < 0, z = 1.
constexpr double Low[3] = { -1.0, -3.0, -3.0 };
constexpr double High[3] = { 4.0, 3.0, 2.0 };
constexpr double Eye[3] = { -1.3, 0.0, -0.5 };
constexpr double Scattering = 0.3;
constexpr double Extinction = 0.5;

double Seconds(int who)
{
  rusage usage;
  getrusage(who, &usage);
  return usage.ru_utime.tv_sec + usage.ru_stime.tv_sec +
    1e-6 * (usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

/// The closed form at a point of the picture, for light of intensity 1.
double Exact(double x, double y)
{
  const double direction[3] = { 1.0, -(2.0 * x / Side - 1.0), 2.0 * y / Side - 1.0 };
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  double near = 1.3; // in units of the distance along x: the half-plane ends, light begins
  double enters = 0.3;
  double far = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
  {
    const double face = direction[axis] > 0.0 ? High[axis] : Low[axis];
    if (direction[axis] != 0.0)
    {
      far = std::min(far, (face - Eye[axis]) / direction[axis]);
    }
  }
  const double hit = direction[2] > 0.0 ? 1.5 / direction[2] : far;
  if (hit < near)
  {
    // Behind the half-plane, which is black.
    return 0.0;
  }
  if (far <= near)
  {
    return 0.0;
  }
  const double vz = direction[2] / length;
  const double a = Extinction * (High[2] - (Eye[2] + enters * direction[2]));
  const double b = Extinction * (1.0 - vz);
  const double t0 = (near - enters) * length;
  const double t1 = (far - enters) * length;
  const double spread =
    std::abs(b * (t1 - t0)) < 1e-9 ? t1 - t0 : (std::exp(-b * t0) - std::exp(-b * t1)) / b;
  return Scattering / (4.0 * Pi) * std::exp(-a) * spread;
}

double RelativeRmse(const std::vector<double>& picture, const std::vector<double>& exact)
{
  double squares = 0.0;
  double reference = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i)
  {
    squares += (picture[i] - exact[i]) * (picture[i] - exact[i]);
    reference += exact[i] * exact[i];
  }
  return std::sqrt(squares / reference);
}

struct Run
{
  double Error = 0.0;
  double Seconds = 0.0;
  double Rays = 0.0; ///< a pixel
};

Run ByRays(const std::vector<double>& exact, int steps, double tolerance)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-1000.0, -1000.0, 1.0);
  plane->SetPoint1(0.0, -1000.0, 1.0);
  plane->SetPoint2(-1000.0, 1000.0, 1.0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(plane->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(0.0, 0.0, 0.0);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->SetBackground(0.0, 0.0, 0.0);
  vtkNew<vtkLight> sun;
  sun->SetPosition(0.0, 0.0, 1.0);
  sun->SetFocalPoint(0.0, 0.0, 0.0);
  renderer->AddLight(sun);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(Eye);
  camera->SetFocalPoint(0.0, 0.0, Eye[2]);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetViewAngle(90.0);
  vtkNew<vtkPenumbraMedium> medium;
  medium->SetScattering(Scattering);
  medium->SetExtinction(Extinction);
  medium->SetBounds(Low[0], High[0], Low[1], High[1], Low[2], High[2]);
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(Side, Side);
  caster->SetCoverageMethod(vtkPenumbraRayCaster::UNIFORM);
  caster->SetUniformSamples(1);
  caster->SetNumberOfThreads(1);
  caster->SetTolerance(tolerance);
  caster->SetMedium(medium);
  caster->SetLightShaftSteps(steps);
  Run run;
  const double start = Seconds(RUSAGE_SELF);
  caster->Update();
  run.Seconds = Seconds(RUSAGE_SELF) - start;
  run.Rays = caster->GetStatistics()->GetArray("Rays/Shaft")->GetTuple1(0) / (double(Side) * Side);
  auto* color = vtkFloatArray::SafeDownCast(caster->GetOutput()->GetPointData()->GetScalars());
  std::vector<double> picture(exact.size());
  for (std::size_t i = 0; i < picture.size(); ++i)
  {
    picture[i] = color->GetTypedComponent(static_cast<vtkIdType>(i), 0);
  }
  run.Error = RelativeRmse(picture, exact);
  return run;
}

/// POV-Ray's media with `samples` samples of its intervals. Its scattering of type 1 has no factor
/// 1 / (4 pi), which the light's brightness makes good.
Run ByPovRay(const ShaftBenchmark& benchmark, const std::vector<double>& exact, int samples)
{
  const std::string scene = benchmark.Output + "/half-plane.pov";
  std::ofstream(scene)
    << "#version 3.7;\nglobal_settings { assumed_gamma 1.0 max_trace_level 20 }\n"
    << "background { rgb 0 }\n"
    << "camera { perspective location <-1.3,0,-0.5> right <0,-2,0> up <0,0,2> direction <1,0,0> }\n"
    << "light_source { <0,0,1000> rgb " << 1.0 / (4.0 * Pi) << " * 10 parallel point_at <0,0,0> }\n"
    << "polygon { 5, <-1000,-1000,1>, <0,-1000,1>, <0,1000,1>, <-1000,1000,1>, <-1000,-1000,1>\n"
    << "  pigment { rgb 0 } finish { ambient 0 diffuse 0 } }\n"
    << "box { <-1,-3,-3>, <4,3,2> hollow pigment { rgbt 1 } interior { media {\n"
    << "  scattering { 1, rgb " << Scattering << " extinction " << Extinction / Scattering
    << " } method 3 intervals 1 samples " << samples << "," << samples
    << " confidence 0.999 variance 1e-6 } } }\n";
  const std::string command = "'" + benchmark.PovRay + "' '+I" + scene + "' '+O" + scene +
    ".png' +W256 +H256 +FN16 File_Gamma=1.0 -A -J -D -V +WT1 >'" + scene + ".log' 2>&1";
  Run run;
  const double start = Seconds(RUSAGE_CHILDREN);
  if (std::system(command.c_str()) != 0)
  {
    throw std::runtime_error("POV-Ray failed; see " + scene + ".log");
  }
  run.Seconds = Seconds(RUSAGE_CHILDREN) - start;
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName((scene + ".png").c_str());
  reader->Update();
  vtkDataArray* colors = reader->GetOutput()->GetPointData()->GetScalars();
  std::vector<double> picture(exact.size());
  for (std::size_t i = 0; i < picture.size(); ++i)
  {
    picture[i] = colors->GetComponent(static_cast<vtkIdType>(i), 0) / 65535.0 / 10.0;
  }
  run.Error = RelativeRmse(picture, exact);
  run.Rays = samples;
  return run;
}

}

void MeasureMarched(ShaftBenchmark& benchmark)
{
  std::vector<double> exact(static_cast<std::size_t>(Side) * Side);
  for (std::size_t i = 0; i < exact.size(); ++i)
  {
    exact[i] = Exact(i % Side + 0.5, i / Side + 0.5);
  }
  Table& table = benchmark.Results;
  const std::string scene = "half-plane, flat top, 256x256";
  const Run sixtyFour = ByRays(exact, 64, 1.0 / 256.0);
  table.Add(scene, "relative RMSE at 64 steps", sixtyFour.Error, Bar::AtMost, 0.005);
  table.Add(scene, "seconds at 64 steps", sixtyFour.Seconds, Bar::None);
  const Run adaptive = ByRays(exact, 0, 1.0 / 256.0);
  table.Add(scene, "relative RMSE at tolerance 1/256", adaptive.Error, Bar::None);
  table.Add(scene, "shadow rays a pixel at tolerance 1/256", adaptive.Rays, Bar::None);
  table.Add(scene, "seconds at tolerance 1/256", adaptive.Seconds, Bar::None);
  if (benchmark.PovRay.empty())
  {
    return;
  }
  Run equal;
  for (int samples = 50; samples <= 800; samples *= 2)
  {
    equal = ByPovRay(benchmark, exact, samples);
    std::printf(
      "  POV-Ray, %d samples: relative RMSE %.5f in %.2f s\n", samples, equal.Error, equal.Seconds);
    if (equal.Error <= adaptive.Error)
    {
      break;
    }
  }
  table.Add(scene, "POV-Ray's time over ours at equal error", equal.Seconds / adaptive.Seconds,
    Bar::AtLeast, 10.0,
    "POV-Ray " + std::to_string(equal.Error) + " with " +
      std::to_string(static_cast<int>(equal.Rays)) + " samples");
}

}
