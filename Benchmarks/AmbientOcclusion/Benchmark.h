// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The parts of the ambient occlusion benchmark. Each adds its results to the table.
#ifndef penumbra_AmbientOcclusionBenchmark_h
#define penumbra_AmbientOcclusionBenchmark_h

#include "OcclusionReference.h"
#include "OcclusionWindow.h"
#include "ResultTable.h"
#include "Scenes.h"

#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace penumbra
{

/// Three scanned meshes on a plane; `folder` contains the files of libcgal-demo.
OcclusionTestScene Scans(const std::string& folder);

struct OcclusionBenchmark
{
  std::string Meshes; ///< folder with the .off files of libcgal-demo
  std::string Output; ///< folder for results and images
  std::string Scene;  ///< name of the only scene to measure; empty: all
  bool Diagnose = false;
  int Stride = 4; ///< distance between pixels with a reference value
  int Rays = 32;  ///< per such pixel, the square of this number
  ResultTable Results;
  std::map<std::string, OcclusionTruth> References; ///< by the scene's name

  /// Adds a result with an upper target; if it is missed, the remark states the ratio and the
  /// reason `why`.
  void Judge(const std::string& scene, const std::string& quantity, double measured, double limit,
    const std::string& why)
  {
    char distance[32];
    std::snprintf(distance, sizeof distance, "%.2f of the target: ", measured / limit);
    this->Results.Add(
      scene, quantity, measured, TargetKind::AtMost, limit, measured > limit ? distance + why : "");
  }

  /// Reference by rays, computed once for all parts.
  const OcclusionTruth& TruthOf(const OcclusionTestScene& scene)
  {
    OcclusionTruth& truth = this->References[scene.Name];
    if (truth.Pixels.empty())
    {
      truth = TraceOcclusion(
        scene.Renderer, OcclusionWindow::Size, scene.Radius, this->Stride, this->Rays);
    }
    return truth;
  }

  std::vector<OcclusionTestScene> Scenes() const
  {
    std::vector<OcclusionTestScene> scenes;
    for (OcclusionTestScene& scene :
      std::vector<OcclusionTestScene>{ penumbra::Scans(this->Meshes), Spheres400(), Sticks() })
    {
      if (this->Scene.empty() || scene.Name == this->Scene)
      {
        scenes.push_back(scene);
      }
    }
    return scenes;
  }
};

/// Every kernel, converged, and vtkSSAOPass, against rays.
void MeasureAccuracy(OcclusionBenchmark& benchmark);

/// Traced rays: after one frame, after 16, converged, and the time of a frame.
void MeasureTraced(OcclusionBenchmark& benchmark);

/// Times of frames: without ambient occlusion, with vtkPenumbraTemporalSSAOPass, converged, with
/// vtkSSAOPass.
void MeasureCost(OcclusionBenchmark& benchmark);

/// Errors and times of frames in fast turns.
void MeasureTurns(OcclusionBenchmark& benchmark);

/// Bytes per pixel.
void MeasureMemory(OcclusionBenchmark& benchmark);

/// Whether the occlusion depends on the number of ranks that render the scene.
void MeasureRanks(OcclusionBenchmark& benchmark);

/// Time until a static view has settled, in small and ordinary windows.
void MeasureSettling(OcclusionBenchmark& benchmark);

/// Noise of static and moving images relative to the images to which they converge.
void MeasureNoise(OcclusionBenchmark& benchmark);

}
#endif
