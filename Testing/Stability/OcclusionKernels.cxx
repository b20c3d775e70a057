// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Limitations of the kernels of [TSSAO] and [ISAO] as printed: each kernel as it is, and with the
// line of its shader that avoids the limitation changed back.
#include "OcclusionScenes.h"
#include "Scenario.h"
#include "vtkPenumbraOcclusionConstants.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPenumbraKernelEstimator.h"
#include "vtkPenumbraKernels.h"

#include <cmath>
#include <stdexcept>

namespace penumbra
{

namespace
{

using Pass = vtkPenumbraTemporalSSAOPass;

/// Kernel with a part of its shader replaced, and optionally a sample index rounded to a float.
class AlteredKernel : public vtkPenumbraKernelEstimator
{
public:
  static AlteredKernel* New();
  vtkTypeMacro(AlteredKernel, vtkPenumbraKernelEstimator);

  void Replace(const std::string& part, const std::string& replacement)
  {
    this->Part = part;
    this->Replacement = replacement;
  }

  /// Continues after the given number of samples.
  void Begin(int sample, bool isFloat)
  {
    this->First = sample;
    this->IsFloat = isFloat;
  }

  std::string GetShader() override
  {
    std::string shader = this->Superclass::GetShader();
    const std::size_t at = shader.find(this->Part);
    if (at == std::string::npos)
    {
      throw std::logic_error("text not found in the shader: " + this->Part);
    }
    return shader.replace(at, this->Part.size(), this->Replacement);
  }

  int SetUniforms(const Request& request, vtkShaderProgram* program) override
  {
    Request later = request;
    later.FirstSample += this->First;
    if (this->IsFloat)
    {
      later.FirstSample = static_cast<int>(static_cast<float>(later.FirstSample));
    }
    return this->Superclass::SetUniforms(later, program);
  }

private:
  std::string Part;
  std::string Replacement;
  int First = 0;
  bool IsFloat = false;
};
vtkStandardNewMacro(AlteredKernel);

vtkSmartPointer<AlteredKernel> NewKernel(const char* name)
{
  auto kernel = vtkSmartPointer<AlteredKernel>::New();
  kernel->SetKernel(vtkPenumbraKernels::Find(name));
  return kernel;
}

/// A floor in front of a wall against a closed form.
ScenarioResult MeasureBeforeAWall(
  vtkPenumbraOcclusionEstimator* kernel, double (*reference)(double))
{
  OcclusionScene scene(160, 96);
  scene.AddOcclusionPass(1.0)->SetTolerance(.005);
  scene.Pass->SetEstimator(kernel);
  const std::vector<double> errors = ErrorsBeforeAWall(scene, reference);
  return { RootMeanSquare(errors), OpennessOf(scene) };
}

/// Cosine-distributed directions. Ablated: weighted by the cosine again.
ScenarioResult CosineOnce(Variant variant)
{
  const auto kernel = NewKernel("volumetric");
  if (variant == Variant::Ablated)
  {
    kernel->Replace("> 1e-4 ? 1.0", "> 1e-4 ? direction.z");
  }
  return MeasureBeforeAWall(kernel, BehindWallFading);
}

/// The horizon kernel, which estimates occlusion with D = 1. Ablated: another kernel.
std::function<ScenarioResult(Variant)> InsteadOf(const char* replacement)
{
  return [replacement](Variant variant) {
    return MeasureBeforeAWall(
      NewKernel(variant == Variant::Ablated ? replacement : "horizon"), BehindWall);
  };
}

/// Sample points behind the visible surface count. Ablated: those in front of it.
ScenarioResult BehindTheSurface(Variant variant)
{
  const auto kernel = NewKernel("depth-difference");
  if (variant == Variant::Ablated)
  {
    kernel->Replace("behind > 1e-4", "behind < -1e-4");
  }
  return MeasureBeforeAWall(kernel, BehindWall);
}

ScenarioResult OpenPlane(Variant variant)
{
  OcclusionScene scene(96, 72);
  scene.AddFloor();
  scene.SetCamera({ 0, -3, 3 }, { 0, 0, 0 });
  scene.AddOcclusionPass(1.0)->SetTolerance(.005);
  const auto kernel = NewKernel("depth-difference");
  if (variant == Variant::Ablated)
  {
    kernel->Replace("sign(dot(offset, point.normal)) * ", "");
  }
  scene.Pass->SetEstimator(kernel);
  scene.Window->Render();
  const Frame image = OcclusionOf(scene);
  return { RootMeanSquare(image.Values), Inverted(image) };
}

/// Samples from index 0, and from index 2e9, where consecutive integers are not exact in a float.
ScenarioResult ManySamples(Variant variant)
{
  const auto kernel = NewKernel("volumetric");
  kernel->Begin(2000000000, variant == Variant::Ablated);
  OcclusionScene scene(96, 72);
  Furnish(scene);
  scene.AddOcclusionPass(1.0)->SetTolerance(.005);
  scene.Pass->GetConstants().Filter = false;
  scene.Pass->SetEstimator(kernel);
  scene.Window->Render();
  const Frame late = OcclusionOf(scene);
  scene.Pass->SetEstimator(NewKernel("volumetric"));
  scene.Window->Render();
  return { Rmse(late.Values, OcclusionOf(scene).Values), Inverted(late) };
}

/// The inside of a half cylinder of few facets and of many.
ScenarioResult Facets(Variant variant)
{
  const auto draw = [variant](int facets) {
    OcclusionScene scene(96, 72);
    const auto at = [facets](int i) {
      const double angle = std::acos(-1.0) * i / facets;
      return std::array<double, 2>{ -std::cos(angle), -std::sin(angle) };
    };
    for (int i = 0; i < facets; ++i)
    {
      const auto from = at(i);
      const auto to = at(i + 1);
      scene.AddWall({ from[0], -2, from[1] }, { 0, 4, 0 }, { to[0] - from[0], 0, to[1] - from[1] });
    }
    scene.SetCamera({ 0, -1, 4 }, { 0, 0, -.6 });
    scene.AddOcclusionPass(.25)->SetTolerance(.005);
    scene.Pass->GetConstants().Filter = false;
    scene.Pass->SetKernelName(variant == Variant::Ablated ? "patch" : "automatic");
    scene.Window->Render();
    return OcclusionOf(scene);
  };
  const Frame coarse = draw(12);
  return { Rmse(coarse.Values, draw(96).Values), Inverted(coarse) };
}

/// One frame after a neighbor has moved. Ablated: its history has no minimum weight.
ScenarioResult AfterAChange(Variant variant)
{
  OcclusionScene scene(64, 48);
  Furnish(scene);
  scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(Pass::NEVER);
  scene.Pass->GetConstants().Filter = false;
  scene.Pass->GetConstants().FirstSamples = 8;
  if (variant == Variant::Ablated)
  {
    scene.Pass->GetConstants().InvalidationWeight = 0.0;
  }
  for (int frame = 0; frame < 40; ++frame)
  {
    scene.Window->Render();
  }
  vtkActor* ball = scene.Renderer->GetActors()->GetLastActor();
  ball->SetPosition(.06, 0.0, .5);
  scene.Window->Render();
  const Frame image = OcclusionOf(scene);
  return { Rmse(image.Values, Limit(scene).Values), Inverted(image) };
}

}

std::vector<Scenario> OcclusionKernelScenarios()
{
  const std::string wall = "a floor in front of a wall, against the closed form";
  return {
    { "KernelCosineOnce", wall + " for D = 1 - t, volumetric kernel", "still", Metric::Bias, .02,
      "cosine by the distribution of directions only: applied again",
      "[TSSAO eq. 3] cosine applied twice", "", CosineOnce },
    { "KernelFalloff", wall, "still", Metric::Bias, .03,
      "a kernel with D = 1 within the radius: the volumetric kernel",
      "[TSSAO eq. 3] estimates another D", "", InsteadOf("volumetric") },
    { "KernelWithoutCosine", wall, "still", Metric::Bias, .03,
      "a kernel with cosine weighting: the kernel of [ISAO]", "[ISAO eq. 1] no cosine, no D", "",
      InsteadOf("depth-difference") },
    { "KernelBehindTheSurface", wall + ", depth-difference kernel", "still", Metric::Bias, .2,
      "counting points behind the surface: points in front, as in step 4",
      "[ISAO] step 4 counts the wrong points", "", BehindTheSurface },
    { "KernelOpenPlane", "an open floor, depth-difference kernel", "still", Metric::Bias, .005,
      "offsets reflected into the hemisphere: offsets in the full sphere",
      "[ISAO] the full sphere darkens an open plane", "", OpenPlane },
    { "KernelManySamples", "a ball on a floor in front of a wall, from sample 2e9 on", "still",
      Metric::Bias, .012, "integer sample index: rounded to a float",
      "[TSSAO eq. 7] rounded sample index", "", ManySamples },
    { "KernelFacets", "a half cylinder of 12 facets and of 96, no filter", "still", Metric::Bias,
      .009, "ray-marched kernel: the patch kernel [TSSAO eq. 12]",
      "[TSSAO eq. 12] shows tessellation", "", Facets },
    { "OcclusionAfterAChange", "a ball on a floor in front of a wall, no filter",
      "the ball moves a little", Metric::Bias, .035, "minimum weight of the history: none",
      "[TSSAO eq. 9] noise where history is discarded", "", AfterAChange },
  };
}

}
