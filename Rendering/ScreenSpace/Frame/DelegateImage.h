// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What a pass's delegate draws, as textures of our own: colour and depth, with a margin around the
// picture if asked for, so that what lies just outside counts; with as many samples a pixel as the
// target has.
#ifndef penumbra_DelegateImage_h
#define penumbra_DelegateImage_h

#include "ScreenTransform.h"

#include "vtkOpenGLFramebufferObject.h"
#include "vtkPenumbraRenderingScreenSpaceModule.h" // for export macro
#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"

#include <functional>

class vtkOpenGLRenderWindow;
class vtkRenderPass;
class vtkRenderState;
class vtkRenderer;
class vtkWindow;

namespace penumbra
{

/// Clears what `cleared` names of two textures of one size, draws into them, and leaves OpenGL's state as
/// it was. False when OpenGL refuses.
bool FillTextures(vtkOpenGLFramebufferObject* framebuffer, vtkTextureObject* color,
  vtkTextureObject* depth, unsigned int cleared, const std::function<void()>& draw);

class VTKPENUMBRARENDERINGSCREENSPACE_EXPORT DelegateImage
{
public:
  DelegateImage();
  ~DelegateImage();

  /// Finds out what Draw() would draw where: the view, the viewport. False when that is nothing.
  /// `bounds`: of all that may be seen, where the clipping planes may be moved to them.
  bool SetUpView(const vtkRenderState* state, const int margin[2], const double* bounds = nullptr);

  /// Draws the delegate for the renderer of `state`; `margin` in pixels on each side, in x and y.
  /// With as many samples a pixel as the target, or one. Returns the number of props drawn, -1 when
  /// OpenGL refuses.
  int Draw(const vtkRenderState* state, vtkRenderPass* delegate, const int margin[2],
    bool oneSample = false, const double* bounds = nullptr);

  /// The same straight into the target of `state`, whose depth is then GetDepth(); there is no colour
  /// to read, and no margin. Nothing is drawn, and -1 returned, unless the target's depth is a texture
  /// of the picture's size with one sample a pixel.
  int DrawToTarget(const vtkRenderState* state, vtkRenderPass* delegate);

  /// After Draw(): draws props of the scene, which `props` does, into a texture of the picture's size;
  /// only what the picture shows of them. Zero elsewhere. False when OpenGL refuses.
  bool DrawAgain(
    vtkRenderer* renderer, vtkTextureObject* target, const std::function<void()>& props);

  /// A texture of the picture's size for four bytes a sample.
  vtkSmartPointer<vtkTextureObject> CreateColor(vtkOpenGLRenderWindow* window, int samples) const;

  /// One depth a pixel, also of pictures with several samples (of these the first).
  vtkTextureObject* GetDepth() const { return this->Depth; }

  /// Colour and depth of every sample: textures with GetSamples() samples a pixel, 1: plain ones.
  vtkTextureObject* GetColor() const { return this->Color; }
  vtkTextureObject* GetSampleDepth() const { return this->SampleDepth; }
  int GetSamples() const { return this->Samples; }

  /// How the picture with its margin looks at the scene.
  const ScreenTransform& GetView() const { return this->View; }

  /// Where the picture without its margin belongs in the target: origin, size.
  const int* GetViewport() const { return this->Viewport; }
  const int* GetMargin() const { return this->Margin; }

  /// For stages that fill textures of the picture's size.
  vtkOpenGLFramebufferObject* GetFramebuffer() const { return this->Framebuffer; }

  void ReleaseGraphicsResources(vtkWindow* window);

  /// Where a frame goes; null unless its colours and depths are textures with one sample a pixel.
  static vtkOpenGLFramebufferObject* GetReadableTarget(const vtkRenderState* state);

private:
  /// Another camera than the renderer's draws.
  bool IsWider() const
  {
    return this->Margin[0] > 0 || this->Margin[1] > 0 || this->HasTightClipping;
  }

  void PrepareFramebuffers(vtkOpenGLRenderWindow* window);
  void Prepare(vtkOpenGLRenderWindow* window, int samples);
  static int SamplesOf(const vtkRenderState* state);
  void ResolveDepth(vtkOpenGLRenderWindow* window);
  void ResolveColor(vtkOpenGLRenderWindow* window, vtkTextureObject* target);

  vtkSmartPointer<vtkTextureObject> Color;
  vtkSmartPointer<vtkTextureObject> SampleDepth; ///< the same as Depth with one sample
  vtkSmartPointer<vtkTextureObject> Depth;
  vtkSmartPointer<vtkOpenGLFramebufferObject> Framebuffer;
  vtkSmartPointer<vtkOpenGLFramebufferObject> Resolved;
  int Samples = 1;
  bool HasTightClipping = false; ///< the clipping planes are not the camera's
  bool UsesTarget = false;       ///< Color and Depth belong to the target
  ScreenTransform View;
  int Viewport[4] = { 0, 0, 0, 0 };
  int Margin[2] = { 0, 0 };
};

}
#endif
