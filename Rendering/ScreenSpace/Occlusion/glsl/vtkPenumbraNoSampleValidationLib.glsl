// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Instead of vtkPenumbraSampleValidationLib: all of the history is trusted.
float neighbourTrust(SurfacePoint point, vec3 before)
{
  return maximumWeight;
}
