// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lit fraction of the radial blur: one color, for groups of a single light.
vec3 litFraction(int number, vec3 fraction)
{
  return fraction;
}
