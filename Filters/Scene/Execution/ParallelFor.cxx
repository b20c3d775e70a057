// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ParallelFor.h"

#include "vtkSMPTools.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace penumbra
{

namespace
{

using Clock = std::chrono::steady_clock;

/// Minimum time between two progress reports.
constexpr std::chrono::milliseconds ReportInterval(50);

/// Minimum duration of a loop whose tasks count in ParallelLoopTotals.
constexpr std::chrono::milliseconds MinimumCountedDuration(10);

/// Whether this thread runs iterations of a loop.
thread_local bool isInLoop = false;

std::mutex totalsMutex;
ParallelLoopTotals totals;

void AddToTotals(std::int64_t tasks, Clock::duration duration)
{
  const std::lock_guard<std::mutex> lock(totalsMutex);
  totals.Seconds += std::chrono::duration<double>(duration).count();
  if (duration >= MinimumCountedDuration)
  {
    totals.FewestTasks = totals.FewestTasks < 0 ? tasks : std::min(totals.FewestTasks, tasks);
  }
}

/// The iterations of a loop, which several threads take.
class Loop
{
public:
  using Range = std::function<void(std::int64_t, std::int64_t)>;
  using StopRequest = std::function<bool(std::int64_t)>;

  Loop(std::int64_t count, std::int64_t grain, const Range& range, const StopRequest& isStopped)
    : Count(count),
      Grain(grain),
      RunRange(range),
      IsStopRequested(isStopped)
  {
  }

  /// Takes and runs iterations until none are left. The calling thread of the loop reports progress.
  void Run(bool isCaller)
  {
    isInLoop = true;
    try
    {
      Clock::time_point reported = Clock::now();
      while (!this->Stop)
      {
        const std::int64_t first = this->Next.fetch_add(this->Grain);
        if (first >= this->Count)
        {
          break;
        }
        const std::int64_t last = std::min(first + this->Grain, this->Count);
        this->RunRange(first, last);
        this->Done += last - first;
        if (isCaller && this->IsStopRequested && Clock::now() - reported > ReportInterval)
        {
          this->ReportProgress();
          reported = Clock::now();
        }
      }
    }
    catch (...)
    {
      const std::lock_guard<std::mutex> lock(this->ExceptionMutex);
      this->Thrown = std::current_exception();
      this->Stop = true;
    }
    isInLoop = false;
  }

  /// Rethrows an exception of an iteration. Returns false if the loop was stopped.
  bool Finish() const
  {
    if (this->Thrown)
    {
      std::rethrow_exception(this->Thrown);
    }
    return !this->Stop;
  }

private:
  void ReportProgress()
  {
    if (this->IsStopRequested(this->Done))
    {
      this->Stop = true;
    }
  }

  const std::int64_t Count;
  const std::int64_t Grain;
  const Range& RunRange;
  const StopRequest& IsStopRequested;
  std::atomic<std::int64_t> Next{ 0 };
  std::atomic<std::int64_t> Done{ 0 };
  std::atomic<bool> Stop{ false };
  std::mutex ExceptionMutex;
  std::exception_ptr Thrown;
};

}

bool RunParallel(std::int64_t count, std::int64_t grain,
  const std::function<void(std::int64_t, std::int64_t)>& range,
  const std::function<bool(std::int64_t)>& isStopped)
{
  if (count <= 0)
  {
    return true;
  }
  const std::int64_t tasks = (count + grain - 1) / grain;
  // vtkSMPTools::IsParallelScope() is not asked: it starts the threads of VTK's pool, and VTK can wait
  // for them forever at exit if they have just started (a wake-up is lost, 1 of 900 short processes).
  const bool isNested = isInLoop;
  const std::int64_t threads =
    isNested ? 1 : std::min<std::int64_t>(vtkSMPTools::GetEstimatedNumberOfThreads(), tasks);
  if (threads == 1 && !isStopped && (isNested || tasks == 1))
  {
    range(0, count);
    return true;
  }
  const Clock::time_point start = Clock::now();
  Loop loop(count, grain, range, isStopped);
  std::vector<std::thread> others;
  others.reserve(static_cast<std::size_t>(threads - 1));
  try
  {
    while (static_cast<std::int64_t>(others.size()) + 1 < threads)
    {
      others.emplace_back([&loop]() { loop.Run(false); });
    }
  }
  catch (const std::exception&)
  {
    // The system has no more threads or memory: the threads that there are do all the work.
  }
  const bool wasInLoop = isInLoop;
  loop.Run(true);
  isInLoop = wasInLoop;
  for (std::thread& other : others)
  {
    other.join();
  }
  if (!isNested && tasks > 1)
  {
    AddToTotals(tasks, Clock::now() - start);
  }
  return loop.Finish();
}

ParallelLoopTotals TakeParallelLoopTotals()
{
  const std::lock_guard<std::mutex> lock(totalsMutex);
  return std::exchange(totals, ParallelLoopTotals());
}

}
