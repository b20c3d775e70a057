// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lit fractions of the depth march: one component per light of the group.
vec3 litFraction(int number, vec3 fractions)
{
  return vec3(fractions[number]);
}
