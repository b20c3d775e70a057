// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Truncated and modified files of every format: the program exits with 0 or 2 and prints at most one line;
// it never crashes. The damage is the same in every run; $PENUMBRA_DAMAGES sets the number of variants of
// each kind per file.
#include "Program.h"
#include "SampleFiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <sys/resource.h>

using namespace penumbra_testing;

namespace
{

int GetVariants()
{
  const char* text = std::getenv("PENUMBRA_DAMAGES");
  return text ? std::atoi(text) : 2;
}

class DamagedFiles : public testing::TestWithParam<std::string>
{
protected:
  // A wrong count may request any amount of memory; limit it to 4 GiB.
  static void SetUpTestSuite()
  {
#if !defined(__SANITIZE_ADDRESS__)
    rlimit limit = {};
    getrlimit(RLIMIT_DATA, &limit);
    limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, 4ull << 30);
    setrlimit(RLIMIT_DATA, &limit);
#endif
  }
};

TEST_P(DamagedFiles, DoNotCrashProgram)
{
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "VTK's readers leak and access invalid memory; the program survives that only "
                  "without sanitizers.";
#endif
  const std::string name = GetParam();
  std::string label = name;
  std::replace(label.begin(), label.end(), '/', '-');
  const Folder folder("damaged-" + label);
  const std::vector<SampleFile> samples = WriteSampleFiles(folder.Path);
  const auto sample = std::find_if(samples.begin(), samples.end(),
    [&](const SampleFile& candidate) { return candidate.Damaged == name; });
  if (sample == samples.end())
  {
    GTEST_SKIP() << "This VTK does not write the format.";
  }
  const std::string whole = ReadText(folder / name);
  ASSERT_FALSE(whole.empty());
  const std::vector<std::string> before = folder.List();
  Dice dice(20240607);
  for (int i = 0; i < GetVariants() * static_cast<int>(NumberOfDamages); ++i)
  {
    const auto damage = static_cast<Damages>(static_cast<std::size_t>(i) % NumberOfDamages);
    const std::string bytes = Damage(whole, damage, dice);
    WriteText(folder / name, bytes);
    const ProgramResult outcome = RunProgram({ "render", folder / sample->Opened, "--read-limit",
      "10", "--resolution", "12,9", "--output", folder / "p.png" });
    EXPECT_TRUE(outcome.Status == 0 || outcome.Status == 2) << outcome.Status << outcome.Errors;
    EXPECT_LE(CountLines(outcome.Errors), 1) << outcome.Errors;
    EXPECT_FALSE(outcome.Status == 2 && outcome.Errors.empty()) << "refused in silence";
    EXPECT_EQ(std::filesystem::remove(folder / "p.png"), outcome.Status == 0) << outcome.Errors;
    EXPECT_EQ(folder.List(), before);
    if (HasFailure())
    {
      const std::string kept = std::filesystem::path(name).filename().string();
      WriteText(std::filesystem::temp_directory_path() / ("damaged-" + kept), bytes);
      FAIL() << NameOf(damage) << ": the file lies in the folder for temporary files as damaged-"
             << kept;
    }
  }
}

std::string NameOfTest(const testing::TestParamInfo<std::string>& file)
{
  std::string name = file.param;
  std::replace_if(
    name.begin(), name.end(), [](char c) { return c == '.' || c == '/'; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Formats, DamagedFiles,
  testing::Values("sphere.stl", "square.stl", "sphere.ply", "sphere.obj", "sphere.vtp",
    "sphere.vtk", "sphere.off", "sphere.gltf", "sphere.glb", "sphere.vtu", "sphere.vtm", "box.vti",
    "box.vtr", "box.vts", "p.pvtp", "u.pvtu", "i.pvti", "s.pvts", "r.pvtr", "d.vtpd", "a.vtpc",
    "sphere.vtkhdf", "box.mha", "box.nii", "a.nrrd", "a.slc", "a.pts", "a.inp", "a.tec", "a.byu",
    "a.facet", "a.neu", "a.cas", "a.xdmf", "a.case", "a.geo", "constant/polyMesh/points",
    "square.3ds", "box.wrl", "red.mtl"),
  NameOfTest);

}
