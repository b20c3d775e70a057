// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Order of numbered files: run_2 before run_10.
#ifndef penumbra_NaturalOrder_h
#define penumbra_NaturalOrder_h

#include <string>
#include <vector>

namespace penumbra
{

/// Returns whether `a` precedes `b` if numbers in them are compared by value.
bool PrecedesNaturally(const std::string& a, const std::string& b);

/// Sorts files by the numbers in their names if they are in the order of characters, in which a
/// shell lists them. Any other order is deliberate and kept.
void SortNaturally(std::vector<std::string>& files);

}
#endif
