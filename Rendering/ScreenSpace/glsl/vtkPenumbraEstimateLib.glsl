// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Estimate of ambient occlusion at a surface point: the mean of a few new samples [TSSAO eq. 2].
// Departure: all pixels use the same range of the Halton sequence, shifted by a function of the
// pixel, so that no index has to be stored or interpolated.
uniform vec4 samples[64];           // Halton points in [0, 1)^4
uniform int sampleCount;            // number of points, at most 64
uniform int shortHistoryPointCount; // the same at pixels with a short history
uniform int settledFirstPoint;      // index of the first point at pixels with a settled history
uniform float turns;                // number of frames in which all of them have one turn
uniform float turn;                 // the turn of this frame, in [0, turns)
uniform float samplesPerPoint;      // weight of a point in the history
uniform float pixelRotation;        // 1: a different shift per pixel; 0: no shift
uniform float thickness;            // of visible objects, in radii

const float pi = 3.14159265;

//VTK::Penumbra::HistoryLengthLib

// Width and height of a block of pixels that have the same turn. Drivers execute neighboring pixels
// together, so only whole blocks without samples save time.
const float turnBlockSide = 4.0;

// Whether the pixel uses the points for a settled history.
bool usesSettledPoints = false;

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
  // The index is the same for all pixels, so that drivers fetch each point once.
  vec4 point = usesSettledPoints ? samples[settledFirstPoint + index] : samples[index];
  return fract(point + pixelRotation * shift);
}

// Returns an offset of one radius in a direction of the image plane at a point, in pixels.
vec2 radiusInPixels(SurfacePoint point, vec2 direction)
{
  return pixelOffsetOnPlane(direction / mix(1.0, -point.position.z, perspective));
}

// Kernels define occlusionAt(), the mean over a number of points, 1 or more. Their loops test the
// number after each point: some drivers execute the body of a loop once more, without effect, if the
// condition comes first. Their cost: Benchmarks/notes/ambient-occlusion.md.
//VTK::Penumbra::QualityLib
//VTK::Penumbra::Kernel

// Largest occlusion that one slice can return; it exceeds 1 if the normal is tilted from the view
// direction. Estimates are not clamped to 1, because the mean over many slices would be biased.
const float maximumSliceOcclusion = 0.5 * pi;

// Returns whether this frame is the turn of a pixel.
bool hasTurn(vec2 pixel)
{
  vec2 block = floor(pixel / turnBlockSide);
  float index = block.x + floor(0.5 * turns) * block.y;
  float turnOfBlock = turns * fract((index + 0.5) / turns);
  return abs(turnOfBlock - (turn + 0.5)) < 0.5;
}

// Returns the number of points for a pixel.
int pointCountAt(vec2 pixel, int historyLength)
{
  int count = historyLength == shortHistory ? shortHistoryPointCount : sampleCount;
  return historyLength == settledHistory && !hasTurn(pixel) ? 0 : count;
}

// Returns the mean of the new samples, or 0 if there are none.
float estimateAt(SurfacePoint point, int historyLength)
{
  int count = pointCountAt(point.pixel, historyLength);
  usesSettledPoints = historyLength == settledHistory;
  float estimate = 0.0;
  if (count > 0)
  {
    estimate = clamp(occlusionAt(point, count), 0.0, maximumSliceOcclusion);
  }
  return estimate;
}

// Returns the number of samples that estimateAt() averages.
float newSamplesAt(SurfacePoint point, int historyLength)
{
  return samplesPerPoint * float(pointCountAt(point.pixel, historyLength));
}
