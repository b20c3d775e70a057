// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "HemicubeRenderer.h"

#include "Frame/OpenGLFunctions.h"
#include "Frame/Stage.h"

#include "vtkNew.h"
#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkPenumbraCubeMapFS.h"
#include "vtkPenumbraCubeMapVS.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"

#include <stdexcept>

namespace penumbra
{
namespace
{

constexpr const char* NoOpenGL =
  "A cube map needs OpenGL, and there is none here that draws into pictures of floats: install "
  "libosmesa6 or libegl1, start an X server, or gather by rays.";

Frustum PyramidOf(const Hemicube::Face& face, glm::vec3 eye, const glm::mat3& frame, float reach)
{
  const glm::vec3 right = frame * face.Right;
  const glm::vec3 up = frame * face.Up;
  const glm::vec3 ahead = frame * face.Forward;
  return { eye, { ahead, ahead - right, ahead + right, ahead - up, up - face.MinimumUp * ahead },
    reach };
}

}

struct HemicubeRenderer::Graphics
{
  vtkNew<vtkRenderWindow> Window;
  vtkOpenGLRenderWindow* Context = nullptr;
  vtkNew<vtkOpenGLFramebufferObject> Framebuffer;
  vtkSmartPointer<vtkTextureObject> Numbers;
  vtkNew<vtkTextureObject> Depths;
  vtkNew<vtkOpenGLBufferObject> Corners;
  vtkNew<vtkOpenGLVertexArrayObject> Attributes;
  vtkShaderProgram* Program = nullptr;
  TriangleClusters::DrawRanges Runs;
};

HemicubeRenderer::HemicubeRenderer(
  const Scene& scene, const TriangleClusters& bundles, const Hemicube& cube)
  : Bundles(bundles),
    Cube(cube)
{
  this->Thread.Run([&] { this->Open(scene); });
}

HemicubeRenderer::~HemicubeRenderer()
{
  this->Thread.Run([this] {
    Graphics& own = *this->OpenGL;
    own.Context->MakeCurrent();
    own.Attributes->ReleaseGraphicsResources();
    own.Corners->ReleaseGraphicsResources();
    own.Framebuffer->ReleaseGraphicsResources(own.Context);
    own.Numbers->ReleaseGraphicsResources(own.Context);
    own.Depths->ReleaseGraphicsResources(own.Context);
    own.Window->Finalize();
  });
  // Here: whoever deletes a gatherer may hold VTK's lock for collecting garbage, which the thread would
  // wait for.
  this->OpenGL.reset();
}

void HemicubeRenderer::Open(const Scene& scene)
{
  auto own = std::make_unique<Graphics>();
  own->Window->SetOffScreenRendering(1);
  own->Window->SetShowWindow(false);
  own->Window->SetSize(8, 8);
  own->Window->AddRenderer(vtkNew<vtkRenderer>());
  own->Window->Render();
  own->Context = vtkOpenGLRenderWindow::SafeDownCast(own->Window);
  if (!own->Context || !own->Context->SupportsOpenGL())
  {
    throw std::runtime_error(NoOpenGL);
  }
  vtkOpenGLRenderWindow* context = own->Context;
  context->MakeCurrent();
  Allocate(own->Numbers, context, this->Cube.GetWidth(), this->Cube.GetHeight(), 2);
  own->Depths->SetContext(context);
  own->Depths->AllocateDepth(
    this->Cube.GetWidth(), this->Cube.GetHeight(), vtkTextureObject::Float32);
  own->Framebuffer->SetContext(context);
  context->GetState()->PushFramebufferBindings();
  own->Framebuffer->Bind();
  own->Framebuffer->AddColorAttachment(0, own->Numbers);
  own->Framebuffer->AddDepthAttachment(own->Depths);
  own->Framebuffer->ActivateDrawBuffer(0);
  own->Framebuffer->ActivateReadBuffer(0);
  own->Program =
    context->GetShaderCache()->ReadyShaderProgram(vtkPenumbraCubeMapVS, vtkPenumbraCubeMapFS, "");
  if (!own->Program || glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
  {
    throw std::runtime_error(NoOpenGL);
  }
  own->Corners->Upload(this->Bundles.MakeCorners(scene), vtkOpenGLBufferObject::ArrayBuffer);
  own->Attributes->Bind();
  own->Attributes->AddAttributeArray(
    own->Program, own->Corners, "corner", 0, sizeof(IdVertex), VTK_FLOAT, 4, false);
  own->Attributes->Release();
  this->OpenGL = std::move(own);
}

long long HemicubeRenderer::Draw(glm::vec3 eye, const glm::mat3& frame, float near, float reach,
  std::vector<HemicubeTexel>& texels)
{
  texels.resize(this->Cube.GetDirections().size());
  long long triangles = 0;
  this->Thread.Run([&] {
    Graphics& own = *this->OpenGL;
    own.Context->MakeCurrent();
    vtkOpenGLState* state = own.Context->GetState();
    own.Framebuffer->Bind();
    const int width = this->Cube.GetWidth();
    const int height = this->Cube.GetHeight();
    state->vtkglDisable(GL_SCISSOR_TEST);
    state->vtkglDisable(GL_BLEND);
    state->vtkglEnable(GL_DEPTH_TEST);
    state->vtkglDepthFunc(GL_GREATER);
    state->vtkglDepthMask(GL_TRUE);
    state->vtkglViewport(0, 0, width, height);
    state->vtkglClearColor(0.f, 0.f, 0.f, 0.f);
    state->vtkglClearDepth(0.0);
    state->vtkglClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    own.Context->GetShaderCache()->ReadyShaderProgram(own.Program);
    own.Attributes->Bind();
    for (const Hemicube::Face& face : this->Cube.GetFaces())
    {
      this->DrawFace(face, eye, frame, near, reach, triangles);
    }
    own.Attributes->Release();
    glReadPixels(0, 0, width, height, GL_RG, GL_FLOAT, texels.data());
  });
  return triangles;
}

void HemicubeRenderer::DrawFace(const Hemicube::Face& face, glm::vec3 eye, const glm::mat3& frame,
  float near, float reach, long long& triangles)
{
  Graphics& own = *this->OpenGL;
  vtkOpenGLState* state = own.Context->GetState();
  const Frustum view = PyramidOf(face, eye, frame, reach);
  const glm::vec3 right = frame * face.Right;
  const glm::vec3 ahead = frame * face.Forward;
  // From [Least, 1] to [-1, 1].
  const float stretch = 2.f / (1.f - face.MinimumUp);
  const glm::vec3 up = stretch * (frame * face.Up) + (1.f - stretch) * ahead;
  own.Program->SetUniform3f("eye", &eye[0]);
  own.Program->SetUniform3f("right", &right[0]);
  own.Program->SetUniform3f("up", &up[0]);
  own.Program->SetUniform3f("ahead", &ahead[0]);
  own.Program->SetUniformf("near", near);
  state->vtkglViewport(face.X, face.Y, face.Width, face.Height);
  for (const auto sides :
    { TriangleClusters::Both, TriangleClusters::FrontOnly, TriangleClusters::BackOnly })
  {
    triangles += this->Bundles.CullToFrustum(view, sides, own.Runs);
    if (own.Runs.First.empty())
    {
      continue;
    }
    if (sides == TriangleClusters::Both)
    {
      state->vtkglDisable(GL_CULL_FACE);
    }
    else
    {
      state->vtkglEnable(GL_CULL_FACE);
      state->vtkglCullFace(sides == TriangleClusters::FrontOnly ? GL_BACK : GL_FRONT);
    }
    glMultiDrawArrays(GL_TRIANGLES, own.Runs.First.data(), own.Runs.Count.data(),
      static_cast<GLsizei>(own.Runs.First.size()));
  }
}

}
