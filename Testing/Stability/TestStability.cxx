// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Tests that every row of the failure catalogue keeps its bound, and exceeds it when the mechanism
// that it guards is disabled.
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

TEST_P(Stability, KeepsBoundOnlyWithItsMechanism)
{
  const Scenario& row = GetParam();
  const std::string metric = TextOf(row.Measured).Name;
  const double value = row.Measure(Variant::Ours).Value;
  if (row.IsKnownFailure)
  {
    EXPECT_GT(value, row.Bound) << metric
                                << ": the row keeps its bound now; remove IsKnownFailure from it";
  }
  else
  {
    EXPECT_LE(value, row.Bound) << metric;
  }
#ifndef __SANITIZE_ADDRESS__ // skipped to save time: AddressSanitizer checks the code, not numbers
  EXPECT_GT(row.Measure(Variant::Ablated).Value, row.Bound)
    << metric << ": " << row.AblatedMechanism;
#endif
}

TEST(Catalogue, HasARowForEveryPublishedLimitation)
{
  std::set<std::string> published;
  for (const PublishedLimitation& limitation : PublishedWeaknesses())
  {
    EXPECT_TRUE(published.insert(limitation.Source).second) << limitation.Source;
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
