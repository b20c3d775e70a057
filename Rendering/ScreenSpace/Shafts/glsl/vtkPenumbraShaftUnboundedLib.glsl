// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A medium without bounds.

// Lengths at which a ray of length `end` enters and leaves the medium.
vec2 clipToMedium(vec3 start, vec3 direction, float end)
{
  return vec2(0.0, end);
}

// Length inside the medium of the path from a point in it to a light at distance `lightDistance`.
float lengthInMedium(vec3 point, vec3 toLight, float lightDistance)
{
  return lightDistance;
}
