// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lit shares from depth: one number for each light.
vec3 litBy(int number, vec3 shares)
{
  return vec3(shares[number]);
}
