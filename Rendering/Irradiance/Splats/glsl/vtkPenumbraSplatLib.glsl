// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Records as a texture, see RecordSplatter.cxx: each has some texels in a row; rows that are full are
// followed by further columns.
uniform sampler2D records;
uniform int rows;
uniform int texels; // a record

vec4 texelOf(int record, int texel)
{
  return texelFetch(records, ivec2(record / rows * texels + texel, record % rows), 0);
}
