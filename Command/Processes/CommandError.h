// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Why the program stops early, and the exit status that says so.
#ifndef penumbra_CommandError_h
#define penumbra_CommandError_h

#include <stdexcept>
#include <string>

namespace penumbra
{

/// Exit statuses of the program.
enum Status
{
  Done = 0,
  AboveThreshold = 1, ///< a comparison only
  BadInput = 2,       ///< bad use or bad input
  Unavailable = 3     ///< no OpenGL context, out of memory, a crash
};

/// One sentence for the user: what, which file or option, what to do.
class CommandError : public std::runtime_error
{
public:
  CommandError(Status status, const std::string& message)
    : std::runtime_error(message),
      ExitStatus(status)
  {
  }

  const Status ExitStatus;
};

/// The user cancelled, by this signal.
class Cancelled : public std::exception
{
public:
  explicit Cancelled(int signal)
    : Signal(signal)
  {
  }

  const int Signal;
};

}
#endif
