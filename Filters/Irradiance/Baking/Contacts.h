// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Query points in contact with other polygons. A vertex of a wall on a floor lies in the plane of
// the floor, where its hemisphere is discontinuous: rounding would decide on which side it is. A
// point represents the polygons around it, so its value is the mean of values slightly inside of
// them, weighted by their angles at the point.
#ifndef penumbra_Contacts_h
#define penumbra_Contacts_h

#include "BakeInput.h"

namespace penumbra
{

class RayScene;

/**
 * Moves the query points of `mesh` that other polygons touch into their own polygons. If other
 * polygons separate these, or their normals differ, the query point is replaced by several, one per
 * triangle, with weights. `rays` are of the occluders of `mesh`. Throws Stopped if `progress`
 * requests a stop.
 */
VTKPENUMBRAFILTERSIRRADIANCE_EXPORT void SeparateContacts(
  const RayScene& rays, BakeInput& mesh, const ProgressCallback& progress = {});

}
#endif
