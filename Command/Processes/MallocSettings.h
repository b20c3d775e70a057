// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Settings of malloc. Call from main() only, never from a library.
#ifndef penumbra_MallocSettings_h
#define penumbra_MallocSettings_h

namespace penumbra
{

/// Keeps up to 256 MiB of freed memory in the process. Mesa's software renderer allocates and frees
/// tens of megabytes per frame. If they are returned to the system, the page faults cost up to a
/// third of a frame. Without this call, the behavior depends on the sizes freed before. No effect
/// without glibc.
void RetainFreedMemory();

}
#endif
