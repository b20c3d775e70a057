// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The state that vtkPenumbraTemporalSSAOPass keeps per renderer, and the steps of a frame: render
// the delegate, convert depth to eye depth, estimate occlusion, add it to the history, filter,
// composite.
#ifndef penumbra_OcclusionViewState_h
#define penumbra_OcclusionViewState_h

#include "ActorMotion.h"
#include "BilateralFilter.h"
#include "ConvergedFrame.h"
#include "Convergence.h"
#include "Frame/Composite.h"
#include "Frame/DelegateImage.h"
#include "Frame/EyeDepth.h"
#include "PixelCounter.h"
#include "TemporalHistory.h"
#include "vtkPenumbraOcclusionConstants.h"
#include "vtkPenumbraOcclusionEstimator.h"

#include <vector>

class vtkImageData;
namespace penumbra
{

/// Settings of a frame; see vtkPenumbraTemporalSSAOPass for their meaning.
struct OcclusionSettings
{
  double Radius = 1.0; ///< world units
  Darkening Darkness;
  double Tolerance = 0.01;
  OcclusionConstants Constants;
  bool InOneRender = false;
  ///@{
  /// Time for the samples of a frame, of a static view and in motion.
  double Seconds = 0.1;
  double SecondsInMotion = 0.02;
  ///@}
  bool DelegateDrawsBackground = true;
  bool SceneChanged = true;   ///< something besides the camera may have moved since the last frame
  bool PropsChanged = false;  ///< props were added or removed since the last frame
  bool HiddenChanged = false; ///< the estimator's scene changed in a way that depth does not show
  /// Reproject moving actors; the delegate renders the renderer's props.
  bool UseActorMotion = false;
  bool Restart = false; ///< settings changed: discard the history
  /// If true, another estimator of the same quantity is used: the history keeps a small weight.
  bool EstimatorChanged = false;
  int Margin[2] = { 0, 0 };
  /// Bounds of the visible scene if clipping planes may be fitted to it.
  const double* Bounds = nullptr;
};

class OcclusionViewState
{
public:
  /// Renders one frame into the target of `state`. Returns false if OpenGL reports an error; the
  /// target is then unchanged.
  bool Render(const vtkRenderState* state, vtkRenderPass* delegate,
    vtkPenumbraOcclusionEstimator* estimator, const OcclusionSettings& settings);

  /// Adds samples to the last frame, which was static, for about `seconds`, without an image. Returns true if a
  /// frame would show a better image, or is needed to continue. The context of the window is current.
  bool RefineBetweenFrames(double seconds);

  int GetNumberOfRenderedProps() const { return this->Props; }

  /// Number of samples per pixel added in the last frame and since the one before; 0 once converged.
  int GetNewSamples() const { return this->NewSamples; }
  bool IsConverged() const { return this->Converged; }
  /// Returns whether the camera or the depths of the last frame differ from the one before.
  bool HasChanged() const { return this->Changed; }
  const Convergence& GetConvergence() const { return this->TileConvergence; }

  /// Counts the pixels of the image without its margin by the fate of their history in the last
  /// frame.
  HistoryCounts CountPixels();

  /// Adds the float arrays AmbientOcclusion, Depth and Convergence, without margin, to `image`.
  void CopyTo(vtkImageData* image) const;

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  bool CanReuseConvergedFrame(const ScreenTransform& view) const;
  void CompareSettings(const OcclusionSettings& last);
  ConvergedFrame::CompositeInputs GetCompositeInputs() const;
  void UpdateActorMotion();
  bool Converge(EyeDepth::Change change);
  bool FinishFrame();
  /// Limits the number of samples that are assumed in pixels to InvalidationWeight.
  void LimitSamplesSinceReset();
  /// Returns whether the estimator can be part of the reprojecting shader.
  bool HasShader() const { return !this->Estimator->GetShader().empty(); }
  bool Estimate(EyeDepth::Change change);
  vtkPenumbraOcclusionEstimator::Request MakeRequest(bool isStatic) const;
  bool Refine();
  vtkPenumbraOcclusionEstimator::Addition AccumulateSamples(
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
  BilateralFilter Bilateral;
  Convergence TileConvergence;
  Composite Compositor;
  ConvergedFrame StoredFrame;
  PixelCounter Counter;
  std::vector<Rectangle> InnerRegion;          ///< the image without its margin
  vtkSmartPointer<vtkTextureObject> Estimates; ///< new estimates, then the filtered result
  int TotalSamples = 0;                        ///< position in the sample sequence
  int FramesWithTurns = 0;                     ///< frames in which settled pixels took turns
  int SamplesSinceReset = 0; ///< number of samples since the history was discarded
  int NewSamples = 0;
  int SamplesOfFrame = 0;           ///< number of samples of the static view in the last frame
  int DisocclusionSamples = 0;      ///< number of new samples at pixels without history
  double MovedNeighborWeight = 0.0; ///< maximum number of samples kept if a neighbor moved
  int Props = 0;
  bool HasActorMotion = false;       ///< the image of moving actors is valid in this frame
  bool Refined = false;              ///< the history is an image of the estimator's Refine()
  bool RefinedBetweenFrames = false; ///< samples were added since the last frame
  bool Filtered = false;             ///< Estimates are filtered with the current settings
  bool StoredFrameValid = false;     ///< StoredFrame was composited with the current settings
  bool Converged = false;
  bool TurnsFast = false; ///< too fast to use the history of a kernel
  bool Changed = true;
};

}
#endif
