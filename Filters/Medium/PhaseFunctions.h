// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The functions of PhaseFunctions.glsl in C++.
#ifndef penumbra_PhaseFunctions_h
#define penumbra_PhaseFunctions_h

#include <algorithm>
#include <cmath>

namespace penumbra
{

using std::max;
using std::sqrt;

#define FUNCTION inline double
#define NUMBER double
#include "PhaseFunctions.glsl"
#undef NUMBER
#undef FUNCTION

}
#endif
