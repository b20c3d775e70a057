// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// How thick are the things in a picture? As thick as they are wide, for want of better knowledge.
#ifndef penumbra_Thickness_h
#define penumbra_Thickness_h

#include "Frame/ScreenTransform.h"

#include <vector>

namespace penumbra
{

/// The median, over pixels of things whose outline is seen, of the shorter of their widths along row
/// and column, in units of the view; 0 where nothing has an outline. `eyeDepths`: row after row.
double MedianWidth(const std::vector<float>& eyeDepths, const ScreenTransform& view);

}
#endif
