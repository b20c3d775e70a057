// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes made to cost as much as they can: of `n` primitives, the same at every call, between -1 and 1.
#ifndef penumbra_Adversaries_h
#define penumbra_Adversaries_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkPolyData;

namespace penumbra
{

struct Adversary
{
  std::string Name;
  vtkSmartPointer<vtkPolyData> (*Make)(int n);
};

/// Slivers in one place, clusters of triangles smaller than pixels, hair, streamlines, soup, fans with
/// and without shared corners, poles, a polygon like a comb, copies in one place.
const std::vector<Adversary>& Adversaries();

/// The one of that name; null when there is none.
const Adversary* FindAdversary(const std::string& name);

}
#endif
