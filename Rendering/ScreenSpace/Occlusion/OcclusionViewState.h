// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// All that vtkPenumbraTemporalSSAOPass keeps of one renderer, and the steps of a frame: draw the
// delegate, turn depths into distances, estimate, join with the history, filter, darken.
#ifndef penumbra_OcclusionViewState_h
#define penumbra_OcclusionViewState_h

#include "ActorMotion.h"
#include "BilateralFilter.h"
#include "ConvergedFrame.h"
#include "Convergence.h"
#include "Frame/Composite.h"
#include "Frame/DelegateImage.h"
#include "Frame/EyeDepth.h"
#include "TemporalHistory.h"
#include "vtkPenumbraOcclusionEstimator.h"

#include <vector>

class vtkImageData;
namespace penumbra
{

/// A frame's settings; see vtkPenumbraTemporalSSAOPass for their meaning.
struct OcclusionSettings
{
  double Radius = 1.0; ///< world units
  Darkening Darkness;
  double Tolerance = 0.01;
  int FirstSamples = 32;
  int Samples = 8;
  double AdaptiveConvergence = 0.2;
  double SpatialConvergence = 0.3;
  double RotationConvergence = 0.5;
  double MaximumWeight = 500.0;
  double InvalidationWeight = 30.0;
  double DepthTolerance = 0.02;
  bool Filter = true;
  bool InOneRender = false;
  bool Interpolate = false; ///< in one Render(): an estimate that is final will do
  bool DelegateDrawsBackground = true;
  bool DelegateOnce = false;   ///< it is drawn once in every picture, neither more nor less
  bool SceneChanged = true;    ///< something besides the eye may have moved since the last frame
  bool PropsChanged = false;   ///< props have appeared or disappeared since the last frame
  bool HiddenChanged = false;  ///< something that the estimator sees and depth does not has changed
  bool UseActorMotion = false; ///< the renderer's props are those that are seen
  bool Restart = false;        ///< settings changed: what is known is worth nothing
  int Margin[2] = { 0, 0 };
  const double* Bounds =
    nullptr; ///< of all that may be seen, where clipping planes may follow them
};

class OcclusionViewState
{
public:
  /// Draws one frame into the target of `state`. False when OpenGL refuses: nothing was drawn.
  bool Render(const vtkRenderState* state, vtkRenderPass* delegate,
    vtkPenumbraOcclusionEstimator* estimator, const OcclusionSettings& settings);

  int GetNumberOfRenderedProps() const { return this->Props; }

  /// Samples a pixel that the last frame took; 0 once converged.
  int GetNewSamples() const { return this->NewSamples; }
  bool IsConverged() const { return this->Converged; }
  const Convergence& GetConvergence() const { return this->TileConvergence; }

  /// Counts of pixels in the picture without margin: surface, and of these by what became of their
  /// history in the last frame.
  struct PixelCounts
  {
    long long Surface = 0;
    long long Kept = 0;
    long long Followed = 0; ///< on actors that moved, with history
    long long Disoccluded = 0;
    long long Invalidated = 0;
    long long Converged = 0;
  };
  PixelCounts CountPixels() const;

  /// Adds the float arrays AmbientOcclusion, Depth and Convergence to an image of the picture
  /// without margin.
  void CopyTo(vtkImageData* image) const;

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  bool CanReuseConvergedFrame(const ScreenTransform& view) const;
  void Compare(const OcclusionSettings& last);
  ConvergedFrame::CompositeInputs GetDarkness() const;
  void LookForMotion();
  bool Converge(EyeDepth::Change change);
  bool Estimate(EyeDepth::Change change);
  int AccumulateSamples(
    const vtkPenumbraOcclusionEstimator::Request& request, EyeDepth::Change change, bool refine);
  bool Filter();
  std::vector<float> ReadMeans() const;
  bool MeetsTolerance() const;

  vtkOpenGLRenderWindow* Window = nullptr;
  vtkRenderer* Renderer = nullptr;
  vtkPenumbraOcclusionEstimator* Estimator = nullptr;
  OcclusionSettings Settings;
  DelegateImage Image;
  ActorMotion Motion;
  EyeDepth Depth;
  TemporalHistory History;
  BilateralFilter Smoother;
  Convergence TileConvergence;
  Composite Darken;
  ConvergedFrame Picture;
  std::vector<Rectangle> InnerRegion; ///< the picture without its margin: nobody sees the rest
  vtkSmartPointer<vtkTextureObject> Estimates; ///< new ones, then the filtered result
  int TotalSamples = 0;                        ///< place in the sample sequence
  int SamplesSinceReset = 0;                   ///< since the last cut
  int NewSamples = 0;
  int Props = 0;
  bool HasActorMotion = false; ///< some actors' motion is drawn
  bool Filtered = false;       ///< Estimates are filtered with these settings
  bool Darkened = false;       ///< so is Picture, and its darkness is that of these settings
  bool Converged = false;
};

}
#endif
