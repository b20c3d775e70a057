// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Every row of the failure catalogue keeps its bound, and would not without what it guards.
#include "PublishedLimitations.h"
#include "Scenario.h"

#include <gtest/gtest.h>

#include <ostream>
#include <set>

using namespace penumbra;

namespace penumbra
{

void PrintTo(const Scenario& row, std::ostream* out)
{
  *out << row.Scene << ", " << row.Motion;
}

}

namespace
{

class Stability : public testing::TestWithParam<Scenario>
{
};

}

TEST_P(Stability, KeepsItsBoundAndWouldNotWithoutItsMechanism)
{
  const Scenario& row = GetParam();
  const std::string metric = TextOf(row.Measured).Name;
  const double ours = row.Measure(Variant::Ours).Value;
  if (row.IsKnownFailure)
  {
    EXPECT_GT(ours, row.Bound) << metric << ": this row is no longer open, say so in its table";
  }
  else
  {
    EXPECT_LE(ours, row.Bound) << metric;
  }
#ifndef __SANITIZE_ADDRESS__ // there it is the code that is watched, not the numbers
  EXPECT_GT(row.Measure(Variant::Ablated).Value, row.Bound)
    << metric << ": " << row.AblatedMechanism;
#endif
}

TEST(Catalogue, HasARowForEveryPublishedWeakness)
{
  std::set<std::string> published;
  for (const PublishedLimitation& weakness : PublishedWeaknesses())
  {
    EXPECT_TRUE(published.insert(weakness.Source).second) << weakness.Source;
  }
  std::set<std::string> guarded;
  for (const Scenario& row : Catalogue())
  {
    if (!row.Source.empty())
    {
      guarded.insert(row.Source);
    }
  }
  EXPECT_EQ(guarded, published);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, Stability, testing::ValuesIn(Catalogue()),
  [](const testing::TestParamInfo<Scenario>& row) { return row.param.Name; });
