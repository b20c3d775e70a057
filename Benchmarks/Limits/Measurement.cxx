// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Measurement.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <stdexcept>

namespace penumbra
{
namespace
{

/// Tasks that take less than this number of seconds are repeated.
constexpr double ShortTime = 0.5;

double CpuSeconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Runs in the child process: writes the time of the task to the pipe.
[[noreturn]] void RunChild(const TaskFactory& make, int limit, int pipe)
{
  const rlimit bound{ static_cast<rlim_t>(limit), static_cast<rlim_t>(limit) + 5 };
  setrlimit(RLIMIT_CPU, &bound);
  try
  {
    const std::function<void()> task = make();
    double best = limit;
    double sum = 0.0;
    for (int i = 0; i < 3 && (i == 0 || sum < ShortTime); ++i)
    {
      const double start = CpuSeconds();
      task();
      const double seconds = CpuSeconds() - start;
      best = std::min(best, seconds);
      sum += seconds;
    }
    _exit(write(pipe, &best, sizeof best) == static_cast<ssize_t>(sizeof best) ? 0 : 1);
  }
  catch (const std::exception& problem)
  {
    std::fprintf(stderr, "%s\n", problem.what());
  }
  _exit(1);
}

struct Child
{
  std::size_t Task;
  int Pipe;
};

std::pair<pid_t, Child> StartChild(const std::vector<NamedTask>& tasks, std::size_t i, int limit)
{
  int ends[2];
  if (pipe(ends) != 0)
  {
    throw std::runtime_error("cannot create a pipe");
  }
  std::fflush(stdout);
  const pid_t id = fork();
  if (id < 0)
  {
    throw std::runtime_error("cannot start a process");
  }
  if (id == 0)
  {
    close(ends[0]);
    RunChild(tasks[i].Make, limit, ends[1]);
  }
  close(ends[1]);
  return { id, { i, ends[0] } };
}

Cost ReadCost(const Child& child, int status, const rusage& usage, int limit)
{
  Cost cost;
  cost.Megabytes = static_cast<double>(usage.ru_maxrss) / 1024.0; // kilobytes on Linux
  const bool complete = read(child.Pipe, &cost.Seconds, sizeof cost.Seconds) ==
    static_cast<ssize_t>(sizeof cost.Seconds);
  close(child.Pipe);
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL))
  {
    cost.Seconds = limit;
    cost.IsBound = true;
  }
  else if (!complete || status != 0)
  {
    throw std::runtime_error("a measured task failed");
  }
  return cost;
}

}

std::vector<Cost> MeasureInProcesses(const std::vector<NamedTask>& tasks, int jobs, int limit)
{
  std::vector<Cost> costs(tasks.size());
  std::map<pid_t, Child> running;
  std::size_t next = 0;
  while (next < tasks.size() || !running.empty())
  {
    while (next < tasks.size() && static_cast<int>(running.size()) < std::max(jobs, 1))
    {
      running.insert(StartChild(tasks, next, limit));
      ++next;
    }
    int status = 0;
    rusage usage{};
    const pid_t id = wait4(-1, &status, 0, &usage);
    const auto child = running.find(id);
    if (child == running.end())
    {
      throw std::runtime_error("cannot wait for a process");
    }
    const std::size_t task = child->second.Task;
    costs[task] = ReadCost(child->second, status, usage, limit);
    running.erase(child);
    std::printf("%-52s %s %8.3f s %8.0f MB\n", tasks[task].Name.c_str(),
      costs[task].IsBound ? ">" : " ", costs[task].Seconds, costs[task].Megabytes);
    std::fflush(stdout);
  }
  return costs;
}

}
