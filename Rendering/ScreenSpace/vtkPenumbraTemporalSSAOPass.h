// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraTemporalSSAOPass
 * @brief   Ambient occlusion from depth, kept and refined from frame to frame [TSSAO].
 *
 * A still view converges until the tolerance is met, then stops: no more work, the same bits. In
 * motion every surface point keeps the samples it has had. AddTo() sets up everything on a renderer
 * in one call, RemoveFrom() restores it.
 *
 * By hand it is a vtkImageProcessingPass: the delegate draws colour and depth, by default the whole
 * picture with its background. Only depth decides on the occlusion: any mapper will do.
 *
 * Departures from [TSSAO]: a still view stops; all pixels take the same run of the sample sequence,
 * so that no index is stored; history is checked against the plane through the point.
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
   * Show ambient occlusion in a renderer: under its translucent geometry, volumes and overlays, and
   * with whatever pass it already has. Returns the pass at work, also when there is one already.
   * Removing restores the renderer's passes exactly.
   */
  static vtkPenumbraTemporalSSAOPass* AddTo(vtkRenderer* renderer);
  static void RemoveFrom(vtkRenderer* renderer);
  ///@}

  ///@{
  /**
   * The error accepted in a still view against its own limit, RMSE of any 16x16 pixels, 0.0001 to 1.
   * Default: 0.01.
   */
  vtkPenumbraSetClampedNumberMacro(Tolerance, 1e-4, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  /** What Radius is measured in. */
  enum RadiusUnits
  {
    FRACTION_OF_BOUNDS, ///< diagonals of the visible props' bounds
    WORLD,              ///< world units
    PIXELS              ///< pixels, at the camera's focal point
  };
  ///@{
  /** Default: FRACTION_OF_BOUNDS. */
  vtkSetClampMacro(RadiusUnit, int, FRACTION_OF_BOUNDS, PIXELS);
  vtkGetMacro(RadiusUnit, int);
  ///@}

  ///@{
  /**
   * How far an occluder reaches, in RadiusUnit; 0: no occlusion. What is negative or not finite is
   * refused. Default: 0.1.
   */
  virtual void SetRadius(double radius);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /** Colours are multiplied by 1 - Strength * occlusion; 0 to 1. Default: 1. */
  vtkPenumbraSetClampedNumberMacro(Strength, 0.0, 1.0);
  vtkGetMacro(Strength, double);
  ///@}

  ///@{
  /**
   * How far light spares a surface, 0 to 1: Strength falls by this times a colour's brightness (its
   * largest component). Hues stay; of a colour map the bright colours are darkened less. Default: 0.
   */
  vtkPenumbraSetClampedNumberMacro(LightAwareness, 0.0, 1.0);
  vtkGetMacro(LightAwareness, double);
  ///@}

  ///@{
  /**
   * A kernel of vtkPenumbraKernels by name, the name of a registered vtkPenumbraOcclusionEstimator
   * ("traced": vtkPenumbraTracedEstimator), or "automatic": true rays, where they are registered, the
   * scene is at hand and does not change from frame to frame and Tolerance asks for more than one
   * layer of depth can tell, interpolated where one Render() converges; else a kernel. Default: "automatic".
   */
  virtual void SetKernelName(const char* name);
  const char* GetKernelName() const { return this->KernelName.c_str(); }
  ///@}

  /** The name of the kernel or estimator that the last frame used; of SetEstimator()'s: its class. */
  const char* GetActiveKernelName();

  ///@{
  /** Who estimates instead of a kernel. Default: none. */
  virtual void SetEstimator(vtkPenumbraOcclusionEstimator* estimator);
  vtkPenumbraOcclusionEstimator* GetEstimator();
  ///@}

  ///@{
  /** Samples (depths fetched) a pixel and frame until AdaptiveConvergence: k1, 8 to 512. Default: 32.
   * What converges in one render takes as many at once as its next look at the tolerance needs, but no
   * more than 128 if this is not more. */
  vtkSetClampMacro(FirstSamples, int, 8, 512);
  vtkGetMacro(FirstSamples, int);
  ///@}

  ///@{
  /** Samples a pixel and frame from then on: k2, 8 to 512. Default: 8. */
  vtkSetClampMacro(Samples, int, 8, 512);
  vtkGetMacro(Samples, int);
  ///@}

  ///@{
  /** Samples after which older ones fade: w_max, 8 to 100000. Convergences are shares of it. Default: 500. */
  vtkPenumbraSetClampedNumberMacro(MaximumWeight, 8.0, 1e5);
  vtkGetMacro(MaximumWeight, double);
  ///@}

  ///@{
  /** Convergence up to which frames take FirstSamples: c_adaptive, 0 to 1. Default: 0.2. */
  vtkPenumbraSetClampedNumberMacro(AdaptiveConvergence, 0.0, 1.0);
  vtkGetMacro(AdaptiveConvergence, double);
  ///@}

  ///@{
  /** Convergence from which pixels are not filtered: c_spatial, 0 to 1. Default: 0.3. */
  vtkPenumbraSetClampedNumberMacro(SpatialConvergence, 0.0, 1.0);
  vtkGetMacro(SpatialConvergence, double);
  ///@}

  ///@{
  /** Convergence up to which samples differ from pixel to pixel: c_rot, 0 to 1. Default: 0.5. */
  vtkPenumbraSetClampedNumberMacro(RotationConvergence, 0.0, 1.0);
  vtkGetMacro(RotationConvergence, double);
  ///@}

  ///@{
  /** Samples that remain where a neighbour moved [TSSAO eq. 9], 0 to 1000. Default: 30. */
  vtkPenumbraSetClampedNumberMacro(InvalidationWeight, 0.0, 1000.0);
  vtkGetMacro(InvalidationWeight, double);
  ///@}

  ///@{
  /** Relative difference of depth from which history is another surface's, 0.0001 to 1; at most .08 radii, but for 1: never. Default: 0.02. */
  vtkPenumbraSetClampedNumberMacro(DepthTolerance, 1e-4, 1.0);
  vtkGetMacro(DepthTolerance, double);
  ///@}

  ///@{
  /** Filter what has not converged. Default: on. */
  vtkSetMacro(Filter, bool);
  vtkGetMacro(Filter, bool);
  vtkBooleanMacro(Filter, bool);
  ///@}

  ///@{
  /**
   * Drawn around the picture so that occluders just outside count: per cent of its larger side, 0 to
   * 50; negative: the radius, at most 10, and nothing for true rays. Needs OpaqueOnly. Default: -1.
   */
  vtkPenumbraSetClampedNumberMacro(Margin, -1.0, 50.0);
  vtkGetMacro(Margin, double);
  ///@}

  ///@{
  /**
   * Every Render() draws the delegate exactly once, as a delegate needs that waits for other ranks; off:
   * a still picture may be drawn in a cheaper way, which may take it a second time. Default: off.
   */
  vtkSetMacro(DelegateOnce, bool);
  vtkGetMacro(DelegateOnce, bool);
  vtkBooleanMacro(DelegateOnce, bool);
  ///@}

  ///@{
  /**
   * History follows actors that move as rigid bodies: they are drawn once more, for which actor a pixel
   * shows. Off: it is dropped where depth shows that something moved. Needs OpaqueOnly. Default: on.
   */
  vtkSetMacro(UseActorMotion, bool);
  vtkGetMacro(UseActorMotion, bool);
  vtkBooleanMacro(UseActorMotion, bool);
  ///@}

  /** When a single Render() converges. */
  enum ConvergeModes
  {
    OFFSCREEN, ///< in offscreen windows; others spread the work over frames
    NEVER,
    ALWAYS
  };
  ///@{
  /** Repeat the estimate within one Render() until the tolerance is met. Default: OFFSCREEN. */
  vtkSetClampMacro(ConvergeInOneRender, int, OFFSCREEN, ALWAYS);
  vtkGetMacro(ConvergeInOneRender, int);
  ///@}

  void ReleaseGraphicsResources(vtkWindow* window) override;

  /** Of the last frame: has it met the tolerance, so that the next one will be the same? */
  bool IsConverged();

  /** Error of the worst 16x16 pixels of a still view that the pass believes in; huge while unknown. */
  double GetEstimatedError();

  /**
   * Of the last frame, one value an array: `Occlusion/Kernel` (the active one's name),
   * `Samples/PerPixel` (new ones), `Samples/Static` (since the last change), and shares of the
   * surface's pixels `Pixels/Reprojected`, `Pixels/ActorMotion` (history on actors that moved), `Pixels/Disoccluded`,
   * `Pixels/Invalidated`, `Pixels/Converged`.
   */
  vtkFieldData* GetStatistics();

  /**
   * Fill `image` with the last frame's float arrays `AmbientOcclusion` (filtered, 0 open, 1
   * blocked), `Depth` (world units along the view axis, infinite where empty) and `Convergence`.
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

  vtkPenumbraOcclusionEstimator* ChooseEstimator(vtkRenderer* renderer, bool still);

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
};

#endif
