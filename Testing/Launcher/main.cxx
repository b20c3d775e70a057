// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// main() of every test program: PROGRAM [--gtest_...] [SOURCE]
//
// Runs the tests in SOURCE, such as TestCamera, or all; but none that the filter of GoogleTest excludes.
#include "Processes/EndProcess.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <string>

namespace
{
/// Returns the names of the tests in a source, each after a colon.
std::string TestsOf(const std::string& source)
{
  std::string names;
  const testing::UnitTest& program = *testing::UnitTest::GetInstance();
  for (int i = 0; i < program.total_test_suite_count(); ++i)
  {
    const testing::TestSuite& suite = *program.GetTestSuite(i);
    for (int j = 0; j < suite.total_test_count(); ++j)
    {
      const testing::TestInfo& test = *suite.GetTestInfo(j);
      if (std::filesystem::path(test.file()).stem() == source)
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
    const std::string tests = TestsOf(argv[1]);
    if (tests.empty())
    {
      std::fprintf(stderr, "%s: no tests of %s\n", argv[0], argv[1]);
      return 1;
    }
    std::string& filter = testing::GTEST_FLAG(filter);
    const std::size_t excluded = filter.find('-');
    filter = tests + (excluded == std::string::npos ? "" : filter.substr(excluded));
  }
  penumbra::EndProcess(RUN_ALL_TESTS());
}
