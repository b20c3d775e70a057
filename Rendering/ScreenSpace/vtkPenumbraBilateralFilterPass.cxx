// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraBilateralFilterPass.h"

#include "Chain/PassSlots.h"
#include "Frame/Composite.h"
#include "Frame/EyeDepth.h"
#include "Frame/Textures.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPenumbraBilateralColorFS.h"
#include "vtkPenumbraViewLib.h"
#include "vtkPointData.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"

#include <vector>

vtkStandardNewMacro(vtkPenumbraBilateralFilterPass);

namespace
{

/// Default of DistanceSigma, in pixel widths at the focal point of the camera.
constexpr double DefaultDistance = 4.0;

}

struct vtkPenumbraBilateralFilterPass::Internals
{
  penumbra::DelegateImage Image;
  penumbra::EyeDepth Depth;
  penumbra::Stage FilterStage;
  penumbra::Composite Composite;
  vtkSmartPointer<vtkTextureObject> Intermediate;
  vtkSmartPointer<vtkTextureObject> Result;
  vtkSmartPointer<vtkTextureObject> WeightTexture;
  vtkSmartPointer<vtkImageData> Weights;
};

vtkPenumbraBilateralFilterPass::vtkPenumbraBilateralFilterPass()
  : Implementation(std::make_unique<Internals>())
{
}

vtkPenumbraBilateralFilterPass::~vtkPenumbraBilateralFilterPass() = default;

void vtkPenumbraBilateralFilterPass::SetWeights(vtkImageData* weights)
{
  this->Implementation->Weights = weights;
  this->Modified();
}

vtkImageData* vtkPenumbraBilateralFilterPass::GetWeights()
{
  return this->Implementation->Weights;
}

bool vtkPenumbraBilateralFilterPass::RenderEffect(const vtkRenderState* state)
{
  static const std::string source =
    penumbra::Assemble(vtkPenumbraBilateralColorFS, { { "ViewLib", vtkPenumbraViewLib } });
  Internals& internals = *this->Implementation;
  vtkRenderer* renderer = state->GetRenderer();
  vtkOpenGLRenderWindow* window = this->EnterWindow(renderer);
  const int margin[2] = { 0, 0 };
  const int props = window ? internals.Image.Draw(state, this->DelegatePass, margin, true) : -1;
  const penumbra::ScreenTransform& view = internals.Image.GetView();
  // The image is filtered whether the depths have changed or not.
  if (props < 0 ||
    internals.Depth.Update(window, internals.Image, view, penumbra::EyeDepth::Comparison::Skip) ==
      penumbra::EyeDepth::Change::Failed)
  {
    return false;
  }

  const std::size_t pixels = static_cast<std::size_t>(view.Width) * view.Height;
  std::vector<float> weights(pixels, 1.f);
  vtkDataArray* scalars =
    internals.Weights ? internals.Weights->GetPointData()->GetScalars() : nullptr;
  if (scalars && static_cast<std::size_t>(scalars->GetNumberOfTuples()) == pixels)
  {
    for (std::size_t i = 0; i < pixels; ++i)
    {
      weights[i] = static_cast<float>(scalars->GetComponent(static_cast<vtkIdType>(i), 0));
    }
  }
  penumbra::Allocate(internals.WeightTexture, window, view.Width, view.Height, 1);
  internals.WeightTexture->Create2DFromRaw(view.Width, view.Height, 1, VTK_FLOAT, weights.data());
  penumbra::Allocate(internals.Intermediate, window, view.Width, view.Height, 4);
  penumbra::Allocate(internals.Result, window, view.Width, view.Height, 4);
  for (int direction = 0; direction < 2; ++direction)
  {
    vtkShaderProgram* program = internals.FilterStage.Ready(window, source);
    const penumbra::ScopedRenderTarget target(window, internals.Image.GetFramebuffer(),
      { direction == 0 ? internals.Intermediate : internals.Result });
    if (!program || !target.IsComplete())
    {
      return false;
    }
    const float axis[2] = { direction == 0 ? 1.f : 0.f, direction == 0 ? 0.f : 1.f };
    const double pixel = penumbra::PixelAtFocus(renderer);
    view.SetUniforms(program);
    program->SetUniform2f("direction", axis);
    program->SetUniformi("reach", this->Radius);
    program->SetUniformf("distance",
      static_cast<float>(
        this->DistanceSigma > 0.0 ? this->DistanceSigma : DefaultDistance * pixel));
    program->SetUniformf("byDepth", this->UseDepthDistance ? 1.f : 0.f);
    internals.FilterStage.BindTexture(
      "colors", direction == 0 ? internals.Image.GetColor() : internals.Intermediate.Get());
    internals.FilterStage.BindTexture("eyeDepths", internals.Depth.GetCurrent());
    internals.FilterStage.BindTexture("weights", internals.WeightTexture);
    internals.FilterStage.Draw();
  }
  this->NumberOfRenderedProps = props;
  return internals.Composite.Draw(window, internals.Image, internals.Depth, internals.Result,
    nullptr, { 0.0, 0.0 }, !this->OpaqueOnly);
}

void vtkPenumbraBilateralFilterPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  Internals& internals = *this->Implementation;
  internals.Image.ReleaseGraphicsResources(window);
  internals.Depth.ReleaseGraphicsResources(window);
  internals.FilterStage.ReleaseGraphicsResources(window);
  internals.Composite.ReleaseGraphicsResources(window);
  penumbra::Release(window, internals.Intermediate, internals.Result, internals.WeightTexture);
}

void vtkPenumbraBilateralFilterPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "DistanceSigma: " << this->DistanceSigma << "\n";
  os << indent << "UseDepthDistance: " << this->UseDepthDistance << "\n";
  os << indent << "Weights: " << this->GetWeights() << "\n";
}
