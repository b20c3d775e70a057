// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Memory of this process, from Linux.
#ifndef Memory_h
#define Memory_h

#include <fstream>
#include <string>

#include <malloc.h>

/// Reads a value of this process in MB, such as "VmRSS:"; 0 if the system has none.
inline double ReadMegabytes(const std::string& key)
{
  std::ifstream file("/proc/self/status");
  std::string word;
  double kilobytes = 0.0;
  while (file >> word)
  {
    if (word == key && file >> kilobytes)
    {
      return kilobytes * 1024.0 / 1e6;
    }
  }
  return 0.0;
}

/// Resets the peak of the resident memory to the current value, which it returns, in MB.
inline double ResetPeakMegabytes()
{
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
  return ReadMegabytes("VmRSS:");
}

/// Returns the peak of the resident memory since it was reset, in MB.
inline double ReadPeakMegabytes()
{
  return ReadMegabytes("VmHWM:");
}

#endif
