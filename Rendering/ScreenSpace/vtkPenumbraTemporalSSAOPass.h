// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraTemporalSSAOPass
 * @brief   Screen-space ambient occlusion, accumulated from frame to frame [TSSAO].
 *
 * A static view is refined until the tolerance is met; further frames are identical and cost no
 * samples. In motion, samples are reprojected with their surface point. AddTo() sets up everything
 * on a renderer in one call, RemoveFrom() restores it.
 *
 * The pass can also be set up as any vtkImageProcessingPass: the delegate renders color and depth,
 * by default the whole image with its background, which then happens exactly once per frame, because
 * the delegate may synchronize with other ranks. Occlusion depends on depth only, so that any mapper
 * works.
 *
 * Departures from [TSSAO]: a static view stops; all pixels use the same section of the sample
 * sequence, so that no index is stored; history is validated against the plane through the surface
 * point.
 */
#ifndef vtkPenumbraTemporalSSAOPass_h
#define vtkPenumbraTemporalSSAOPass_h

#include "vtkPenumbraRenderingScreenSpaceModule.h" // for export macro
#include "vtkPenumbraScreenSpacePass.h"
#include "vtkPenumbraSetNumber.h" // for setters
#include "vtkSmartPointer.h"      // for members

#include <memory> // for std::unique_ptr
#include <string> // for std::string

namespace penumbra
{
struct OcclusionConstants;
}
class vtkFieldData;
class vtkImageData;
class vtkPenumbraOcclusionEstimator;
class vtkRenderer;

class VTKPENUMBRARENDERINGSCREENSPACE_EXPORT vtkPenumbraTemporalSSAOPass
  : public vtkPenumbraScreenSpacePass
{
public:
  static vtkPenumbraTemporalSSAOPass* New();
  vtkTypeMacro(vtkPenumbraTemporalSSAOPass, vtkPenumbraScreenSpacePass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Add ambient occlusion to a renderer, or remove it: below its translucent geometry, volumes and
   * overlays, in addition to its other passes. AddTo() returns the new pass, or the existing one if
   * there is one. RemoveFrom() restores the passes of the renderer exactly. FindIn() returns the
   * pass that is part of those of the renderer, null if there is none.
   */
  static vtkPenumbraTemporalSSAOPass* AddTo(vtkRenderer* renderer);
  static void RemoveFrom(vtkRenderer* renderer);
  static vtkPenumbraTemporalSSAOPass* FindIn(vtkRenderer* renderer);
  ///@}

  ///@{
  /**
   * Accepted error of a static view relative to its converged image: the RMSE of any 16x16 pixels.
   * Range: [1e-4, 1]. Default: 0.01.
   */
  vtkPenumbraSetClampedNumberMacro(Tolerance, 1e-4, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  /** Units of Radius. */
  enum RadiusUnits
  {
    FRACTION_OF_BOUNDS, ///< fraction of the diagonal of the visible props' bounds
    WORLD,              ///< world units
    PIXELS              ///< pixels at the focal point of the camera
  };
  ///@{
  /** Unit of Radius. Default: FRACTION_OF_BOUNDS. */
  vtkSetClampMacro(RadiusUnit, int, FRACTION_OF_BOUNDS, PIXELS);
  vtkGetMacro(RadiusUnit, int);
  ///@}

  ///@{
  /**
   * Maximum distance of occluders, in RadiusUnit; 0: no occlusion. Negative and non-finite values
   * are rejected. Default: 0.1.
   */
  virtual void SetRadius(double radius);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /** Colors are multiplied by 1 - Strength * occlusion. Range: [0, 1]. Default: 1. */
  vtkPenumbraSetClampedNumberMacro(Strength, 0.0, 1.0);
  vtkGetMacro(Strength, double);
  ///@}

  ///@{
  /**
   * Influence of brightness: Strength is multiplied by 1 - LightAwareness * brightness, where
   * brightness is the largest component of the color. Hues do not change. Range: [0, 1].
   * Default: 0.
   */
  vtkPenumbraSetClampedNumberMacro(LightAwareness, 0.0, 1.0);
  vtkGetMacro(LightAwareness, double);
  ///@}

  ///@{
  /**
   * Name of a kernel of vtkPenumbraKernels, name of a registered vtkPenumbraOcclusionEstimator
   * ("traced": vtkPenumbraTracedEstimator), or "automatic". Automatic selects ray tracing if it is
   * registered, the scene is available and static, and Tolerance is below the bias of the kernel;
   * else the kernel "march". Default: "automatic".
   */
  virtual void SetKernelName(const char* name);
  const char* GetKernelName() const { return this->KernelName.c_str(); }
  ///@}

  /**
   * Name of the kernel or estimator of the last frame; the class name if it was set with
   * SetEstimator().
   */
  const char* GetActiveKernelName();

  ///@{
  /** Estimator that replaces the kernel. Default: none. */
  virtual void SetEstimator(vtkPenumbraOcclusionEstimator* estimator);
  vtkPenumbraOcclusionEstimator* GetEstimator();
  ///@}

  /** Conditions under which a single Render() converges. */
  enum ConvergeModes
  {
    /// In offscreen windows whose DesiredUpdateRate is below 1 per second, which is not the case
    /// during interaction; other windows converge over several frames.
    OFFSCREEN,
    NEVER,
    ALWAYS
  };
  ///@{
  /**
   * Condition under which one Render() repeats the estimate until the tolerance is met or the
   * window reports an abort (vtkRenderWindow::CheckAbortStatus()); the next Render() then
   * continues. Default: OFFSCREEN.
   */
  vtkSetClampMacro(ConvergeInOneRender, int, OFFSCREEN, ALWAYS);
  vtkGetMacro(ConvergeInOneRender, int);
  ///@}

  ///@{
  /**
   * Time in seconds that the samples of a frame of a static view take, as long as it has not converged.
   * Ray tracing takes a fifth of it in motion, and so do static views while the window's
   * DesiredUpdateRate is 1 per second or more. A frame takes at least one step of samples. Converged
   * images do not depend on it. Range: [0.001, 10]. Default: 0.1.
   */
  vtkPenumbraSetClampedNumberMacro(FrameTime, 0.001, 10.0);
  vtkGetMacro(FrameTime, double);
  ///@}

  ///@{
  /**
   * If on, a window with a vtkRenderWindowInteractor renders a static view again, through
   * vtkRenderWindowInteractor::Render(), until it has converged. Frames of the application take
   * precedence: a repeating timer waits for a pause of at least five ticks of 10 ms. No frames are
   * requested while the window's DesiredUpdateRate is 1 per second or more, as during interaction.
   * Between these frames, each tick adds samples for about FrameTime, which the passes of the window share. A frame
   * is rendered when the view has converged, when there are four times as many samples as in the last one, or
   * when rays have a better image.
   * Default: on.
   */
  vtkSetMacro(RefineStaticView, bool);
  vtkGetMacro(RefineStaticView, bool);
  vtkBooleanMacro(RefineStaticView, bool);
  ///@}

  /** Constants of the method, for benchmarks and tests. Their names and meanings may change. */
  penumbra::OcclusionConstants& GetConstants();

  void ReleaseGraphicsResources(vtkWindow* w) override;

  /** Returns whether the last frame met the tolerance, so that the next one will be identical. */
  bool IsConverged();

  /** Estimated error of the worst 16x16 pixels of a static view; VTK_DOUBLE_MAX while unknown. */
  double GetEstimatedError();

  /**
   * Statistics of the last frame, one value per array: `Occlusion/Kernel` (name of the active
   * kernel), `Samples/PerPixel` (new samples), `Samples/Static` (samples since the last change),
   * and fractions of the pixels with a surface: `Pixels/Reprojected`, `Pixels/ActorMotion` (history
   * on moving actors), `Pixels/Disoccluded`, `Pixels/Invalidated`, `Pixels/Converged`.
   */
  vtkFieldData* GetStatistics();

  /**
   * Fill `image` with float arrays of the last frame: `AmbientOcclusion` (filtered, 0 unoccluded, 1
   * fully occluded), `Depth` (world units along the view axis, infinite at empty pixels) and
   * `Convergence`.
   */
  void CopyOcclusion(vtkImageData* image);

protected:
  vtkPenumbraTemporalSSAOPass();
  ~vtkPenumbraTemporalSSAOPass() override;

  bool RenderEffect(const vtkRenderState* state) override;
  const char* GetEffectName() override { return "ambient occlusion"; }

private:
  vtkPenumbraTemporalSSAOPass(const vtkPenumbraTemporalSSAOPass&) = delete;
  void operator=(const vtkPenumbraTemporalSSAOPass&) = delete;

  vtkPenumbraOcclusionEstimator* ChooseEstimator(vtkRenderer* renderer, bool isStatic);

  struct Internals;
  std::unique_ptr<Internals> Implementation;

  double Tolerance = 0.01;
  int RadiusUnit = FRACTION_OF_BOUNDS;
  double Radius = 0.1;
  double Strength = 1.0;
  double LightAwareness = 0.0;
  std::string KernelName = "automatic";
  int ConvergeInOneRender = OFFSCREEN;
  double FrameTime = 0.1;
  bool RefineStaticView = true;
};

#endif
