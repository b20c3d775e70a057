// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The same scene through a program that a script of Benchmarks/Peers/scripts drives: triangles of even colours,
// their light already in them, so that only what happens at borders differs between programs.
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

/// Writes the file that scripts read. Perspective cameras over black, flat shading.
void WriteFaces(const std::string& path, vtkRenderer* renderer, const BruteForceScene& scene,
  int width, int height);

/// Draws `scene` at one of the peer's settings. Throws std::runtime_error where the program fails.
PeerImage RunImageScript(
  const Peer& peer, const std::string& scene, const std::string& setting, int width, int height);

}
#endif
