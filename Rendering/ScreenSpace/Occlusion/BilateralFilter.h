// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The separable cross-bilateral filter of occlusion [TSSAO eq. 10-11], as stages of a pass.
#ifndef penumbra_BilateralFilter_h
#define penumbra_BilateralFilter_h

#include "Frame/DelegateImage.h"
#include "Frame/Stage.h"

#include <vector>

namespace penumbra
{

struct BilateralSettings
{
  double ConvergedWeight = 150.0; ///< pixels with at least this many samples are not filtered
  double DistanceInPixels = 4.0;  ///< distance at which the weight falls to 1/e, in pixel widths
};

class BilateralFilter
{
public:
  /// Filters `values` (r: sum, g: number of samples) and writes means to `target`. `intermediate`
  /// is a texture of two components for the first direction, `view` the view of `eyeDepths`. Only
  /// pixels in `parts` are filtered. Returns false if OpenGL reports an error.
  bool Apply(vtkOpenGLRenderWindow* window, const DelegateImage& image, const ScreenTransform& view,
    vtkTextureObject* eyeDepths, vtkTextureObject* values, vtkTextureObject* intermediate,
    vtkTextureObject* target, const BilateralSettings& settings,
    const std::vector<Rectangle>& parts);

  /// Applies the same filter in a single pass, which is faster if most pixels have converged.
  bool ApplySinglePass(vtkOpenGLRenderWindow* window, const DelegateImage& image,
    const ScreenTransform& view, vtkTextureObject* eyeDepths, vtkTextureObject* values,
    vtkTextureObject* target, const BilateralSettings& settings,
    const std::vector<Rectangle>& parts);

  /// Writes the means of `values` without filtering.
  bool Copy(vtkOpenGLRenderWindow* window, const DelegateImage& image, vtkTextureObject* values,
    vtkTextureObject* target, const std::vector<Rectangle>& parts);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  Stage Smooth;
  Stage SinglePass;
  Stage Mean;
};

}
#endif
