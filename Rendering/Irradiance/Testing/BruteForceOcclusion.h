// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Reference ambient occlusion at pixel centers, by brute-force rays against the meshes, without a
// depth buffer.
#ifndef BruteForceOcclusion_h
#define BruteForceOcclusion_h

#include <vector>

class vtkRenderer;

/// Returns the occlusion per pixel, row by row from the bottom; background is 0. Each pixel traces
/// `side` x `side` stratified cosine-distributed rays of length `radius` (world units).
std::vector<float> ComputeBruteForceOcclusion(
  vtkRenderer* renderer, int width, int height, double radius, int side);

#endif
