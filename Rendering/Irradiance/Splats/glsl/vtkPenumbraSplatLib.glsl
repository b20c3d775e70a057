// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Reads the record texture, see RecordSplatter.cxx. The texels of a record are consecutive in one
// row. If there are more records than rows, further records follow in the next columns.
uniform sampler2D records;
uniform int rows;
uniform int texels; // texels per record

vec4 recordTexel(int record, int texel)
{
  return texelFetch(records, ivec2(record / rows * texels + texel, record % rows), 0);
}
