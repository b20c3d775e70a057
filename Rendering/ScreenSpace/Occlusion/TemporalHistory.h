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
  /// Adds `samples` new samples per pixel, whose mean is `estimates`, to the history. After
  /// Change::None the history of the same pixel is used, after Change::Moved it is reprojected, and
  /// after Change::Reset it is discarded. Only pixels in `parts` are updated. Returns false if
  /// OpenGL reports an error.
  bool Add(vtkOpenGLRenderWindow* window, const DelegateImage& image, const EyeDepth& depth,
    EyeDepth::Change change, vtkTextureObject* estimates, int samples,
    const TemporalSettings& settings, const std::vector<Rectangle>& parts);

  /// Reprojects the history after Change::Moved and adds an estimate in the same pass; the
  /// estimator must have a shader. Returns the number of new samples, or 0 if OpenGL reports an
  /// error.
  int ReprojectAndEstimate(const vtkPenumbraOcclusionEstimator::Request& request,
    vtkPenumbraOcclusionEstimator* estimator, const TemporalSettings& settings);

  /// Adds samples after Change::None by blending.
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

  /// Resizes the scratch texture, which held a history of another size, to the size of the view.
  void ResizeScratchTexture(vtkOpenGLRenderWindow* window, const ScreenTransform& view);

  vtkSmartPointer<vtkTextureObject> Textures[2];
  int Current = 0;
  Stage Reproject;
  Stage Validate; ///< Reproject with sample validation
  Stage Estimate; ///< Reproject or Validate, with the estimate in the same shader
  Stage Accumulation;
  Stage Sum;
};

}
#endif
