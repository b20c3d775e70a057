// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Refusal of scenes that do not fit into memory, with injected limits.
#include "Execution/AvailableMemory.h"
#include "Import/SceneExtraction.h"
#include "Scene.h"
#include "Surface.h"

#include "vtkActor.h"
#include "vtkGlyph3DMapper.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

using namespace penumbra;

namespace
{

constexpr double MiB = 1024.0 * 1024.0;

/// Sets PENUMBRA_AVAILABLE_MEMORY during its lifetime.
struct MemoryVariable
{
  explicit MemoryVariable(const char* value) { setenv("PENUMBRA_AVAILABLE_MEMORY", value, 1); }
  ~MemoryVariable() { unsetenv("PENUMBRA_AVAILABLE_MEMORY"); }
};

/// A folder with files of a system.
class System
{
public:
  explicit System(const char* name)
    : Root(std::filesystem::path(testing::TempDir()) / name)
  {
    std::filesystem::remove_all(this->Root);
  }
  ~System() { std::filesystem::remove_all(this->Root); }
  System(const System&) = delete;
  void operator=(const System&) = delete;

  void Write(const std::string& file, const std::string& text) const
  {
    const std::filesystem::path path = this->Root / file;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  double FindAvailable() const { return FindAvailableMemory(this->Root.string()); }

private:
  std::filesystem::path Root;
};

/// Returns the message of the refusal to extract `renderer`; empty if it is extracted.
std::string FindRefusal(vtkRenderer* renderer)
{
  ExtractionOptions options;
  options.Resolution[0] = options.Resolution[1] = 8;
  try
  {
    ExtractScene(renderer, options);
  }
  catch (const InsufficientMemory& error)
  {
    return error.what();
  }
  return {};
}

}

TEST(AvailableMemory, IsThatOfTheSystem)
{
  const System system("penumbra-memory");
  EXPECT_TRUE(std::isinf(system.FindAvailable()));
  system.Write("proc/meminfo",
    "MemTotal:       24000000 kB\nMemFree:         1000000 kB\nMemAvailable:    8192 kB\n");
  EXPECT_EQ(system.FindAvailable(), 8.0 * MiB);
}

TEST(AvailableMemory, IsWhatControlGroupsGrant)
{
  const System system("penumbra-memory-2");
  system.Write("proc/meminfo", "MemAvailable: 1000000 kB\n");
  system.Write("proc/self/cgroup", "0::/slice/job\n");
  system.Write("sys/fs/cgroup/slice/job/memory.max", "max\n");
  EXPECT_EQ(system.FindAvailable(), 1e6 * 1024.0);
  // The limit of the outer group; 2 MiB of its use are cached files.
  system.Write("sys/fs/cgroup/slice/memory.max", "10485760\n");
  system.Write("sys/fs/cgroup/slice/memory.current", "5242880\n");
  system.Write("sys/fs/cgroup/slice/memory.stat",
    "anon 3145728\nfile 2097152\ninactive_file 1048576\nactive_file 1048576\n");
  EXPECT_EQ(system.FindAvailable(), 7.0 * MiB);
  // A group that is over its limit grants nothing.
  system.Write("sys/fs/cgroup/slice/job/memory.max", "1048576\n");
  system.Write("sys/fs/cgroup/slice/job/memory.current", "2097152\n");
  EXPECT_EQ(system.FindAvailable(), 0.0);
}

TEST(AvailableMemory, IsWhatTheMemoryControllerOfTheFirstVersionGrants)
{
  const System system("penumbra-memory-1");
  system.Write("proc/self/cgroup", "5:cpu,cpuacct:/a\n4:memory:/a/b\n0::/\n");
  system.Write("sys/fs/cgroup/memory/a/b/memory.limit_in_bytes", "9223372036854771712\n");
  // A container shows its own group as the root.
  system.Write("sys/fs/cgroup/memory/memory.limit_in_bytes", "8388608\n");
  system.Write("sys/fs/cgroup/memory/memory.usage_in_bytes", "4194304\n");
  system.Write("sys/fs/cgroup/memory/memory.stat",
    "inactive_file 7\ntotal_inactive_file 1048576\ntotal_active_file 0\n");
  EXPECT_EQ(system.FindAvailable(), 5.0 * MiB);
}

TEST(AvailableMemory, FollowsTheEnvironment)
{
  EXPECT_GT(FindAvailableMemory(), 0.0);
  {
    const MemoryVariable variable("0.5");
    EXPECT_EQ(FindAvailableMemory(), 0.5 * MiB);
    EXPECT_NO_THROW(RequireMemory(0.4 * MiB, "4 glyphs"));
    EXPECT_THROW(RequireMemory(0.6 * MiB, "6 glyphs"), InsufficientMemory);
  }
  EXPECT_NO_THROW(RequireMemory(0.6 * MiB, "6 glyphs"));
  for (const char* text : { "", "much", "1 GiB", "-1", "0", "nan" })
  {
    const MemoryVariable variable(text);
    EXPECT_THROW(FindAvailableMemory(), std::runtime_error) << text;
  }
}

TEST(AvailableMemory, RefusesSpheresThatDoNotFit)
{
  vtkNew<vtkPointSource> points;
  points->SetNumberOfPoints(20000);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(points->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->RenderPointsAsSpheresOn();
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  EXPECT_EQ(FindRefusal(renderer), "");
  const MemoryVariable variable("1");
  EXPECT_EQ(FindRefusal(renderer),
    "Not enough memory: 20000 spheres need at least 1.5 MiB, and 1 MiB are available. Show less of "
    "the "
    "data, or free memory.");
}

TEST(AvailableMemory, RefusesGlyphsThatDoNotFit)
{
  vtkNew<vtkPointSource> points;
  points->SetNumberOfPoints(4000);
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(20);
  sphere->SetPhiResolution(20);
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputConnection(points->GetOutputPort());
  mapper->SetSourceConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  {
    // As many triangles as 2.9 million would take more than 100 MiB; instances do not.
    const MemoryVariable variable("4");
    EXPECT_EQ(FindRefusal(renderer), "");
  }
  {
    const MemoryVariable variable("0.5");
    EXPECT_NE(FindRefusal(renderer).find("4000 glyphs need at least"), std::string::npos);
  }
  {
    const MemoryVariable variable("0.1"); // less than the transforms
    EXPECT_NE(FindRefusal(renderer).find("4000 glyphs need at least"), std::string::npos);
  }
  // Glyphs with edges are copied.
  actor->GetProperty()->EdgeVisibilityOn();
  const MemoryVariable variable("4");
  EXPECT_NE(FindRefusal(renderer).find("2880000 triangles, 4000 glyphs need"), std::string::npos)
    << FindRefusal(renderer);
}

TEST(AvailableMemory, RefusesTrianglesThatDoNotFit)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(100, 100);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(plane->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  const MemoryVariable variable("0.5");
  EXPECT_NE(FindRefusal(renderer).find("20000 triangles need at least"), std::string::npos);
}
