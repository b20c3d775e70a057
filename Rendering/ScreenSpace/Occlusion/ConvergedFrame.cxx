// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConvergedFrame.h"

#include "Frame/OpenGLFunctions.h"
#include "Frame/Uniforms.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPenumbraConvergedCompositeFS.h"
#include "vtkPenumbraConvergedCopyFS.h"
#include "vtkRenderPass.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"

namespace penumbra
{

namespace
{

void SetTexelSize(vtkShaderProgram* program, const char* name, vtkTextureObject* texture)
{
  SetPixelSize(program, name, texture->GetWidth(), texture->GetHeight());
}

}

bool ConvergedFrame::Draw(const vtkRenderState* state, vtkRenderPass* delegate,
  const DelegateImage& image, const CompositeInputs& inputs)
{
  auto* window = static_cast<vtkOpenGLRenderWindow*>(state->GetRenderer()->GetRenderWindow());
  vtkOpenGLFramebufferObject* target = DelegateImage::GetReadableTarget(state);
  if (!target)
  {
    this->Valid = false;
    return false;
  }
  vtkOpenGLState* gl = window->GetState();
  const vtkOpenGLState::ScopedglViewport viewport(gl);
  const vtkOpenGLState::ScopedglScissor scissor(gl);
  const vtkOpenGLState::ScopedglEnableDisable scissorTest(gl, GL_SCISSOR_TEST);
  const vtkOpenGLState::ScopedglEnableDisable depthTest(gl, GL_DEPTH_TEST);
  delegate->Render(state);
  this->Props = delegate->GetNumberOfRenderedProps();
  vtkTextureObject* depth = target->GetDepthAttachmentAsTextureObject();
  this->Valid = this->Valid || this->Store(window, image, depth, inputs);
  this->Valid = this->Valid && this->ApplyOcclusion(window, image, target, inputs.DepthAndFactor);
  return this->Valid;
}

bool ConvergedFrame::Store(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  vtkTextureObject* depth, const CompositeInputs& inputs)
{
  vtkShaderProgram* program = this->Copy.Ready(window, vtkPenumbraConvergedCopyFS);
  const ScopedRenderTarget renderTarget(window, image.GetFramebuffer(), { inputs.DepthAndFactor });
  if (!program || !renderTarget.IsComplete())
  {
    return false;
  }
  const int* at = image.GetViewport();
  const int* margin = image.GetMargin();
  SetVector(program, "offset", at[0] - margin[0], at[1] - margin[1]);
  SetTexelSize(program, "targetPixelSize", depth);
  SetTexelSize(program, "pixelSize", inputs.Occlusions);
  program->SetUniformf("strength", static_cast<float>(inputs.Strength));
  this->Copy.BindTexture("depthBuffer", depth);
  this->Copy.BindTexture("occlusions", inputs.Occlusions);
  this->Copy.Draw({ { margin[0], margin[1], at[2], at[3] } });
  return true;
}

bool ConvergedFrame::ApplyOcclusion(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  vtkOpenGLFramebufferObject* target, vtkTextureObject* convergedFrame)
{
  vtkTextureObject* depth = target->GetDepthAttachmentAsTextureObject();
  vtkShaderProgram* program = this->Multiply.Ready(window, vtkPenumbraConvergedCompositeFS);
  const ScopedRenderTarget renderTarget(
    window, image.GetFramebuffer(), { target->GetColorAttachmentAsTextureObject(0) });
  if (!program || !renderTarget.IsComplete())
  {
    return false;
  }
  const int* at = image.GetViewport();
  const int* margin = image.GetMargin();
  SetVector(program, "offset", margin[0] - at[0], margin[1] - at[1]);
  SetTexelSize(program, "targetPixelSize", depth);
  SetTexelSize(program, "pixelSize", convergedFrame);
  this->Multiply.BindTexture("depthBuffer", depth);
  this->Multiply.BindTexture("convergedFrame", convergedFrame);

  vtkOpenGLState* gl = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable blend(gl, GL_BLEND);
  const vtkOpenGLState::ScopedglBlendFuncSeparate function(gl);
  gl->vtkglViewport(at[0], at[1], at[2], at[3]);
  gl->vtkglEnable(GL_BLEND);
  gl->vtkglBlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE);
  GLuint query = 0;
  GLuint unchanged = 0;
  glGenQueries(1, &query);
  glBeginQuery(GL_SAMPLES_PASSED, query);
  this->Multiply.Draw();
  glEndQuery(GL_SAMPLES_PASSED);
  glGetQueryObjectuiv(query, GL_QUERY_RESULT, &unchanged);
  glDeleteQueries(1, &query);
  return unchanged == static_cast<GLuint>(at[2]) * static_cast<GLuint>(at[3]);
}

void ConvergedFrame::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Copy.ReleaseGraphicsResources(window);
  this->Multiply.ReleaseGraphicsResources(window);
  this->Valid = false;
}

}
