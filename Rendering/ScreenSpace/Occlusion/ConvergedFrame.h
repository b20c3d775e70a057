// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Fast path for a frame whose occlusion has converged. The delegate renders directly into the
// target, which is then multiplied by the known occlusion. The stored depth reveals whether the
// image has changed.
#ifndef penumbra_ConvergedFrame_h
#define penumbra_ConvergedFrame_h

#include "Frame/DelegateImage.h"
#include "Frame/Stage.h"

namespace penumbra
{

class ConvergedFrame
{
public:
  /// Occlusion to apply and the texture that stores the frame.
  struct CompositeInputs
  {
    vtkTextureObject* Occlusions;
    double Strength;
    /// Texture of two components, reserved for this object until Invalidate().
    vtkTextureObject* DepthAndFactor;
  };

  /// Renders the delegate into the target of `state` and multiplies pixels that show a surface by
  /// 1 - strength * occlusion. `image`: set up for the target. The first call after Invalidate()
  /// stores the frame. Returns false if the depth of any
  /// pixel differs from the stored one, or if the depth of the target cannot be read; the caller
  /// must then render the target again.
  bool Draw(const vtkRenderState* state, vtkRenderPass* delegate, const DelegateImage& image,
    const CompositeInputs& inputs);

  /// Returns true if a frame is stored.
  bool IsValid() const { return this->Valid; }
  void Invalidate() { this->Valid = false; }

  int GetNumberOfRenderedProps() const { return this->Props; }
  void ReleaseGraphicsResources(vtkWindow* window);

private:
  bool Store(vtkOpenGLRenderWindow* window, const DelegateImage& image, vtkTextureObject* depth,
    const CompositeInputs& inputs);
  bool ApplyOcclusion(vtkOpenGLRenderWindow* window, const DelegateImage& image,
    vtkOpenGLFramebufferObject* target, vtkTextureObject* convergedFrame);

  Stage Copy;
  Stage Multiply;
  int Props = 0;
  bool Valid = false;
};

}
#endif
