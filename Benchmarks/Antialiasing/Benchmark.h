// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The parts of the antialiasing benchmark. Each adds its results to the table.
#ifndef penumbra_Benchmark_h
#define penumbra_Benchmark_h

#include "BruteForce/ImageErrors.h"
#include "ResultTable.h"
#include "Scenes/TestScene.h"

#include <string>
#include <vector>

namespace penumbra
{

struct Benchmark
{
  std::string Meshes;    ///< folder with the .off files of Debian's libcgal-demo
  std::string Output;    ///< folder for results, images and POV-Ray's scene files
  std::string PovRay;    ///< program; empty: no comparison with it
  int TruthSamples = 64; ///< per side of a pixel, for lit scenes
  bool Peers = true;     ///< compare times with uniform supersampling and POV-Ray
  bool Diagnose = false; ///< also write error images and lists of the worst pixels
  ResultTable Results;
  ErrorCalibration Estimates; ///< over all scenes at their default tolerance

  std::string MeshFile(const std::string& name) const { return this->Meshes + "/" + name + ".off"; }
};

/// Half-plane, disc, small discs, rods, comb and star: unlit, against exact coverage.
void MeasureFlatShapes(Benchmark& benchmark);

/// Dragon and elephant: lit, against brute force, uniform supersampling and POV-Ray.
void MeasureLitMeshes(Benchmark& benchmark);

/// 830 thousand triangles in 64 x 64 pixels.
void MeasureDenseMesh(Benchmark& benchmark);

/// Packets of 16 rays against single rays, shaded.
void MeasureBasePass(Benchmark& benchmark);

/// Memory: a mesh of 10 million triangles; 1,000 images in one process.
void MeasureMemory(Benchmark& benchmark);

/// Compares a result with its reference, records the quality of its error estimates, and writes
/// diagnostics if requested.
Errors Judge(Benchmark& benchmark, const std::string& scene, const Answer& answer,
  const std::vector<glm::dvec3>& truth, const std::vector<bool>& isEdge, int width);

}
#endif
