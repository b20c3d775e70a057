//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Converts the depth buffer to eye depth, the distance along the view axis.
//VTK::Penumbra::ViewLib
uniform sampler2D depthBuffer;

void main()
{
  gl_FragData[0] = vec4(eyeDepthOfBuffer(texture(depthBuffer, gl_FragCoord.xy * pixelSize).r));
}
