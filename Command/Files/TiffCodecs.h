// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Decompresses strips and tiles of .tif files. All functions return fewer than `expected` bytes if `in` is damaged.
#ifndef penumbra_TiffCodecs_h
#define penumbra_TiffCodecs_h

#include <cstddef>
#include <vector>

namespace penumbra
{

/// PackBits [TIFF 6.0, section 9].
std::vector<unsigned char> DecodeTiffPackBits(
  const unsigned char* in, std::size_t size, std::size_t expected);

/// LZW [TIFF 6.0, section 13].
std::vector<unsigned char> DecodeTiffLzw(
  const unsigned char* in, std::size_t size, std::size_t expected);

/// Deflate; `expected` has to be the exact size.
std::vector<unsigned char> InflateTiff(
  const unsigned char* in, std::size_t size, std::size_t expected);

}
#endif
