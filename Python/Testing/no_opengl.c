/* SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
   SPDX-License-Identifier: BSD-3-Clause

   Simulates a machine without OpenGL: if preloaded, hides the OpenGL libraries from VTK. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <string.h>

void* dlopen(const char* name, int flags)
{
  void* (*next)(const char*, int) = (void* (*)(const char*, int))dlsym(RTLD_NEXT, "dlopen");
  if (name && (strstr(name, "libOSMesa") || strstr(name, "libEGL") || strstr(name, "libGL")))
  {
    return next("hidden", flags);
  }
  return next(name, flags);
}
