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
  "Gathering by cube maps needs OpenGL with floating-point render targets, which is not available: "
  "install libosmesa6 or libegl1, start an X server, or gather by rays.";

Frustum ComputeFrustum(const Hemicube::Face& face, glm::vec3 eye, const glm::mat3& frame, float far)
{
  const glm::vec3 right = frame * face.Right;
  const glm::vec3 up = frame * face.Up;
  const glm::vec3 forward = frame * face.Forward;
  return { eye,
    { forward, forward - right, forward + right, forward - up, up - face.MinimumUp * forward },
    far };
}

}

struct HemicubeRenderer::Graphics
{
  vtkNew<vtkRenderWindow> Window;
  vtkOpenGLRenderWindow* Context = nullptr;
  vtkNew<vtkOpenGLFramebufferObject> Framebuffer;
  vtkSmartPointer<vtkTextureObject> TriangleIds;
  vtkNew<vtkTextureObject> Depths;
  vtkNew<vtkOpenGLBufferObject> Vertices;
  vtkNew<vtkOpenGLVertexArrayObject> Attributes;
  vtkShaderProgram* Program = nullptr;
  TriangleClusters::DrawRanges Ranges;
};

HemicubeRenderer::HemicubeRenderer(
  const std::vector<Surface>& surfaces, const TriangleClusters& clusters, const Hemicube& cube)
  : Clusters(clusters),
    Cube(cube)
{
  this->Thread.Run([&] { this->Open(surfaces); });
}

HemicubeRenderer::~HemicubeRenderer()
{
  this->Thread.Run([this] {
    Graphics& graphics = *this->OpenGL;
    graphics.Context->MakeCurrent();
    graphics.Attributes->ReleaseGraphicsResources();
    graphics.Vertices->ReleaseGraphicsResources();
    graphics.Framebuffer->ReleaseGraphicsResources(graphics.Context);
    graphics.TriangleIds->ReleaseGraphicsResources(graphics.Context);
    graphics.Depths->ReleaseGraphicsResources(graphics.Context);
    graphics.Window->Finalize();
  });
  // Deleted in the calling thread: it may hold the lock of VTK's garbage collector, for which the
  // OpenGL thread would wait.
  this->OpenGL.reset();
}

void HemicubeRenderer::Open(const std::vector<Surface>& surfaces)
{
  auto graphics = std::make_unique<Graphics>();
  graphics->Window->SetOffScreenRendering(1);
  graphics->Window->SetShowWindow(false);
  graphics->Window->SetSize(8, 8);
  graphics->Window->AddRenderer(vtkNew<vtkRenderer>());
  graphics->Window->Render();
  graphics->Context = vtkOpenGLRenderWindow::SafeDownCast(graphics->Window);
  if (!graphics->Context || !graphics->Context->SupportsOpenGL())
  {
    throw std::runtime_error(NoOpenGL);
  }
  vtkOpenGLRenderWindow* context = graphics->Context;
  context->MakeCurrent();
  Allocate(graphics->TriangleIds, context, this->Cube.GetWidth(), this->Cube.GetHeight(), 2);
  graphics->Depths->SetContext(context);
  graphics->Depths->AllocateDepth(
    this->Cube.GetWidth(), this->Cube.GetHeight(), vtkTextureObject::Float32);
  graphics->Framebuffer->SetContext(context);
  context->GetState()->PushFramebufferBindings();
  graphics->Framebuffer->Bind();
  graphics->Framebuffer->AddColorAttachment(0, graphics->TriangleIds);
  graphics->Framebuffer->AddDepthAttachment(graphics->Depths);
  graphics->Framebuffer->ActivateDrawBuffer(0);
  graphics->Framebuffer->ActivateReadBuffer(0);
  graphics->Program =
    context->GetShaderCache()->ReadyShaderProgram(vtkPenumbraCubeMapVS, vtkPenumbraCubeMapFS, "");
  if (!graphics->Program || glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
  {
    throw std::runtime_error(NoOpenGL);
  }
  graphics->Vertices->Upload(
    this->Clusters.CreateVertices(surfaces), vtkOpenGLBufferObject::ArrayBuffer);
  graphics->Attributes->Bind();
  graphics->Attributes->AddAttributeArray(
    graphics->Program, graphics->Vertices, "vertex", 0, sizeof(IdVertex), VTK_FLOAT, 4, false);
  graphics->Attributes->Release();
  this->OpenGL = std::move(graphics);
}

long long HemicubeRenderer::Draw(glm::vec3 eye, const TangentFrame& frame, float near, float far,
  std::vector<HemicubeTexel>& texels)
{
  texels.resize(this->Cube.GetDirections().size());
  long long triangles = 0;
  this->Thread.Run([&] {
    Graphics& graphics = *this->OpenGL;
    graphics.Context->MakeCurrent();
    vtkOpenGLState* state = graphics.Context->GetState();
    graphics.Framebuffer->Bind();
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
    graphics.Context->GetShaderCache()->ReadyShaderProgram(graphics.Program);
    graphics.Program->SetUniform3f("normal", &frame.Axes[2][0]);
    graphics.Program->SetUniform3f("geometricNormal", &frame.GeometricNormal[0]);
    graphics.Attributes->Bind();
    glEnable(GL_CLIP_DISTANCE0);
    glEnable(GL_CLIP_DISTANCE1);
    for (const Hemicube::Face& face : this->Cube.GetFaces())
    {
      this->DrawFace(face, eye, frame.Axes, near, far, triangles);
    }
    glDisable(GL_CLIP_DISTANCE0);
    glDisable(GL_CLIP_DISTANCE1);
    graphics.Attributes->Release();
    glReadPixels(0, 0, width, height, GL_RG, GL_FLOAT, texels.data());
  });
  return triangles;
}

void HemicubeRenderer::DrawFace(const Hemicube::Face& face, glm::vec3 eye, const glm::mat3& frame,
  float near, float far, long long& triangles)
{
  Graphics& graphics = *this->OpenGL;
  vtkOpenGLState* state = graphics.Context->GetState();
  const Frustum view = ComputeFrustum(face, eye, frame, far);
  const glm::vec3 right = frame * face.Right;
  const glm::vec3 forward = frame * face.Forward;
  // Maps [MinimumUp, 1] to [-1, 1].
  const float scale = 2.f / (1.f - face.MinimumUp);
  const glm::vec3 up = scale * (frame * face.Up) + (1.f - scale) * forward;
  graphics.Program->SetUniform3f("eye", &eye[0]);
  graphics.Program->SetUniform3f("right", &right[0]);
  graphics.Program->SetUniform3f("up", &up[0]);
  graphics.Program->SetUniform3f("forward", &forward[0]);
  graphics.Program->SetUniformf("near", near);
  state->vtkglViewport(face.X, face.Y, face.Width, face.Height);
  for (const auto sides :
    { TriangleClusters::Both, TriangleClusters::FrontOnly, TriangleClusters::BackOnly })
  {
    triangles += this->Clusters.CullToFrustum(view, sides, graphics.Ranges);
    if (graphics.Ranges.First.empty())
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
    glMultiDrawArrays(GL_TRIANGLES, graphics.Ranges.First.data(), graphics.Ranges.Count.data(),
      static_cast<GLsizei>(graphics.Ranges.First.size()));
  }
}

}
