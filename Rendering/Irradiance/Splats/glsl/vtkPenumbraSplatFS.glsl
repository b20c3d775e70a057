//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Extrapolates one record to the surface of a pixel, multiplied by its weight [IC, after Tabellion,
// Lamorlette]. Blending sums the outputs. The computation equals penumbra::Record::Weight() and
// penumbra::RecordInterpolator::Add(); offsets, normal differences and gradients are expressed
// along two tangents of the surface. Outputs: 0 value at the midpoint and weight; 1 offset and
// normal difference; from 2, for each channel, translation and rotation gradient.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::SplatLib
uniform sampler2D surfaces;  // unit normal, eye depth
uniform mat3 eyeToRecords;   // transforms offsets
uniform mat3 normalToRecords;
uniform float normalFactor;  // RecordOctree::ComputeNormalFactor(); 9.0124 for 9.0 degrees
uniform int channels;

flat in int record;
flat in vec3 center;

// Distance to the nearest wall in the direction (x, y) of the tangent plane of the record.
float clearance(float x, float y)
{
  bool steep = abs(y) > abs(x);
  int sector = (y < 0.0 ? 4 : 0) + ((x < 0.0) != (y < 0.0) ? 2 : 0) +
    (steep != ((x < 0.0) != (y < 0.0)) ? 1 : 0);
  return recordTexel(record, 3 + sector / 4)[sector % 4];
}

// d: offset from the record; recordPlane: its normal and maximum plane distance.
float computeWeight(vec3 d, vec3 normal, vec4 recordPlane, float radius)
{
  float error =
    max(length(d) / radius, normalFactor * sqrt(max(0.0, 1.0 - dot(normal, recordPlane.xyz))));
  bool offPlane = abs(dot(d, normal + recordPlane.xyz)) > 2.0 * recordPlane.w;
  vec4 tangent = recordTexel(record, 2);
  vec2 offset = vec2(dot(d, tangent.xyz), dot(d, cross(recordPlane.xyz, tangent.xyz)));
  bool behindWall = length(offset) > clearance(offset.x, offset.y);
  return error < 1.0 && !offPlane && !behindWall ? tangent.w * (1.0 - error) : 0.0;
}

// Components of a vector along the two tangents of the surface.
vec2 surfaceDerivative(mat2x3 tangents, vec3 v)
{
  return v * tangents;
}

void main()
{
  vec4 surface = texelFetch(surfaces, ivec2(gl_FragCoord.xy), 0);
  vec3 d = eyeToRecords * (eyePosition(gl_FragCoord.xy, surface.a) - center);
  vec4 sphere = recordTexel(record, 0);
  if (dot(d, d) >= sphere.w * sphere.w)
  {
    discard;
  }
  vec3 normal = normalize(normalToRecords * surface.rgb);
  vec4 recordPlane = recordTexel(record, 1);
  float weight = computeWeight(d, normal, recordPlane, sphere.w);
  if (weight <= 0.0)
  {
    discard;
  }
  vec3 other = abs(normal.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
  vec3 first = normalize(cross(normal, other));
  mat2x3 tangents = mat2x3(first, cross(normal, first));
  vec4 offset =
    vec4(surfaceDerivative(tangents, d), surfaceDerivative(tangents, normal - recordPlane.xyz));
  vec4 midpointValue = vec4(recordTexel(record, 5).rgb, 1.0);
  vec4 gradients[3] = vec4[3](vec4(0.0), vec4(0.0), vec4(0.0));
  for (int c = 0; c < channels; ++c)
  {
    gradients[c] = vec4(surfaceDerivative(tangents, recordTexel(record, 6 + 2 * c).xyz),
      surfaceDerivative(tangents, recordTexel(record, 7 + 2 * c).xyz));
    midpointValue[c] += 0.5 * dot(gradients[c], offset);
  }
  gl_FragData[0] = weight * midpointValue;
  gl_FragData[1] = weight * offset;
  gl_FragData[2] = weight * gradients[0];
  gl_FragData[3] = weight * gradients[1];
  gl_FragData[4] = weight * gradients[2];
}
