// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Film.h"

#include "Files/ImageFiles.h"
#include "Files/InputFiles.h"
#include "Files/Placeholders.h"
#include "Options/FrozenOptions.h"
#include "Processes/CommandConstants.h"
#include "Processes/CommandError.h"

#include "vtkVersion.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace penumbra
{

namespace
{

bool IsDigit(char character)
{
  return std::isdigit(static_cast<unsigned char>(character)) != 0;
}

// Returns the digits at `at` without leading zeros, and moves `at` behind them.
std::string TakeNumber(const std::string& text, std::size_t& at)
{
  const std::size_t begin = at;
  while (at < text.size() && IsDigit(text[at]))
  {
    ++at;
  }
  const std::size_t first = std::min(text.find_first_not_of('0', begin), at);
  return text.substr(first, at - first);
}

/// Returns whether `a` precedes `b` if numbers in them are compared by value.
bool PrecedesNaturally(const std::string& a, const std::string& b)
{
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size())
  {
    if (IsDigit(a[i]) && IsDigit(b[j]))
    {
      const std::string first = TakeNumber(a, i);
      const std::string second = TakeNumber(b, j);
      if (first != second)
      {
        return first.size() != second.size() ? first.size() < second.size() : first < second;
      }
    }
    else if (a[i] != b[j])
    {
      return a[i] < b[j];
    }
    else
    {
      ++i;
      ++j;
    }
  }
  return a.size() - i != b.size() - j ? a.size() - i < b.size() - j : a < b;
}

/// Sorts files by the numbers in their names if they are in the order of characters, in which a
/// shell lists them. Any other order is deliberate and kept.
void SortNaturally(std::vector<std::string>& files)
{
  // Shells sort by the rules of the language, which this program does not load, or by bytes.
  const auto ignoresCase = [](const std::string& a, const std::string& b) {
    return strcasecmp(a.c_str(), b.c_str()) < 0;
  };
  if (std::is_sorted(files.begin(), files.end()) ||
    std::is_sorted(files.begin(), files.end(), ignoresCase))
  {
    std::stable_sort(files.begin(), files.end(), PrecedesNaturally);
  }
}

// Computes the 64-bit Fowler-Noll-Vo hash (FNV-1a).
std::string Hash(const std::string& text)
{
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char byte : text)
  {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  }
  std::ostringstream digits;
  digits << std::hex << hash;
  return digits.str();
}

std::string FormatFrame(int frame)
{
  const std::string number = std::to_string(frame);
  return std::string(number.size() < 4 ? 4 - number.size() : 0, '0') + number;
}

// Returns the name of the input in messages.
std::string Name(const std::vector<std::string>& files)
{
  return files.size() == 1 ? files.front() : "the set of files";
}

// Returns `count` times at equal distances.
std::vector<double> Divide(double first, double last, int count)
{
  std::vector<double> times(count, first);
  for (int i = 1; i < count; ++i)
  {
    times[i] = first + (last - first) * i / (count - 1);
  }
  return times;
}

}

Film::Film(const FilmOptions& options)
  : Options(options)
{
  RenderOptions& render = this->Options.Render;
  if (this->Options.TimeSeries)
  {
    SortNaturally(render.Files);
    this->Options.Frames = static_cast<int>(render.Files.size());
    this->Times = Divide(0.0, this->Options.Frames - 1.0, this->Options.Frames);
  }
  if (!options.Defaults.empty())
  {
    this->ReadDefaults();
  }
  else if (!this->Options.TimeSeries)
  {
    this->PlanSteps();
  }
  if (this->Status != Done)
  {
    return;
  }
  if (this->Options.Frames == 0)
  {
    this->Options.Frames = DefaultFrames;
  }
  if (std::isnan(this->Options.Orbit))
  {
    this->Options.Orbit = this->IsSeries() || !options.Movements.empty() ? 0.0 : 360.0;
  }
  this->TimeTexts = FormatTimes(this->Times);
  this->Identity = std::string(PENUMBRA_VERSION) + ' ' + vtkVersion::GetVTKVersion() + '\n' +
    options.Description + "images=" + std::to_string(this->Options.Frames) + '\n';
  for (const std::string& file : render.Files)
  {
    this->Identity += DescribeInput(file) + '\n';
  }
  this->CheckPart();
  this->CheckOutputs();
}

void Film::PlanSteps()
{
  const RenderOptions& render = this->Options.Render;
  Timeline timeline;
  if (std::any_of(render.Files.begin(), render.Files.end(), MayHaveTimeSteps))
  {
    std::vector<Timeline> timelines;
    this->Status = ReadTimelines({ render.Files }, 1, timelines);
    timeline = timelines.front();
    this->AllTimes = timeline.Times;
  }
  if (this->Status != Done)
  {
    return;
  }
  std::vector<double> times = SelectTimes(render.Time, timeline, Name(render.Files));
  if (render.Time.Time || render.Time.Step || (times.size() < 2 && !render.Time.Range))
  {
    this->FixedTime = times.empty() ? this->FixedTime : times.front();
    return;
  }
  if (this->Options.Frames > 0)
  {
    times = Divide(times.front(), times.back(), this->Options.Frames);
  }
  this->Options.Frames = static_cast<int>(times.size());
  this->Times = std::move(times);
}

void Film::CheckPart() const
{
  const int last = this->Options.Frames - 1;
  for (const FrameRange& range : this->Options.Part)
  {
    if (range.second > last)
    {
      throw CommandError(BadInput,
        "--frames or --frame-list: the film has the images 0 to " + std::to_string(last) +
          ", but " + std::to_string(range.second) + " is requested");
    }
  }
}

void Film::CheckOutputs() const
{
  const RenderOptions& render = this->Options.Render;
  if (!Contains(render.Output, FramePlaceholder) && !this->IsSeries())
  {
    throw CommandError(
      BadInput, "--output " + render.Output + ": the path of numbered images must contain {frame}");
  }
  const bool usesTime = render.TimeLabel || Contains(render.Text, TimePlaceholder) ||
    Contains(render.Output, TimePlaceholder) || Contains(render.Statistics, TimePlaceholder);
  if (usesTime && !this->IsSeries() && !this->FixedTime)
  {
    throw CommandError(
      BadInput, "--time-label or {time}: " + Name(render.Files) + " has no time steps");
  }
}

bool Film::IsWanted(int frame) const
{
  const std::vector<FrameRange>& part = this->Options.Part;
  return part.empty() || std::any_of(part.begin(), part.end(), [frame](const FrameRange& range) {
    return frame >= range.first && frame <= range.second;
  });
}

bool Film::IsUpToDate(int frame) const
{
  const RenderOptions one = this->GetFrameOptions(frame);
  return this->Options.Resume && ReadNote(one.Output) == this->GetFingerprint(frame) &&
    (one.Statistics.empty() || std::filesystem::exists(one.Statistics));
}

std::string Film::GetFingerprint(int frame) const
{
  return "animate " + Hash(this->Identity + std::to_string(frame));
}

StepInput Film::GetInput(int frame) const
{
  const std::vector<std::string>& files = this->Options.Render.Files;
  if (this->Options.TimeSeries)
  {
    return { { files[frame] }, std::nullopt };
  }
  return { files, this->IsSeries() ? this->Times[frame] : this->FixedTime };
}

RenderOptions Film::GetFrameOptions(int frame) const
{
  RenderOptions one = this->Options.Render;
  one.ShownTime = this->IsSeries() ? this->Times[frame] : this->FixedTime;
  if (one.ShownTime)
  {
    one.TimeText = this->IsSeries() ? this->TimeTexts[frame] : FormatTime(*one.ShownTime);
  }
  for (std::string* path : { &one.Output, &one.Statistics })
  {
    *path = ReplaceAll(
      ReplaceAll(*path, FramePlaceholder, FormatFrame(frame)), TimePlaceholder, one.TimeText);
  }
  if (this->HasDefaults())
  {
    ApplyFrozen(this->Defaults, one);
  }
  return one;
}

double Film::ComputeFraction(int frame) const
{
  const bool turns =
    this->Options.Movements.empty() && std::fmod(this->Options.Orbit, 360.0) == 0.0;
  const int frames = this->Options.Frames;
  return frame / static_cast<double>(std::max(turns ? frames : frames - 1, 1));
}

}
