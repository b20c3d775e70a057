// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraTracedEstimator
 * @brief   Ambient occlusion of what the depth buffer shows, by true rays.
 *
 * Every pixel asks a ray or a few a frame: is anything of the scene within the radius? Nothing is
 * guessed from the picture, so that the mean converges to the occlusion of [TSSAO eq. 1] with D = 1
 * up to the radius. Where one estimate shall do, records of the irradiance cache are interpolated.
 * Needs the scene's meshes on this machine; the tree over them is built again whenever they change.
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

  /** Make it known to vtkPenumbraTemporalSSAOPass as the kernel "traced". */
  static void Register();

  /** The same by a name that wrapped languages show. */
  static void RegisterEstimator() { vtkPenumbraTracedEstimator::Register(); }

  ///@{
  /**
   * One ray a pixel for so many samples asked for (at least one ray), 1 to 512: a ray costs about
   * as much as 8 depths fetched. Default: 32.
   */
  vtkSetClampMacro(SamplesPerRay, int, 1, 512);
  vtkGetMacro(SamplesPerRay, int);
  ///@}

  ///@{
  /**
   * While the picture moves, one pixel of every 2 x 2 is traced a frame, by turns; the others go by their
   * history, their neighbours and, where both fail, that pixel. Off: all pixels. Default: on.
   */
  vtkSetMacro(SparseInMotion, bool);
  vtkGetMacro(SparseInMotion, bool);
  vtkBooleanMacro(SparseInMotion, bool);
  ///@}

  int Estimate(const Request& request, vtkTextureObject* target) override;

  /** Are all opaque props of the renderer meshes that rays can meet? */
  bool CanEstimate(vtkRenderer* renderer) override;
  vtkMTimeType GetSceneMTime(vtkRenderer* renderer) override;

  bool NeedsMargin() override { return false; }

  /** It has answered from the irradiance cache. */
  bool IsFinal() override { return this->Final; }

  void ReleaseGraphicsResources(vtkWindow* window) override;

  /** Rays traced, and trees built, since this object exists. */
  vtkGetMacro(NumberOfRays, vtkTypeInt64);
  vtkGetMacro(NumberOfTrees, vtkTypeInt64);

protected:
  vtkPenumbraTracedEstimator();
  ~vtkPenumbraTracedEstimator() override;

private:
  vtkPenumbraTracedEstimator(const vtkPenumbraTracedEstimator&) = delete;
  void operator=(const vtkPenumbraTracedEstimator&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Implementation;

  int SamplesPerRay = 32;
  bool SparseInMotion = true;
  bool Final = false;
  vtkTypeInt64 NumberOfRays = 0;
  vtkTypeInt64 NumberOfTrees = 0;
};

#endif
