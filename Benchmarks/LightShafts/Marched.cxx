// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The marched reference: a half-plane shadows one side from straight above, and the medium has a
// flat top. Compares the closed form, the ray caster, and POV-Ray's media.
#include "Benchmark.h"
#include "ClosedForms/HalfPlaneScattering.h"
#include "vtkPenumbraMedium.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraRayCasterConstants.h"

#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGReader.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"

#include <glm/gtc/constants.hpp>

#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace penumbra
{

namespace
{

constexpr int Side = 256;
constexpr double Pi = glm::pi<double>();

double Seconds(int who)
{
  rusage usage;
  getrusage(who, &usage);
  return usage.ru_utime.tv_sec + usage.ru_stime.tv_sec +
    1e-6 * (usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

/// The medium in a box, as POV-Ray's media require.
HalfPlaneInHaze BoxedHaze()
{
  HalfPlaneInHaze haze;
  haze.Low[0] = -1.0;
  haze.High[0] = 4.0;
  haze.Low[1] = haze.Low[2] = -3.0;
  haze.High[1] = 3.0;
  return haze;
}

double RelativeRmse(const std::vector<double>& image, const std::vector<double>& exact)
{
  double squares = 0.0;
  double reference = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i)
  {
    squares += (image[i] - exact[i]) * (image[i] - exact[i]);
    reference += exact[i] * exact[i];
  }
  return std::sqrt(squares / reference);
}

struct Run
{
  double Error = 0.0;
  double Seconds = 0.0;
  double Rays = 0.0; ///< per pixel
};

Run ByRays(const std::vector<double>& exact, int steps, double tolerance)
{
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkPenumbraMedium> medium;
  BoxedHaze().AddTo(renderer);
  BoxedHaze().Describe(medium);
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(Side, Side);
  caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Uniform;
  caster->GetConstants().UniformSamples = 1;
  caster->SetNumberOfThreads(1);
  caster->SetTolerance(tolerance);
  caster->SetMedium(medium);
  caster->GetConstants().LightShaftSteps = steps;
  Run run;
  const double start = Seconds(RUSAGE_SELF);
  caster->Update();
  run.Seconds = Seconds(RUSAGE_SELF) - start;
  run.Rays = caster->GetStatistics()->GetArray("Rays/Shaft")->GetTuple1(0) / (double(Side) * Side);
  auto* color = vtkFloatArray::SafeDownCast(caster->GetOutput()->GetPointData()->GetScalars());
  std::vector<double> image(exact.size());
  for (std::size_t i = 0; i < image.size(); ++i)
  {
    image[i] = color->GetTypedComponent(static_cast<vtkIdType>(i), 0);
  }
  run.Error = RelativeRmse(image, exact);
  return run;
}

/// Renders POV-Ray's media with `samples` samples per interval. Its scattering type 1 omits the
/// factor 1 / (4 pi), which the light's intensity compensates.
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
    << "  scattering { 1, rgb " << HalfPlaneInHaze::Scattering << " extinction "
    << HalfPlaneInHaze::Extinction / HalfPlaneInHaze::Scattering
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
  std::vector<double> image(exact.size());
  for (std::size_t i = 0; i < image.size(); ++i)
  {
    image[i] = colors->GetComponent(static_cast<vtkIdType>(i), 0) / 65535.0 / 10.0;
  }
  run.Error = RelativeRmse(image, exact);
  run.Rays = samples;
  return run;
}

/// Renders Mitsuba's volpath with `samples` samples per pixel; also returns its version.
Run ByMitsuba(const ShaftBenchmark& benchmark, int samples, std::string& version)
{
  const std::string answer = benchmark.Output + "/volpath.txt";
  const std::string command = "'" + benchmark.Mitsuba + "' Benchmarks/Peers/scripts/volpath.py " +
    std::to_string(samples) + " >'" + answer + "'";
  if (std::system(command.c_str()) != 0)
  {
    throw std::runtime_error("Mitsuba failed: " + command);
  }
  Run run;
  std::string line;
  std::getline(std::ifstream(answer), line);
  char name[64] = "";
  if (std::sscanf(line.c_str(), "relative RMSE %lf, gain %*f, %lf CPU seconds, %63[^\n]",
        &run.Error, &run.Seconds, name) != 3)
  {
    throw std::runtime_error("Cannot parse the output of Mitsuba: " + line);
  }
  version = name;
  run.Rays = samples;
  return run;
}

void CompareWithPovRay(
  ShaftBenchmark& benchmark, const std::string& scene, const std::vector<double>& exact, Run ours)
{
  Run equal;
  for (int samples = 50; samples <= 800; samples *= 2)
  {
    equal = ByPovRay(benchmark, exact, samples);
    std::printf(
      "  POV-Ray, %d samples: relative RMSE %.5f in %.2f s\n", samples, equal.Error, equal.Seconds);
    if (equal.Error <= ours.Error)
    {
      break;
    }
  }
  benchmark.Results.Add(scene, "POV-Ray's time over ours at equal error",
    equal.Seconds / ours.Seconds, TargetKind::AtLeast, 10.0,
    "POV-Ray " + std::to_string(equal.Error) + " with " +
      std::to_string(static_cast<int>(equal.Rays)) + " samples" +
      (equal.Error > ours.Error ? ", a larger error" : ""));
}

/// The variance is inversely proportional to the number of samples: the time at Penumbra's error is
/// extrapolated from a run of a few seconds. A run with four times the samples must have half the
/// error.
void CompareWithMitsuba(ShaftBenchmark& benchmark, const std::string& scene, Run ours)
{
  std::string version;
  const Run few = ByMitsuba(benchmark, 16, version);
  const Run many = ByMitsuba(benchmark, 64, version);
  const double more = many.Error / ours.Error;
  char remark[160];
  std::snprintf(remark, sizeof remark,
    "%s: %.3f with 16, %.3f with 64 samples in %.2f s; extrapolated by the square of the error",
    version.c_str(), few.Error, many.Error, many.Seconds);
  benchmark.Results.Add(scene, "Mitsuba volpath's time over ours at equal error",
    many.Seconds * more * more / ours.Seconds, TargetKind::AtLeast, 10.0, remark);
}

}

void MeasureMarched(ShaftBenchmark& benchmark)
{
  std::vector<double> exact(static_cast<std::size_t>(Side) * Side);
  for (std::size_t i = 0; i < exact.size(); ++i)
  {
    const double x = static_cast<double>(i % Side) + 0.5;
    const double y = static_cast<double>(i / Side) + 0.5;
    exact[i] = BoxedHaze().Exact(2.0 * x / Side - 1.0, 2.0 * y / Side - 1.0);
  }
  ResultTable& table = benchmark.Results;
  const std::string scene = "half-plane, flat top, 256x256";
  const Run sixtyFour = ByRays(exact, 64, 1.0 / 256.0);
  table.Add(scene, "relative RMSE at 64 steps", sixtyFour.Error, TargetKind::AtMost, 0.005);
  table.Add(scene, "seconds at 64 steps", sixtyFour.Seconds, TargetKind::None);
  const Run adaptive = ByRays(exact, 0, 1.0 / 256.0);
  table.Add(scene, "relative RMSE at tolerance 1/256", adaptive.Error, TargetKind::None);
  table.Add(scene, "shadow rays a pixel at tolerance 1/256", adaptive.Rays, TargetKind::None);
  table.Add(scene, "seconds at tolerance 1/256", adaptive.Seconds, TargetKind::None);
  if (!benchmark.PovRay.empty())
  {
    CompareWithPovRay(benchmark, scene, exact, adaptive);
  }
  if (!benchmark.Mitsuba.empty())
  {
    CompareWithMitsuba(benchmark, scene, adaptive);
  }
}

}
