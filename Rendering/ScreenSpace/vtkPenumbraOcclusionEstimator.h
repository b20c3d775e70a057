// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraOcclusionEstimator
 * @brief   Who estimates: a few new samples of ambient occlusion for every pixel of a picture.
 *
 * vtkPenumbraTemporalSSAOPass keeps the mean of all samples, follows it from frame to frame, filters
 * it and darkens the picture. Where the samples come from is an estimator's business: kernels look
 * at the depth buffer alone (vtkPenumbraKernelEstimator), others may trace true rays from the
 * positions in it.
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
   * Estimators of other modules by name, as vtkPenumbraTemporalSSAOPass::SetKernelName() takes them:
   * a module registers what makes them. New() gives null for a name that nobody registered.
   */
  using Maker = vtkPenumbraOcclusionEstimator* (*)();
  static void Register(const char* name, Maker maker);
  static bool IsRegistered(const char* name);
  static vtkPenumbraOcclusionEstimator* New(const char* name);
  ///@}

  /** What is asked for. */
  struct Request
  {
    vtkOpenGLRenderWindow* Window = nullptr;
    vtkRenderer* Renderer = nullptr;
    const penumbra::DelegateImage* Image = nullptr; ///< colour and depth of the picture
    const penumbra::EyeDepth* Depth = nullptr;      ///< eye depths and the view, in radii
    double Radius = 1.0;                            ///< of occlusion, world units
    int FirstSample = 0;        ///< samples that every pixel has had before this call
    int Samples = 8;            ///< wanted for every pixel
    bool Moving = false;        ///< one of a run of pictures that are much alike
    bool RotatePerPixel = true; ///< samples shall differ from pixel to pixel
    /// One estimate shall do, with this error: whoever can interpolates between few points that it looks
    /// at closely. 0: more samples follow.
    double Tolerance = 0.0;
    /// Where they are wanted; null: everywhere.
    const std::vector<penumbra::Rectangle>* Parts = nullptr;
  };

  /**
   * Fill `target` (one float a pixel) with the mean of new samples, 0 open, 1 blocked. Returns how
   * many samples a pixel that were, 0 when it cannot. In motion a pixel without samples of its own may
   * have -1 - the mean of one beside it: that counts only where nothing else is known.
   */
  virtual int Estimate(const Request& request, vtkTextureObject* target) = 0;

  ///@{
  /**
   * The same within a shader of somebody else's: GLSL, over those of vtkPenumbraViewLib and
   * vtkPenumbraSurfaceLib, of a function `float estimateAt(SurfacePoint)`, empty where there is none;
   * and the uniforms that it needs, which returns as Estimate() does.
   */
  virtual std::string GetShader() { return {}; }
  virtual int SetUniforms(const Request&, vtkShaderProgram*) { return 0; }
  ///@}

  /** Is all that it needs of the renderer's scene at hand? Asked before every frame. */
  virtual bool CanEstimate(vtkRenderer*) { return true; }

  /** Another number whenever what it sees of the scene beside depth has changed; 0: it sees depth alone. */
  virtual vtkMTimeType GetSceneMTime(vtkRenderer*) { return 0; }

  /** The error that it believes to remain however many samples are taken. */
  virtual double GetBias() { return 0.0; }

  /** Was the last estimate within Request::Tolerance, so that no more are needed? */
  virtual bool IsFinal() { return false; }

  /** Does it help to draw more than the picture, so that occluders just outside are seen? */
  virtual bool NeedsMargin() { return true; }

  /** Free what lives in the window's OpenGL context. */
  virtual void ReleaseGraphicsResources(vtkWindow* window) = 0;

protected:
  vtkPenumbraOcclusionEstimator() = default;
  ~vtkPenumbraOcclusionEstimator() override = default;

private:
  vtkPenumbraOcclusionEstimator(const vtkPenumbraOcclusionEstimator&) = delete;
  void operator=(const vtkPenumbraOcclusionEstimator&) = delete;
};

#endif
