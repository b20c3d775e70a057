// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraEnvironment
 * @brief   A picture of everything around that light comes from: latitudes and longitudes.
 *
 * Give it to vtkPenumbraRayCaster or vtkPenumbraIrradianceFilter; it takes the place of their
 * EnvironmentColor. The picture lies on a sphere infinitely far away as in vtkRenderer and vtkSkybox: its
 * upper border is Up, its middle column Right, and columns to the right of that lie towards Right x Up.
 * Each texel is one colour.
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
   * The picture: scalars at its points with 1 (grey) or 3 or more components (red, green, blue), bottom row
   * first. Floats (such as those of vtkHDRReader) are radiance as they are; whole numbers of 8 or 16 bits
   * are sRGB, the greatest of them radiance 1. Default: none.
   */
  virtual void SetImage(vtkImageData* image);
  vtkImageData* GetImage();
  ///@}

  ///@{
  /** Multiplies every radiance, 0 up. Default: 1. */
  vtkSetClampMacro(Intensity, double, 0.0, 1e6);
  vtkGetMacro(Intensity, double);
  ///@}

  ///@{
  /** Where the upper border of the picture lies, of any length. Default: 0, 1, 0. */
  vtkSetVector3Macro(Up, double);
  vtkGetVector3Macro(Up, double);
  ///@}

  ///@{
  /** Where the middle of the picture lies, as near to this as Up allows. Default: 1, 0, 0. */
  vtkSetVector3Macro(Right, double);
  vtkGetVector3Macro(Right, double);
  ///@}

  /**
   * The picture as rays ask it, the same until something changes. Throws std::runtime_error where there
   * is none, where it is no picture of finite colours from 0 up, or where Up is no direction.
   */
  VTK_WRAPEXCLUDE std::shared_ptr<const penumbra::EnvironmentMap> GetMap();

  /** Also that of the picture. */
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
