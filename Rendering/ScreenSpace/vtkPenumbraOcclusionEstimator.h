// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraOcclusionEstimator
 * @brief   Interface for objects that compute new samples of ambient occlusion for every pixel.
 *
 * vtkPenumbraTemporalSSAOPass accumulates the samples, reprojects their mean from frame to frame,
 * filters it and darkens the image. Estimators provide the samples: vtkPenumbraKernelEstimator
 * reads the depth buffer only, others may trace rays from the positions in it.
 */
#ifndef vtkPenumbraOcclusionEstimator_h
#define vtkPenumbraOcclusionEstimator_h

#include "vtkObject.h"
#include "vtkPenumbraRenderingScreenSpaceModule.h" // for export macro

#include <string> // for std::string
#include <vector> // for std::vector

namespace penumbra
{
class DelegateImage;
class EyeDepth;
struct Rectangle;
}
class vtkOpenGLRenderWindow;
class vtkRenderer;
class vtkShaderProgram;
class vtkTextureObject;
class vtkWindow;

class VTKPENUMBRARENDERINGSCREENSPACE_EXPORT vtkPenumbraOcclusionEstimator : public vtkObject
{
public:
  vtkAbstractTypeMacro(vtkPenumbraOcclusionEstimator, vtkObject);

  ///@{
  /**
   * Registry of estimators of other modules, by the name that
   * vtkPenumbraTemporalSSAOPass::SetKernelName() accepts. New() returns null if the name is not
   * registered.
   */
  using Factory = vtkPenumbraOcclusionEstimator* (*)();
  static void Register(const char* name, Factory factory);
  static bool IsRegistered(const char* name);
  static vtkPenumbraOcclusionEstimator* New(const char* name);
  ///@}

  /** Input of an estimate. */
  struct Request
  {
    vtkOpenGLRenderWindow* Window = nullptr;
    vtkRenderer* Renderer = nullptr;
    const penumbra::DelegateImage* Image = nullptr; ///< color and depth of the image
    const penumbra::EyeDepth* Depth = nullptr;      ///< eye depth and view; the unit is the radius
    double Radius = 1.0;                            ///< of occlusion, in world units
    int FirstSample = 0; ///< number of samples per pixel before this call; 0: without history
    int Samples = 8;     ///< requested number per pixel
    /// Requested number at pixels with a short history, at least Samples; only for shaders.
    int ShortHistorySamples = 8;
    ///@{
    /// Pixels with a settled history get samples in one of several frames; only for shaders.
    int Turns = 1;              ///< number of frames in which each of these pixels has one turn
    int Turn = 0;               ///< the turn of this frame, in [0, Turns)
    int SettledFirstSample = 0; ///< number of samples of these pixels before this call
    ///@}
    bool Moving = false;        ///< one of a sequence of similar frames
    bool RotatePerPixel = true; ///< samples differ from pixel to pixel
    double Tolerance = 0.01;    ///< only for Refine(): accepted RMSE of any 16x16 pixels
    /// Time that Refine() may take; Estimate() may take more samples than requested in it. 0: one step,
    /// or the requested samples.
    double Seconds = 0.1;
    /// Rectangles in which samples are requested; null: the whole image.
    const std::vector<penumbra::Rectangle>* Parts = nullptr;
  };

  /**
   * Fill `target` (one float per pixel) with the mean of new samples: 0 unoccluded, 1 fully
   * occluded. Returns the number of samples per pixel; 0 if the estimate failed. Windows with an interactor
   * also call this between frames of a static view, with the context of the window current.
   */
  virtual int Estimate(const Request& request, vtkTextureObject* target) = 0;

  ///@{
  /**
   * The estimate as part of another shader. GetShader() returns the GLSL of two functions that use
   * vtkPenumbraViewLib and vtkPenumbraSurfaceLib; empty if there are none. `float
   * estimateAt(SurfacePoint, bool hasShortHistory)` returns the mean of the new samples, `float
   * newSamplesAt(bool hasShortHistory)` their number. SetUniforms() sets their uniforms and returns
   * the same number as Estimate().
   */
  virtual std::string GetShader() { return {}; }
  virtual int SetUniforms(const Request&, vtkShaderProgram*) { return 0; }
  ///@}

  /** Numbers of new samples of a pixel. */
  struct Addition
  {
    int Samples = 0;             ///< with a long history; 0: the estimate failed
    int ShortHistorySamples = 0; ///< without history
  };

  ///@{
  /**
   * Alternative to Estimate() for an estimator without shader while the view moves, if
   * CanAddToHistory() returns true. `history` (two floats per pixel) has the sum and the number of the
   * reprojected samples. AddToHistory() adds new samples to both; pixels may differ in their number.
   */
  virtual bool CanAddToHistory() { return false; }
  virtual Addition AddToHistory(const Request&, vtkTextureObject*) { return {}; }
  ///@}

  /** Returns whether the scene of the renderer can be estimated. Called before every frame. */
  virtual bool CanEstimate(vtkRenderer*) { return true; }

  /**
   * Modification time of the scene data that the estimator reads in addition to depth; 0 if it
   * reads depth only.
   */
  virtual vtkMTimeType GetSceneMTime(vtkRenderer*) { return 0; }

  /** Estimated error that remains with any number of samples. */
  virtual double GetBias() { return 0.0; }

  /** State of the image of a static view that Refine() computes. */
  struct Refinement
  {
    bool HasFailed = false;
    bool IsFinal = false; ///< the tolerance is met, or more samples would not help
    int Samples = 0;      ///< number of independent samples with the same RMSE; 0: no new image
    double Error = 0.0;   ///< estimated RMSE of the worst 16x16 pixels of the new image
  };

  ///@{
  /**
   * Alternative to Estimate() for static views, if CanRefine() returns true. Refine() continues an
   * image of the current depths for about Request::Seconds, and fills `target` when a better image
   * is available. RefineBetweenFrames() continues the images of the renderer without OpenGL, and
   * returns true if Refine() then has a new one, or if a frame is needed. The images depend on neither
   * the calls nor their times.
   */
  virtual bool CanRefine() { return false; }
  virtual Refinement Refine(const Request&, vtkTextureObject*) { return {}; }
  virtual bool RefineBetweenFrames(vtkRenderer*, double) { return true; }
  ///@}

  /**
   * Returns whether a margin around the image, with occluders just outside of it, improves the
   * estimate.
   */
  virtual bool NeedsMargin() { return true; }

  /** Release the OpenGL resources of the window. */
  virtual void ReleaseGraphicsResources(vtkWindow* window) = 0;

protected:
  vtkPenumbraOcclusionEstimator() = default;
  ~vtkPenumbraOcclusionEstimator() override = default;

private:
  vtkPenumbraOcclusionEstimator(const vtkPenumbraOcclusionEstimator&) = delete;
  void operator=(const vtkPenumbraOcclusionEstimator&) = delete;
};

#endif
