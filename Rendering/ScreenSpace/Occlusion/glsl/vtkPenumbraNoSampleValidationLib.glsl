// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Replaces vtkPenumbraSampleValidationLib if nothing but the camera moved: the history keeps its
// weight.
float historyWeightLimit(SurfacePoint point, vec3 before)
{
  return maximumWeight;
}
