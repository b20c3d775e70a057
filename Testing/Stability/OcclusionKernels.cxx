// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What [TSSAO] and [ISAO] say or print of their kernels that would make them fail: each kernel as it is,
// and with the line of its shader changed that settles it.
#include "OcclusionScenes.h"
#include "Scenario.h"

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

/// A kernel with a piece of its shader replaced, and an index of samples that may be a float.
class AlteredKernel : public vtkPenumbraKernelEstimator
{
public:
  static AlteredKernel* New();
  vtkTypeMacro(AlteredKernel, vtkPenumbraKernelEstimator);

  void Replace(const std::string& piece, const std::string& other)
  {
    this->Piece = piece;
    this->Other = other;
  }

  /// As after so many samples.
  void Begin(int sample, bool isFloat)
  {
    this->First = sample;
    this->IsFloat = isFloat;
  }

  std::string GetShader() override
  {
    std::string shader = this->Superclass::GetShader();
    const std::size_t at = shader.find(this->Piece);
    if (at == std::string::npos)
    {
      throw std::logic_error("not in the shader: " + this->Piece);
    }
    return shader.replace(at, this->Piece.size(), this->Other);
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
  std::string Piece;
  std::string Other;
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

/// A floor before a wall, against a closed form.
ScenarioResult BeforeAWall(vtkPenumbraOcclusionEstimator* kernel, double (*truth)(double))
{
  OcclusionScene scene(160, 96);
  scene.AddOcclusionPass(1.0)->SetTolerance(.005);
  scene.Pass->SetEstimator(kernel);
  const std::vector<double> errors = ErrorsBeforeAWall(scene, truth);
  return { RootMeanSquare(errors), OpennessOf(scene) };
}

/// Directions that are distributed as the cosine already.
ScenarioResult CosineOnce(Variant variant)
{
  const auto kernel = NewKernel("volumetric");
  if (variant == Variant::Ablated)
  {
    kernel->Replace("> 1e-4 ? 1.0", "> 1e-4 ? way.z");
  }
  return BeforeAWall(kernel, BehindWallFading);
}

/// The kernel whose D is that of eq. 1; broken: another.
std::function<ScenarioResult(Variant)> InsteadOf(const char* other)
{
  return [other](Variant variant) {
    return BeforeAWall(NewKernel(variant == Variant::Ablated ? other : "horizon"), BehindWall);
  };
}

/// The points that count are those behind what is seen.
ScenarioResult BehindTheSurface(Variant variant)
{
  const auto kernel = NewKernel("depth-difference");
  if (variant == Variant::Ablated)
  {
    kernel->Replace("behind > 1e-4", "behind < -1e-4");
  }
  return BeforeAWall(kernel, BehindWall);
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
    kernel->Replace("sign(dot(way, point.normal)) * ", "");
  }
  scene.Pass->SetEstimator(kernel);
  scene.Window->Render();
  const Frame picture = OcclusionOf(scene);
  return { RootMeanSquare(picture.Values), Inverted(picture) };
}

/// From the first sample, and after two thousand million, more than a float counts one by one.
ScenarioResult ManySamples(Variant variant)
{
  const auto kernel = NewKernel("volumetric");
  kernel->Begin(2000000000, variant == Variant::Ablated);
  OcclusionScene scene(96, 72);
  Furnish(scene);
  scene.AddOcclusionPass(1.0)->SetTolerance(.005);
  scene.Pass->FilterOff();
  scene.Pass->SetEstimator(kernel);
  scene.Window->Render();
  const Frame late = OcclusionOf(scene);
  scene.Pass->SetEstimator(NewKernel("volumetric"));
  scene.Window->Render();
  return { Rmse(late.Values, OcclusionOf(scene).Values), Inverted(late) };
}

/// The inside of a trough of few facets and of many.
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
    scene.Pass->SetKernelName(variant == Variant::Ablated ? "patch" : "automatic");
    scene.Window->Render();
    return OcclusionOf(scene);
  };
  const Frame coarse = draw(12);
  return { Rmse(coarse.Values, draw(96).Values), Inverted(coarse) };
}

/// One frame after a neighbour has moved; broken: nothing is left of the history there.
ScenarioResult AfterAChange(Variant variant)
{
  OcclusionScene scene(64, 48);
  Furnish(scene);
  scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(Pass::NEVER);
  scene.Pass->FilterOff();
  scene.Pass->SetFirstSamples(8);
  if (variant == Variant::Ablated)
  {
    scene.Pass->SetInvalidationWeight(0.0);
  }
  for (int frame = 0; frame < 40; ++frame)
  {
    scene.Window->Render();
  }
  vtkActor* ball = scene.Renderer->GetActors()->GetLastActor();
  ball->SetPosition(.06, 0.0, .5);
  scene.Window->Render();
  const Frame picture = OcclusionOf(scene);
  return { Rmse(picture.Values, Limit(scene).Values), Inverted(picture) };
}

}

std::vector<Scenario> OcclusionKernelScenarios()
{
  const std::string wall = "a floor before a wall, against the closed form";
  return {
    { "KernelCosineOnce", wall + " of D = 1 - t, volumetric kernel", "still", Metric::Bias, .02,
      "the cosine of eq. 3 left to the directions: applied again",
      "[TSSAO eq. 3] cosine applied twice", "", CosineOnce },
    { "KernelFalloff", wall, "still", Metric::Bias, .03,
      "a kernel whose D is 1 within the radius: the volumetric one",
      "[TSSAO eq. 3] estimates another D", "", InsteadOf("volumetric") },
    { "KernelWithoutCosine", wall, "still", Metric::Bias, .03,
      "a kernel that weighs by the cosine: [ISAO]'s", "[ISAO eq. 1] no cosine, no D", "",
      InsteadOf("depth-difference") },
    { "KernelBehindTheSurface", wall + ", depth-difference kernel", "still", Metric::Bias, .2,
      "what counts: points before the surface, as step 4 says",
      "[ISAO] step 4 counts the wrong way", "", BehindTheSurface },
    { "KernelOpenPlane", "an open floor, depth-difference kernel", "still", Metric::Bias, .005,
      "offsets reflected into the hemisphere: the full sphere",
      "[ISAO] the full sphere darkens an open plane", "", OpenPlane },
    { "KernelManySamples", "a ball on a floor before a wall, from the 2e9th sample on", "still",
      Metric::Bias, .012, "an index that counts on: rounded to a float",
      "[TSSAO eq. 7] an index of samples that is rounded", "", ManySamples },
    { "KernelFacets", "a trough of 12 facets and of 96", "still", Metric::Bias, .009,
      "rays through the layer: the patch kernel [TSSAO eq. 12]",
      "[TSSAO eq. 12] shows tessellation", "", Facets },
    { "OcclusionAfterAChange", "a ball on a floor before a wall, no filter",
      "the ball moves a little", Metric::Bias, .035, "a least weight of the history: none",
      "[TSSAO eq. 9] noise flashes up where history ends", "", AfterAChange },
  };
}

}
