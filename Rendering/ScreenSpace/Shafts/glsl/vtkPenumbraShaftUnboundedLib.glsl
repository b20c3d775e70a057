// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A medium without end.

// Where a ray enters and leaves the medium.
vec2 spanInMedium(vec3 start, vec3 direction, float end)
{
  return vec2(0.0, end);
}

// How much of the way from a point to a light `away` lies in the medium.
float wayInMedium(vec3 point, vec3 towards, float away)
{
  return away;
}
