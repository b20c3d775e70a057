// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraMedium
 * @brief   Homogeneous participating medium (haze) in which light shafts are visible.
 *
 * Light is attenuated by exp(-Extinction s) along a view ray of length s, and each light adds
 *
 *   integral over t of Scattering p(cosine) E V(t) exp(-Extinction (t + l(t))) dt.
 *
 * p is the phase function, V(t) is 0 in shadow and 1 elsewhere, and l(t) is the distance that the
 * light travels through the medium. In an unbounded medium, l = 0 for directional lights, and the
 * integral over an unshadowed ray is [Shafts eq. 1]. E is the color of the light times its
 * intensity and, for positional lights, its attenuation.
 */
#ifndef vtkPenumbraMedium_h
#define vtkPenumbraMedium_h

#include "vtkObject.h"
#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro

#include <limits> // for infinite bounds

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT vtkPenumbraMedium : public vtkObject
{
public:
  static vtkPenumbraMedium* New();
  vtkTypeMacro(vtkPenumbraMedium, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Scattering coefficient: fraction of light scattered per world unit. If negative, 0.25 divided
   * by the diagonal of the scene. Default: -1.
   */
  vtkSetMacro(Scattering, double);
  vtkGetMacro(Scattering, double);
  ///@}

  ///@{
  /**
   * Extinction coefficient: fraction of light absorbed or scattered out per world unit. A value
   * below Scattering is replaced by Scattering, which means no absorption. Default: -1.
   */
  vtkSetMacro(Extinction, double);
  vtkGetMacro(Extinction, double);
  ///@}

  /** Phase function: directional distribution of scattered light. */
  enum Phases
  {
    ISOTROPIC,        ///< uniform: 1 / (4 pi)
    RAYLEIGH,         ///< small particles: 3 / (16 pi) (1 + cosine^2)
    HENYEY_GREENSTEIN ///< mostly forward or backward, see Asymmetry
  };
  ///@{
  /** Phase function, one of Phases. Default: ISOTROPIC. */
  vtkSetClampMacro(Phase, int, ISOTROPIC, HENYEY_GREENSTEIN);
  vtkGetMacro(Phase, int);
  ///@}

  ///@{
  /**
   * Mean cosine of the scattering angle of HENYEY_GREENSTEIN; positive values scatter forward.
   * Range: [-0.999, 0.999]. Default: 0.6.
   */
  vtkSetClampMacro(Asymmetry, double, -0.999, 0.999);
  vtkGetMacro(Asymmetry, double);
  ///@}

  ///@{
  /**
   * Bounding box of the medium in world coordinates: xmin, xmax, ymin, ymax, zmin, zmax. Values may
   * be infinite. Default: unbounded.
   */
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
  ///@}

protected:
  vtkPenumbraMedium() = default;
  ~vtkPenumbraMedium() override = default;

private:
  vtkPenumbraMedium(const vtkPenumbraMedium&) = delete;
  void operator=(const vtkPenumbraMedium&) = delete;

  static constexpr double Infinity = std::numeric_limits<double>::infinity();

  double Scattering = -1.0;
  double Extinction = -1.0;
  int Phase = ISOTROPIC;
  double Asymmetry = 0.6;
  double Bounds[6] = { -Infinity, Infinity, -Infinity, Infinity, -Infinity, Infinity };
};

#endif
