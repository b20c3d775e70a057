// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// One full-screen step of a pass: a fragment shader, the textures that it reads, the textures that
// it fills.
#ifndef penumbra_Stage_h
#define penumbra_Stage_h

#include "vtkOpenGLQuadHelper.h"
#include "vtkPenumbraRenderingScreenSpaceModule.h" // for export macro, which tests need
#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"

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

/// Shader text with every line `//VTK::Penumbra::NAME` replaced by the piece of that name.
VTKPENUMBRARENDERINGSCREENSPACE_EXPORT std::string Assemble(
  std::string source, const std::vector<std::pair<std::string, std::string>>& pieces);

/// Part of a picture, in pixels.
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

  /// Readies the program for uniforms; compiled once, and again when the source differs. Null when
  /// it cannot be compiled.
  vtkShaderProgram* Ready(vtkOpenGLRenderWindow* window, const std::string& source);

  /// What the sampler `name` reads in the next Draw().
  void BindTexture(const char* name, vtkTextureObject* texture);

  /// Draws into whatever is bound: all of it, or only within some rectangles.
  void Draw();
  void Draw(const std::vector<Rectangle>& parts);

  /// Draws and counts the pixels that were not discarded.
  unsigned int DrawAndCount();

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  void Unbind();

  std::unique_ptr<vtkOpenGLQuadHelper> Quad;
  std::string Source;
  vtkOpenGLRenderWindow* Window = nullptr;
  std::vector<vtkTextureObject*> Inputs;
};

/// What stages change of OpenGL; it is as it was when this ends.
struct SavedState;

/// While it lives, stages draw into textures: all of them, all at once, without blending. With a
/// depth texture only pixels that show a surface are drawn; it stays as it is. Then OpenGL is as it was.
class VTKPENUMBRARENDERINGSCREENSPACE_EXPORT ScopedRenderTarget
{
public:
  ScopedRenderTarget(vtkOpenGLRenderWindow* window, vtkOpenGLFramebufferObject* framebuffer,
    const std::vector<vtkTextureObject*>& targets, vtkTextureObject* depth = nullptr);
  ~ScopedRenderTarget();
  ScopedRenderTarget(const ScopedRenderTarget&) = delete;
  void operator=(const ScopedRenderTarget&) = delete;

  /// False: OpenGL does not accept these textures as targets.
  bool IsComplete() const { return this->Complete; }

private:
  vtkOpenGLRenderWindow* Window;
  std::unique_ptr<SavedState> Saved;
  vtkOpenGLFramebufferObject* Framebuffer;
  unsigned int Count;
  bool Depth;
  bool Complete = false;
};

/// While it lives, stages are blended over part of whatever is bound: alpha is what they hide of it, and
/// their colours are multiplied by it already. `depths`: they replace depths, too.
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

/// A texture of floats, sampled at the nearest pixel; cleared to zero. Kept while its size is right.
/// True when it is new.
VTKPENUMBRARENDERINGSCREENSPACE_EXPORT bool Allocate(vtkSmartPointer<vtkTextureObject>& texture,
  vtkOpenGLRenderWindow* window, int width, int height, int components);

/// All values of a texture of floats, row after row.
VTKPENUMBRARENDERINGSCREENSPACE_EXPORT std::vector<float> ReadBack(vtkTextureObject* texture);

}
#endif
