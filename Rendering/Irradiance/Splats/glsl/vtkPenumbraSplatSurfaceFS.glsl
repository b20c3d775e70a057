//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Reconstructs the visible surface from eye depths. rgb: unit normal toward the camera in eye
// coordinates, a: eye depth. Along rows and along columns, the shader uses the three consecutive
// pixels that are closest to a plane: the center and its neighbors, or the center and two pixels on
// one side.
//VTK::Penumbra::ViewLib
uniform sampler2D eyeDepths;

float eyeDepthAt(vec2 pixel)
{
  vec2 coordinates = pixel * pixelSize;
  bool inside = all(greaterThan(coordinates, vec2(0.0))) && all(lessThan(coordinates, vec2(1.0)));
  return inside ? texture(eyeDepths, coordinates).r : farAway;
}

// Depth value that is linear in pixels over a plane.
float linearDepth(float eyeDepth)
{
  return perspective > 0.5 ? 1.0 / eyeDepth : eyeDepth;
}

// Second difference of three consecutive pixels; 0 on a plane.
float secondDifference(vec3 depths)
{
  vec3 q = vec3(linearDepth(depths.x), linearDepth(depths.y), linearDepth(depths.z));
  return abs(q.x - 2.0 * q.y + q.z);
}

// Derivative of the surface position along `offset`, a step of one pixel.
vec3 surfaceDerivative(vec2 pixel, vec2 offset, float center)
{
  vec2 before = vec2(eyeDepthAt(pixel - 2.0 * offset), eyeDepthAt(pixel - offset));
  vec2 after = vec2(eyeDepthAt(pixel + offset), eyeDepthAt(pixel + 2.0 * offset));
  vec3 differences = vec3(secondDifference(vec3(before, center)),
    secondDifference(vec3(before.y, center, after.x)), secondDifference(vec3(center, after)));
  vec3 first = eyePosition(pixel - offset, before.y);
  vec3 last = eyePosition(pixel + offset, after.x);
  if (differences.x < min(differences.y, differences.z))
  {
    first = eyePosition(pixel - 2.0 * offset, before.x);
    last = eyePosition(pixel, center);
  }
  else if (differences.z < differences.y)
  {
    first = eyePosition(pixel, center);
    last = eyePosition(pixel + 2.0 * offset, after.y);
  }
  return last - first;
}

void main()
{
  vec2 pixel = gl_FragCoord.xy;
  float center = eyeDepthAt(pixel);
  vec3 normal = cross(surfaceDerivative(pixel, vec2(1.0, 0.0), center),
    surfaceDerivative(pixel, vec2(0.0, 1.0), center));
  gl_FragData[0] = vec4(normalize(normal), center);
}
