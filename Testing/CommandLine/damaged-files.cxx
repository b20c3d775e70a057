// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Renders damaged files of every format, each in a child process with limits of time and address
// space, and prints a table of the results:
//
//   penumbra-damaged-files --files N --first-seed S [--only NAME] [--keep FOLDER]
//
// The files that crash the program, exceed the limits or leave other files behind are copied to the
// folder. Exit status: 0 if there are none, else 1.
#include "Program.h"
#include "SampleFiles.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

using namespace penumbra_testing;

namespace
{

struct Options
{
  std::size_t Files = 1000;
  unsigned long long FirstSeed = 1;
  std::string Only;
  std::string Kept;
};

struct Counts
{
  std::size_t Files = 0;
  std::size_t Rendered = 0;
  std::size_t Refused = 0;
  std::size_t Memory = 0; ///< exit status 3
  std::size_t Limit = 0;  ///< ended by the limit of the test, not by --read-limit
  std::size_t Crashed = 0;
  std::size_t Silent = 0; ///< refused without a line, or with several
  std::size_t Left = 0;   ///< files left behind
  std::size_t Bad() const { return this->Limit + this->Crashed + this->Silent + this->Left; }
};

ProgramResult Render(const Folder& folder, const std::string& name)
{
  return RunShell("ulimit -v 8388608 -t 30; exec timeout -k 5 120 $PENUMBRA render " +
    Quote(folder / name) + " --read-limit 10 --resolution 12,9 --output " +
    Quote(folder / "image.png"));
}

void Count(Counts& counts, const Folder& folder, const SampleFile& sample,
  const std::vector<std::string>& before)
{
  const ProgramResult result = Render(folder, sample.Opened);
  ++counts.Files;
  counts.Rendered += result.Status == 0;
  counts.Refused += result.Status == 2;
  counts.Memory += result.Status == 3;
  const bool late = result.Status == 124 || result.Status == 137 || result.Status == 152;
  counts.Limit += late;
  counts.Crashed += !late && (result.Status < 0 || result.Status > 3 || result.Status == 1);
  counts.Silent += result.Status == 2 && CountLines(result.Errors) != 1;
  const bool image = std::filesystem::remove(folder / "image.png");
  counts.Left += image != (result.Status == 0) || folder.List() != before;
}

/// Damages a file and counts the result. The same seed gives the same file.
void Try(const Options& options, const Folder& folder, const SampleFile& sample,
  const std::vector<std::string>& before, unsigned long long seed, Damages damage, Counts& counts)
{
  const std::string whole = ReadText(folder / sample.Damaged);
  Dice dice(seed);
  const std::string bytes = Damage(whole, damage, dice);
  WriteText(folder / sample.Damaged, bytes);
  const std::size_t bad = counts.Bad();
  Count(counts, folder, sample, before);
  WriteText(folder / sample.Damaged, whole);
  if (counts.Bad() > bad)
  {
    std::fprintf(stderr, "%s, seed %llu, %s\n", sample.Damaged.c_str(), seed, NameOf(damage));
    if (!options.Kept.empty())
    {
      const std::string name = std::filesystem::path(sample.Damaged).filename().string();
      WriteText(options.Kept + "/" + std::to_string(seed) + "-" + name, bytes);
    }
  }
}

void PrintRow(const std::string& name, const Counts& counts)
{
  std::printf("| `%s` | %zu | %zu | %zu | %zu | %zu | %zu | %zu | %zu |\n", name.c_str(),
    counts.Files, counts.Rendered, counts.Refused, counts.Memory, counts.Limit, counts.Crashed,
    counts.Silent, counts.Left);
}

int Run(const Options& options)
{
  const Folder folder("damaged-files");
  std::vector<SampleFile> samples;
  for (const SampleFile& sample : WriteSampleFiles(folder.Path))
  {
    const ProgramResult result = Render(folder, sample.Opened);
    if (result.Status != 0)
    {
      std::fprintf(stderr, "%s: not valid: %s", sample.Opened.c_str(), result.Errors.c_str());
    }
    else if (sample.Damaged.find(options.Only) != std::string::npos)
    {
      samples.push_back(sample);
    }
    std::filesystem::remove(folder / "image.png");
  }
  const std::vector<std::string> before = folder.List();
  std::map<std::string, Counts> table;
  Counts total;
  for (std::size_t i = 0; i < options.Files && !samples.empty(); ++i)
  {
    const SampleFile& sample = samples[i % samples.size()];
    const auto damage = static_cast<Damages>(i / samples.size() % NumberOfDamages);
    Try(options, folder, sample, before, options.FirstSeed + i, damage, table[sample.Damaged]);
  }
  std::printf("| file | damaged | rendered | refused | too little memory | over the limits | "
              "crashed | without one line | files left behind |\n|---|---|---|---|---|---|---|---|"
              "---|\n");
  for (const auto& [name, counts] : table)
  {
    PrintRow(name, counts);
    total.Files += counts.Files;
    total.Rendered += counts.Rendered;
    total.Refused += counts.Refused;
    total.Memory += counts.Memory;
    total.Limit += counts.Limit;
    total.Crashed += counts.Crashed;
    total.Silent += counts.Silent;
    total.Left += counts.Left;
  }
  PrintRow("all", total);
  return total.Bad() > 0;
}

}

int main(int count, char** arguments)
{
  Options options;
  for (int i = 1; i + 1 < count; i += 2)
  {
    const std::string name = arguments[i];
    const char* value = arguments[i + 1];
    options.Files = name == "--files" ? std::strtoull(value, nullptr, 10) : options.Files;
    options.FirstSeed =
      name == "--first-seed" ? std::strtoull(value, nullptr, 10) : options.FirstSeed;
    options.Only = name == "--only" ? value : options.Only;
    options.Kept = name == "--keep" ? value : options.Kept;
  }
  return Run(options);
}
