// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Truncated and modified files of every format: the program exits with 0 or 2 and prints at most one line;
// it never crashes. The damage is the same in every run; $PENUMBRA_DAMAGES sets the number of variants of
// each kind per file.
#include "Meshes.h"
#include "Program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <sys/resource.h>

using namespace penumbra_testing;

namespace
{

// A fixed generator, because the distributions of the standard library differ between versions.
class Dice
{
public:
  explicit Dice(unsigned long long seed)
    : State(seed)
  {
  }

  std::size_t Below(std::size_t bound)
  {
    this->State = this->State * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<std::size_t>(this->State >> 33) % bound;
  }

private:
  unsigned long long State;
};

int Damages()
{
  const char* text = std::getenv("PENUMBRA_DAMAGES");
  return text ? std::atoi(text) : 4;
}

std::string Cut(const std::string& bytes, Dice& dice)
{
  return bytes.substr(0, dice.Below(bytes.size()));
}

// Modifies one byte in 200, at least two; half of them near the beginning, in the header.
std::string Scratch(std::string bytes, Dice& dice)
{
  const std::size_t scratches = 2 + dice.Below(1 + bytes.size() / 200);
  const std::size_t reach = dice.Below(2) ? std::min<std::size_t>(bytes.size(), 400) : bytes.size();
  for (std::size_t i = 0; i < scratches; ++i)
  {
    bytes[dice.Below(reach)] = static_cast<char>(dice.Below(256));
  }
  return bytes;
}

// Replaces digits by other digits, which gives valid but wrong counts and indices.
std::string ChangeDigits(std::string bytes, Dice& dice)
{
  for (int i = 0; i < 200; ++i)
  {
    char& byte = bytes[dice.Below(bytes.size())];
    if (byte >= '0' && byte <= '9')
    {
      byte = static_cast<char>('0' + dice.Below(10));
    }
  }
  return bytes;
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
  const std::string name = GetParam();
  const Folder folder("damaged-" + name);
  WriteSpheres(folder.Path);
  const std::string whole = ReadText(folder / name);
  ASSERT_FALSE(whole.empty());
  Dice dice(20240607);
  const auto expectNoCrash = [&](const std::string& bytes, const std::string& damage) {
    WriteText(folder / name, bytes);
    std::filesystem::remove(folder / "p.png");
    const ProgramResult outcome =
      RunProgram({ "render", folder / name, "--resolution", "12,9", "--output", folder / "p.png" });
    EXPECT_TRUE(outcome.Status == 0 || outcome.Status == 2) << outcome.Status << outcome.Errors;
    EXPECT_LE(CountLines(outcome.Errors), 1) << outcome.Errors;
    EXPECT_FALSE(outcome.Status == 2 && outcome.Errors.empty()) << "refused in silence";
    EXPECT_EQ(std::filesystem::exists(folder / "p.png"), outcome.Status == 0) << outcome.Errors;
    if (testing::Test::HasFailure())
    {
      WriteText(std::filesystem::temp_directory_path() / ("damaged-" + name), bytes);
      FAIL() << damage << ": the file lies in the folder for temporary files as damaged-" << name;
    }
  };
  for (int i = 0; i < Damages() && !HasFailure(); ++i)
  {
    expectNoCrash(Cut(whole, dice), "cut");
    expectNoCrash(Scratch(whole, dice), "scratched");
    expectNoCrash(ChangeDigits(whole, dice), "digits");
  }
}

std::string NameOf(const testing::TestParamInfo<std::string>& file)
{
  std::string name = file.param;
  name[name.find('.')] = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Formats, DamagedFiles,
  testing::Values("sphere.stl", "square.stl", "sphere.ply", "sphere.obj", "sphere.vtp",
    "sphere.vtk", "sphere.off", "sphere.gltf", "sphere.vtu", "sphere.vtm", "box.vti", "box.vtr",
    "box.vts"),
  NameOf);

}
