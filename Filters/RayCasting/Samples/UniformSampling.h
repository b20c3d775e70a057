// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Samples on a regular grid in the pixel, for comparison.
#ifndef penumbra_UniformSampling_h
#define penumbra_UniformSampling_h

#include "Pixels/PixelContext.h"

namespace penumbra
{

/// Returns the mean of UniformSamples x UniformSamples rays.
PixelResult SampleUniformly(PixelContext& pixel);

}
#endif
