// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraGatherer
 * @brief   How the irradiance cache looks around from its records, other than by rays [IC].
 *
 * Give one to vtkPenumbraIrradianceCache::SetGatherer(): vtkPenumbraCubeMapGatherer rasterises. What is
 * seen means the same whoever looks, so that records of one gatherer serve where those of another do.
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
   * Looks at the scene that `seen` traces, and lets it say what that means; `seen` must outlive what is
   * returned, and this object, too. Throws std::runtime_error where this machine or the scene does not
   * allow it.
   */
  VTK_WRAPEXCLUDE virtual std::unique_ptr<penumbra::Gatherer> Make(
    const penumbra::RayGatherer& seen) = 0;

  /** Adds what it counted since Make(). */
  virtual void Report(vtkFieldData* statistics) const = 0;

protected:
  vtkPenumbraGatherer() = default;
  ~vtkPenumbraGatherer() override = default;

private:
  vtkPenumbraGatherer(const vtkPenumbraGatherer&) = delete;
  void operator=(const vtkPenumbraGatherer&) = delete;
};

#endif
