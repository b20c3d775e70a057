// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// How much a neighbour counts in the filter of occlusion [TSSAO eq. 10-11]. Departures: the fewer samples
// a pixel has, the farther it looks, where neighbours lie in one plane with it.
uniform float distanceInPixels; // a neighbour this many pixel widths away in space counts 1/e

// So far where a pixel has one sample; its square shrinks as samples come. Measured with offPlane, for
// rays: `./penumbra benchmark ambient-occlusion --only traced`.
const float farthest = 12.0;

// A neighbour this many pixel widths off the plane through the pixel counts 1/e.
const float offPlane = 1.0;

// `apart`: the way to the neighbour, `inPlane`: what it would be in the plane through the pixel.
float neighbourWeight(vec3 apart, vec3 inPlane, float samples, float pixelWidth)
{
  float width = clamp(farthest / sqrt(max(samples, 1.0)), distanceInPixels, farthest);
  vec3 far = apart / (width * pixelWidth);
  vec3 off = (apart - inPlane) / (offPlane * pixelWidth);
  return exp(-dot(far, far) - dot(off, off));
}
