//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// One record, as a rectangle that covers its sphere, at the depth of the sphere's far side: under
// GL_GREATER only pixels whose surface lies before that are shaded. Four vertices make a strip.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::SplatLib
uniform mat4 recordsToEye;
uniform float stretch; // length in eye coordinates of one unit of the records

flat out int record;
flat out vec3 middle; // of the sphere, eye coordinates

// Plane coordinates of what lies between `low` and `high`, at distances between `near` and `far`.
vec2 spread(float low, float high, float near, float far)
{
  return vec2(low / (low > 0.0 ? far : near), high / (high > 0.0 ? near : far));
}

float bufferDepthOf(float eyeDepth)
{
  float q = perspective > 0.5 ? 1.0 / eyeDepth : eyeDepth;
  return clamp(1.0 - (q - depthToEye.x) / depthToEye.y, 0.0, 1.0);
}

void main()
{
  record = gl_InstanceID;
  vec4 sphere = texelOf(record, 0);
  float radius = stretch * sphere.w;
  middle = (recordsToEye * vec4(sphere.xyz, 1.0)).xyz;
  float near = perspective > 0.5 ? -middle.z - radius : 1.0;
  float far = perspective > 0.5 ? -middle.z + radius : 1.0;
  vec2 corner = vec2(float(gl_VertexID % 2), float(gl_VertexID / 2));
  vec2 at = 2.0 * corner - 1.0; // the eye inside of the sphere: the whole picture
  if (near > 0.0)
  {
    vec2 x = spread(middle.x - radius, middle.x + radius, near, far);
    vec2 y = spread(middle.y - radius, middle.y + radius, near, far);
    vec2 plane = vec2(mix(x.x, x.y, corner.x), mix(y.x, y.y, corner.y));
    at = 2.0 * (plane - pixelToEye.zw) / pixelToEye.xy * pixelSize - 1.0;
  }
  float back = bufferDepthOf((-middle.z + radius) * 1.0001);
  // Behind the eye: outside of the picture.
  gl_Position = far > 0.0 ? vec4(at, 2.0 * back - 1.0, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
