// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Clock of the times in statistics files.
#ifndef penumbra_Clock_h
#define penumbra_Clock_h

#include <chrono>

namespace penumbra
{

using Clock = std::chrono::steady_clock;

inline double SecondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}
#endif
