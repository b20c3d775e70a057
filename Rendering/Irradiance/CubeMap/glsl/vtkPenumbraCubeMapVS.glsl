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

flat out float triangleId;

void main()
{
  triangleId = vertex.w;
  vec3 offset = vertex.xyz - eye;
  float depth = dot(forward, offset);
  gl_Position = vec4(dot(right, offset), dot(up, offset), depth - 2.0 * near, depth);
}
