// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Random scenes, each drawn in a child process with limits of time and memory:
//
//   penumbra-random-scenes --seconds N --first-seed S    as many scenes as fit into N seconds
//   penumbra-random-scenes --seed S [--images FOLDER] [--keep I]...    one scene in this process
//
// --effects F multiplies the probabilities of shadows, ambient occlusion, indirect light and media. --extras 1 adds
// features to props, see RandomExtras.h; they need seeds of their own.
// Reports crashes, scenes over the limits, values that are not finite, images that depend on the
// number of threads, tiles above the tolerance whose estimate is below their error, and large regions
// that differ from VTK's image without a warning. Exit status: 0 if there are none, else 1.
#include "Random/SceneChecks.h"

#include "vtkLogger.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkStringOutputWindow.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <csignal>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace penumbra_soak;

namespace
{

struct Options
{
  double Seconds = 60.0;
  std::uint64_t FirstSeed = 1;
  std::uint64_t Count = 1000000000;
  bool Single = false;
  std::string Images;
  std::vector<int> Kept;
  double Effects = 1.0;
  bool Extras = false;
  double CastSeconds = 60.0;      ///< of CPU time
  double ReferenceSeconds = 30.0; ///< of CPU time; beyond, the tiles are not compared
  double Gigabytes = 4.0;
};

void LimitProcessorTime(double seconds)
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  rlimit limit;
  getrlimit(RLIMIT_CPU, &limit);
  limit.rlim_cur = static_cast<rlim_t>(
    static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) + seconds + 1.0);
  setrlimit(RLIMIT_CPU, &limit);
}

void LimitMemory([[maybe_unused]] double gigabytes)
{
#ifndef __SANITIZE_ADDRESS__
  rlimit limit;
  getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = static_cast<rlim_t>(gigabytes * 1073741824.0);
  setrlimit(RLIMIT_DATA, &limit);
#endif
}

/// The pixel whose error is most above its estimate.
void PrintWorstPixel(const CastImage& image, const penumbra::StratifiedReference& reference)
{
  double largest = -1.0;
  std::size_t worst = 0;
  for (std::size_t p = 0; p < reference.Colors.size(); ++p)
  {
    const glm::dvec3 d = image.Values.Colors[p] * image.Values.Alphas[p] - reference.Colors[p];
    const double excess = std::sqrt(glm::dot(d, d) / 3.0) - image.Values.Estimates[p];
    if (excess > largest)
    {
      largest = excess;
      worst = p;
    }
  }
  const glm::dvec3 color = image.Values.Colors[worst] * image.Values.Alphas[worst];
  const glm::dvec3 exact = reference.Colors[worst];
  std::printf("pixel %zu %zu: %.4f %.4f %.4f, reference %.4f %.4f %.4f, estimate %.4f\n",
    worst % ImageSide, worst / ImageSide, color.r, color.g, color.b, exact.r, exact.g, exact.b,
    image.Values.Estimates[worst]);
}

void PrintTiles(
  const RandomScene& scene, const CastImage& image, std::uint64_t seed, const Options& options)
{
  penumbra::StratifiedReference reference = DrawReference(scene, 1);
  std::vector<penumbra::TileAccuracy> tiles =
    penumbra::CompareTiles(image.Values, reference, ImageSide);
  const bool suspect = std::any_of(tiles.begin(), tiles.end(),
    [&](const penumbra::TileAccuracy& tile) { return IsMisjudged(scene, tile); });
  if (suspect)
  {
    reference = DrawReference(scene, 3); // excludes noise of the reference
    tiles = penumbra::CompareTiles(image.Values, reference, ImageSide);
  }
  if (!options.Images.empty())
  {
    std::vector<glm::dvec3> differences;
    for (std::size_t p = 0; p < reference.Colors.size(); ++p)
    {
      differences.push_back(
        0.1 / scene.Tolerance * glm::abs(image.Values.Colors[p] - reference.Colors[p]));
    }
    WriteSheet({ image.Values.Colors, reference.Colors, differences },
      options.Images + "/" + std::to_string(seed) + "-reference.png");
  }
  PrintWorstPixel(image, reference);
  std::printf("tiles %g", TileLimit(scene));
  for (const penumbra::TileAccuracy& tile : tiles)
  {
    std::printf(" %.6f %.6f", tile.Error, tile.Estimate);
  }
  std::printf("\n");
}

void PrintComparison(
  const RandomScene& scene, const CastImage& image, std::uint64_t seed, const Options& options)
{
  const bool plain = !scene.Effects && !scene.NeedsCaster && !scene.Shadows;
  const CastImage cast = plain ? image : CastScene(scene, true);
  const std::vector<glm::dvec3> vtk = DrawWithVTK(scene);
  const int blocks = CountDifferentBlocks(cast.Values.Colors, vtk);
  if (scene.ComparesWithVTK)
  {
    std::printf("vtk %d\n", cast.Warnings.empty() ? blocks : -blocks);
  }
  if (!options.Images.empty())
  {
    WriteSheet({ image.Values.Colors, cast.Values.Colors, vtk },
      options.Images + "/" + std::to_string(seed) + ".png");
  }
}

/// Draws and checks one scene; prints lines that Read() understands.
int CheckScene(std::uint64_t seed, const Options& options)
{
  vtkNew<vtkStringOutputWindow> messages;
  vtkOutputWindow::SetInstance(messages);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  LimitMemory(options.Gigabytes);
  std::printf("stage scene\n");
  const RandomScene scene = MakeRandomScene(seed, options.Kept, options.Effects, options.Extras);
  std::printf("scene %s\nstage cast\n", scene.Description.c_str());
  LimitProcessorTime(options.CastSeconds);
  const CastImage image = CastScene(scene, false);
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  std::printf("cast %.3f %.0f %d\n", image.Values.Seconds, double(usage.ru_maxrss) / 1024.0,
    image.Finite ? 1 : 0);
  std::printf("warnings %s\n", image.Warnings.c_str());
  if (seed % 4 == 0 && image.Values.Seconds < options.ReferenceSeconds / 10.0)
  {
    std::printf("stage threads\n");
    const CastImage other = CastScene(scene, false, 2);
    std::printf("threads %d\n",
      other.Values.Colors == image.Values.Colors && other.Values.Estimates == image.Values.Estimates
        ? 1
        : 0);
  }
  std::printf("stage vtk\n");
  LimitProcessorTime(options.CastSeconds);
  PrintComparison(scene, image, seed, options);
  std::printf("stage reference\n");
  LimitProcessorTime(options.ReferenceSeconds);
  if (scene.ComparesTiles)
  {
    PrintTiles(scene, image, seed, options);
  }
  std::printf("stage end\n");
  vtkOutputWindow::SetInstance(nullptr);
  return 0;
}

/// What the child process of a scene reported.
struct Report
{
  std::uint64_t Seed = 0;
  int Status = 0; ///< exit status, or minus the signal
  std::map<std::string, std::string> Lines;
};

Report RunChild(const std::string& program, std::uint64_t seed, const Options& options)
{
  int channel[2];
  Report report;
  report.Seed = seed;
  if (pipe(channel) != 0)
  {
    report.Status = -1;
    return report;
  }
  const std::string number = std::to_string(seed);
  const std::string effects = std::to_string(options.Effects);
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0)
  {
    dup2(channel[1], 1);
    close(channel[0]);
    close(channel[1]);
    alarm(static_cast<unsigned int>(20.0 * options.CastSeconds));
    execl(program.c_str(), program.c_str(), "--seed", number.c_str(), "--effects", effects.c_str(),
      "--extras", options.Extras ? "1" : "0", options.Images.empty() ? nullptr : "--images",
      options.Images.c_str(), nullptr);
    _exit(127);
  }
  close(channel[1]);
  std::string text;
  char buffer[4096];
  for (ssize_t size; (size = read(channel[0], buffer, sizeof(buffer))) > 0;)
  {
    text.append(buffer, static_cast<std::size_t>(size));
  }
  close(channel[0]);
  int state = 0;
  waitpid(child, &state, 0);
  report.Status = WIFEXITED(state) ? WEXITSTATUS(state) : -WTERMSIG(state);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
  {
    const std::size_t space = line.find(' ');
    report.Lines[line.substr(0, space)] = space < line.size() ? line.substr(space + 1) : "";
  }
  return report;
}

/// Counts over all scenes.
struct Totals
{
  std::map<std::string, std::vector<std::uint64_t>> Findings; ///< seeds of each kind
  std::size_t Scenes = 0;
  std::size_t Tiles = 0;
  std::size_t Above = 0;
  std::size_t Misjudged = 0;
  std::size_t Compared = 0;  ///< with VTK's image
  std::size_t Unchecked = 0; ///< scenes whose reference takes too long
  std::vector<double> Ratios;
  double SlowestSeconds = 0.0;
  double LargestMegabytes = 0.0;
};

void AddFinding(Totals& totals, const Report& report, const std::string& kind)
{
  totals.Findings[kind].push_back(report.Seed);
  const auto scene = report.Lines.find("scene");
  std::printf("%s: seed %llu: %s\n", kind.c_str(), static_cast<unsigned long long>(report.Seed),
    scene == report.Lines.end() ? "" : scene->second.c_str());
  std::fflush(stdout);
}

void AddTiles(Totals& totals, const Report& report, const std::string& line)
{
  std::istringstream numbers(line);
  double limit = 0.0;
  double error = 0.0;
  double estimate = 0.0;
  double worst = 0.0;
  std::size_t misjudged = 0;
  numbers >> limit;
  while (numbers >> error >> estimate)
  {
    const bool wrong = error > limit && estimate < error;
    ++totals.Tiles;
    totals.Above += error > limit;
    misjudged += wrong;
    worst = wrong ? std::max(worst, error / limit) : worst;
    if (error > 0.1 * limit)
    {
      totals.Ratios.push_back(estimate / error);
    }
  }
  totals.Misjudged += misjudged;
  if (worst > 2.0)
  {
    AddFinding(totals, report, "tiles above twice the tolerance with a smaller estimate");
    std::printf("  %zu tiles, worst error %.1f times the tolerance\n", misjudged, worst);
  }
}

void Add(Totals& totals, const Report& report)
{
  const auto get = [&](const char* key) {
    const auto line = report.Lines.find(key);
    return line == report.Lines.end() ? std::string() : line->second;
  };
  ++totals.Scenes;
  const std::string stage = get("stage");
  const bool late = report.Status == -SIGXCPU || report.Status == -SIGALRM;
  if (late && stage == "reference")
  {
    ++totals.Unchecked;
  }
  else if (late)
  {
    AddFinding(totals, report, "over the time limit in stage " + stage);
  }
  else if (report.Status != 0)
  {
    AddFinding(totals, report, "crash (" + std::to_string(report.Status) + ") in stage " + stage);
  }
  double seconds = 0.0;
  double megabytes = 0.0;
  int finite = 1;
  if (std::istringstream(get("cast")) >> seconds >> megabytes >> finite && !finite)
  {
    AddFinding(totals, report, "values that are not finite");
  }
  totals.SlowestSeconds = std::max(totals.SlowestSeconds, seconds);
  totals.LargestMegabytes = std::max(totals.LargestMegabytes, megabytes);
  if (get("threads") == "0")
  {
    AddFinding(totals, report, "depends on the number of threads");
  }
  if (report.Lines.count("tiles"))
  {
    AddTiles(totals, report, get("tiles"));
  }
  if (report.Lines.count("vtk"))
  {
    ++totals.Compared;
    const int blocks = std::atoi(get("vtk").c_str());
    if (blocks >= 2)
    {
      AddFinding(totals, report, "differs from VTK without a warning");
      std::printf("  %d blocks of 8x8 pixels\n", blocks);
    }
  }
}

void Print(Totals& totals, double seconds)
{
  const double tiles = std::max<double>(1.0, static_cast<double>(totals.Tiles));
  std::sort(totals.Ratios.begin(), totals.Ratios.end());
  std::printf("\n%zu scenes in %.0f s, %zu tiles, %zu scenes compared with VTK, "
              "%zu without a reference\n",
    totals.Scenes, seconds, totals.Tiles, totals.Compared, totals.Unchecked);
  std::printf("tiles above the tolerance: %.2f %%, with an estimate below the error: %.2f %%\n",
    100.0 * static_cast<double>(totals.Above) / tiles,
    100.0 * static_cast<double>(totals.Misjudged) / tiles);
  std::printf("median of estimate / error: %.2f\n",
    totals.Ratios.empty() ? 0.0 : totals.Ratios[totals.Ratios.size() / 2]);
  std::printf(
    "slowest: %.1f CPU s, largest: %.0f MB\n", totals.SlowestSeconds, totals.LargestMegabytes);
  for (const auto& [kind, seeds] : totals.Findings)
  {
    std::printf("%s: %zu:", kind.c_str(), seeds.size());
    for (const std::uint64_t seed : seeds)
    {
      std::printf(" %llu", static_cast<unsigned long long>(seed));
    }
    std::printf("\n");
  }
}

/// Returns false for an unknown option.
bool Parse(int count, char** arguments, Options& options)
{
  for (int i = 1; i < count; i += 2)
  {
    const std::string name = arguments[i];
    if (i + 1 == count)
    {
      return false;
    }
    const char* value = arguments[i + 1];
    if (name == "--seconds")
    {
      options.Seconds = std::atof(value);
    }
    else if (name == "--first-seed" || name == "--seed")
    {
      options.FirstSeed = std::strtoull(value, nullptr, 10);
      options.Single = name == "--seed";
    }
    else if (name == "--scenes")
    {
      options.Count = std::strtoull(value, nullptr, 10);
    }
    else if (name == "--images")
    {
      options.Images = value;
    }
    else if (name == "--keep")
    {
      options.Kept.push_back(std::atoi(value));
    }
    else if (name == "--extras")
    {
      options.Extras = std::atoi(value) != 0;
    }
    else if (name == "--effects")
    {
      options.Effects = std::atof(value);
    }
    else
    {
      return false;
    }
  }
  return true;
}

}

int main(int count, char** arguments)
{
  Options options;
  if (!Parse(count, arguments, options))
  {
    std::fprintf(stderr,
      "penumbra-random-scenes [--seconds N] [--scenes N] [--first-seed S] "
      "[--seed S [--keep INDEX]...] [--effects FACTOR] [--extras 0|1] [--images FOLDER]\n");
    return 2;
  }
  if (options.Single)
  {
    return CheckScene(options.FirstSeed, options);
  }
  Totals totals;
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  for (std::uint64_t i = 0; i < options.Count && elapsed() < options.Seconds; ++i)
  {
    Add(totals, RunChild(arguments[0], options.FirstSeed + i, options));
  }
  Print(totals, elapsed());
  return totals.Findings.empty() ? 0 : 1;
}
