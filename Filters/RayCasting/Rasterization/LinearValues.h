// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Functions of values that are linear in a pixel.
#ifndef penumbra_LinearValues_h
#define penumbra_LinearValues_h

#include "Tiles/ScreenTriangle.h"

#include <algorithm>

namespace penumbra
{

inline double Evaluate(const LinearValue<double>& f, glm::dvec2 p)
{
  return f.Value + f.SlopeX * p.x + f.SlopeY * p.y;
}

/// Returns the value relative to the origin `p`, minus `offset`.
inline LinearValue<float> MoveTo(const LinearValue<double>& f, glm::dvec2 p, double offset)
{
  return { static_cast<float>(Evaluate(f, p) - offset), static_cast<float>(f.SlopeX),
    static_cast<float>(f.SlopeY) };
}

/// Returns the minimum in the unit square.
inline float FindMinimum(const LinearValue<float>& f)
{
  return f.Value + std::min(f.SlopeX, 0.f) + std::min(f.SlopeY, 0.f);
}

/// Returns the maximum in the unit square.
inline float FindMaximum(const LinearValue<float>& f)
{
  return f.Value + std::max(f.SlopeX, 0.f) + std::max(f.SlopeY, 0.f);
}

}
#endif
