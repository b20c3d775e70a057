// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Applies occlusion to a color: all components are multiplied by the same factor, which preserves
// the hue.
uniform float strength;
uniform float lightAwareness; // 0: all colors are darkened equally; 1: full brightness is not darkened

vec3 applyOcclusion(vec3 color, float occlusion)
{
  float brightness = clamp(max(color.r, max(color.g, color.b)), 0.0, 1.0);
  return color * (1.0 - strength * occlusion * (1.0 - lightAwareness * brightness));
}
