// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The separable cross-bilateral filter [TSSAO eq. 10-11], as steps of a pass.
#ifndef penumbra_BilateralFilter_h
#define penumbra_BilateralFilter_h

#include "Frame/DelegateImage.h"
#include "Frame/Stage.h"

#include <vector>

namespace penumbra
{

struct BilateralSettings
{
  double ConvergedWeight = 150.0; ///< from this weight on a pixel is left alone
  double DistanceInPixels = 4.0;  ///< a neighbour so many pixel widths away in space counts 1/e
};

class BilateralFilter
{
public:
  /// From `values` (r: sum, g: number of samples) over `between` (two floats) to means in
  /// `target`.
  /// `view` is that of `eyeDepths`. Only within `parts`. False when OpenGL refuses.
  bool Apply(vtkOpenGLRenderWindow* window, const DelegateImage& image, const ScreenTransform& view,
    vtkTextureObject* eyeDepths, vtkTextureObject* values, vtkTextureObject* between,
    vtkTextureObject* target, const BilateralSettings& settings,
    const std::vector<Rectangle>& parts);

  /// The same in one step: cheaper where all but some spots have converged, else dearer.
  bool ApplySinglePass(vtkOpenGLRenderWindow* window, const DelegateImage& image,
    const ScreenTransform& view, vtkTextureObject* eyeDepths, vtkTextureObject* values,
    vtkTextureObject* target, const BilateralSettings& settings,
    const std::vector<Rectangle>& parts);

  /// The mean of `values` as it is, for pictures that need no filter.
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
