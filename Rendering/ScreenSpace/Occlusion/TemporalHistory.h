// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Temporal history of occlusion [TSSAO eq. 4-9]: per pixel, r is the sum of the samples of its
// surface point over all frames, g their number.
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
  double MaximumWeight = 500.0;     ///< maximum number of samples; older ones fade
  double WeightCap = 1e9;           ///< upper bound of the weight of the history in this frame
  double GrowingHistory = 0.0;      ///< weight below which pixels get Request::ShortHistorySamples
  double SettledHistory = 1e9;      ///< weight from which on pixels get samples in their turn only
  double DepthTolerance = 0.02;     ///< maximum relative difference from the expected depth
  bool ImageOnly = true;            ///< estimates do not know occluders outside of the image
  bool NeighborValidation = false;  ///< something besides the camera may have moved
  double InvalidationWeight = 30.0; ///< maximum number of samples kept if a neighbor moved
  bool PropsChanged = false; ///< props were added or removed: samples next to them are discarded
  const ActorMotion* Motion = nullptr; ///< motion of actors, or null if none moved
};

class TemporalHistory
{
public:
  /// Adds `samples` new samples per pixel, whose mean is `estimates`, to the history of the same pixel,
  /// which is discarded after Change::Reset. Only pixels in `parts` are updated. Returns false if
  /// OpenGL reports an error.
  bool Add(vtkOpenGLRenderWindow* window, const DelegateImage& image, const EyeDepth& depth,
    EyeDepth::Change change, vtkTextureObject* estimates, int samples,
    const TemporalSettings& settings, const std::vector<Rectangle>& parts);

  /// Reprojects the history after Change::Moved and adds an estimate, in the same pass if the estimator
  /// has a shader. `estimates`: for the means of one that neither has a shader nor adds to histories.
  /// Returns the numbers of new samples, 0 if OpenGL reports an error.
  vtkPenumbraOcclusionEstimator::Addition ReprojectAndEstimate(
    const vtkPenumbraOcclusionEstimator::Request& request, vtkPenumbraOcclusionEstimator* estimator,
    const TemporalSettings& settings, vtkTextureObject* estimates);

  /// Adds samples to the current history by blending.
  bool Accumulate(vtkOpenGLRenderWindow* window, const DelegateImage& image,
    vtkTextureObject* estimates, int samples, const std::vector<Rectangle>& parts);

  vtkTextureObject* GetTexture() const { return this->Textures[this->Current]; }

  /// The texture that the next Add() fills; it may be overwritten until then.
  vtkTextureObject* GetScratchTexture() const { return this->Textures[1 - this->Current]; }

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  /// Makes the scratch texture the current one, with the size of the view. Returns true if there is
  /// no history.
  bool SwapTextures(vtkOpenGLRenderWindow* window, const ScreenTransform& view);

  /// Reprojects the history, and adds the estimate of an estimator with a shader. `samples`: their
  /// number. Returns false if OpenGL reports an error.
  bool Reproject(const vtkPenumbraOcclusionEstimator::Request& request,
    vtkPenumbraOcclusionEstimator* estimator, const TemporalSettings& settings, int& samples);

  /// Resizes the scratch texture, which held a history of another size, to the size of the view.
  void ResizeScratchTexture(vtkOpenGLRenderWindow* window, const ScreenTransform& view);

  vtkSmartPointer<vtkTextureObject> Textures[2];
  int Current = 0;
  Stage Reprojection;
  Stage Validation; ///< Reprojection with sample validation
  Stage Accumulation;
  Stage Sum;
};

}
#endif
