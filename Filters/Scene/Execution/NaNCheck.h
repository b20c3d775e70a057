// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Rejects NaN settings, which VTK's clamp macros let through.
#ifndef penumbra_NaNCheck_h
#define penumbra_NaNCheck_h

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <string>

namespace penumbra
{

/// Throws std::runtime_error if one of `numbers` is NaN. `names` lists the settings for the
/// message.
inline void RequireNotNaN(const std::string& names, std::initializer_list<double> numbers)
{
  if (std::any_of(numbers.begin(), numbers.end(), [](double n) { return std::isnan(n); }))
  {
    throw std::runtime_error(names + " must not be NaN.");
  }
}

}
#endif
