// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Weight of a neighbor in the filter of occlusion [TSSAO eq. 10-11]. Departures: the fewer samples
// a pixel has, the wider its filter; neighbors off its tangent plane have less weight.
uniform float distanceInPixels; // minimum distance at which the weight is 1/e, in pixel widths

// So inSpace where a pixel has one sample; its square shrinks as samples come. Measured with
// planeWidth, for rays: `./penumbra benchmark ambient-occlusion --only traced`.
const float maximumWidth = 12.0;

// Distance from the tangent plane of the pixel at which the weight is 1/e, in pixel widths.
const float planeWidth = 1.0;

// `delta`: offset of the neighbor. `inPlane`: its offset if it were on the tangent plane of the
// pixel.
float neighborWeight(vec3 delta, vec3 inPlane, float samples, float pixelWidth)
{
  float width = clamp(maximumWidth / sqrt(max(samples, 1.0)), distanceInPixels, maximumWidth);
  vec3 inSpace = delta / (width * pixelWidth);
  vec3 fromPlane = (delta - inPlane) / (planeWidth * pixelWidth);
  return exp(-dot(inSpace, inSpace) - dot(fromPlane, fromPlane));
}
