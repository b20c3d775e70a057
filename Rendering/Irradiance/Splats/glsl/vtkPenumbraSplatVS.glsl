//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Renders one record as a rectangle that covers its sphere, at the depth of the far side of the
// sphere. With the depth test GL_GREATER, only pixels whose surface is in front of that depth are
// shaded. Four vertices form a triangle strip.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::SplatLib
uniform mat4 recordsToEye;
uniform float unitScale; // length of one record unit in eye coordinates

flat out int record;
flat out vec3 center; // of the sphere, in eye coordinates

// Bounds in plane coordinates of the interval [low, high] at distances in [near, far].
vec2 projectInterval(float low, float high, float near, float far)
{
  return vec2(low / (low > 0.0 ? far : near), high / (high > 0.0 ? near : far));
}

float toBufferDepth(float eyeDepth)
{
  float q = perspective > 0.5 ? 1.0 / eyeDepth : eyeDepth;
  return clamp(1.0 - (q - depthToEye.x) / depthToEye.y, 0.0, 1.0);
}

void main()
{
  record = gl_InstanceID;
  vec4 sphere = recordTexel(record, 0);
  float radius = unitScale * sphere.w;
  center = (recordsToEye * vec4(sphere.xyz, 1.0)).xyz;
  float near = perspective > 0.5 ? -center.z - radius : 1.0;
  float far = perspective > 0.5 ? -center.z + radius : 1.0;
  vec2 corner = vec2(float(gl_VertexID % 2), float(gl_VertexID / 2));
  vec2 position = 2.0 * corner - 1.0; // the camera is inside the sphere: the whole image
  if (near > 0.0)
  {
    vec2 x = projectInterval(center.x - radius, center.x + radius, near, far);
    vec2 y = projectInterval(center.y - radius, center.y + radius, near, far);
    vec2 plane = vec2(mix(x.x, x.y, corner.x), mix(y.x, y.y, corner.y));
    position = 2.0 * pixelOffsetOnPlane(plane - pixelToEye.zw) * pixelSize - 1.0;
  }
  float farDepth = toBufferDepth((-center.z + radius) * 1.0001);
  // Spheres behind the camera are moved out of the image.
  gl_Position = far > 0.0 ? vec4(position, 2.0 * farDepth - 1.0, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
