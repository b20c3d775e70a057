// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ReadLimit.h"

#include "Files/InputFiles.h"
#include "Parsing/Arguments.h"
#include "Processes/CommandConstants.h"
#include "Processes/CommandError.h"
#include "Processes/MessageLog.h"
#include "Processes/Worker.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <sstream>

#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

namespace penumbra
{

namespace
{

// AddressSanitizer reserves more address space than any limit allows.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool LimitsMemory = false;
#else
constexpr bool LimitsMemory = true;
#endif

double RequestedSeconds = 0.0; ///< 0: computed from the file size
std::string TimeoutMessage;

void EndReading(int)
{
  [[maybe_unused]] const auto written =
    write(TerminalDescriptor(), TimeoutMessage.data(), TimeoutMessage.size());
  RemoveTemporaries();
  _exit(BadInput);
}

void SetTimer(double seconds)
{
  itimerval timer = {};
  timer.it_value.tv_sec = static_cast<time_t>(seconds);
  timer.it_value.tv_usec = static_cast<suseconds_t>(1e6 * (seconds - std::floor(seconds)));
  setitimer(ITIMER_REAL, &timer, nullptr);
}

// Returns whether the file, or a file that it refers to, may be compressed.
bool MayBeCompressed(const std::string& path, unsigned long long bytes)
{
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const bool refersToOthers = static_cast<unsigned long long>(file.tellg()) < bytes;
  file.seekg(0);
  std::string head(4096, '\0');
  file.read(&head[0], static_cast<std::streamsize>(head.size()));
  for (const char* signature : { "compressor", "CompressedData", "gz", "\x89HDF", "bz" })
  {
    if (head.find(signature) != std::string::npos)
    {
      return true;
    }
  }
  return refersToOthers;
}

// Returns the memory in use, in bytes, as RLIMIT_DATA counts it.
unsigned long long MemoryInUse()
{
  std::ifstream file("/proc/self/statm");
  unsigned long long pages = 0;
  for (int field = 0; field < 6; ++field)
  {
    file >> pages;
  }
  return file ? pages * static_cast<unsigned long long>(sysconf(_SC_PAGESIZE)) : 0;
}

}

Option AddReadLimitOption(const CommandLine& app)
{
  return AddNumber(app, "--read-limit", RequestedSeconds, "SECONDS",
    "Longest time for reading a file, inf: no limit on time and memory; default: 60 plus 1 per MiB",
    { 0.0, Infinity, true, true })
    .Default("");
}

ReadLimit::ReadLimit(const std::string& path)
{
  rlimit limit = {};
  getrlimit(RLIMIT_DATA, &limit);
  this->Memory = limit.rlim_cur;
  if (std::isinf(RequestedSeconds))
  {
    return;
  }
  const unsigned long long bytes = InputBytes(path);
  if (LimitsMemory)
  {
    const unsigned long long memory = MemoryInUse() + BaseMemory +
      bytes * (MayBeCompressed(path, bytes) ? MemoryPerCompressedFileByte : MemoryPerFileByte);
    this->ByFile = memory < this->Memory;
    limit.rlim_cur = std::min<unsigned long long>(memory, this->Memory);
    setrlimit(RLIMIT_DATA, &limit);
  }
  const double seconds =
    RequestedSeconds > 0.0 ? RequestedSeconds : std::ceil(BaseSeconds + bytes / 1048576.0);
  std::ostringstream text;
  text << path << ": reading takes more than " << seconds
       << " s; the file is damaged or needs a longer --read-limit";
  TimeoutMessage = LineOf(text.str());
  std::signal(SIGALRM, EndReading);
  SetTimer(std::min(std::max(seconds, 1e-6), 1e8));
}

ReadLimit::~ReadLimit()
{
  SetTimer(0.0);
  rlimit limit = {};
  getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = this->Memory;
  setrlimit(RLIMIT_DATA, &limit);
}

}
