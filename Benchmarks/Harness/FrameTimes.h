// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Cost of frames relative to plain frames that are rendered alternately with them.
#ifndef penumbra_FrameTimes_h
#define penumbra_FrameTimes_h

#include <vector>

namespace penumbra
{

/// Median of the difference between each frame and the plain frame of its round, in seconds. Both
/// are affected equally if the machine is slow for a while. @pre both vectors have the same,
/// nonzero size
double MedianOverhead(const std::vector<double>& frames, const std::vector<double>& plain);

/// Median of the ratios of the same frames.
double MedianQuotient(const std::vector<double>& frames, const std::vector<double>& plain);

double Median(std::vector<double> values);

}
#endif
