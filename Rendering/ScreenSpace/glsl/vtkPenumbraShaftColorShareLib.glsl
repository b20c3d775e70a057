// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A lit share from what glows: a colour. rgb: share, a: eye depth.
vec4 foundShare(vec2 texel)
{
  return texture(litShares, texel);
}
