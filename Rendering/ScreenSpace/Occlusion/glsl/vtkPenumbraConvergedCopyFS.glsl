//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Stores a converged frame: r is its depth buffer, g the factor that applies occlusion to its
// colors.
uniform sampler2D depthBuffer;
uniform sampler2D occlusions;
uniform vec2 offset;          // from pixels of the occlusions to those of the target
uniform vec2 targetPixelSize; // 1 / size of the target
uniform vec2 pixelSize;       // 1 / size of the occlusions
uniform float strength;

void main()
{
  float depth = texture(depthBuffer, (gl_FragCoord.xy + offset) * targetPixelSize).r;
  float occlusion = texture(occlusions, gl_FragCoord.xy * pixelSize).r;
  gl_FragData[0] = vec4(depth, depth < 1.0 ? 1.0 - strength * occlusion : 1.0, 0.0, 1.0);
}
