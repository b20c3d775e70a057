// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraMedium
 * @brief   Haze: a homogeneous medium in which light shafts are seen.
 *
 * Along a view ray of length s light is lost as exp(-Extinction s), and each light adds
 *
 *   integral over t of Scattering p(cosine) E V(t) exp(-Extinction (t + l(t))) dt,
 *
 * p the phase function, V = 0 in shadow, l the light's own way through the medium; in a medium
 * without end l = 0 for directional lights, and the integral over a lit ray is [Shafts eq. 1].
 * E is the light's colour times its intensity and, of positional lights, its attenuation.
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
   * Share of light scattered per world unit. Negative: a quarter over the diagonal of the scene.
   * Default: -1.
   */
  vtkSetMacro(Scattering, double);
  vtkGetMacro(Scattering, double);
  ///@}

  ///@{
  /**
   * Share of light lost per world unit, scattering included; less than Scattering means Scattering:
   * nothing is absorbed. Default: -1.
   */
  vtkSetMacro(Extinction, double);
  vtkGetMacro(Extinction, double);
  ///@}

  /** Where scattered light goes. */
  enum Phases
  {
    ISOTROPIC,        ///< everywhere alike: 1 / (4 pi)
    RAYLEIGH,         ///< small particles: 3 / (16 pi) (1 + cosine^2)
    HENYEY_GREENSTEIN ///< forward or backward, see Asymmetry
  };
  ///@{
  /** The phase function. Default: ISOTROPIC. */
  vtkSetClampMacro(Phase, int, ISOTROPIC, HENYEY_GREENSTEIN);
  vtkGetMacro(Phase, int);
  ///@}

  ///@{
  /** HENYEY_GREENSTEIN: the mean cosine of scattering, -0.999 to 0.999; positive: forward. Default: 0.6. */
  vtkSetClampMacro(Asymmetry, double, -0.999, 0.999);
  vtkGetMacro(Asymmetry, double);
  ///@}

  ///@{
  /**
   * The box that the medium fills, in world coordinates (xmin, xmax, ymin, ...), any of them infinite.
   * Default: everywhere.
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

  static constexpr double Endless = std::numeric_limits<double>::infinity();

  double Scattering = -1.0;
  double Extinction = -1.0;
  int Phase = ISOTROPIC;
  double Asymmetry = 0.6;
  double Bounds[6] = { -Endless, Endless, -Endless, Endless, -Endless, Endless };
};

#endif
