// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraBilateralFilterPass.h"

#include "Chain/PassSlots.h"
#include "Frame/Composite.h"
#include "Frame/EyeDepth.h"

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

/// Where no distance is set: pixel widths at the camera's focal point.
constexpr double UsualDistance = 4.0;

}

struct vtkPenumbraBilateralFilterPass::Internals
{
  penumbra::DelegateImage Image;
  penumbra::EyeDepth Depth;
  penumbra::Stage Smooth;
  penumbra::Composite Composite;
  vtkSmartPointer<vtkTextureObject> Between;
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
  Internals& own = *this->Implementation;
  vtkRenderer* renderer = state->GetRenderer();
  vtkOpenGLRenderWindow* window = this->EnterWindow(renderer);
  const int margin[2] = { 0, 0 };
  const int props = window ? own.Image.Draw(state, this->DelegatePass, margin, true) : -1;
  const penumbra::ScreenTransform& view = own.Image.GetView();
  if (props < 0 || own.Depth.Update(window, own.Image, view) == penumbra::EyeDepth::Change::Failed)
  {
    return false;
  }

  const std::size_t pixels = static_cast<std::size_t>(view.Width) * view.Height;
  std::vector<float> weights(pixels, 1.f);
  vtkDataArray* given = own.Weights ? own.Weights->GetPointData()->GetScalars() : nullptr;
  if (given && static_cast<std::size_t>(given->GetNumberOfTuples()) == pixels)
  {
    for (std::size_t i = 0; i < pixels; ++i)
    {
      weights[i] = static_cast<float>(given->GetComponent(static_cast<vtkIdType>(i), 0));
    }
  }
  penumbra::Allocate(own.WeightTexture, window, view.Width, view.Height, 1);
  own.WeightTexture->Create2DFromRaw(view.Width, view.Height, 1, VTK_FLOAT, weights.data());
  penumbra::Allocate(own.Between, window, view.Width, view.Height, 4);
  penumbra::Allocate(own.Result, window, view.Width, view.Height, 4);
  for (int direction = 0; direction < 2; ++direction)
  {
    vtkShaderProgram* program = own.Smooth.Ready(window, source);
    const penumbra::ScopedRenderTarget into(
      window, own.Image.GetFramebuffer(), { direction == 0 ? own.Between : own.Result });
    if (!program || !into.IsComplete())
    {
      return false;
    }
    const float way[2] = { direction == 0 ? 1.f : 0.f, direction == 0 ? 0.f : 1.f };
    const double pixel = penumbra::PixelAtFocus(renderer);
    view.SetUniforms(program);
    program->SetUniform2f("way", way);
    program->SetUniformi("reach", this->Reach);
    program->SetUniformf("distance",
      static_cast<float>(this->Distance > 0.0 ? this->Distance : UsualDistance * pixel));
    program->SetUniformf("byDepth", this->ByDepth ? 1.f : 0.f);
    own.Smooth.BindTexture("colors", direction == 0 ? own.Image.GetColor() : own.Between.Get());
    own.Smooth.BindTexture("eyeDepths", own.Depth.GetCurrent());
    own.Smooth.BindTexture("weights", own.WeightTexture);
    own.Smooth.Draw();
  }
  this->NumberOfRenderedProps = props;
  return own.Composite.Draw(
    window, own.Image, own.Depth, own.Result, nullptr, { 0.0, 0.0 }, !this->OpaqueOnly);
}

void vtkPenumbraBilateralFilterPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  Internals& own = *this->Implementation;
  own.Image.ReleaseGraphicsResources(window);
  own.Depth.ReleaseGraphicsResources(window);
  own.Smooth.ReleaseGraphicsResources(window);
  own.Composite.ReleaseGraphicsResources(window);
  for (vtkSmartPointer<vtkTextureObject>* texture :
    { &own.Between, &own.Result, &own.WeightTexture })
  {
    if (*texture)
    {
      (*texture)->ReleaseGraphicsResources(window);
      *texture = nullptr;
    }
  }
}

void vtkPenumbraBilateralFilterPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Reach: " << this->Reach << "\n";
  os << indent << "Distance: " << this->Distance << "\n";
  os << indent << "ByDepth: " << this->ByDepth << "\n";
  os << indent << "Weights: " << this->GetWeights() << "\n";
}
