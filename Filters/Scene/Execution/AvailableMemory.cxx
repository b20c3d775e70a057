// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "AvailableMemory.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace penumbra
{
namespace
{

constexpr double Unlimited = std::numeric_limits<double>::infinity();
constexpr double MiB = 1024.0 * 1024.0;
/// Requests below this size are granted without reading the files of the system.
constexpr double SmallRequest = 64.0 * MiB;

/// Returns the first number in a file; `otherwise` if there is none, such as "max".
double ReadNumber(const std::string& path, double otherwise)
{
  std::ifstream file(path);
  double number = 0.0;
  return file >> number ? number : otherwise;
}

/// Returns the number that follows `key` in a file, 0 if there is none.
double ReadValue(const std::string& path, const std::string& key)
{
  std::ifstream file(path);
  std::string word;
  double number = 0.0;
  while (file >> word)
  {
    if (word == key && file >> number)
    {
      return number;
    }
  }
  return 0.0;
}

/// Returns what one control group grants: its limit less its use, of which cached files do not
/// count because the system drops them.
double FindGrant(const std::string& folder, const char* limitName, const char* usageName,
  const std::string& prefix)
{
  const double limit = ReadNumber(folder + "/" + limitName, Unlimited);
  const double used = ReadNumber(folder + "/" + usageName, 0.0);
  const double cached = ReadValue(folder + "/memory.stat", prefix + "active_file") +
    ReadValue(folder + "/memory.stat", prefix + "inactive_file");
  return limit - std::max(used - cached, 0.0);
}

/// Returns what the control groups of the process grant. A limit of a group holds for the groups in
/// it, and containers show their own group as the root.
double FindControlGroupGrant(const std::string& root)
{
  double grant = Unlimited;
  std::ifstream groups(root + "/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);)
  {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos)
    {
      continue;
    }
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool isUnified = controllers.empty();
    if (!isUnified && controllers != "memory")
    {
      continue;
    }
    const std::string base = root + (isUnified ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory");
    std::string path = line.substr(second + 1);
    while (true)
    {
      grant = std::min(grant,
        isUnified
          ? FindGrant(base + path, "memory.max", "memory.current", "")
          : FindGrant(base + path, "memory.limit_in_bytes", "memory.usage_in_bytes", "total_"));
      if (path.empty() || path == "/")
      {
        break;
      }
      path.erase(path.rfind('/'));
    }
  }
  return grant;
}

/// Returns what the resource limits of the process allow.
double FindResourceGrant()
{
  double grant = Unlimited;
#ifdef __linux__
  std::ifstream file("/proc/self/statm");
  double pages[6] = {}; // total, resident, shared, text, library, data
  for (double& number : pages)
  {
    file >> number;
  }
  const auto pageSize = static_cast<double>(sysconf(_SC_PAGESIZE));
  const auto apply = [&](int resource, double used) {
    rlimit limit = {};
    if (file && getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    {
      grant = std::min(grant, static_cast<double>(limit.rlim_cur) - pageSize * used);
    }
  };
  apply(RLIMIT_AS, pages[0]);
  apply(RLIMIT_DATA, pages[5]);
#endif
  return grant;
}

/// Returns a size with two significant digits or all digits before the point.
std::string ToText(double bytes)
{
  const bool isSmall = bytes < 1024.0 * MiB;
  const double size = bytes / (isSmall ? MiB : 1024.0 * MiB);
  std::ostringstream text;
  text << std::setprecision(size < 10.0 ? 2 : 6) << (size < 10.0 ? size : std::round(size))
       << (isSmall ? " MiB" : " GiB");
  return text.str();
}

}

double FindAvailableMemory(const std::string& root)
{
  if (const char* text = std::getenv("PENUMBRA_AVAILABLE_MEMORY"))
  {
    char* end = nullptr;
    const double number = std::strtod(text, &end);
    if (end == text || *end != '\0' || !(number > 0.0))
    {
      throw std::runtime_error("PENUMBRA_AVAILABLE_MEMORY must be a positive number of MiB.");
    }
    return number * MiB;
  }
  const double ofSystem = 1024.0 * ReadValue(root + "/proc/meminfo", "MemAvailable:");
  const double available = std::min({ ofSystem > 0.0 ? ofSystem : Unlimited,
    FindControlGroupGrant(root), root.empty() ? FindResourceGrant() : Unlimited });
  return std::max(available, 0.0);
}

void RequireMemory(double bytes, const std::string& what)
{
  const bool isLimited = std::getenv("PENUMBRA_AVAILABLE_MEMORY") != nullptr;
  if (bytes <= SmallRequest && !isLimited)
  {
    return;
  }
  const double available = FindAvailableMemory();
  if (bytes > available)
  {
    throw InsufficientMemory("Not enough memory: " + what + " need at least " + ToText(bytes) +
      ", and " + ToText(available) + " are available. Show less of the data, or free memory.");
  }
}

}
