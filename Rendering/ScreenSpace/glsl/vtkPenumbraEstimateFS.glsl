//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Estimates ambient occlusion from a few new samples per pixel.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::SurfaceLib
//VTK::Penumbra::EstimateLib

void main()
{
  gl_FragData[0] = vec4(estimateAt(surfaceAt(gl_FragCoord.xy), growingHistory));
}
