//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Writes the triangle id and the depth along the axis of the face. The depth test compares inverse
// depths, which have the same relative precision at all distances.
uniform float near;

flat in float triangleId;

void main()
{
  gl_FragData[0] = vec4(triangleId, 1.0 / gl_FragCoord.w, 0.0, 1.0);
  gl_FragDepth = near * gl_FragCoord.w;
}
