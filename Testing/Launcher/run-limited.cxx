// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// run-limited --limit SECONDS PROGRAM [ARGUMENT...]
//
// Runs a program so that nothing remains of it:
// - after SECONDS, or $PENUMBRA_TEST_SECONDS if set, prints the stacks of its processes and ends
//   them (exit status 124);
// - a process that the program leaves behind is named and ended (exit status 125);
// - if run-limited is interrupted or its own caller ends, the program and its processes end, too.
// Otherwise the exit status, or the signal, is that of the program.
// Appends a line to the file $PENUMBRA_TEST_TIMES, if set: seconds of processor time, seconds, and the command.
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{

constexpr int LimitExceeded = 124;
constexpr int LeftProcesses = 125;
constexpr int CannotRun = 127;

double Now()
{
  timespec time = {};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// The parent of a process; 0 if the process has ended.
pid_t ParentOf(pid_t process)
{
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(file, text);
  const std::size_t name = text.rfind(')'); // The name may contain spaces and parentheses.
  char state = 'Z';
  int parent = 0;
  if (name == std::string::npos ||
    std::sscanf(text.c_str() + name + 1, " %c %d", &state, &parent) != 2 || state == 'Z')
  {
    return 0;
  }
  return parent;
}

// All running processes below this one. Those whose parents have ended are children of this process, because it
// is a subreaper.
std::vector<pid_t> Descendants()
{
  std::multimap<pid_t, pid_t> children;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", error))
  {
    const pid_t process = std::atoi(entry.path().filename().c_str());
    if (process > 0)
    {
      children.emplace(ParentOf(process), process);
    }
  }
  std::vector<pid_t> found = { getpid() };
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    const auto range = children.equal_range(found[i]);
    for (auto child = range.first; child != range.second; ++child)
    {
      found.push_back(child->second);
    }
  }
  found.erase(found.begin());
  return found;
}

std::string CommandOf(pid_t process)
{
  std::ifstream file("/proc/" + std::to_string(process) + "/cmdline", std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(file), {});
  for (char& character : text)
  {
    character = character == '\0' ? ' ' : character;
  }
  return std::to_string(process) + " " + text.substr(0, 200);
}

// Waits for a signal up to a time of the clock; returns 0 if none came.
int WaitForSignal(const sigset_t& signals, double until)
{
  const double seconds = std::max(0.0, until - Now());
  timespec duration = {};
  duration.tv_sec = static_cast<time_t>(seconds);
  duration.tv_nsec = static_cast<long>(1e9 * (seconds - static_cast<double>(duration.tv_sec)));
  const int signal = sigtimedwait(&signals, nullptr, &duration);
  return signal > 0 ? signal : 0;
}

// Takes the status of all children that have ended. Returns whether children remain.
bool Reap(pid_t program, int& status, bool& ended)
{
  for (;;)
  {
    int childStatus = 0;
    const pid_t child = waitpid(-1, &childStatus, WNOHANG);
    if (child <= 0)
    {
      return child == 0;
    }
    if (child == program)
    {
      status = childStatus;
      ended = true;
    }
  }
}

// Ends all processes below this one: some seconds after SIGTERM, by SIGKILL.
void EndAll(const sigset_t& signals, double grace)
{
  int status = 0;
  bool ended = false;
  const double start = Now();
  for (int signal = grace > 0.0 ? SIGTERM : SIGKILL;; signal = SIGKILL)
  {
    for (const pid_t process : Descendants())
    {
      kill(process, signal);
    }
    const double until = signal == SIGTERM ? start + grace : Now() + 0.1;
    bool remain = Reap(0, status, ended);
    while (remain && Now() < until)
    {
      WaitForSignal(signals, std::min(until, Now() + 0.1));
      remain = Reap(0, status, ended);
    }
    if (!remain || Now() > start + grace + 10.0)
    {
      return;
    }
  }
}

void PrintStacks()
{
  for (const pid_t process : Descendants())
  {
    std::fprintf(stderr, "run-limited: stack of %s\n", CommandOf(process).c_str());
    const pid_t printer = fork();
    if (printer == 0)
    {
      sigset_t none;
      sigemptyset(&none);
      sigprocmask(SIG_SETMASK, &none, nullptr);
      alarm(30);
      dup2(STDERR_FILENO, STDOUT_FILENO);
      execlp("eu-stack", "eu-stack", "-p", std::to_string(process).c_str(), nullptr);
      std::fprintf(stderr, "run-limited: eu-stack is not installed (Debian package elfutils)\n");
      _exit(CannotRun);
    }
    waitpid(printer, nullptr, 0);
  }
}

[[noreturn]] void Execute(char** command)
{
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  prctl(PR_SET_PTRACER, PR_SET_PTRACER_ANY); // Lets eu-stack attach where only parents may.
  execvp(command[0], command);
  std::fprintf(stderr, "run-limited: %s: %s\n", command[0], std::strerror(errno));
  _exit(CannotRun);
}

// Ends by a signal, without a core file.
int EndBy(int signal)
{
  const rlimit none = {};
  setrlimit(RLIMIT_CORE, &none);
  std::signal(signal, SIG_DFL);
  sigset_t all;
  sigfillset(&all);
  sigprocmask(SIG_UNBLOCK, &all, nullptr);
  std::raise(signal);
  return 128 + signal;
}

// Appends the times of the program, which has ended, to $PENUMBRA_TEST_TIMES.
void RecordTimes(double seconds, char** command)
{
  const char* path = std::getenv("PENUMBRA_TEST_TIMES");
  if (!path)
  {
    return;
  }
  rusage used = {};
  getrusage(RUSAGE_CHILDREN, &used);
  const auto secondsOf = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  char times[64];
  std::snprintf(times, sizeof(times), "%8.2f %8.2f",
    secondsOf(used.ru_utime) + secondsOf(used.ru_stime), seconds);
  std::string line = times;
  for (; *command; ++command)
  {
    line += std::string(" ") + *command;
  }
  if (const char* filter = std::getenv("GTEST_FILTER"))
  {
    line += std::string(" ") + filter;
  }
  std::ofstream(path, std::ios::app) << line + "\n" << std::flush;
}

// Ends as the program did.
int Repeat(int status)
{
  return WIFSIGNALED(status) ? EndBy(WTERMSIG(status)) : WEXITSTATUS(status);
}

}

int main(int argc, char** argv)
{
  const char* environment = std::getenv("PENUMBRA_TEST_SECONDS");
  const bool valid = argc > 3 && std::strcmp(argv[1], "--limit") == 0;
  const double limit = valid ? std::atof(environment ? environment : argv[2]) : 0.0;
  if (!(limit > 0.0))
  {
    std::fprintf(stderr, "usage: run-limited --limit SECONDS PROGRAM [ARGUMENT...]\n");
    return 2;
  }
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : { SIGCHLD, SIGINT, SIGTERM, SIGHUP })
  {
    sigaddset(&signals, signal);
  }
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGCHLD, SIG_DFL); // If ignored, waitpid() would not report statuses.
  const double begin = Now();
  const double end = begin + limit;
  const pid_t program = fork();
  if (program == 0)
  {
    Execute(argv + 3);
  }
  int status = 0;
  bool ended = program < 0;
  bool remain = true;
  while (!ended)
  {
    const int signal = WaitForSignal(signals, end);
    remain = Reap(program, status, ended);
    if (!ended && signal != 0 && signal != SIGCHLD)
    {
      EndAll(signals, 5.0);
      return EndBy(signal);
    }
    if (!ended && Now() >= end)
    {
      std::fprintf(stderr, "run-limited: %s exceeds %g s\n", argv[3], limit);
      PrintStacks();
      EndAll(signals, 0.0);
      return LimitExceeded;
    }
  }
  RecordTimes(Now() - begin, argv + 3);
  // Processes that are ending have two seconds.
  for (const double until = Now() + 2.0; remain && Now() < until;)
  {
    WaitForSignal(signals, std::min(until, Now() + 0.05));
    remain = Reap(program, status, ended);
  }
  if (remain)
  {
    for (const pid_t process : Descendants())
    {
      std::fprintf(
        stderr, "run-limited: %s leaves %s behind\n", argv[3], CommandOf(process).c_str());
    }
    EndAll(signals, 0.0);
    return status == 0 ? LeftProcesses : Repeat(status);
  }
  return Repeat(status);
}
