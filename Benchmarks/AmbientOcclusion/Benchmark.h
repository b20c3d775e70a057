// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The parts of the benchmark of ambient occlusion. Each adds its figures to the table.
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

/// Three scanned meshes on a plane; `folder` holds the files of libcgal-demo.
OcclusionTestScene Scans(const std::string& folder);

struct OcclusionBenchmark
{
  std::string Meshes; ///< folder with the .off files of libcgal-demo
  std::string Output; ///< folder for results and pictures
  bool Diagnose = false;
  int Stride = 4; ///< of the pixels with a truth
  int Rays = 32;  ///< squared: per such pixel
  ResultTable Results;
  std::map<std::string, OcclusionTruth> Truths; ///< by the scene's name

  /// Adds a figure with a bar; where it is missed its remark says by how much and `why`.
  void Judge(const std::string& scene, const std::string& quantity, double measured, double limit,
    const std::string& why)
  {
    char distance[32];
    std::snprintf(distance, sizeof distance, "%.2f of the bar: ", measured / limit);
    this->Results.Add(
      scene, quantity, measured, TargetKind::AtMost, limit, measured > limit ? distance + why : "");
  }

  /// By rays, once for all parts.
  const OcclusionTruth& TruthOf(const OcclusionTestScene& scene)
  {
    OcclusionTruth& truth = this->Truths[scene.Name];
    if (truth.Pixels.empty())
    {
      truth = TraceOcclusion(
        scene.Renderer, OcclusionWindow::Size, scene.Radius, this->Stride, this->Rays);
    }
    return truth;
  }

  std::vector<OcclusionTestScene> Scenes() const
  {
    return { penumbra::Scans(this->Meshes), Spheres400(), Sticks() };
  }
};

/// Every kernel, converged, against rays; and vtkSSAOPass.
void MeasureAccuracy(OcclusionBenchmark& benchmark);

/// True rays: after one frame, after 16, converged, and what a frame costs.
void MeasureTraced(OcclusionBenchmark& benchmark);

/// Times of frames: plain, with our pass, converged, with vtkSSAOPass.
void MeasureCost(OcclusionBenchmark& benchmark);

/// Bytes a pixel.
void MeasureMemory(OcclusionBenchmark& benchmark);

/// Whether the occlusion tells how many ranks drew the scene.
void MeasureRanks(OcclusionBenchmark& benchmark);

/// Noise of still and moving pictures against their own limit.
void MeasureNoise(OcclusionBenchmark& benchmark);

}
#endif
