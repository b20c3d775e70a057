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
 * by default the whole image with its background. Occlusion depends on depth only, so that any
 * mapper works.
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
   * else the kernel "march". If a single Render() converges, traced occlusion is interpolated.
   * Default: "automatic".
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

  ///@{
  /**
   * Samples (depth fetches) per pixel and frame (k1 in [TSSAO]): for static views, and in motion
   * for pixels whose convergence is below AdaptiveConvergence. When converging within one Render(),
   * batches have as many samples as the next tolerance check needs, at most 128 or FirstSamples.
   * Range: [8, 512]. Default: 32.
   */
  vtkSetClampMacro(FirstSamples, int, 8, 512);
  vtkGetMacro(FirstSamples, int);
  ///@}

  ///@{
  /**
   * Samples per pixel and frame in motion, at pixels above AdaptiveConvergence, k2 in [TSSAO].
   * Range: [8, 512]. Default: 8.
   */
  vtkSetClampMacro(Samples, int, 8, 512);
  vtkGetMacro(Samples, int);
  ///@}

  ///@{
  /**
   * Number of frames in which a pixel takes Samples once while only the camera moves, if the kernel
   * reads depth only and the pixel is above AdaptiveConvergence and SpatialConvergence. Blocks of
   * 4x4 pixels take turns. Above 1, frames are faster and the image is steadier, but it follows
   * the view more slowly. Range: [1, 16]. Default: 1.
   */
  vtkSetClampMacro(SettledPeriod, int, 1, 16);
  vtkGetMacro(SettledPeriod, int);
  ///@}

  ///@{
  /**
   * Number of samples above which older ones fade, w_max in [TSSAO]. The convergence of a pixel is
   * its number of samples divided by this. Range: [8, 1e5]. Default: 500.
   */
  vtkPenumbraSetClampedNumberMacro(MaximumWeight, 8.0, 1e5);
  vtkGetMacro(MaximumWeight, double);
  ///@}

  ///@{
  /**
   * Convergence up to which pixels take FirstSamples in motion, c_adaptive in [TSSAO].
   * Range: [0, 1]. Default: 0.2.
   */
  vtkPenumbraSetClampedNumberMacro(AdaptiveConvergence, 0.0, 1.0);
  vtkGetMacro(AdaptiveConvergence, double);
  ///@}

  ///@{
  /**
   * Convergence from which pixels are not filtered, c_spatial in [TSSAO]. Range: [0, 1].
   * Default: 0.3.
   */
  vtkPenumbraSetClampedNumberMacro(SpatialConvergence, 0.0, 1.0);
  vtkGetMacro(SpatialConvergence, double);
  ///@}

  ///@{
  /**
   * Convergence up to which samples differ from pixel to pixel, c_rot in [TSSAO]. Range: [0, 1].
   * Default: 0.5.
   */
  vtkPenumbraSetClampedNumberMacro(RotationConvergence, 0.0, 1.0);
  vtkGetMacro(RotationConvergence, double);
  ///@}

  ///@{
  /**
   * Maximum number of samples kept at a pixel if a neighbor moved [TSSAO eq. 9]. Range: [0, 1000].
   * Default: 30.
   */
  vtkPenumbraSetClampedNumberMacro(InvalidationWeight, 0.0, 1000.0);
  vtkGetMacro(InvalidationWeight, double);
  ///@}

  ///@{
  /**
   * Relative depth difference from which history is rejected as that of another surface; limited to
   * 0.08 radii. 1: history is never rejected, not even at camera cuts. Range: [1e-4, 1].
   * Default: 0.02.
   */
  vtkPenumbraSetClampedNumberMacro(DepthTolerance, 1e-4, 1.0);
  vtkGetMacro(DepthTolerance, double);
  ///@}

  ///@{
  /** If on, pixels below SpatialConvergence are filtered. Default: on. */
  vtkSetMacro(Filter, bool);
  vtkGetMacro(Filter, bool);
  vtkBooleanMacro(Filter, bool);
  ///@}

  ///@{
  /**
   * Margin around the image, in which occluders have an effect, in percent of the larger image
   * side. Negative: the radius, at most 10 percent, and 0 for ray tracing. Requires OpaqueOnly.
   * Range: up to 50. Default: -1.
   */
  vtkPenumbraSetClampedNumberMacro(Margin, -1.0, 50.0);
  vtkGetMacro(Margin, double);
  ///@}

  ///@{
  /**
   * If on, every Render() renders the delegate exactly once, as required by a delegate that
   * synchronizes with other ranks. If off, a cheaper path for static views may render it a second
   * time. Default: off.
   */
  vtkSetMacro(DelegateOnce, bool);
  vtkGetMacro(DelegateOnce, bool);
  vtkBooleanMacro(DelegateOnce, bool);
  ///@}

  ///@{
  /**
   * If on, history is reprojected with actors that move as rigid bodies; they are rendered a second
   * time to identify the pixels of each actor. If off, history is discarded where depth shows
   * motion. Requires OpaqueOnly. Default: on.
   */
  vtkSetMacro(UseActorMotion, bool);
  vtkGetMacro(UseActorMotion, bool);
  vtkBooleanMacro(UseActorMotion, bool);
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
   * If on, a window with a vtkRenderWindowInteractor renders a static view again, through
   * vtkRenderWindowInteractor::Render(), until it has converged. Frames of the application take
   * precedence: a repeating timer waits for a pause of at least five ticks of 10 ms. No frames are
   * requested while the window's DesiredUpdateRate is 1 per second or more, as during interaction.
   * Default: on.
   */
  vtkSetMacro(RefineStaticView, bool);
  vtkGetMacro(RefineStaticView, bool);
  vtkBooleanMacro(RefineStaticView, bool);
  ///@}

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
  int FirstSamples = 32;
  int Samples = 8;
  int SettledPeriod = 1;
  double MaximumWeight = 500.0;
  double AdaptiveConvergence = 0.2;
  double SpatialConvergence = 0.3;
  double RotationConvergence = 0.5;
  double InvalidationWeight = 30.0;
  double DepthTolerance = 0.02;
  bool Filter = true;
  double Margin = -1.0;
  bool DelegateOnce = false;
  bool UseActorMotion = true;
  int ConvergeInOneRender = OFFSCREEN;
  bool RefineStaticView = true;
};

#endif
