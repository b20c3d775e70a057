// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A picture of the props that glow, everything else black [Shafts 13.5]: over the depths of a picture
// that is there already (the mask), or of the other props, drawn once more for it (the pre-pass).
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
  /// `view`: of one pixel in each block of the image's, `block` pixels a side. False when OpenGL
  /// refuses.
  bool Draw(const vtkRenderState* state, const DelegateImage& image, const ScreenTransform& view,
    int block, const std::vector<vtkProp*>& emitters, bool prepass);

  /// rgb: colour, a: 1 where an emitter is seen.
  vtkTextureObject* GetColor() const { return this->Color; }

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  void Allocate(vtkOpenGLRenderWindow* window, const ScreenTransform& view);
  bool CopyDepth(vtkOpenGLRenderWindow* window, const DelegateImage& image, int block);

  Stage Depths;
  vtkSmartPointer<vtkTextureObject> Color;
  vtkSmartPointer<vtkTextureObject> Depth;
  vtkSmartPointer<vtkOpenGLFramebufferObject> Framebuffer;
};

}
#endif
