// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Estimates the thickness of visible objects, which one layer of depth does not contain, from their
// width.
#ifndef penumbra_Thickness_h
#define penumbra_Thickness_h

#include "Frame/ScreenTransform.h"

#include <vector>

namespace penumbra
{

/// Returns the median width of visible objects, in units of the view. The width at a pixel is the
/// shorter of the widths along its row and its column. Only objects whose outline is visible count;
/// 0 if there are none. `eyeDepths`: one value per pixel, row by row.
double MedianWidth(const std::vector<float>& eyeDepths, const ScreenTransform& view);

/// A thickness that approaches new measurements over several frames, so that occlusion does not pop
/// while the view moves.
class GradualThickness
{
public:
  double Get() const { return this->Current; }

  /// Sets the thickness at once.
  void Set(double thickness) { this->Current = this->Measured = thickness; }

  /// Sets the thickness that the following frames approach.
  void Approach(double thickness) { this->Measured = thickness; }

  /// Advances by a frame.
  void Advance();

private:
  double Current = 1.0;
  double Measured = 1.0;
};

}
#endif
