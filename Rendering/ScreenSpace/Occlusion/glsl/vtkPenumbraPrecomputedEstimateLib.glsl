// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Replaces vtkPenumbraEstimateLib if an estimator has already written its estimates to a texture.
uniform sampler2D estimates;
uniform float newSamples; // in every estimate

//VTK::Penumbra::HistoryLengthLib

float estimateAt(SurfacePoint point, int historyLength)
{
  return texture(estimates, point.pixel * pixelSize).r;
}

float newSamplesAt(SurfacePoint point, int historyLength)
{
  return newSamples;
}
