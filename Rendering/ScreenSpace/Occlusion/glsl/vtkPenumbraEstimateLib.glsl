// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A few new samples of ambient occlusion at a surface point [TSSAO eq. 2]: the mean of what the kernel
// says of them. Departures: all pixels use the same run of the Halton sequence, turned and shifted
// by a function of the pixel, so that no index has to be stored or interpolated.
uniform vec4 samples[64]; // Halton points in [0, 1)^4
uniform int sampleCount;       // at most 64
uniform float pixelRotation;   // 1: turned from pixel to pixel; 0: all pixels alike
uniform float thickness;       // of what is seen, in radii

const float pi = 3.14159265;

// A number in [0, 1) that differs much between neighbours [Jimenez 2014, interleaved gradient noise].
float pixelNoise(vec2 pixel)
{
  return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
}

// The point of the sequence as this pixel uses it.
vec4 pixelSample(int index, vec2 pixel)
{
  vec2 at = floor(pixel);
  vec4 shift = vec4(
    pixelNoise(at), pixelNoise(at.yx + 17.0), pixelNoise(at + 61.0), pixelNoise(at.yx + 89.0));
  return fract(samples[index] + pixelRotation * shift);
}

// The pixels over which a length of one radius reaches at a point.
vec2 radiusInPixels(SurfacePoint point)
{
  return 1.0 / (pixelToEye.xy * mix(1.0, -point.position.z, perspective));
}

//VTK::Penumbra::Kernel

// What one slice can hold of the hemisphere's mean, where the normal is tilted. Estimates are not cut
// at 1: the mean of many would fall short.
const float mostOfASlice = 0.5 * pi;

float estimateAt(SurfacePoint point)
{
  return clamp(occlusionAt(point), 0.0, mostOfASlice);
}
