// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Estimate of ambient occlusion at a surface point: the mean of a few new samples [TSSAO eq. 2].
// Departure: all pixels use the same range of the Halton sequence, shifted by a function of the
// pixel, so that no index has to be stored or interpolated.
uniform vec4 samples[64];           // Halton points in [0, 1)^4
uniform int sampleCount;            // number of points, at most 64
uniform int shortHistoryPointCount; // the same at pixels with a short history
uniform float samplesPerPoint;      // weight of a point in the history
uniform float pixelRotation;        // 1: a different shift per pixel; 0: no shift
uniform float thickness;            // of visible objects, in radii

const float pi = 3.14159265;

// Returns a number in [0, 1) that differs strongly between neighboring pixels
// [Jimenez 2014, interleaved gradient noise].
float pixelNoise(vec2 pixel)
{
  return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
}

// Returns a number in [0, 1) that is independent of pixelNoise() [Roberts, R2 sequence].
float pixelLattice(vec2 pixel)
{
  return fract(dot(pixel, vec2(0.75487767, 0.56984029)));
}

// Returns a point of the sequence, with the shift of the pixel applied. The shifts of two
// dimensions are independent: an offset of the pixel would change pixelNoise() by a constant.
vec4 pixelSample(int index, vec2 pixel)
{
  vec2 at = floor(pixel);
  vec4 shift = vec4(pixelNoise(at), pixelNoise(at.yx + 17.0), pixelLattice(at), pixelLattice(at.yx));
  return fract(samples[index] + pixelRotation * shift);
}

// Returns the radius at a point projected onto the image, in pixels.
vec2 radiusInPixels(SurfacePoint point)
{
  return 1.0 / (pixelToEye.xy * mix(1.0, -point.position.z, perspective));
}

//VTK::Penumbra::Kernel

// Largest occlusion that one slice can return; it exceeds 1 if the normal is tilted from the view
// direction. Estimates are not clamped to 1, because the mean over many slices would be biased.
const float maximumSliceOcclusion = 0.5 * pi;

// Returns the mean of the new samples. Pixels with a short history have more samples.
float estimateAt(SurfacePoint point, bool hasShortHistory)
{
  int count = hasShortHistory ? shortHistoryPointCount : sampleCount;
  return clamp(occlusionAt(point, count), 0.0, maximumSliceOcclusion);
}

// Returns the number of samples that estimateAt() averages.
float newSamplesAt(bool hasShortHistory)
{
  return samplesPerPoint * float(hasShortHistory ? shortHistoryPointCount : sampleCount);
}
