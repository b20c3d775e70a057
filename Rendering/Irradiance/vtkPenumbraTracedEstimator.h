// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraTracedEstimator
 * @brief   Ray-traced ambient occlusion of the surface in the depth buffer.
 *
 * Each pixel traces one or a few rays per frame against the meshes of the renderer, within the
 * radius. The depth buffer only defines the ray origins, so the mean converges to the occlusion of
 * [TSSAO eq. 1] with D = 1 up to the radius. In static views, neighboring pixels are joined by
 * regression until the tolerance is met. The meshes must be in this process. Their BVH is rebuilt
 * whenever they change.
 */
#ifndef vtkPenumbraTracedEstimator_h
#define vtkPenumbraTracedEstimator_h

#include "vtkPenumbraOcclusionEstimator.h"
#include "vtkPenumbraRenderingIrradianceModule.h" // for export macro

#include <memory> // for std::unique_ptr

class VTKPENUMBRARENDERINGIRRADIANCE_EXPORT vtkPenumbraTracedEstimator
  : public vtkPenumbraOcclusionEstimator
{
public:
  static vtkPenumbraTracedEstimator* New();
  vtkTypeMacro(vtkPenumbraTracedEstimator, vtkPenumbraOcclusionEstimator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Registers this class with vtkPenumbraTemporalSSAOPass as the kernel "traced". */
  static void Register();

  /** Same as Register(), under a name that is available in wrapped languages. */
  static void RegisterEstimator() { vtkPenumbraTracedEstimator::Register(); }

  ///@{
  /**
   * Number of requested samples that one traced ray replaces; at least one ray per pixel is traced.
   * A ray costs about as much as 8 depth fetches. Range: [1, 512]. Default: 32.
   */
  vtkSetClampMacro(SamplesPerRay, int, 1, 512);
  vtkGetMacro(SamplesPerRay, int);
  ///@}

  ///@{
  /**
   * If on, one pixel of each 2 x 2 block is traced per frame while the view moves (interleaved
   * sampling), unless there is time for more, and each pixel without history. If off, all pixels are
   * traced. Default: on.
   */
  vtkSetMacro(SparseInMotion, bool);
  vtkGetMacro(SparseInMotion, bool);
  vtkBooleanMacro(SparseInMotion, bool);
  ///@}

  int Estimate(const Request& request, vtkTextureObject* target) override;
  bool CanAddToHistory() override { return true; }
  Addition AddToHistory(const Request& request, vtkTextureObject* history) override;

  /** Returns whether all opaque props of the renderer are meshes that rays can hit. */
  bool CanEstimate(vtkRenderer* renderer) override;
  vtkMTimeType GetSceneMTime(vtkRenderer* renderer) override;

  bool NeedsMargin() override { return false; }
  bool CanRefine() override { return true; }
  Refinement Refine(const Request& request, vtkTextureObject* target) override;
  bool RefineBetweenFrames(vtkRenderer* renderer, double seconds) override;

  void ReleaseGraphicsResources(vtkWindow* window) override;

  /** Number of rays traced and of BVHs built since this object was created. */
  vtkGetMacro(NumberOfRays, vtkTypeInt64);
  vtkGetMacro(NumberOfTrees, vtkTypeInt64);

protected:
  vtkPenumbraTracedEstimator();
  ~vtkPenumbraTracedEstimator() override;

private:
  vtkPenumbraTracedEstimator(const vtkPenumbraTracedEstimator&) = delete;
  void operator=(const vtkPenumbraTracedEstimator&) = delete;

  struct RendererState;
  struct Internals;
  /** Updates the geometry and warns if rays do not hit all of it. */
  RendererState& UpdateRenderer(const Request& request);

  std::unique_ptr<Internals> Implementation;

  int SamplesPerRay = 32;
  bool SparseInMotion = true;
  vtkTypeInt64 NumberOfRays = 0;
  vtkTypeInt64 NumberOfTrees = 0;
};

#endif
