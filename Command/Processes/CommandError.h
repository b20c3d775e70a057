// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Exceptions that end the program, and its exit statuses.
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
  AboveThreshold = 1, ///< `compare` only
  BadInput = 2,       ///< invalid usage or input
  Unavailable = 3     ///< no OpenGL context, out of memory, a crash
};

/// Error that ends the program with an exit status. The message is one line: the file or option,
/// the problem, the remedy.
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

/// Thrown when a signal of the user cancels the program.
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
