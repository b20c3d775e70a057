// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Borders of texels in a pixel.
#ifndef penumbra_TextureBorders_h
#define penumbra_TextureBorders_h

#include "PixelContext.h"

namespace penumbra
{

/// Returns true if the corners lie in different texels of a texture, so that colors may change within
/// the pixel without an edge of the mesh. `hasEdges`: edges of the mesh cross the pixel.
bool IsTextureDiscontinuous(const PixelContext& pixel, bool hasEdges);

}
#endif
