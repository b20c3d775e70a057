// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Renders the same scene with a peer program, driven by a script in Benchmarks/Peers/scripts. The
// triangles have constant, already shaded colors, so that the images differ only in their
// antialiasing.
#ifndef penumbra_TriangleScene_h
#define penumbra_TriangleScene_h

#include "BruteForce/BruteForce.h"
#include "Peers.h"

#include <string>
#include <vector>

class vtkRenderer;

namespace penumbra
{

struct PeerImage
{
  std::vector<glm::dvec3> Colors;
  double Seconds = 0.0; ///< CPU seconds of drawing, as the script measures them
  double SamplesPerPixel = 0.0;
};

/// Writes the scene file that the scripts read. Requires a perspective camera, a black background
/// and flat shading.
void WriteFaces(const std::string& path, vtkRenderer* renderer, const BruteForceScene& scene,
  int width, int height);

/// Renders `scene` at one of the peer's settings. Throws std::runtime_error if the program fails.
PeerImage RunImageScript(
  const Peer& peer, const std::string& scene, const std::string& setting, int width, int height);

}
#endif
