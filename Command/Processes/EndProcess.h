// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The end of our programs. The destructor of VTK's thread pool asks its threads to end without holding the mutex
// that they wait with: a thread that is about to wait misses the request, and exit() waits for that thread forever.
// It was seen once, in a test on a loaded machine.
#ifndef penumbra_EndProcess_h
#define penumbra_EndProcess_h

#include <cstdio>
#include <cstdlib>
#include <iostream>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace penumbra
{

/// Writes what the standard streams hold, and ends the process without destroying static objects.
[[noreturn]] inline void EndProcess(int status)
{
  std::cout.flush();
  std::cerr.flush();
  std::fflush(nullptr);
#ifdef __SANITIZE_ADDRESS__
  __lsan_do_leak_check(); // Ends the process with another status if there is a leak.
#endif
  std::_Exit(status);
}

}
#endif
