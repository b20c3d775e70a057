// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Keeps NaN and infinity out of the history, where they would remain in all later means.

// Upper bound of sums and counts in the history. Comparisons with NaN are false.
const float largestSum = 1e9;

// Returns sum and number of samples as fetched, or (0, 0) if one of them is not finite.
vec2 finiteHistory(vec2 fetched)
{
  bool isFinite = fetched.r >= 0.0 && fetched.r <= largestSum && fetched.g >= 0.0 &&
    fetched.g <= largestSum;
  return isFinite ? fetched : vec2(0.0);
}

// Returns sum and number of new samples with this mean, or (0, 0) if the mean is not finite.
vec2 finiteSamples(float mean, float number)
{
  bool isFinite = mean >= 0.0 && mean <= largestSum;
  return isFinite ? number * vec2(mean, 1.0) : vec2(0.0);
}
