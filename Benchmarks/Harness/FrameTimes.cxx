// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FrameTimes.h"

#include <algorithm>
#include <cstddef>
#include <functional>

namespace penumbra
{

namespace
{

double MedianOfPairs(const std::vector<double>& frames, const std::vector<double>& plain,
  const std::function<double(double, double)>& compare)
{
  std::vector<double> values(frames.size());
  std::transform(frames.begin(), frames.end(), plain.begin(), values.begin(), compare);
  return Median(values);
}

}

double MedianOverhead(const std::vector<double>& frames, const std::vector<double>& plain)
{
  return MedianOfPairs(frames, plain, std::minus<double>());
}

double MedianQuotient(const std::vector<double>& frames, const std::vector<double>& plain)
{
  return MedianOfPairs(frames, plain, std::divides<double>());
}

double Median(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}
