// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What frames cost beside plain ones that were drawn in turn with them.
#ifndef penumbra_FrameTimes_h
#define penumbra_FrameTimes_h

#include <vector>

namespace penumbra
{

/// CPU seconds of the calling thread, on which OSMesa draws with one; others may keep the machine busy.
double ThreadSeconds();

/// The median of what each frame took beyond the plain one of its round, seconds. A machine that is slow
/// for a while is so for both. @pre as many of both, at least one
double MedianOverhead(const std::vector<double>& frames, const std::vector<double>& plain);

/// The median of the quotients of the same.
double MedianQuotient(const std::vector<double>& frames, const std::vector<double>& plain);

double Median(std::vector<double> values);

}
#endif
