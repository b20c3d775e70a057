// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Parallel loops and bins: every iteration runs once, results do not depend on the number of threads,
// progress is reported in the calling thread, and requests to stop and exceptions end a loop.
#include "Execution/ParallelBins.h"

#include "vtkSMPTools.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

using namespace penumbra;

namespace
{

template <typename Work>
void WithThreads(int threads, const Work& work)
{
  vtkSMPTools::LocalScope(vtkSMPTools::Config(threads), work);
}

class WithThreadsTest : public testing::TestWithParam<int>
{
};

TEST_P(WithThreadsTest, EveryIterationRunsOnce)
{
  WithThreads(GetParam(), [] {
    for (const int grain : { 0, 1, 7, 5000 })
    {
      std::vector<std::atomic<int>> runs(4321);
      ParallelFor<std::size_t>(
        0, runs.size(), static_cast<std::size_t>(grain), [&](std::size_t i) { ++runs[i]; });
      for (const std::atomic<int>& count : runs)
      {
        ASSERT_EQ(count, 1) << "grain " << grain;
      }
    }
  });
}

TEST_P(WithThreadsTest, ProgressIsReportedInTheCallingThread)
{
  WithThreads(GetParam(), [] {
    const std::thread::id caller = std::this_thread::get_id();
    std::vector<double> reported;
    std::atomic<bool> isReported{ false };
    const auto progress = [&](double fraction) {
      EXPECT_EQ(std::this_thread::get_id(), caller);
      reported.push_back(fraction);
      isReported = fraction > 0.25;
      return false;
    };
    // The other threads wait in their first iteration, so that the calling thread gets enough of them.
    EXPECT_TRUE(ParallelForWithProgress(60, 0.25, 0.75, progress, [&](int) {
      do
      {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
      while (!isReported && std::this_thread::get_id() != caller);
    }));
    ASSERT_GE(reported.size(), 3u);
    EXPECT_EQ(reported.front(), 0.25);
    EXPECT_EQ(reported.back(), 0.75);
    EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
  });
}

TEST_P(WithThreadsTest, AStopRequestEndsTheLoop)
{
  WithThreads(GetParam(), [] {
    std::atomic<int> runs{ 0 };
    const auto progress = [&](double fraction) { return fraction > 0.0; };
    EXPECT_FALSE(ParallelForWithProgress(10000, 0.0, 1.0, progress, [&](int) {
      ++runs;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }));
    EXPECT_LT(runs, 10000);
  });
}

TEST_P(WithThreadsTest, ExceptionsReachTheCaller)
{
  WithThreads(GetParam(), [] {
    std::string message;
    try
    {
      ParallelFor(0, 100, 1, [](int i) {
        if (i == 42)
        {
          throw std::runtime_error("iteration 42");
        }
      });
    }
    catch (const std::runtime_error& error)
    {
      message = error.what();
    }
    EXPECT_EQ(message, "iteration 42");
  });
}

TEST_P(WithThreadsTest, InnerLoopsRunInOneThread)
{
  WithThreads(GetParam(), [] {
    std::atomic<int> other{ 0 };
    ParallelFor(0, 16, 1, [&](int) {
      const std::thread::id thread = std::this_thread::get_id();
      ParallelFor(0, 100, 1, [&](int) { other += std::this_thread::get_id() == thread ? 0 : 1; });
    });
    EXPECT_EQ(other, 0);
  });
}

TEST_P(WithThreadsTest, BinsHaveTheOrderOfTheItems)
{
  constexpr std::size_t Count = 100000;
  constexpr std::size_t NumberOfBins = 37;
  std::vector<std::vector<int>> expected(NumberOfBins);
  for (std::size_t i = 0; i < Count; ++i)
  {
    expected[i * i % NumberOfBins].push_back(static_cast<int>(i));
    expected[(i + 1) % 5].push_back(static_cast<int>(i));
  }
  Bins<int> bins;
  WithThreads(GetParam(), [&] {
    bins.Fill(Count, NumberOfBins, [&](std::size_t first, std::size_t last, const auto& add) {
      for (std::size_t i = first; i < last; ++i)
      {
        add(i * i % NumberOfBins, static_cast<int>(i));
        add((i + 1) % 5, static_cast<int>(i));
      }
    });
  });
  ASSERT_EQ(bins.GetNumberOfBins(), NumberOfBins);
  for (std::size_t bin = 0; bin < NumberOfBins; ++bin)
  {
    EXPECT_EQ(std::vector<int>(bins.Get(bin), bins.Get(bin) + bins.GetCount(bin)), expected[bin]);
  }
}

INSTANTIATE_TEST_SUITE_P(Threads, WithThreadsTest, testing::Values(1, 2, 5));

TEST(ParallelFor, TheNumberOfThreadsIsBounded)
{
  std::mutex mutex;
  std::set<std::thread::id> threads;
  WithThreads(2, [&] {
    ParallelFor(0, 64, 1, [&](int) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      const std::lock_guard<std::mutex> lock(mutex);
      threads.insert(std::this_thread::get_id());
    });
  });
  EXPECT_LE(threads.size(), 2u);
}

TEST(ParallelFor, PartsCoverTheRange)
{
  for (const std::size_t count : { 0, 1, 999, 1000, 1001, 123457 })
  {
    const std::vector<std::size_t> boundaries = SplitIntoParts(count, 100);
    EXPECT_EQ(boundaries.front(), 0u);
    EXPECT_EQ(boundaries.back(), count);
    for (std::size_t part = 1; part < boundaries.size() && count >= 100; ++part)
    {
      EXPECT_GE(boundaries[part] - boundaries[part - 1], 100u);
    }
  }
  EXPECT_LE(SplitIntoParts(100000000, 1).size(), static_cast<std::size_t>(AutomaticTasks) + 1);
}

}
