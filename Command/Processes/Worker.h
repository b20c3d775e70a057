// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Every picture is made by a process of its own: a damaged file that crashes its reader, or a scene
// too large for the machine, ends that picture with a message and never the program.
#ifndef penumbra_Worker_h
#define penumbra_Worker_h

#include <functional>
#include <string>

namespace penumbra
{

/// What the worker is doing, for the message in case it dies of it.
/// `blame`: BadInput where a crash means a damaged file, else Unavailable.
void EnterPhase(const std::string& what, int blame);

/// Remove `path` should the worker die before `path` is renamed to its final name; two at most.
void RemoveOnCrash(const std::string& path);

/// No longer: it was renamed, or removed.
void KeepOnCrash(const std::string& path);

/// Remove them now; safe in a signal's handler.
void RemoveTemporaries();

/// Do count tasks, each in a process of its own, `jobs` at a time; `finished` hears after each.
/// `task` returns an exit status or throws Failure, whose message is said. Returns the largest
/// status. When the user cancels (SIGINT, SIGTERM, SIGHUP, unless ignored), the workers end, what they
/// had begun to write is removed, and Cancelled is thrown.
int RunWorkers(int count, int jobs, const std::function<int(int)>& task,
  const std::function<void(int finishedTasks)>& finished);

/// Run one body, its exceptions but Cancelled, and a standard output that cannot be written, turned
/// into one line and a status.
int RunGuarded(const std::function<int()>& body);

/// Physical memory of the machine, or what the control group grants of it.
unsigned long long MachineMemory();

}
#endif
