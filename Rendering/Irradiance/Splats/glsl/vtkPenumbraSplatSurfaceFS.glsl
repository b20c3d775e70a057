//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The visible surface from eye depths: rgb its unit normal towards the eye, in eye coordinates, a its
// eye depth. Along rows and along columns three pixels are taken that lie in one plane, if there are any:
// two on one side of this one, or one on each.
//VTK::Penumbra::ViewLib
uniform sampler2D eyeDepths;

float eyeDepthAt(vec2 pixel)
{
  vec2 at = pixel * pixelSize;
  bool inside = all(greaterThan(at, vec2(0.0))) && all(lessThan(at, vec2(1.0)));
  return inside ? texture(eyeDepths, at).r : farAway;
}

// What is linear in pixels over a plane.
float linearDepth(float eyeDepth)
{
  return perspective > 0.5 ? 1.0 / eyeDepth : eyeDepth;
}

// How far three pixels in a row are from one plane.
float bend(vec3 depths)
{
  vec3 q = vec3(linearDepth(depths.x), linearDepth(depths.y), linearDepth(depths.z));
  return abs(q.x - 2.0 * q.y + q.z);
}

// Along the surface, `way` being one pixel.
vec3 along(vec2 pixel, vec2 way, float here)
{
  vec2 behind = vec2(eyeDepthAt(pixel - 2.0 * way), eyeDepthAt(pixel - way));
  vec2 ahead = vec2(eyeDepthAt(pixel + way), eyeDepthAt(pixel + 2.0 * way));
  vec3 bends = vec3(bend(vec3(behind, here)), bend(vec3(behind.y, here, ahead.x)), bend(vec3(here, ahead)));
  vec3 first = eyePosition(pixel - way, behind.y);
  vec3 last = eyePosition(pixel + way, ahead.x);
  if (bends.x < min(bends.y, bends.z))
  {
    first = eyePosition(pixel - 2.0 * way, behind.x);
    last = eyePosition(pixel, here);
  }
  else if (bends.z < bends.y)
  {
    first = eyePosition(pixel, here);
    last = eyePosition(pixel + 2.0 * way, ahead.y);
  }
  return last - first;
}

void main()
{
  vec2 pixel = gl_FragCoord.xy;
  float here = eyeDepthAt(pixel);
  vec3 normal = cross(along(pixel, vec2(1.0, 0.0), here), along(pixel, vec2(0.0, 1.0), here));
  gl_FragData[0] = vec4(normalize(normal), here);
}
