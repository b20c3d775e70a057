// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Image of the emitters with everything else black [Shafts 13.5]. Occlusion comes from the depth of
// the delegate's image (mask) or from rendering the other props a second time (pre-pass).
#ifndef penumbra_EmitterImage_h
#define penumbra_EmitterImage_h

#include "Frame/DelegateImage.h"
#include "Frame/Stage.h"

#include <vector>

class vtkProp;

namespace penumbra
{

class EmitterImage
{
public:
  /// Renders the emitters. `view` is the view of `image` downsampled to blocks of `block` pixels
  /// per side. If `prepass` is on, occluders are rendered instead of copying the depth of `image`.
  /// Returns false if OpenGL reports an incomplete framebuffer or a shader does not compile.
  bool Draw(const vtkRenderState* state, const DelegateImage& image, const ScreenTransform& view,
    int block, const std::vector<vtkProp*>& emitters, bool prepass);

  /// rgb: color, a: 1 where an emitter is visible.
  vtkTextureObject* GetColor() const { return this->Color; }

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  void Allocate(vtkOpenGLRenderWindow* window, const ScreenTransform& view);
  bool CopyDepth(vtkOpenGLRenderWindow* window, const DelegateImage& image, int block);

  Stage DepthCopy;
  vtkSmartPointer<vtkTextureObject> Color;
  vtkSmartPointer<vtkTextureObject> Depth;
  vtkSmartPointer<vtkOpenGLFramebufferObject> Framebuffer;
};

}
#endif
