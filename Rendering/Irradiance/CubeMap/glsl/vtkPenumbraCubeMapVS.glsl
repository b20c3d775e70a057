//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Projects vertices onto one face of a cube around `eye`, with a near plane and an infinite far
// plane.
in vec4 vertex; // position in scene coordinates, and the id of its triangle

uniform vec3 eye;
uniform vec3 right;
uniform vec3 up; // scaled so that the face fills its viewport
uniform vec3 forward;
uniform float near;
uniform vec3 normal; // axis of the hemicube
uniform vec3 geometricNormal; // of the triangle at `eye`

// Smallest height over the two planes of `eye`, as a fraction of the distance. Heights are rounded by less. Without it,
// the plane around `eye` could be rounded above `eye` and, clipped at the near plane, cover directions far from it.
const float lowest = 2.5e-7;

flat out float triangleId;

void main()
{
  triangleId = vertex.w;
  vec3 offset = vertex.xyz - eye;
  float depth = dot(forward, offset);
  gl_Position = vec4(dot(right, offset), dot(up, offset), depth - 2.0 * near, depth);
  float least = lowest * length(offset);
  gl_ClipDistance[0] = dot(normal, offset) - least;
  gl_ClipDistance[1] = dot(geometricNormal, offset) - least;
}
