// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Cost of worst-case scenes: CPU time and peak memory relative to a smooth mesh with as many
// primitives that fills the image, at 1,000 to 1,000,000 primitives, and the exponent of growth.
#include "LimitScenes.h"
#include "Measurement.h"
#include "Program.h"

#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <thread>
#include <tuple>

namespace
{

using namespace penumbra;

constexpr double MaximumTime = 10.0;    // times that of the plain mesh
constexpr double MaximumMemory = 3.0;   // times that of the plain mesh
constexpr double MaximumExponent = 1.2; // of time as a function of the number of primitives

struct Options
{
  std::string Output;
  std::string Only; ///< name of a family; empty: all
  std::string Limit = "120";
  std::string Jobs;
  bool Quick = false;
};

std::string Describe(int n)
{
  return n >= 1000000 ? std::to_string(n / 1000000) + " M"
    : n >= 1000       ? std::to_string(n / 1000) + " k"
                      : std::to_string(n);
}

std::string Format(double value, bool isBound)
{
  char text[32];
  std::snprintf(text, sizeof text, "%s%.3g", isBound ? "> " : "", value);
  return text;
}

/// Scenes whose costs are measured at once, each with its plain mesh. Equal plain meshes are
/// measured once.
class Measurements
{
public:
  void Add(const LimitScene& scene)
  {
    const LimitScene plain = MakePlainScene(scene);
    const auto key =
      std::make_tuple(static_cast<int>(plain.Task), plain.Primitives, plain.Width, plain.Height);
    const auto added = this->IndicesOfPlain.emplace(key, this->Tasks.size());
    if (added.second)
    {
      this->AddTask(plain);
    }
    this->Pairs.emplace_back(this->Tasks.size(), added.first->second);
    this->AddTask(scene);
  }

  void Run(const Options& options)
  {
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    const int jobs = options.Jobs.empty() ? std::clamp(cores, 1, 2) : std::stoi(options.Jobs);
    this->Costs = MeasureInProcesses(this->Tasks, jobs, std::stoi(options.Limit));
  }

  /// Cost of the i-th scene and of its plain mesh.
  const Cost& GetCost(std::size_t i) const { return this->Costs[this->Pairs[i].first]; }
  const Cost& GetPlainCost(std::size_t i) const { return this->Costs[this->Pairs[i].second]; }

private:
  void AddTask(const LimitScene& scene)
  {
    this->Tasks.push_back({ scene.Name + ", " + Describe(scene.Primitives), [scene] {
                             const vtkSmartPointer<vtkPolyData> mesh = scene.MakeMesh();
                             return [scene, mesh] { RunScene(scene, mesh); };
                           } });
  }

  std::vector<NamedTask> Tasks;
  std::vector<std::pair<std::size_t, std::size_t>> Pairs; ///< of indices of scene and plain mesh
  std::map<std::tuple<int, int, int, int>, std::size_t> IndicesOfPlain;
  std::vector<Cost> Costs;
};

/// A ratio or exponent, which may be only a lower bound.
struct Value
{
  double Number = 0.0;
  bool IsBound = false;

  void Include(double number, bool isBound)
  {
    this->Number = std::max(this->Number, number);
    this->IsBound = this->IsBound || isBound;
  }
};

/// Adds a row. A lower bound that does not exceed the target is not judged.
void AddRow(const std::string& name, const std::string& quantity, const Value& value, double target,
  const std::string& remark, ResultTable& results)
{
  const bool isOpen = value.IsBound && value.Number <= target;
  results.Add(name, quantity, value.Number, isOpen ? TargetKind::None : TargetKind::AtMost, target,
    remark + (isOpen ? "; a measurement was ended, not judged" : ""));
}

/// Adds the three rows of a family: time and memory relative to the plain mesh, and exponent.
void AddFamily(const std::string& name, const std::vector<int>& sizes,
  const Measurements& measurements, std::size_t first, ResultTable& results)
{
  Value worstTime;
  Value worstMemory;
  Value worstExponent;
  std::string times;
  std::string memories;
  std::string seconds;
  for (std::size_t i = 0; i < sizes.size(); ++i)
  {
    const Cost& cost = measurements.GetCost(first + i);
    const Cost& plain = measurements.GetPlainCost(first + i);
    const double time = cost.Seconds / plain.Seconds;
    const double memory = cost.Megabytes / plain.Megabytes;
    const std::string separator = i > 0 ? "; " : "";
    times += separator + Describe(sizes[i]) + ": " + Format(time, cost.IsBound);
    memories += separator + Describe(sizes[i]) + ": " + Format(memory, cost.IsBound);
    seconds += separator + Describe(sizes[i]) + ": " + Format(cost.Seconds, cost.IsBound) + " s, " +
      Format(cost.Megabytes, cost.IsBound) + " MB";
    const bool isBound = cost.IsBound || plain.IsBound;
    worstTime.Include(time, isBound);
    worstMemory.Include(memory, isBound);
    if (i > 0)
    {
      const double before = measurements.GetCost(first + i - 1).Seconds;
      worstExponent.Include(
        std::log(cost.Seconds / before) / std::log(double(sizes[i]) / sizes[i - 1]), cost.IsBound);
    }
  }
  AddRow(name, "time / plain mesh, worst", worstTime, MaximumTime, times, results);
  AddRow(name, "memory / plain mesh, worst", worstMemory, MaximumMemory, memories, results);
  AddRow(name, "exponent of time, worst", worstExponent, MaximumExponent, seconds, results);
}

void AddSingle(const LimitScene& scene, const Cost& cost, const Cost& plain, ResultTable& results)
{
  const std::string remark = Format(cost.Seconds, cost.IsBound) + " s, " +
    Format(cost.Megabytes, cost.IsBound) +
    " MB; plain mesh: " + Format(plain.Seconds, plain.IsBound) + " s, " +
    Format(plain.Megabytes, plain.IsBound) + " MB";
  const bool isBound = cost.IsBound || plain.IsBound;
  AddRow(scene.Name, "time / plain mesh", { cost.Seconds / plain.Seconds, isBound }, MaximumTime,
    remark, results);
  AddRow(scene.Name, "memory / plain mesh", { cost.Megabytes / plain.Megabytes, isBound },
    MaximumMemory, "", results);
}

void Measure(const Options& options, ResultTable& results)
{
  const std::vector<int> sizes = options.Quick ? std::vector<int>{ 1000, 10000, 100000 }
                                               : std::vector<int>{ 1000, 10000, 100000, 1000000 };
  Measurements measurements;
  std::vector<LimitFamily> families;
  for (const LimitFamily& family : GetLimitFamilies())
  {
    if (options.Only.empty() || options.Only == family.Name)
    {
      families.push_back(family);
      for (const int n : sizes)
      {
        measurements.Add(MakeScene(family, n));
      }
    }
  }
  std::vector<LimitScene> singles;
  for (LimitScene& scene : MakeSingleScenes(PENUMBRA_SOURCE_DIR "/Data"))
  {
    if (options.Only.empty() || options.Only == "single" || options.Only == scene.Name)
    {
      measurements.Add(scene);
      singles.push_back(std::move(scene));
    }
  }
  measurements.Run(options);
  std::size_t first = 0;
  for (const LimitFamily& family : families)
  {
    AddFamily(family.Name, sizes, measurements, first, results);
    first += sizes.size();
  }
  for (const LimitScene& scene : singles)
  {
    AddSingle(scene, measurements.GetCost(first), measurements.GetPlainCost(first), results);
    ++first;
  }
}

}

int main(int argc, char** argv)
{
  Options options;
  ResultTable results;
  Program program;
  program.Name = "limits";
  program.Title = "Limits: cost of worst-case scenes";
  program.Usage = "--output FOLDER [--quick] [--scene NAME|single] [--limit SECONDS] [--jobs N]";
  program.Values = { { "--output", &options.Output, true }, { "--scene", &options.Only },
    { "--limit", &options.Limit }, { "--jobs", &options.Jobs } };
  program.Switches = { { "--quick", &options.Quick } };
  program.Parts = { { "", [&] { Measure(options, results); } } };
  return program.Run(argc, argv, results, options.Output, [&] {
    return std::vector<std::string>{ "one thread per measurement",
      "plain mesh: smooth height field of as many triangles that fills the image, drawn or baked "
      "in the same run; images of families: 256x256",
      "CPU seconds; peak resident memory of a process per measurement, which includes the mesh and "
      "the libraries; a measurement ends after " +
        options.Limit + " CPU s, \">\"" };
  });
}
