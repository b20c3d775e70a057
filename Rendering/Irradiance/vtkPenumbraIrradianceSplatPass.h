// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraIrradianceSplatPass
 * @brief   Draws the records of an irradiance cache over what its delegate draws [IC, splatting].
 *
 * Every record is drawn as a splat as large as it serves, over the surface that is seen first; weights
 * and weighted values are added up by OpenGL's blending. What comes out is what
 * vtkPenumbraIrradianceCache interpolates at the same places: ambient occlusion that darkens the
 * picture, or light that its colours reflect. The records are any vtkPolyData that the cache wrote, for
 * this view or for others: moving the eye gathers nothing.
 */
#ifndef vtkPenumbraIrradianceSplatPass_h
#define vtkPenumbraIrradianceSplatPass_h

#include "vtkPenumbraRenderingIrradianceModule.h" // for export macro
#include "vtkPenumbraScreenSpacePass.h"
#include "vtkPenumbraSetNumber.h" // for setters

#include <memory> // for std::unique_ptr

class vtkFieldData;
class vtkImageData;
class vtkPolyData;
class vtkRenderer;

class VTKPENUMBRARENDERINGIRRADIANCE_EXPORT vtkPenumbraIrradianceSplatPass
  : public vtkPenumbraScreenSpacePass
{
public:
  static vtkPenumbraIrradianceSplatPass* New();
  vtkTypeMacro(vtkPenumbraIrradianceSplatPass, vtkPenumbraScreenSpacePass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Hangs a pass among a renderer's, around its opaque props, or returns the one that is there. */
  static vtkPenumbraIrradianceSplatPass* AddTo(vtkRenderer* renderer);
  /** Takes it out again, if there is one. */
  static void RemoveFrom(vtkRenderer* renderer);

  ///@{
  /**
   * Records, as vtkPenumbraIrradianceCache::GetRecords() or GetIrradianceRecords() gives them, world
   * coordinates. Default: none, the picture is the delegate's.
   */
  virtual void SetRecords(vtkPolyData* records);
  vtkPolyData* GetRecords();
  ///@}

  ///@{
  /**
   * Greatest angle between normals that share a record, degrees, up to 90; 0: the one that the records'
   * field data tells (`NormalAngle`), else 9, that of [IC]. Default: 0.
   */
  vtkPenumbraSetClampedNumberMacro(NormalAngle, 0.0, 90.0);
  vtkGetMacro(NormalAngle, double);
  ///@}

  ///@{
  /**
   * Of occlusion: rgb = color * (1 - Strength * occlusion). Of light: rgb = color * Strength *
   * irradiance / pi; draw the scene unlit, its colours being what surfaces reflect. 0 to 1. Default: 1.
   */
  vtkPenumbraSetClampedNumberMacro(Strength, 0.0, 1.0);
  vtkGetMacro(Strength, double);
  ///@}

  /**
   * What the last frame interpolated, one value a pixel: `AmbientOcclusion` (1) or `Irradiance` (3), and
   * `Weight`, the sum of the records' weights, 0 where there is none.
   */
  void CopyResult(vtkImageData* image);

  /**
   * Of the last frame: `Cache/Records` drawn, `Pixels/Interpolated`, the share of the pixels with a
   * surface that a record serves.
   */
  vtkFieldData* GetStatistics();

  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkPenumbraIrradianceSplatPass();
  ~vtkPenumbraIrradianceSplatPass() override;

  bool RenderEffect(const vtkRenderState* state) override;
  const char* GetEffectName() override { return "the records of the irradiance cache"; }

private:
  vtkPenumbraIrradianceSplatPass(const vtkPenumbraIrradianceSplatPass&) = delete;
  void operator=(const vtkPenumbraIrradianceSplatPass&) = delete;

  bool ReadRecords();
  bool RenderSplats(const vtkRenderState* state);

  struct Internals;
  std::unique_ptr<Internals> Implementation;

  double NormalAngle = 0.0;
  double Strength = 1.0;
};

#endif
