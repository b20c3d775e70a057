// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Worker processes. A separate process renders each image, so that a reader that crashes or a scene
// that exceeds the memory ends one image with a message, and not the program.
#ifndef penumbra_Worker_h
#define penumbra_Worker_h

#include <functional>
#include <string>

namespace penumbra
{

/// Sets the phase that the message names if the worker crashes.
/// `blame`: exit status of a crash; BadInput while a file is read, else Unavailable.
void EnterPhase(const std::string& what, int blame);

/// Registers a temporary file to remove if the worker crashes; at most two.
void RemoveOnCrash(const std::string& path);

/// Unregisters a temporary file that was renamed or removed.
void KeepOnCrash(const std::string& path);

/// Removes the registered temporary files; safe in a signal handler.
void RemoveTemporaries();

/// Runs `count` tasks in separate processes, `jobs` at a time, and calls `finished` after each.
/// `task` returns an exit status or throws CommandError, whose message is printed. Returns the
/// largest exit status. SIGINT, SIGTERM and SIGHUP, unless ignored, end the workers and remove
/// their temporary files; Cancelled is thrown.
int RunWorkers(int count, int jobs, const std::function<int(int)>& task,
  const std::function<void(int finishedTasks)>& finished);

/// Prints an error, unless one of the same `cause` was printed by a worker of the pool: RunWorkers() prints the
/// number of those.
void PrintError(const std::string& error, const std::string& cause);

/// Runs `body`. Converts exceptions other than Cancelled, and a failed write to standard output, to
/// one line and an exit status.
int RunGuarded(const std::function<int()>& body);

/// Physical memory of the machine in bytes, or the limit of the control group if lower.
unsigned long long MachineMemory();

}
#endif
