// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A medium whose density falls off exponentially with height, with closed-form columns.
uniform vec4 heightOfPoint; // of points in eye coordinates, above the base, in scale heights

const float maximumExponent = 30.0;
const float endlessColumn = 1e9;

// Relative density at a point.
float densityAt(vec3 point)
{
  return exp(clamp(-dot(heightOfPoint, vec4(point, 1.0)), -2.0 * maximumExponent, maximumExponent));
}

// Rate at which the density decreases along a direction, per unit of length.
float decayAlong(vec3 direction)
{
  return dot(heightOfPoint.xyz, direction);
}

// Integral of the density over the length `span` from a point of this density.
float columnAlong(float density, float decay, float span)
{
  float x = clamp(decay * span, -2.0 * maximumExponent, 2.0 * maximumExponent);
  float column = abs(x) < 1e-3 ? span * (1.0 - 0.5 * x) : (1.0 - exp(-x)) / decay;
  return min(density * column, endlessColumn);
}

// Length along a view ray over which the column is reached; large if it is not.
float lengthOfColumn(ViewRay ray, float column)
{
  float x = ray.decay * column / max(ray.density, 1e-30);
  float span = abs(x) < 1e-3 ? (1.0 + 0.5 * x) * column / max(ray.density, 1e-30)
                             : -log(max(1.0 - x, 1e-13)) / ray.decay;
  return min(span, ray.pathLength);
}
