// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The cheap way to draw a picture whose occlusion is known: the delegate draws straight into the
// target, which is then darkened. Depth tells whether it is still the picture that was known.
#ifndef penumbra_ConvergedFrame_h
#define penumbra_ConvergedFrame_h

#include "Frame/DelegateImage.h"
#include "Frame/Stage.h"

namespace penumbra
{

class ConvergedFrame
{
public:
  /// What a picture is darkened by, and where that is remembered.
  struct CompositeInputs
  {
    vtkTextureObject* Occlusions;
    double Strength;
    vtkTextureObject* DepthAndFactor; ///< two floats a pixel, nobody else's until Forget()
  };

  /// Draws the delegate into the target of `state` and multiplies it by 1 - strength * occlusion,
  /// where there is a surface. The first picture after Forget() is remembered; of others it is false
  /// when any depth differs, and false where the target's depth cannot be read: then the target's
  /// content is to be drawn over. `image`: aimed at the target, which is cleared first if asked for.
  bool Draw(const vtkRenderState* state, vtkRenderPass* delegate, const DelegateImage& image,
    const CompositeInputs& darkness, bool clear);

  /// Is there a picture to compare with?
  bool IsKnown() const { return this->Known; }
  void Forget() { this->Known = false; }

  int GetNumberOfRenderedProps() const { return this->Props; }
  void ReleaseGraphicsResources(vtkWindow* window);

private:
  bool Store(vtkOpenGLRenderWindow* window, const DelegateImage& image, vtkTextureObject* depth,
    const CompositeInputs& darkness);
  bool Darken(vtkOpenGLRenderWindow* window, const DelegateImage& image,
    vtkOpenGLFramebufferObject* target, vtkTextureObject* memory);

  Stage Copy;
  Stage Multiply;
  int Props = 0;
  bool Known = false;
};

}
#endif
