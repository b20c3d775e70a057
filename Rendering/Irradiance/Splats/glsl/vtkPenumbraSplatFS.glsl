//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What one record says about a pixel's surface, times its weight [IC, after Tabellion, Lamorlette], to be
// added up: the same as penumbra::Record::Weight() and penumbra::Blend::Add(), offsets, turns and
// gradients along two tangents of the pixel's surface. Outputs: 0 the value halfway along the gradient
// and the weight; 1 offset and turn; from 2 on, for each channel, translation and rotation.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::SplatLib
uniform sampler2D surfaces;  // unit normal, eye depth
uniform mat3 eyeToRecords;   // of lengths
uniform mat3 normalToRecords;
uniform float normalFactor;  // 9.0124 for 9.0 degrees
uniform int channels;

flat in int record;
flat in vec3 middle;

// Distance of the wall in the direction (x, y) of the record's tangent plane.
float clearance(float x, float y)
{
  bool steep = abs(y) > abs(x);
  int sector = (y < 0.0 ? 4 : 0) + ((x < 0.0) != (y < 0.0) ? 2 : 0) +
    (steep != ((x < 0.0) != (y < 0.0)) ? 1 : 0);
  return texelOf(record, 3 + sector / 4)[sector % 4];
}

float weightOf(vec3 d, vec3 normal, vec4 own, float radius)
{
  float error = max(length(d) / radius, normalFactor * sqrt(max(0.0, 1.0 - dot(normal, own.xyz))));
  bool off = abs(dot(d, normal + own.xyz)) > 2.0 * own.w;
  vec4 tangent = texelOf(record, 2);
  vec2 way = vec2(dot(d, tangent.xyz), dot(d, cross(own.xyz, tangent.xyz)));
  bool behindWall = length(way) > clearance(way.x, way.y);
  return error < 1.0 && !off && !behindWall ? tangent.w * (1.0 - error) : 0.0;
}

// From the record to what lies along the two tangents.
vec2 along(mat2x3 tangents, vec3 v)
{
  return v * tangents;
}

void main()
{
  vec4 surface = texelFetch(surfaces, ivec2(gl_FragCoord.xy), 0);
  vec3 d = eyeToRecords * (eyePosition(gl_FragCoord.xy, surface.a) - middle);
  vec4 sphere = texelOf(record, 0);
  if (dot(d, d) >= sphere.w * sphere.w)
  {
    discard;
  }
  vec3 normal = normalize(normalToRecords * surface.rgb);
  vec4 own = texelOf(record, 1);
  float weight = weightOf(d, normal, own, sphere.w);
  if (weight <= 0.0)
  {
    discard;
  }
  vec3 other = abs(normal.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
  vec3 first = normalize(cross(normal, other));
  mat2x3 tangents = mat2x3(first, cross(normal, first));
  vec4 way = vec4(along(tangents, d), along(tangents, normal - own.xyz));
  vec4 halfway = vec4(texelOf(record, 5).rgb, 1.0);
  vec4 slopes[3] = vec4[3](vec4(0.0), vec4(0.0), vec4(0.0));
  for (int c = 0; c < channels; ++c)
  {
    slopes[c] = vec4(along(tangents, texelOf(record, 6 + 2 * c).xyz),
      along(tangents, texelOf(record, 7 + 2 * c).xyz));
    halfway[c] += 0.5 * dot(slopes[c], way);
  }
  gl_FragData[0] = weight * halfway;
  gl_FragData[1] = weight * way;
  gl_FragData[2] = weight * slopes[0];
  gl_FragData[3] = weight * slopes[1];
  gl_FragData[4] = weight * slopes[2];
}
