// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// All samples that a pixel's surface point has had, over frames [TSSAO eq. 4-9]: r their sum, g
// their number. What is averaged is the caller's business.
#ifndef penumbra_TemporalHistory_h
#define penumbra_TemporalHistory_h

#include "ActorMotion.h"
#include "Frame/EyeDepth.h"
#include "Frame/Stage.h"
#include "vtkPenumbraOcclusionEstimator.h"

#include <vector>

namespace penumbra
{

struct TemporalSettings
{
  double MaximumWeight = 500.0;     ///< samples; older ones fade
  double WeightCap = 1e9;           ///< no more of the history counts in this frame
  double DepthTolerance = 0.02;     ///< relative distance from the surface expected
  bool NeighbourValidation = false; ///< something besides the eye may have moved
  double InvalidationWeight = 30.0; ///< a neighbour's motion pulls no weight below this
  bool PropsChanged = false;        ///< props appeared or disappeared: no sample next to them stays
  const ActorMotion* Motion = nullptr; ///< of actors that moved, where there are any
};

class TemporalHistory
{
public:
  /// Joins `samples` new samples a pixel, whose mean is `estimates`, with the history. After
  /// Change::None pixel by pixel, after Change::Some where the points were before, after
  /// Change::All there is no history. Only within `parts`. False when OpenGL refuses.
  bool Add(vtkOpenGLRenderWindow* window, const DelegateImage& image, const EyeDepth& depth,
    EyeDepth::Change change, vtkTextureObject* estimates, int samples,
    const TemporalSettings& settings, const std::vector<Rectangle>& parts);

  /// After Change::Some, the same in one step with the estimate itself, by an estimator with a shader.
  /// Returns how many new samples those were, 0 when OpenGL refuses.
  int ReprojectAndEstimate(const vtkPenumbraOcclusionEstimator::Request& request,
    vtkPenumbraOcclusionEstimator* estimator, const TemporalSettings& settings);

  /// The same where nothing changed.
  bool Accumulate(vtkOpenGLRenderWindow* window, const DelegateImage& image,
    vtkTextureObject* estimates, int samples, const std::vector<Rectangle>& parts);

  vtkTextureObject* GetTexture() const { return this->Textures[this->Current]; }

  /// The texture that the next Add() will fill: free until then.
  vtkTextureObject* GetScratchTexture() const { return this->Textures[1 - this->Current]; }

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  /// Makes the spare texture the current one, with the size of the view. True if there is no history.
  bool Prepare(vtkOpenGLRenderWindow* window, const ScreenTransform& view);

  /// The spare texture held a history of another size; gives it that of the current one.
  void FitSpare(vtkOpenGLRenderWindow* window, const ScreenTransform& view);

  vtkSmartPointer<vtkTextureObject> Textures[2];
  int Current = 0;
  Stage Reproject;
  Stage Validate; ///< the same, and looks whether neighbours have moved
  Stage Estimate; ///< one of the two, with the estimate
  Stage Accumulation;
  Stage Sum;
};

}
#endif
