// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Replaces vtkPenumbraEstimateLib if an estimator has already written its estimates to a texture.
uniform sampler2D estimates;

float estimateAt(SurfacePoint point)
{
  return texture(estimates, point.pixel * pixelSize).r;
}
