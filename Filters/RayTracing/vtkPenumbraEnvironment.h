// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraEnvironment
 * @brief   Environment map in latitude-longitude (equirectangular) projection.
 *
 * Pass it to vtkPenumbraRayCaster or vtkPenumbraIrradianceFilter, where it replaces
 * EnvironmentColor. The image covers a sphere at infinity with the orientation of vtkRenderer and
 * vtkSkybox: the top edge is the direction Up, the middle column is Right, and the columns to the
 * right of the middle turn toward Right x Up. Texels have constant color: they are not
 * interpolated.
 */
#ifndef vtkPenumbraEnvironment_h
#define vtkPenumbraEnvironment_h

#include "vtkObject.h"
#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro
#include "vtkSmartPointer.h"                    // for members

#include <memory> // for std::shared_ptr

class vtkImageData;

namespace penumbra
{
class EnvironmentMap;
}

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT vtkPenumbraEnvironment : public vtkObject
{
public:
  static vtkPenumbraEnvironment* New();
  vtkTypeMacro(vtkPenumbraEnvironment, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Environment image, one slice, with point scalars of 1 (gray) or at least 3 components (red,
   * green, blue), bottom row first. Floating-point values (as read by vtkHDRReader) are radiance.
   * Integers are sRGB-encoded, and the largest value of their type is radiance 1. Default: nullptr.
   */
  virtual void SetImage(vtkImageData* image);
  vtkImageData* GetImage();
  ///@}

  ///@{
  /** Factor of all radiances. Range: [0, 1e6]. Default: 1. */
  vtkSetClampMacro(Intensity, double, 0.0, 1e6);
  vtkGetMacro(Intensity, double);
  ///@}

  ///@{
  /**
   * Direction of the top edge of the image, finite and nonzero; need not be unit. Default: (0, 1,
   * 0).
   */
  vtkSetVector3Macro(Up, double);
  vtkGetVector3Macro(Up, double);
  ///@}

  ///@{
  /**
   * Direction of the middle column of the image. It is made perpendicular to Up. If it is parallel
   * to Up, an arbitrary perpendicular direction is used. Default: (1, 0, 0).
   */
  vtkSetVector3Macro(Right, double);
  vtkGetVector3Macro(Right, double);
  ///@}

  /**
   * Environment map for ray queries; it is rebuilt only after a modification. Throws
   * std::runtime_error if there is no image, if a radiance is negative or not finite, or if Up is
   * zero or not finite.
   */
  VTK_WRAPEXCLUDE std::shared_ptr<const penumbra::EnvironmentMap> GetMap();

  /** Modification time, including that of the image. */
  vtkMTimeType GetMTime() override;

protected:
  vtkPenumbraEnvironment();
  ~vtkPenumbraEnvironment() override;

private:
  vtkPenumbraEnvironment(const vtkPenumbraEnvironment&) = delete;
  void operator=(const vtkPenumbraEnvironment&) = delete;

  vtkSmartPointer<vtkImageData> Image;
  double Intensity = 1.0;
  double Up[3] = { 0.0, 1.0, 0.0 };
  double Right[3] = { 1.0, 0.0, 0.0 };
  std::shared_ptr<const penumbra::EnvironmentMap> Map;
  vtkMTimeType MapTime = 0;
};

#endif
