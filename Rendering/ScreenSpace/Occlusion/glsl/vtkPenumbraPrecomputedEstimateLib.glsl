// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Replaces vtkPenumbraEstimateLib if an estimator has already written its estimates to a texture.
uniform sampler2D estimates;
uniform float newSamples; // in every estimate

float estimateAt(SurfacePoint point, bool hasShortHistory)
{
  return texture(estimates, point.pixel * pixelSize).r;
}

float newSamplesAt(bool hasShortHistory)
{
  return newSamples;
}
