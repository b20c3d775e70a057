// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// main() of every test program: PROGRAM [--gtest_...] [SOURCE...]
//
// Runs the tests in each SOURCE, such as TestOverlay, or all; but none that the filter of GoogleTest excludes.
// Exit status: 77, which CTest shows as skipped, if no test ran or all were skipped.
#include "Processes/EndProcess.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <set>
#include <string>

namespace
{
constexpr int Skipped = 77;

/// Returns the names of the tests in some sources, each after a colon.
std::string TestsOf(const std::set<std::string>& sources)
{
  std::string names;
  const testing::UnitTest& program = *testing::UnitTest::GetInstance();
  for (int i = 0; i < program.total_test_suite_count(); ++i)
  {
    const testing::TestSuite& suite = *program.GetTestSuite(i);
    for (int j = 0; j < suite.total_test_count(); ++j)
    {
      const testing::TestInfo& test = *suite.GetTestInfo(j);
      if (sources.count(std::filesystem::path(test.file()).stem().string()) > 0)
      {
        names += std::string(":") + suite.name() + "." + test.name();
      }
    }
  }
  return names;
}
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  if (argc > 1)
  {
    const std::string tests = TestsOf({ argv + 1, argv + argc });
    if (tests.empty())
    {
      std::fprintf(stderr, "%s: no tests of %s, which may need another VTK\n", argv[0], argv[1]);
      return Skipped;
    }
    std::string& filter = testing::GTEST_FLAG(filter);
    const std::size_t excluded = filter.find('-');
    filter = tests + (excluded == std::string::npos ? "" : filter.substr(excluded));
  }
  const int status = RUN_ALL_TESTS();
  const testing::UnitTest& program = *testing::UnitTest::GetInstance();
  const bool skipped = program.skipped_test_count() == program.test_to_run_count();
  penumbra::EndProcess(status == 0 && skipped ? Skipped : status);
}
