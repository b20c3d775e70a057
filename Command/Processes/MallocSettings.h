// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// How a program of ours wants its memory; for main functions alone, never for a library.
#ifndef penumbra_MallocSettings_h
#define penumbra_MallocSettings_h

namespace penumbra
{

/// Freed memory stays with the process, up to a quarter of a gigabyte. Mesa's software renderer gets and
/// frees tens of megabytes for every frame: handed back to the system in between, each page of them
/// costs a fault, together as much as a third of a frame. Whether the C library does so by itself
/// depends on the sizes that happened to be freed before. Elsewhere than with glibc: nothing.
void RetainFreedMemory();

}
#endif
