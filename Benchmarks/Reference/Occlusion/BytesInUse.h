// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Memory in use by the process, to measure the memory of software rendering.
#ifndef penumbra_occlusion_BytesInUse_h
#define penumbra_occlusion_BytesInUse_h

#include <cstdlib> // defines the macros of the C library

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace penumbra
{

/// Bytes allocated from the C library, which include the textures of a software renderer; 0 if the
/// library does not report them.
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
