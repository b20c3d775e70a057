// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Replaces vtkPenumbraEstimateLib if new samples are added after the history was reprojected.
//VTK::Penumbra::HistoryLengthLib

float estimateAt(SurfacePoint point, int historyLength)
{
  return 0.0;
}

float newSamplesAt(SurfacePoint point, int historyLength)
{
  return 0.0;
}
