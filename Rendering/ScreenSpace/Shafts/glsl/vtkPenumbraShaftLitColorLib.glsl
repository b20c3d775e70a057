// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The lit share from what glows: a colour, of one light alone.
vec3 litBy(int number, vec3 share)
{
  return share;
}
