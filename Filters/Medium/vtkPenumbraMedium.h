// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraMedium
 * @brief   Participating medium (haze) in which light shafts are visible.
 *
 * In each color channel, light is attenuated by exp(-extinction c(s)) along a view ray of length s,
 * and each light adds
 *
 *   integral over t of d(t) sigma(cosine) E V(t) exp(-extinction (c(t) + l(t))) dt,
 *
 * where sigma = scattering p(cosine) + Rayleigh scattering p_R(cosine). p and p_R are the phase
 * functions, d is the relative density of the medium, c its integral along the view ray and l that
 * along the path of the light through the medium. V(t) is 0 in shadow and 1 elsewhere. In a
 * homogeneous medium d = 1, and c is the length. If the medium is homogeneous and unbounded, l = 0
 * for directional lights, and the integral over an unshadowed ray is [Shafts eq. 1]. E is the color
 * of the light times its intensity and, for positional lights, its attenuation.
 */
#ifndef vtkPenumbraMedium_h
#define vtkPenumbraMedium_h

#include "vtkObject.h"
#include "vtkPenumbraFiltersMediumModule.h" // for export macro
#include "vtkSmartPointer.h"                // for the density image

#include <limits> // for infinite bounds
#include <string> // for messages

class vtkDataObject;
class vtkImageData;

class VTKPENUMBRAFILTERSMEDIUM_EXPORT vtkPenumbraMedium : public vtkObject
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
   * Extinction coefficient: fraction of light absorbed or scattered out per world unit. In each
   * channel, a value below that of Scattering is replaced by it, which means no absorption.
   * Default: -1.
   */
  vtkSetMacro(Extinction, double);
  vtkGetMacro(Extinction, double);
  ///@}

  ///@{
  /**
   * Factors on Scattering and Extinction in the red, green and blue channel. Range: >= 0. Default:
   * (1, 1, 1), a gray medium.
   */
  vtkSetVector3Macro(ScatteringColor, double);
  vtkGetVector3Macro(ScatteringColor, double);
  vtkSetVector3Macro(ExtinctionColor, double);
  vtkGetVector3Macro(ExtinctionColor, double);
  ///@}

  ///@{
  /**
   * Scattering coefficient, per world unit, of small particles in the green channel (550 nm), in
   * addition to Scattering and Extinction. It is proportional to the power -4 of the wavelength:
   * 0.428 of it in red (680 nm) and 2.441 in blue (440 nm), and its phase function is RAYLEIGH.
   * Haze in clear air combines it with a gray Scattering and HENYEY_GREENSTEIN (Mie scattering).
   * Range: >= 0. Default: 0.
   */
  vtkSetMacro(RayleighScattering, double);
  vtkGetMacro(RayleighScattering, double);
  ///@}

  /** Phase function: directional distribution of scattered light. */
  enum Phases
  {
    ISOTROPIC,        ///< uniform: 1 / (4 pi)
    RAYLEIGH,         ///< small particles: 3 / (16 pi) (1 + cosine^2)
    HENYEY_GREENSTEIN ///< mostly forward or backward, see Asymmetry
  };
  ///@{
  /** Phase function of Scattering, one of Phases. Default: ISOTROPIC. */
  vtkSetClampMacro(Phase, int, ISOTROPIC, HENYEY_GREENSTEIN);
  vtkGetMacro(Phase, int);
  void SetPhaseToIsotropic() { this->SetPhase(ISOTROPIC); }
  void SetPhaseToRayleigh() { this->SetPhase(RAYLEIGH); }
  void SetPhaseToHenyeyGreenstein() { this->SetPhase(HENYEY_GREENSTEIN); }
  const char* GetPhaseAsString();
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

  ///@{
  /**
   * Relative density exp(-(h - BaseHeight) / ScaleHeight) at height h, the distance from the origin
   * along Up in world units. Directional lights are then specified above the medium; those from
   * below the horizon do not reach it. ScaleHeight 0: the density is 1 everywhere. Range of
   * ScaleHeight: >= 0. Default: 0. Default of BaseHeight: 0, of Up: (0, 1, 0).
   */
  vtkSetMacro(ScaleHeight, double);
  vtkGetMacro(ScaleHeight, double);
  vtkSetMacro(BaseHeight, double);
  vtkGetMacro(BaseHeight, double);
  vtkSetVector3Macro(Up, double);
  vtkGetVector3Macro(Up, double);
  ///@}

  ///@{
  /**
   * Relative density as point scalars of an image with one component, finite and not negative; a
   * factor on the density of the height. It is interpolated trilinearly, and zero outside of the
   * image. The image is three-dimensional, with at least 2 points per axis, and axis-aligned.
   * Default: null.
   */
  void SetDensity(vtkImageData* image);
  vtkImageData* GetDensity();
  ///@}

  /**
   * Return what makes `data` unusable as a density, as a sentence without subject and period, for
   * example "has no point scalars". Empty if it is usable.
   */
  static std::string FindInvalidDensity(vtkDataObject* data);

  /** Attenuation of light on its way to surfaces. */
  enum SurfaceLights
  {
    AUTOMATIC,    ///< ATTENUATED, but UNATTENUATED if the medium is gray and homogeneous
    UNATTENUATED, ///< as without a medium
    ATTENUATED    ///< as on its way to points in the medium
  };
  ///@{
  /**
   * Attenuation of lights that cast shadows on their way to surfaces. Light from other surfaces and
   * from the environment is not attenuated. Default: AUTOMATIC.
   */
  vtkSetClampMacro(SurfaceLight, int, AUTOMATIC, ATTENUATED);
  vtkGetMacro(SurfaceLight, int);
  void SetSurfaceLightToAutomatic() { this->SetSurfaceLight(AUTOMATIC); }
  void SetSurfaceLightToUnattenuated() { this->SetSurfaceLight(UNATTENUATED); }
  void SetSurfaceLightToAttenuated() { this->SetSurfaceLight(ATTENUATED); }
  const char* GetSurfaceLightAsString();
  ///@}

  ///@{
  /**
   * If on, translucent surfaces are seen through the medium. If off, only what is behind them is:
   * they stand out of the haze, as they do with vtkPenumbraLightShaftPass. Default: on.
   */
  vtkSetMacro(TranslucentSurfaces, bool);
  vtkGetMacro(TranslucentSurfaces, bool);
  vtkBooleanMacro(TranslucentSurfaces, bool);
  ///@}

  vtkMTimeType GetMTime() override;

protected:
  vtkPenumbraMedium();
  ~vtkPenumbraMedium() override;

private:
  vtkPenumbraMedium(const vtkPenumbraMedium&) = delete;
  void operator=(const vtkPenumbraMedium&) = delete;

  static constexpr double Infinity = std::numeric_limits<double>::infinity();

  double Scattering = -1.0;
  double Extinction = -1.0;
  double ScatteringColor[3] = { 1.0, 1.0, 1.0 };
  double ExtinctionColor[3] = { 1.0, 1.0, 1.0 };
  double RayleighScattering = 0.0;
  int Phase = ISOTROPIC;
  double Asymmetry = 0.6;
  double Bounds[6] = { -Infinity, Infinity, -Infinity, Infinity, -Infinity, Infinity };
  double ScaleHeight = 0.0;
  double BaseHeight = 0.0;
  double Up[3] = { 0.0, 1.0, 0.0 };
  vtkSmartPointer<vtkImageData> Density;
  int SurfaceLight = AUTOMATIC;
  bool TranslucentSurfaces = true;
};

#endif
