// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Exact integration of a texture over a pixel, case 2 of [AA]: the borders of texels are lines in the
// image, which divide the pixel into convex polygons with one texel each.
#ifndef penumbra_TexelIntegral_h
#define penumbra_TexelIntegral_h

#include "Pixels/PixelContext.h"
#include "Rasterization/TileRasterizer.h"

#include <optional>

namespace penumbra
{

/// Integrates the texture of the only triangle in the pixel that the rasterizer has selected, which is
/// opaque. Gives up, without a result, if this is not the case, takes more time than samples, or is less accurate.
std::optional<PixelResult> IntegrateTexels(PixelContext& context, const TileRasterizer& rasterizer);

}
#endif
