// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraGatherer
 * @brief   Interface for objects that sample the hemisphere of a record without rays [IC].
 *
 * Set with vtkPenumbraIrradianceCache::SetGatherer(). vtkPenumbraCubeMapGatherer rasterizes the
 * scene. All gatherers shade what they find in the same way, so that their records can replace each
 * other.
 */
#ifndef vtkPenumbraGatherer_h
#define vtkPenumbraGatherer_h

#include "vtkObject.h"
#include "vtkPenumbraFiltersIrradianceModule.h" // for export macro

#include <memory> // for std::unique_ptr

class vtkFieldData;

namespace penumbra
{
class Gatherer;
class RayGatherer;
}

class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT vtkPenumbraGatherer : public vtkObject
{
public:
  vtkAbstractTypeMacro(vtkPenumbraGatherer, vtkObject);

  /**
   * Returns a gatherer for the scene of `rayGatherer`, which also shades the hits. `rayGatherer`
   * and this object must outlive the returned object. Throws std::runtime_error if this machine or
   * the scene is not supported.
   */
  VTK_WRAPEXCLUDE virtual std::unique_ptr<penumbra::Gatherer> Make(
    const penumbra::RayGatherer& rayGatherer) = 0;

  /** Adds the statistics collected since Make() to `statistics`. */
  virtual void Report(vtkFieldData* statistics) const = 0;

protected:
  vtkPenumbraGatherer() = default;
  ~vtkPenumbraGatherer() override = default;

private:
  vtkPenumbraGatherer(const vtkPenumbraGatherer&) = delete;
  void operator=(const vtkPenumbraGatherer&) = delete;
};

#endif
