// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A medium with the same density everywhere: columns are lengths.
float densityAt(vec3 point)
{
  return 1.0;
}

float decayAlong(vec3 direction)
{
  return 0.0;
}

float columnAlong(float density, float decay, float span)
{
  return span;
}

float lengthOfColumn(ViewRay ray, float column)
{
  return column;
}
