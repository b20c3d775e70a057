// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TimeOptions.h"

#include "Processes/CommandError.h"

#include "vtkVersion.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace penumbra
{

namespace
{

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
constexpr const char* NoTimeSteps = " has no time steps";
#else
// Of VTK HDF files, this VTK reads the first step only.
constexpr const char* NoTimeSteps = " has no time steps that VTK " VTK_VERSION " reads";
#endif

// Splits "A:B[:S]"; A and B may be empty.
TimeRange ParseRange(const std::string& text)
{
  const std::size_t first = text.find(':');
  const std::size_t second = first == text.npos ? text.npos : text.find(':', first + 1);
  if (first == text.npos)
  {
    throw InvalidValue("--times", "'" + text + "' is not of the form A:B or A:B:S");
  }
  const auto parse = [](const std::string& number, double other, const Range& range) {
    return number.empty() ? other : ParseNumbers("--times", number, 1, 1, range)[0];
  };
  TimeRange range;
  range.First = parse(text.substr(0, first), range.First, {});
  range.Last = parse(text.substr(first + 1, second - first - 1), range.Last, {});
  if (second != text.npos)
  {
    range.Increment = parse(text.substr(second + 1), 0.0, { 0.0, Infinity, true });
  }
  if (range.First > range.Last)
  {
    throw InvalidValue("--times", "'" + text + "' begins after its end");
  }
  return range;
}

[[noreturn]] void FailOutside(
  const std::string& option, const std::vector<double>& times, const std::string& input)
{
  throw CommandError(BadInput,
    option + ": " + input + " has times from " + FormatTime(times.front()) + " to " +
      FormatTime(times.back()));
}

double SelectTime(const TimeOptions& options, const Timeline& timeline, const std::string& input)
{
  const std::vector<double>& times = timeline.Times;
  const int count = static_cast<int>(times.size());
  if (options.Step)
  {
    const int step = *options.Step < 0 ? count + *options.Step : *options.Step;
    if (step < 0 || step >= count)
    {
      throw CommandError(BadInput,
        "--time-step " + std::to_string(*options.Step) + ": " + input + " has the steps 0 to " +
          std::to_string(count - 1) + ", or -1 for the last");
    }
    return times[step];
  }
  const double tolerance = 1e-6 * std::max(std::abs(times.front()), std::abs(times.back()));
  if (*options.Time < times.front() - tolerance || *options.Time > times.back() + tolerance)
  {
    FailOutside("--time " + FormatTime(*options.Time), times, input);
  }
  return timeline.IsContinuous ? *options.Time : times[FindStep(times, *options.Time)];
}

}

void DeclareTimeOptions(const CommandLine& app, TimeOptions& time)
{
  app.SetGroup("Time");
  app
    .AddParsed(
      "--time,--animation-time",
      [&time](const std::string& text) { time.Time = ParseNumbers("--time", text, 1, 1, {})[0]; },
      "Show the time step at this time, or the last one before it; default: the first step")
    .TypeName("T");
  app
    .AddParsed(
      "--time-step",
      [&time](const std::string& text) {
        time.Step = ParseInteger("--time-step", text, -1000000000, 1000000000);
      },
      "Show this time step, 0: the first, -1: the last")
    .TypeName("N");
  app
    .AddParsed(
      "--times", [&time](const std::string& text) { time.Range = ParseRange(text); },
      "One image per time step from A to B, or at A, A + S, A + 2 S, ...; {time} in --output")
    .TypeName("A:B[:S]");
}

void CheckTimeOptions(const CommandLine& app)
{
  const std::string names[] = { "--time", "--time-step", "--times" };
  std::string given;
  for (const std::string& name : names)
  {
    if (app.Count(name) > 0)
    {
      if (!given.empty())
      {
        throw CommandError(BadInput, name + " cannot be combined with " + given + "; give one");
      }
      given = name;
    }
  }
}

std::vector<double> SelectTimes(
  const TimeOptions& options, const Timeline& timeline, const std::string& input)
{
  const std::vector<double>& times = timeline.Times;
  if (times.empty() && options.IsSet())
  {
    throw CommandError(BadInput,
      std::string(options.Time ? "--time"
          : options.Step       ? "--time-step"
                               : "--times") +
        ": " + input + NoTimeSteps);
  }
  if (options.Time || options.Step)
  {
    return { SelectTime(options, timeline, input) };
  }
  if (!options.Range)
  {
    return times;
  }
  std::vector<double> selected;
  const double first = std::max(options.Range->First, times.front());
  const double last = std::min(options.Range->Last, times.back());
  const double step = options.Range->Increment;
  const double rounding = 1e-9 * std::max(std::abs(first), std::abs(last));
  if (step > 0.0 && first <= last + rounding)
  {
    const double count = std::floor((last + rounding - first) / step) + 1.0;
    if (count > MaximumFrames)
    {
      throw CommandError(BadInput, "--times: more than a million images; choose a larger step");
    }
    for (int i = 0; i < static_cast<int>(count); ++i)
    {
      selected.push_back(first + i * step);
    }
  }
  else
  {
    std::copy_if(times.begin(), times.end(), std::back_inserter(selected),
      [&](double time) { return time >= first - rounding && time <= last + rounding; });
  }
  if (selected.empty())
  {
    FailOutside("--times selects no time step", times, input);
  }
  return selected;
}

std::string FormatTime(double time, int digits)
{
  std::ostringstream text;
  text.precision(digits);
  text << time;
  return text.str();
}

std::vector<std::string> FormatTimes(const std::vector<double>& times)
{
  std::vector<std::string> texts;
  for (int digits = TimeDigits; digits <= std::numeric_limits<double>::max_digits10; ++digits)
  {
    texts.clear();
    for (const double time : times)
    {
      texts.push_back(FormatTime(time, digits));
    }
    if (std::adjacent_find(texts.begin(), texts.end()) == texts.end())
    {
      break;
    }
  }
  return texts;
}

}
