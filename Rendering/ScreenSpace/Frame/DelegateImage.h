// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The image that the delegate of a pass renders, as textures: color and depth, with an optional
// margin so that geometry just outside the image has an effect, and with as many samples per pixel
// as the target.
#ifndef penumbra_DelegateImage_h
#define penumbra_DelegateImage_h

#include "ScreenTransform.h"

#include "vtkOpenGLFramebufferObject.h"
#include "vtkPenumbraRenderingScreenSpaceModule.h" // for export macro
#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"
#include "vtkType.h"

#include <functional>

class vtkOpenGLRenderWindow;
class vtkRenderPass;
class vtkRenderState;
class vtkRenderer;
class vtkWindow;

namespace penumbra
{

/// Clears the buffers in `cleared` (GL_COLOR_BUFFER_BIT, GL_DEPTH_BUFFER_BIT) of two textures of
/// the same size, calls `draw` with them bound, and restores the OpenGL state. Returns false,
/// without calling `draw`, if the framebuffer is incomplete.
bool FillTextures(vtkOpenGLFramebufferObject* framebuffer, vtkTextureObject* color,
  vtkTextureObject* depth, unsigned int cleared, const std::function<void()>& draw);

class VTKPENUMBRARENDERINGSCREENSPACE_EXPORT DelegateImage
{
public:
  DelegateImage();
  ~DelegateImage();

  /// Computes the view and the viewport of Draw(). `margin` is in pixels on each side, in x and y.
  /// If `bounds`, those of all visible props, are given, the clipping planes may be moved to them.
  /// Returns false if the viewport is empty.
  bool SetUpView(const vtkRenderState* state, const int margin[2], const double* bounds = nullptr);

  /// Renders the delegate for the renderer of `state`, with as many samples per pixel as the target
  /// or, if `oneSample` is on, with one. Returns the number of rendered props, or -1 if the
  /// viewport is empty or the framebuffer is incomplete.
  int Draw(const vtkRenderState* state, vtkRenderPass* delegate, const int margin[2],
    bool oneSample = false, const double* bounds = nullptr);

  /// Renders the delegate directly into the target of `state`, without a margin. GetDepth() and
  /// GetColor() are then the textures of the target; its color cannot be read while it is drawn to.
  /// Renders nothing and returns -1 unless the depth of the target is a texture of the size of the
  /// image with one sample per pixel.
  int DrawToTarget(const vtkRenderState* state, vtkRenderPass* delegate);

  /// After Draw(): renders props a second time into `target`, a texture of the size of the image.
  /// `props` renders them; only their visible pixels are written, the others are 0. Returns false
  /// if the framebuffer is incomplete.
  bool DrawAgain(
    vtkRenderer* renderer, vtkTextureObject* target, const std::function<void()>& props);

  /// Creates a texture of the size of the image with four components of a VTK type per sample.
  vtkSmartPointer<vtkTextureObject> CreateColor(
    vtkOpenGLRenderWindow* window, int samples, int type = VTK_UNSIGNED_CHAR) const;

  /// One depth per pixel; that of the first sample if there are several.
  vtkTextureObject* GetDepth() const { return this->Depth; }

  /// Color and depth of every sample; multisample textures if GetSamples() is above 1.
  vtkTextureObject* GetColor() const { return this->Color; }
  vtkTextureObject* GetSampleDepth() const { return this->SampleDepth; }
  int GetSamples() const { return this->Samples; }

  /// View of the image, margin included.
  const ScreenTransform& GetView() const { return this->View; }

  /// Rectangle of the target that the image without its margin covers: origin, size.
  const int* GetViewport() const { return this->Viewport; }
  const int* GetMargin() const { return this->Margin; }

  /// Framebuffer object for stages that render into textures.
  vtkOpenGLFramebufferObject* GetFramebuffer() const { return this->Framebuffer; }

  void ReleaseGraphicsResources(vtkWindow* window);

  /// Returns the target of a frame; null unless its color and depth are textures with one sample
  /// per pixel.
  static vtkOpenGLFramebufferObject* GetReadableTarget(const vtkRenderState* state);

private:
  /// The image is rendered with a camera other than that of the renderer.
  bool IsWider() const
  {
    return this->Margin[0] > 0 || this->Margin[1] > 0 || this->HasTightClipping;
  }

  void PrepareFramebuffers(vtkOpenGLRenderWindow* window);
  void Prepare(vtkOpenGLRenderWindow* window, int samples, int colorType);
  static int GetTargetSamples(const vtkRenderState* state);
  /// Returns the VTK type of the color components of the target: VTK_FLOAT under tone mapping.
  static int GetTargetColorType(const vtkRenderState* state);
  void ResolveDepth(vtkOpenGLRenderWindow* window);
  void ResolveColor(vtkOpenGLRenderWindow* window, vtkTextureObject* target);

  vtkSmartPointer<vtkTextureObject> Color;
  vtkSmartPointer<vtkTextureObject> SampleDepth; ///< identical to Depth if Samples is 1
  vtkSmartPointer<vtkTextureObject> Depth;
  vtkSmartPointer<vtkOpenGLFramebufferObject> Framebuffer;
  vtkSmartPointer<vtkOpenGLFramebufferObject> Resolved;
  int Samples = 1;
  int ColorType = VTK_UNSIGNED_CHAR;
  bool HasTightClipping = false; ///< the clipping planes differ from those of the camera
  bool UsesTarget = false;       ///< Color and Depth belong to the target
  ScreenTransform View;
  int Viewport[4] = { 0, 0, 0, 0 };
  int Margin[2] = { 0, 0 };
};

}
#endif
