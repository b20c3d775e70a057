// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Errors of several values of two constants of the march kernel, on the generated scenes to which they
// were fitted and on meshes that were not used in the fit. Run it with `./penumbra benchmark fit`.
#include "OcclusionReference.h"
#include "OcclusionWindow.h"
#include "Program.h"
#include "ResultTable.h"
#include "Scenes.h"

#include "Frame/ScopedShaderEdit.h"

#include "vtkCamera.h"
#include "vtkNew.h"
#include "vtkPLYReader.h"
#include "vtkPolyData.h"
#include "vtkSTLReader.h"
#include "vtkXMLPolyDataReader.h"

#include <cmath>
#include <sstream>

namespace
{

using namespace penumbra;

constexpr int Width = 320;
constexpr int Height = 240;
constexpr int Stride = 4; ///< distance between pixels with a reference value
constexpr int Rays = 16;  ///< per such pixel, the square of this number

/// Values of the constants; the first is that of the shader.
constexpr double Slopes[] = { 4.0, 2.0, 8.0 };
constexpr double ThicknessFactors[] = { 1.0, 0.5, 2.0 };

struct Setting
{
  double Slope;
  double ThicknessFactor;
  double FittedSquares = 0.0;
  double HeldOutSquares = 0.0;

  std::string Name() const
  {
    std::ostringstream name;
    name << "maximumSlope " << this->Slope << ", thickness x " << this->ThicknessFactor;
    return name.str();
  }
};

/// White mesh, seen from above. The radius has its default, a tenth of the diagonal.
template <typename Reader>
OcclusionTestScene ReadScene(const std::string& folder, const char* name, const char* extension)
{
  vtkNew<Reader> reader;
  reader->SetFileName((folder + "/" + name + extension).c_str());
  reader->Update();
  OcclusionTestScene scene{ name, vtkSmartPointer<vtkRenderer>::New(), 0.0 };
  Show(scene.Renderer, reader->GetOutput());
  double bounds[6];
  reader->GetOutput()->GetBounds(bounds);
  const double diagonal =
    std::hypot(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]);
  scene.Radius = 0.1 * diagonal;
  double target[3];
  reader->GetOutput()->GetCenter(target);
  const double eye[3] = { target[0] + 0.9 * diagonal, target[1] - 1.2 * diagonal,
    target[2] + 0.9 * diagonal };
  Look(scene.Renderer, eye, target, 32.0);
  return scene;
}

double Measure(const OcclusionTestScene& scene, const OcclusionTruth& truth, const Setting& setting)
{
  const auto text = [](double value) {
    std::ostringstream out;
    out << std::fixed << value;
    return out.str();
  };
  const ScopedShaderEdit slope("maximumSlope = 4.0", "maximumSlope = " + text(setting.Slope));
  const ScopedShaderEdit thickness("exp(-behind / thickness)",
    "exp(-behind / (" + text(setting.ThicknessFactor) + " * thickness))");
  OcclusionWindow window(scene.Renderer, Width, Height);
  window.UsePenumbraPass(scene.Radius)->SetKernelName("march");
  window.Ours->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::ALWAYS);
  window.Draw();
  return Rmse(truth, Falloff::Constant, window.Array("AmbientOcclusion"));
}

void MeasureSet(ResultTable& results, const std::vector<OcclusionTestScene>& scenes, bool isFitted,
  std::vector<Setting>& settings)
{
  const int size[2] = { Width, Height };
  for (const OcclusionTestScene& scene : scenes)
  {
    const OcclusionTruth truth = TraceOcclusion(scene.Renderer, size, scene.Radius, Stride, Rays);
    for (Setting& setting : settings)
    {
      const double error = Measure(scene, truth, setting);
      (isFitted ? setting.FittedSquares : setting.HeldOutSquares) +=
        error * error / static_cast<double>(scenes.size());
      results.Add(scene.Name + (isFitted ? ", fitted" : ", held out"), "RMSE, " + setting.Name(),
        error, TargetKind::None);
    }
  }
}

void Fit(ResultTable& results, const std::string& data)
{
  std::vector<Setting> settings;
  for (const double slope : Slopes)
  {
    for (const double factor : ThicknessFactors)
    {
      settings.push_back({ slope, factor });
    }
  }
  MeasureSet(results, { Spheres400(), Sticks() }, true, settings);
  MeasureSet(results,
    { ReadScene<vtkXMLPolyDataReader>(data, "brain", ".vtp"),
      ReadScene<vtkPLYReader>(data, "head", ".ply"),
      ReadScene<vtkXMLPolyDataReader>(data, "terrain", ".vtp"),
      ReadScene<vtkSTLReader>(data, "bracket", ".stl") },
    false, settings);
  const Setting* best = &settings[0];
  const Setting* bestHeldOut = &settings[0];
  for (const Setting& setting : settings)
  {
    best = setting.FittedSquares < best->FittedSquares ? &setting : best;
    bestHeldOut = setting.HeldOutSquares < bestHeldOut->HeldOutSquares ? &setting : bestHeldOut;
  }
  const auto report = [&](const std::string& name, const Setting& setting) {
    results.Add(name, "RMSE over the fitted scenes", std::sqrt(setting.FittedSquares),
      TargetKind::None, 0.0, setting.Name());
    results.Add(name, "RMSE over the held-out scenes", std::sqrt(setting.HeldOutSquares),
      TargetKind::None, 0.0, setting.Name());
  };
  report("constants of the shader", settings[0]);
  report("best for the fitted scenes", *best);
  report("best for the held-out scenes", *bestHeldOut);
}

}

int main(int argc, char** argv)
{
  std::string data;
  std::string output;
  ResultTable results;
  Program program;
  program.Name = "fit";
  program.Title = "Constants of the march kernel: errors on fitted and on held-out scenes";
  program.Usage = "--data FOLDER --output FOLDER";
  program.Values = { { "--data", &data, true }, { "--output", &output, true } };
  program.Parts = { { "march", [&] { Fit(results, data); } } };
  return program.Run(argc, argv, results, output, [] {
    return std::vector<std::string>{ "OSMesa, one thread; 320x240",
      "fitted: the generated scenes of the benchmark ambient-occlusion; held out: meshes of Data/",
      "reference: 256 rays at every 4th foreground pixel in both directions" };
  });
}
