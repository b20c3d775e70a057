// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Keeps values that are not finite out of the history: one of them would stay in every later mean.

// The largest sum that a history can hold; comparisons with NaN are false.
const float largestSum = 1e9;

// Sum and number of samples as fetched; (0, 0) if one of the two is not finite.
vec2 soundHistory(vec2 fetched)
{
  bool sound = fetched.r >= 0.0 && fetched.r <= largestSum && fetched.g >= 0.0 &&
    fetched.g <= largestSum;
  return sound ? fetched : vec2(0.0);
}

// Sum and number of new samples with this mean; (0, 0) if the mean is not finite.
vec2 soundSamples(float mean, float number)
{
  bool sound = mean >= 0.0 && mean <= largestSum;
  return sound ? number * vec2(mean, 1.0) : vec2(0.0);
}
