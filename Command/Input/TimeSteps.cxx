// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TimeSteps.h"

#include "FileSeries.h"
#include "Files/FileExtension.h"
#include "Files/InputFiles.h"
#include "Processes/CommandConstants.h"
#include "ReadLimit.h"
#include "Readers.h"

#include "vtkAlgorithm.h"
#include "vtkGLTFReader.h"
#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace penumbra
{

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

// Relative differences of equal times that were rounded to single or to double precision, and the
// fraction of the distance between two steps that a difference must not exceed.
constexpr double SinglePrecision = 1e-6;
constexpr double DoublePrecision = 1e-13;
constexpr double SpacingFraction = 0.01;

bool IsAnimation(const std::string& path)
{
  const std::string extension = LowerExtension(path);
  return extension == ".gltf" || extension == ".glb";
}

double FindMagnitude(const std::vector<double>& times)
{
  return std::max(std::abs(times.front()), std::abs(times.back()));
}

// Returns the largest amount by which a step may be later than the time that it is shown at: readers
// store some times in single precision.
double FindTolerance(const std::vector<double>& times)
{
  double tolerance = SinglePrecision * FindMagnitude(times);
  for (std::size_t i = 1; i < times.size(); ++i)
  {
    tolerance = std::min(tolerance, SpacingFraction * (times[i] - times[i - 1]));
  }
  return tolerance;
}

}

bool MayHaveTimeSteps(const std::string& path)
{
  static const char* const extensions[] = { ".vtkhdf", ".e", ".ex2", ".exo", ".exii", ".g", ".case",
    ".encas", ".foam", ".cgns", ".xdmf", ".xmf", ".gltf", ".glb" };
  const std::string extension = LowerExtension(path);
  return IsFileSeries(path) ||
    std::find(std::begin(extensions), std::end(extensions), extension) != std::end(extensions);
}

Timeline ReadTimeline(const std::vector<std::string>& files)
{
  Timeline timeline;
  for (const std::string& path : files)
  {
    if (!MayHaveTimeSteps(path))
    {
      continue;
    }
    RecordInput(path);
    const ReadLimit limit(path);
    const std::vector<double> times = ReadTimes(path);
    timeline.Times.insert(timeline.Times.end(), times.begin(), times.end());
    timeline.IsContinuous = timeline.IsContinuous || (IsAnimation(path) && !times.empty());
  }
  std::vector<double>& times = timeline.Times;
  std::sort(times.begin(), times.end());
  if (!times.empty())
  {
    const double tolerance = DoublePrecision * FindMagnitude(times);
    times.erase(std::unique(times.begin(), times.end(),
                  [tolerance](double a, double b) { return b - a <= tolerance; }),
      times.end());
  }
  return timeline;
}

std::size_t FindStep(const std::vector<double>& times, double time)
{
  const auto next = std::upper_bound(times.begin(), times.end(), time + FindTolerance(times));
  return next == times.begin() ? 0 : static_cast<std::size_t>(next - times.begin()) - 1;
}

std::vector<double> UpdateTimes(vtkAlgorithm* reader)
{
  reader->UpdateInformation();
  if (auto* animation = vtkGLTFReader::SafeDownCast(reader))
  {
    for (vtkIdType i = 0; i < animation->GetNumberOfAnimations(); ++i)
    {
      animation->EnableAnimation(i);
    }
    animation->SetFrameRate(AnimationFrameRate);
    reader->UpdateInformation();
  }
  vtkInformation* information = reader->GetOutputInformation(0);
  const int count =
    information->Has(Pipeline::TIME_STEPS()) ? information->Length(Pipeline::TIME_STEPS()) : 0;
  const double* first = count > 0 ? information->Get(Pipeline::TIME_STEPS()) : nullptr;
  std::vector<double> times(first, first + count);
  std::sort(times.begin(), times.end());
  return times;
}

void UpdateAtTime(vtkAlgorithm* reader, double time)
{
  const std::vector<double> times = UpdateTimes(reader);
  if (times.empty())
  {
    reader->Update();
    return;
  }
  if (reader->IsA("vtkHDFReader"))
  {
    // VTK 9.7 reads the first step of composite data unless it is asked for the information again.
    reader->Modified();
  }
  reader->UpdateTimeStep(vtkGLTFReader::SafeDownCast(reader)
      ? std::min(std::max(time, times.front()), times.back())
      : times[FindStep(times, time)]);
}

}
