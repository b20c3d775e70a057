// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Settings that are no numbers: VTK's clamps let NaN pass.
#ifndef penumbra_NaNCheck_h
#define penumbra_NaNCheck_h

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <string>

namespace penumbra
{

/// Throws std::runtime_error where one of `numbers` is NaN; `names` are theirs, in words.
inline void RequireNotNaN(const std::string& names, std::initializer_list<double> numbers)
{
  if (std::any_of(numbers.begin(), numbers.end(), [](double n) { return std::isnan(n); }))
  {
    throw std::runtime_error(names + " must be numbers, one of them is NaN.");
  }
}

}
#endif
