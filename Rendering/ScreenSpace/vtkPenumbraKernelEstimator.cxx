// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraKernelEstimator.h"

#include "EyeDepth.h"
#include "Stage.h"
#include "vtkPenumbraEstimateFS.h"
#include "vtkPenumbraKernels.h"
#include "vtkPenumbraSurfaceLib.h"
#include "vtkPenumbraViewLib.h"

#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>

vtkStandardNewMacro(vtkPenumbraKernelEstimator);

namespace
{

/// Points of the sequence in one draw: the array in vtkPenumbraEstimateFS.glsl.
constexpr int MaximumPoints = 64;

/// The number's digits to the base, mirrored at the point [TSSAO, Halton].
double RadicalInverse(int base, long long number)
{
  double inverse = 0.0;
  double digit = 1.0 / base;
  for (; number > 0; number /= base, digit /= base)
  {
    inverse += static_cast<double>(number % base) * digit;
  }
  return inverse;
}

void SetPoints(vtkShaderProgram* program, long long first, int count)
{
  constexpr int bases[4] = { 2, 3, 5, 7 };
  float points[MaximumPoints][4] = {};
  for (int i = 0; i < count; ++i)
  {
    for (int axis = 0; axis < 4; ++axis)
    {
      points[i][axis] = static_cast<float>(RadicalInverse(bases[axis], first + i + 1));
    }
  }
  program->SetUniform4fv("samples", MaximumPoints, points);
  program->SetUniformi("sampleCount", count);
}

}

struct vtkPenumbraKernelEstimator::Internals
{
  penumbra::Stage Stage;
  std::string Source;
};

vtkPenumbraKernelEstimator::vtkPenumbraKernelEstimator()
  : Implementation(std::make_unique<Internals>())
{
}

vtkPenumbraKernelEstimator::~vtkPenumbraKernelEstimator() = default;

void vtkPenumbraKernelEstimator::SetKernel(int kernel)
{
  if (!vtkPenumbraKernels::GetName(kernel))
  {
    vtkErrorMacro("There is no kernel " << kernel << ".");
  }
  else if (kernel != this->Kernel)
  {
    this->Kernel = kernel;
    this->Implementation->Source.clear();
    this->Modified();
  }
}

int vtkPenumbraKernelEstimator::Estimate(const Request& request, vtkTextureObject* target)
{
  Internals& state = *this->Implementation;
  if (state.Source.empty())
  {
    state.Source = penumbra::Assemble(vtkPenumbraEstimateFS,
      { { "ViewLib", vtkPenumbraViewLib }, { "SurfaceLib", vtkPenumbraSurfaceLib },
        { "Kernel", vtkPenumbraKernels::GetShader(this->Kernel) } });
  }
  vtkShaderProgram* program = state.Stage.Ready(request.Window, state.Source);
  const penumbra::DrawInto into(
    request.Window, request.Image->GetFramebuffer(), { target }, request.Image->GetDepth());
  if (!program || !into.IsComplete())
  {
    return 0;
  }
  const int fetches = vtkPenumbraKernels::GetFetchesPerPoint(this->Kernel);
  const int points = std::clamp(request.Samples / fetches, 1, MaximumPoints);
  request.Depth->GetView().SetUniforms(program);
  SetPoints(program, request.FirstSample / fetches, points);
  program->SetUniformf("pixelRotation", request.TurnPixels ? 1.f : 0.f);
  if (program->IsUniformUsed("thickness"))
  {
    program->SetUniformf("thickness", static_cast<float>(this->Thickness));
  }
  state.Stage.Read("eyeDepths", request.Depth->GetCurrent());
  if (request.Parts)
  {
    state.Stage.Draw(*request.Parts);
  }
  else
  {
    state.Stage.Draw();
  }
  return points * fetches;
}

void vtkPenumbraKernelEstimator::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Implementation->Stage.ReleaseGraphicsResources(window);
}

void vtkPenumbraKernelEstimator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Kernel: " << vtkPenumbraKernels::GetName(this->Kernel) << "\n";
  os << indent << "Thickness: " << this->Thickness << "\n";
}
