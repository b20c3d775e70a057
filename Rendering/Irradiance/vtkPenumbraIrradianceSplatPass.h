// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraIrradianceSplatPass
 * @brief   Shades the image of its delegate pass with irradiance cache records [IC, splatting].
 *
 * Each record is rendered as a splat with the record's radius over the visible surface. OpenGL's
 * blending sums the weights and the weighted values. The result equals the interpolation of
 * vtkPenumbraIrradianceCache at the same points: ambient occlusion that darkens the image, or
 * irradiance that is multiplied by its colors. The records are any vtkPolyData written by the
 * cache, for this view or for others. No rays are traced, also when the camera moves.
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

  /** Inserts a pass around the opaque props of the renderer, or returns the existing one. */
  static vtkPenumbraIrradianceSplatPass* AddTo(vtkRenderer* renderer);
  /** Removes the pass from the renderer, if it has one. */
  static void RemoveFrom(vtkRenderer* renderer);

  ///@{
  /**
   * Records as returned by vtkPenumbraIrradianceCache::GetRecords() or GetIrradianceRecords(), in
   * world coordinates. Without records the image of the delegate pass is unchanged. Default: none.
   */
  virtual void SetRecords(vtkPolyData* records);
  vtkPolyData* GetRecords();
  ///@}

  ///@{
  /**
   * Maximum angle between the normals of a record and of a surface that uses it, in degrees. 0
   * selects the value of the field data array `NormalAngle` of the records, or 9 degrees [IC]
   * without that array. Range: [0, 90]. Default: 0.
   */
  vtkPenumbraSetClampedNumberMacro(NormalAngle, 0.0, 90.0);
  vtkGetMacro(NormalAngle, double);
  ///@}

  ///@{
  /**
   * Strength of the effect. With occlusion: rgb = color * (1 - Strength * occlusion). With
   * irradiance: rgb = color * Strength * irradiance / pi, where color is the diffuse reflectance,
   * rendered without lighting. Range: [0, 1]. Default: 1.
   */
  vtkPenumbraSetClampedNumberMacro(Strength, 0.0, 1.0);
  vtkGetMacro(Strength, double);
  ///@}

  /**
   * Copies the interpolated values of the last frame, one tuple per pixel: `AmbientOcclusion` (1
   * component) or `Irradiance` (3 components), and `Weight`, the sum of the weights of the records,
   * which is 0 if no record covers the pixel.
   */
  void CopyResult(vtkImageData* image);

  /**
   * Statistics of the last frame: `Cache/Records`, the number of records rendered;
   * `Pixels/Interpolated`, the fraction of the surface pixels that at least one record covers;
   * `Pixels/Invalid`, the fraction at which an invalid record has the largest weight. There the
   * cache would trace rays, and the error of the interpolated value is unknown.
   */
  vtkFieldData* GetStatistics();

  void ReleaseGraphicsResources(vtkWindow* w) override;

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
