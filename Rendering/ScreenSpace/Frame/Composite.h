// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The last step of a pass: draws the image of the delegate, darkened by occlusion, with its depth,
// into the bound framebuffer.
#ifndef penumbra_Composite_h
#define penumbra_Composite_h

#include "EyeDepth.h"
#include "Stage.h"

namespace penumbra
{

/// Colors are multiplied by 1 - Strength * occlusion * (1 - LightAwareness * brightness).
struct Darkening
{
  double Strength = 1.0;
  double LightAwareness = 0.0;
};

class VTKPENUMBRARENDERINGSCREENSPACE_EXPORT Composite
{
public:
  /// Draws `colors`, darkened by `occlusions`. If `occlusions` is null, Strength must be 0. If
  /// `background` is on, pixels without a surface are drawn, too; else the target keeps them.
  /// Returns false if the shader does not compile.
  bool Draw(vtkOpenGLRenderWindow* window, const DelegateImage& image, const EyeDepth& depth,
    vtkTextureObject* colors, vtkTextureObject* occlusions, const Darkening& darkening,
    bool background);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  Stage DrawStage;
};

}
#endif
