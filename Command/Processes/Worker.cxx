// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Worker.h"

#include "CommandError.h"
#include "EndProcess.h"
#include "MessageLog.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <new>
#include <system_error>
#include <vector>

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{

// State of a worker in memory shared with its supervisor.
struct WorkerStatus
{
  char Phase[1024];
  char Temporary[2][4096];
  int Blame;
};

/// Errors of the workers of a pool, in shared memory.
struct SharedErrors
{
  std::atomic<std::uint64_t> Keys[64]; ///< hashes of those that were printed; 0: none
  std::atomic<int> Repeated;
};

WorkerStatus* CurrentStatus = nullptr;
SharedErrors* CurrentErrors = nullptr;
std::atomic<int> CancelSignal{ 0 };

void RequestCancel(int number)
{
  CancelSignal = number;
}

void CopyText(char* target, std::size_t size, const std::string& text)
{
  std::snprintf(target, size, "%s", text.c_str());
}

void RemoveTemporaries(const WorkerStatus& report)
{
  for (const char* path : report.Temporary)
  {
    if (*path)
    {
      unlink(path);
    }
  }
}

// Signal handler of a worker whose supervisor has ended.
void RemoveAndExit(int)
{
  RemoveTemporaries(*CurrentStatus);
  _exit(penumbra::Unavailable);
}

// Delivers the cancelling signals and SIGCHLD only within Wait(), during the lifetime of the object.
// Signals that were ignored on entry, for example by nohup, stay ignored.
class SignalGuard
{
public:
  SignalGuard()
  {
    struct sigaction action = {};
    action.sa_handler = RequestCancel;
    sigset_t blocked;
    sigemptyset(&blocked);
    for (std::size_t i = 0; i < std::size(Cancelling); ++i)
    {
      sigaction(Cancelling[i], nullptr, &this->Actions[i]);
      if (this->Actions[i].sa_handler != SIG_IGN)
      {
        sigaction(Cancelling[i], &action, nullptr);
        sigaddset(&blocked, Cancelling[i]);
      }
    }
    action.sa_handler = [](int) {};
    sigaction(SIGCHLD, &action, &this->ChildAction);
    sigaddset(&blocked, SIGCHLD);
    sigprocmask(SIG_BLOCK, &blocked, &this->Mask);
    this->WaitMask = this->Mask;
    sigdelset(&this->WaitMask,
      SIGCHLD); // The parent process may have blocked SIGCHLD, which Wait() depends on.
  }
  ~SignalGuard()
  {
    this->RestoreActions();
    sigaction(SIGCHLD, &this->ChildAction, nullptr);
    sigprocmask(SIG_SETMASK, &this->Mask, nullptr);
  }
  SignalGuard(const SignalGuard&) = delete;
  void operator=(const SignalGuard&) = delete;

  void Wait() const { sigsuspend(&this->WaitMask); }

  // Sets up the signals of a worker: it ends when the user cancels and when its supervisor ends.
  void EnterWorker() const
  {
    this->RestoreActions();
    signal(SIGCHLD, SIG_DFL);
    signal(SIGUSR1, RemoveAndExit);
    sigset_t mask = this->WaitMask;
    sigdelset(&mask, SIGUSR1);
    sigdelset(&mask, SIGALRM); // ReadLimit uses it.
    sigprocmask(SIG_SETMASK, &mask, nullptr);
    prctl(PR_SET_PDEATHSIG, SIGUSR1);
  }

private:
  static constexpr int Cancelling[] = { SIGINT, SIGTERM, SIGHUP };

  void RestoreActions() const
  {
    for (std::size_t i = 0; i < std::size(Cancelling); ++i)
    {
      sigaction(Cancelling[i], &this->Actions[i], nullptr);
    }
  }

  struct sigaction Actions[std::size(Cancelling)];
  struct sigaction ChildAction;
  sigset_t Mask;
  sigset_t WaitMask;
};

void LimitMemory()
{
#if !defined(__SANITIZE_ADDRESS__)
  // Allocations beyond the memory of the machine then fail with a message instead of a kill.
  rlimit limit = {};
  getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = std::min<rlim_t>(penumbra::MachineMemory(), limit.rlim_cur);
  setrlimit(RLIMIT_DATA, &limit);
#endif
}

// Prints a line about a worker that a signal ended, and returns its exit status.
int DescribeExit(const WorkerStatus& report, int signalNumber)
{
  RemoveTemporaries(report);
  if (CancelSignal)
  {
    return penumbra::Done;
  }
  if (signalNumber == SIGKILL)
  {
    penumbra::PrintMessage(std::string(report.Phase) +
      ": killed by the system, most likely out of memory; use a smaller --resolution or mesh");
    return penumbra::Unavailable;
  }
  if (report.Blame == penumbra::BadInput)
  {
    penumbra::PrintMessage(std::string(report.Phase) + ": the file is damaged: its reader crashed");
    return penumbra::BadInput;
  }
  penumbra::PrintMessage(std::string(report.Phase) + ": crashed (" + strsignal(signalNumber) +
    "); please report the crash with the command and " +
    (penumbra::LogPath().empty() ? "the file" : penumbra::LogPath()));
  return penumbra::Unavailable;
}

// The running workers. The destructor kills them.
class WorkerPool
{
public:
  explicit WorkerPool(int count)
    : Bytes(sizeof(SharedErrors) + sizeof(WorkerStatus) * count)
  {
    void* memory =
      mmap(nullptr, this->Bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED)
    {
      throw std::bad_alloc();
    }
    this->Errors = static_cast<SharedErrors*>(memory);
    this->Reports = reinterpret_cast<WorkerStatus*>(this->Errors + 1);
  }
  ~WorkerPool()
  {
    this->Kill();
    for (const auto& worker : this->Running)
    {
      waitpid(worker.first, nullptr, 0);
      RemoveTemporaries(this->Reports[worker.second]);
    }
    munmap(this->Errors, this->Bytes);
  }
  WorkerPool(const WorkerPool&) = delete;
  void operator=(const WorkerPool&) = delete;

  bool HasWorkers() const { return !this->Running.empty(); }
  int Size() const { return static_cast<int>(this->Running.size()); }
  void Wait() const { this->Signals.Wait(); }
  int CountRepeatedErrors() const { return this->Errors->Repeated; }

  // Returns false if the process limit is reached; throws CommandError if not even one process can start.
  bool Start(int number, const std::function<int(int)>& task)
  {
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child < 0 && !this->HasWorkers())
    {
      throw penumbra::CommandError(
        penumbra::Unavailable, std::string("cannot start a process: ") + strerror(errno));
    }
    if (child == 0)
    {
      CurrentStatus = &this->Reports[number];
      CurrentErrors = this->Errors;
      this->Signals.EnterWorker();
      LimitMemory();
      penumbra::EndProcess(penumbra::RunGuarded([&]() { return task(number); }));
    }
    if (child > 0)
    {
      this->Running[child] = number;
    }
    return child > 0;
  }

  // Gets the exit status of a worker that has ended; returns false if none has.
  bool Collect(int& status)
  {
    int state = 0;
    const pid_t child = waitpid(-1, &state, WNOHANG);
    const auto worker = this->Running.find(child);
    if (worker == this->Running.end())
    {
      return false;
    }
    status = WIFSIGNALED(state) ? DescribeExit(this->Reports[worker->second], WTERMSIG(state))
                                : WEXITSTATUS(state);
    this->Running.erase(worker);
    return true;
  }

  void Kill() const
  {
    for (const auto& worker : this->Running)
    {
      kill(worker.first, SIGKILL);
    }
  }

private:
  SignalGuard Signals;
  std::map<pid_t, int> Running;
  SharedErrors* Errors = nullptr;
  WorkerStatus* Reports = nullptr;
  std::size_t Bytes;
};

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
  if (CurrentStatus)
  {
    CopyText(CurrentStatus->Phase, sizeof(CurrentStatus->Phase), what);
    CurrentStatus->Blame = blame;
  }
}

void RemoveOnCrash(const std::string& path)
{
  if (CurrentStatus)
  {
    char* slot = CurrentStatus->Temporary[*CurrentStatus->Temporary[0] ? 1 : 0];
    CopyText(slot, sizeof(CurrentStatus->Temporary[0]), path);
  }
}

void KeepOnCrash(const std::string& path)
{
  for (int i = 0; CurrentStatus && i < 2; ++i)
  {
    if (path == CurrentStatus->Temporary[i])
    {
      *CurrentStatus->Temporary[i] = '\0';
    }
  }
}

void RemoveTemporaries()
{
  if (CurrentStatus)
  {
    ::RemoveTemporaries(*CurrentStatus);
  }
}

void PrintError(const std::string& error, const std::string& cause)
{
  const std::uint64_t key = std::hash<std::string>()(cause) | 1; // never 0
  for (std::size_t i = 0; CurrentErrors && i < std::size(CurrentErrors->Keys); ++i)
  {
    std::uint64_t found = 0;
    if (!CurrentErrors->Keys[i].compare_exchange_strong(found, key) && found == key)
    {
      ++CurrentErrors->Repeated;
      return;
    }
    if (found == 0)
    {
      break;
    }
  }
  PrintMessage(error);
}

int RunGuarded(const std::function<int()>& body)
{
  try
  {
    const int status = body();
    errno = 0;
    if (!std::cout.flush())
    {
      throw CommandError(Unavailable,
        std::string("standard output cannot be written: ") +
          (errno != 0 ? strerror(errno) : "an earlier write failed"));
    }
    return status;
  }
  catch (const CommandError& failure)
  {
    PrintError(failure.what(), failure.what());
    return failure.ExitStatus;
  }
  catch (const Cancelled&)
  {
    throw;
  }
  catch (const std::bad_alloc&)
  {
    PrintMessage((CurrentStatus ? CurrentStatus->Phase + std::string(": ") : std::string()) +
      "out of memory; use a smaller --resolution or a smaller mesh");
    return Unavailable;
  }
  catch (const std::system_error& error)
  {
    PrintMessage((CurrentStatus ? CurrentStatus->Phase + std::string(": ") : std::string()) +
      "the system reported an error: " + error.what());
    return Unavailable;
  }
  catch (const std::exception& error)
  {
    PrintMessage(
      (CurrentStatus ? CurrentStatus->Phase + std::string(": ") : std::string()) + error.what());
    return CurrentStatus && CurrentStatus->Blame == BadInput ? BadInput : Unavailable;
  }
}

int RunWorkers(int count, int jobs, const std::function<int(int)>& task,
  const std::function<void(int finishedTasks)>& finished)
{
  if (count == 0)
  {
    return Done; // An empty pool has no memory to map.
  }
  WorkerPool pool(count);
  int started = 0;
  int done = 0;
  int worst = Done;
  while (pool.HasWorkers() || (started < count && !CancelSignal))
  {
    while (started < count && pool.Size() < jobs && !CancelSignal && pool.Start(started, task))
    {
      ++started;
    }
    int status = Done;
    if (!pool.Collect(status))
    {
      pool.Wait();
      if (CancelSignal)
      {
        pool.Kill();
      }
      continue;
    }
    worst = std::max(worst, status);
    finished(++done);
  }
  if (CancelSignal)
  {
    throw Cancelled(CancelSignal);
  }
  if (const int repeated = pool.CountRepeatedErrors())
  {
    PrintMessage("the same error occurred " + std::to_string(repeated) +
      (repeated == 1 ? " more time" : " more times"));
  }
  return worst;
}

}
