// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Worker.h"

#include "Failure.h"
#include "MessageLog.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <new>
#include <vector>

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{

// Shared between a worker and its supervisor.
struct Report
{
  char Phase[1024];
  char Temporary[2][4096];
  int Blame;
};

Report* Mine = nullptr;
std::atomic<bool> CancelRequested{ false };

void RequestCancel(int)
{
  CancelRequested = true;
}

void CopyText(char* target, std::size_t size, const std::string& text)
{
  std::snprintf(target, size, "%s", text.c_str());
}

// Blocks the signals that the supervisor waits for; they arrive while it is suspended.
sigset_t BlockSignals()
{
  struct sigaction action = {};
  action.sa_handler = RequestCancel;
  sigset_t blocked;
  sigset_t before;
  sigemptyset(&blocked);
  for (int number : { SIGINT, SIGTERM, SIGHUP })
  {
    sigaction(number, &action, nullptr);
    sigaddset(&blocked, number);
  }
  action.sa_handler = [](int) {};
  sigaction(SIGCHLD, &action, nullptr);
  sigaddset(&blocked, SIGCHLD);
  sigprocmask(SIG_BLOCK, &blocked, &before);
  return before;
}

// A worker simply dies when the user cancels, or with its supervisor.
void RestoreSignals(const sigset_t& before)
{
  for (int number : { SIGINT, SIGTERM, SIGHUP, SIGCHLD })
  {
    signal(number, SIG_DFL);
  }
  sigprocmask(SIG_SETMASK, &before, nullptr);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
}

void LimitMemory()
{
#if !defined(__SANITIZE_ADDRESS__)
  // Refusing memory that the machine does not have leads to a message instead of a kill.
  rlimit limit = {};
  getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = std::min<rlim_t>(penumbra::MachineMemory(), limit.rlim_cur);
  setrlimit(RLIMIT_DATA, &limit);
#endif
}

void RemoveTemporaries(const Report& report)
{
  for (const char* path : report.Temporary)
  {
    if (*path)
    {
      unlink(path);
    }
  }
}

// A status for a worker that was killed, and a line about it.
int ExplainDeath(const Report& report, int signalNumber)
{
  RemoveTemporaries(report);
  if (CancelRequested)
  {
    return penumbra::Done;
  }
  if (signalNumber == SIGKILL)
  {
    penumbra::Say(std::string(report.Phase) + ": ended by the system, most likely out of memory");
    return penumbra::MachineCannot;
  }
  if (report.Blame == penumbra::BadInput)
  {
    penumbra::Say(std::string(report.Phase) + ": the file is damaged: its reader crashed on it");
    return penumbra::BadInput;
  }
  penumbra::Say(std::string(report.Phase) + ": crashed (" + strsignal(signalNumber) +
    "); please report it, with the command and " +
    (penumbra::LogPath().empty() ? "the file" : penumbra::LogPath()));
  return penumbra::MachineCannot;
}

}

namespace penumbra
{

unsigned long long MachineMemory()
{
  unsigned long long memory =
    static_cast<unsigned long long>(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGESIZE);
  std::ifstream controlGroup("/sys/fs/cgroup/memory.max");
  unsigned long long granted = 0;
  if (controlGroup >> granted)
  {
    memory = std::min(memory, granted);
  }
  return memory;
}

void EnterPhase(const std::string& what, int blame)
{
  if (Mine)
  {
    CopyText(Mine->Phase, sizeof(Mine->Phase), what);
    Mine->Blame = blame;
  }
}

void RemoveOnCrash(const std::string& path)
{
  if (Mine)
  {
    char* slot = Mine->Temporary[*Mine->Temporary[0] ? 1 : 0];
    CopyText(slot, sizeof(Mine->Temporary[0]), path);
  }
}

int RunGuarded(const std::function<int()>& body)
{
  try
  {
    return body();
  }
  catch (const Failure& failure)
  {
    Say(failure.what());
    return failure.ExitStatus;
  }
  catch (const Cancelled&)
  {
    throw;
  }
  catch (const std::bad_alloc&)
  {
    Say((Mine ? Mine->Phase + std::string(": ") : std::string()) +
      "out of memory; a smaller --resolution or a smaller mesh needs less");
    return MachineCannot;
  }
  catch (const std::exception& error)
  {
    Say((Mine ? Mine->Phase + std::string(": ") : std::string()) + error.what());
    return Mine && Mine->Blame == BadInput ? BadInput : MachineCannot;
  }
}

int RunWorkers(int count, int jobs, const std::function<int(int)>& task,
  const std::function<void(int finishedTasks)>& finished)
{
  void* memory = mmap(
    nullptr, sizeof(Report) * count, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED)
  {
    throw std::bad_alloc();
  }
  Report* reports = static_cast<Report*>(memory);
  const sigset_t signalsBefore = BlockSignals();
  std::map<pid_t, int> running;
  int started = 0;
  int done = 0;
  int worst = Done;
  while (!running.empty() || (started < count && !CancelRequested))
  {
    while (started < count && static_cast<int>(running.size()) < jobs && !CancelRequested)
    {
      std::fflush(nullptr);
      const pid_t child = fork();
      if (child < 0)
      {
        throw Failure(MachineCannot, std::string("cannot start a process: ") + strerror(errno));
      }
      if (child == 0)
      {
        Mine = &reports[started];
        RestoreSignals(signalsBefore);
        LimitMemory();
        std::exit(RunGuarded([&]() { return task(started); }));
      }
      running[child] = started++;
    }
    int state = 0;
    pid_t child = waitpid(-1, &state, WNOHANG);
    if (child <= 0)
    {
      sigsuspend(&signalsBefore);
      for (auto worker = running.begin(); CancelRequested && worker != running.end(); ++worker)
      {
        kill(worker->first, SIGKILL);
      }
      continue;
    }
    const int status = WIFSIGNALED(state) ? ExplainDeath(reports[running[child]], WTERMSIG(state))
                                          : WEXITSTATUS(state);
    worst = std::max(worst, status);
    running.erase(child);
    finished(++done);
  }
  sigprocmask(SIG_SETMASK, &signalsBefore, nullptr);
  munmap(memory, sizeof(Report) * count);
  if (CancelRequested)
  {
    throw Cancelled();
  }
  return worst;
}

}
