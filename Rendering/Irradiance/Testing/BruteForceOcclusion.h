// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The truth of the screen side: occlusion at the centres of a picture's pixels, by rays from the
// meshes themselves; nothing is taken from a depth buffer.
#ifndef BruteForceOcclusion_h
#define BruteForceOcclusion_h

#include <vector>

class vtkRenderer;

/// Row after row from below; 0 where nothing is seen. A grid of `side` x `side` cosine rays a pixel,
/// within `radius`.
std::vector<float> BruteForceOcclusion(
  vtkRenderer* renderer, int width, int height, double radius, int side);

#endif
