//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The number of the triangle and its depth along the face's axis. Depths are compared by their inverse,
// which floats hold as well far away as nearby.
uniform float near;

flat in float number;

void main()
{
  gl_FragData[0] = vec4(number, 1.0 / gl_FragCoord.w, 0.0, 1.0);
  gl_FragDepth = near * gl_FragCoord.w;
}
