// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// How much memory a picture takes where a processor draws.
#ifndef penumbra_occlusion_BytesInUse_h
#define penumbra_occlusion_BytesInUse_h

#include <cstdlib> // tells which C library it is

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace penumbra
{

/// What the C library has handed out, textures of a processor that draws among it; 0 where it does not say.
inline double BytesInUse()
{
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
#else
  return 0.0;
#endif
}

}
#endif
