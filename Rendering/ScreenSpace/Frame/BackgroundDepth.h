// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Eye depth of pixels without a surface.
#ifndef penumbra_BackgroundDepth_h
#define penumbra_BackgroundDepth_h

namespace penumbra
{

/// Pixels with a larger eye depth are background. The shaders write farAway of
/// vtkPenumbraViewLib.glsl, 1e18, which rounds to a float above this.
constexpr float BackgroundDepth = 1e17f;

}
#endif
