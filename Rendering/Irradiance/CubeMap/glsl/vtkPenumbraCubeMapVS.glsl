//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A face of a cube about `eye`: everything from `near` on, however far.
in vec4 corner; // position and the number of its triangle, scene coordinates

uniform vec3 eye;
uniform vec3 right;
uniform vec3 up; // brings what is seen to the whole height of the picture
uniform vec3 ahead;
uniform float near;

flat out float number;

void main()
{
  number = corner.w;
  vec3 to = corner.xyz - eye;
  float depth = dot(ahead, to);
  gl_Position = vec4(dot(right, to), dot(up, to), depth - 2.0 * near, depth);
}
