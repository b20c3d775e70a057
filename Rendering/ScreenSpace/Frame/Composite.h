// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The last step of a pass: the delegate's picture, darkened, with its own depth, into whatever is
// bound.
#ifndef penumbra_Composite_h
#define penumbra_Composite_h

#include "EyeDepth.h"
#include "Stage.h"

namespace penumbra
{

/// Colours are multiplied by 1 - Strength * occlusion * (1 - LightAwareness * brightness).
struct Darkening
{
  double Strength = 1.0;
  double LightAwareness = 0.0;
};

class VTKPENUMBRARENDERINGSCREENSPACE_EXPORT Composite
{
public:
  /// `colors`, darkened; without occlusions Strength must be 0. `background`: pixels without a surface
  /// are drawn, too, else they stay. False when OpenGL refuses.
  bool Draw(vtkOpenGLRenderWindow* window, const DelegateImage& image, const EyeDepth& depth,
    vtkTextureObject* colors, vtkTextureObject* occlusions, const Darkening& darkening,
    bool background);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  Stage Darken;
};

}
#endif
