// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A full-screen step of a pass: a fragment shader with its input textures, and scoped OpenGL state
// for its outputs.
#ifndef penumbra_Stage_h
#define penumbra_Stage_h

#include "Textures.h"

#include "vtkOpenGLQuadHelper.h"
#include "vtkPenumbraRenderingScreenSpaceModule.h" // for export macro, which tests need

#include <memory>
#include <string>
#include <utility>
#include <vector>

class vtkOpenGLFramebufferObject;
class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkWindow;

namespace penumbra
{

/// Replaces every line `//VTK::Penumbra::NAME` of a shader by the piece of that name.
VTKPENUMBRARENDERINGSCREENSPACE_EXPORT std::string Assemble(
  std::string source, const std::vector<std::pair<std::string, std::string>>& pieces);

/// Number of pixels that a stage drew, which the graphics card computes while the CPU goes on.
class PendingCount
{
public:
  PendingCount() = default;
  PendingCount(const PendingCount&) = delete;
  void operator=(const PendingCount&) = delete;

  /// Starts to count. A number that was not taken is discarded.
  void Begin();
  void End();

  /// Returns the number. Waits for the graphics card if it has not arrived.
  unsigned int Take();

  /// Deletes the query. The context of the window is current.
  void ReleaseGraphicsResources();

private:
  unsigned int Query = 0;
};

/// Rectangle of an image, in pixels.
struct Rectangle
{
  int X = 0;
  int Y = 0;
  int Width = 0;
  int Height = 0;
};

class VTKPENUMBRARENDERINGSCREENSPACE_EXPORT Stage
{
public:
  Stage();
  ~Stage();

  /// Compiles and activates the program, so that uniforms can be set. It is compiled again only if
  /// the source differs. Returns null if it does not compile.
  vtkShaderProgram* Ready(vtkOpenGLRenderWindow* window, const std::string& text);

  /// Binds a texture to the sampler `name` for the next Draw().
  void BindTexture(const char* name, vtkTextureObject* texture);

  /// Draws into the whole bound framebuffer, or only into some rectangles of it.
  void Draw();
  void Draw(const std::vector<Rectangle>& parts);

  /// Draws each sample of the pixels of the bound framebuffer by itself; its number is the uniform
  /// sampleIndex of the program.
  void DrawSamples(vtkShaderProgram* program);

  /// Draws and counts the pixels that were not discarded. Waits for the graphics card.
  unsigned int DrawAndCount();
  /// The same without waiting; the number is taken from `count` some frames later.
  void DrawAndCount(PendingCount& count);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  void Unbind();

  std::unique_ptr<vtkOpenGLQuadHelper> Quad;
  std::string Source;
  vtkOpenGLRenderWindow* Window = nullptr;
  std::vector<vtkTextureObject*> Inputs;
};

/// OpenGL state that stages change; the destructor restores it.
struct SavedState;

/// Redirects stages into textures, all at once and without blending, and restores the OpenGL state
/// when it is destroyed. With a depth texture, only pixels with a surface are drawn; the depth is
/// not modified.
class VTKPENUMBRARENDERINGSCREENSPACE_EXPORT ScopedRenderTarget
{
public:
  ScopedRenderTarget(vtkOpenGLRenderWindow* window, vtkOpenGLFramebufferObject* framebuffer,
    const std::vector<vtkTextureObject*>& targets, vtkTextureObject* depth = nullptr);
  ~ScopedRenderTarget();
  ScopedRenderTarget(const ScopedRenderTarget&) = delete;
  void operator=(const ScopedRenderTarget&) = delete;

  /// Returns false if OpenGL does not accept these textures as targets.
  bool IsComplete() const { return this->Complete; }

private:
  vtkOpenGLRenderWindow* Window;
  std::unique_ptr<SavedState> Saved;
  vtkOpenGLFramebufferObject* Framebuffer;
  unsigned int Count;
  bool Depth;
  bool Complete = false;
};

/// Blends the output of stages over a viewport of the bound framebuffer, with premultiplied alpha,
/// and restores the OpenGL state when it is destroyed. If `depths` is on, stages also replace the
/// depth.
class VTKPENUMBRARENDERINGSCREENSPACE_EXPORT ScopedBlending
{
public:
  ScopedBlending(vtkOpenGLRenderWindow* window, const int viewport[4], bool depths);
  ~ScopedBlending();
  ScopedBlending(const ScopedBlending&) = delete;
  void operator=(const ScopedBlending&) = delete;

private:
  std::unique_ptr<SavedState> Saved;
};

}
#endif
