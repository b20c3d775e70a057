// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the ranks of a parallel program have exchanged for an image or for baking.
#ifndef penumbra_ExchangeCounts_h
#define penumbra_ExchangeCounts_h

namespace penumbra
{

struct ExchangeCounts
{
  long long SceneBytes = 0;      ///< of surfaces, received by this rank
  long long WholeBytes = 0;      ///< of all surfaces of all ranks
  long long Primitives = 0;      ///< that this rank has after the exchange
  long long WholePrimitives = 0; ///< of all ranks
  long long PixelBytes = 0;      ///< of parts of the image, received by this rank
  long long Rays = 0;            ///< traced by this rank
};

}
#endif
