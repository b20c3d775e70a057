// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Instead of vtkPenumbraEstimateLib: an estimate that an estimator has drawn already.
uniform sampler2D estimates;

float estimateAt(SurfacePoint point)
{
  return texture(estimates, point.pixel * pixelSize).r;
}
