// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraIrradianceProvider
 * @brief   Who answers: how much of the sky does a point not see, and how much light arrives there?
 *
 * Shading asks a source for the occlusion of points: the share of the cosine-weighted hemisphere
 * above the point in which something is met nearer than a radius,
 *
 *   AO(p, n) = 1/pi * integral over directions w with w.n > 0 of D(t(p, w)) (w.n) dw,
 *
 * D = 1 for t < Radius unless a fall-off is chosen, 0 beyond; 0 is open, 1 is blocked. Surfaces block from both sides; lines
 * and points do not block. The default source, vtkPenumbraBruteForceIrradiance, shoots rays for every
 * point; a source may also keep what it found and interpolate.
 *
 * and for the irradiance there, E = the integral of the radiance that comes from w, times w.n: pi
 * under a sky of radiance 1.
 *
 * Use: Begin() once per picture, then Occlusion() from any number of threads at once; likewise
 * BeginIrradiance() and Irradiance(). The same
 * point must get the same answer whatever was asked before, on any thread: pictures must not
 * depend on the number of threads or on tiles.
 */
#ifndef vtkPenumbraIrradianceSource_h
#define vtkPenumbraIrradianceSource_h

#include "vtkObject.h"
#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro

#include <functional> // for progress

class vtkFieldData;

namespace penumbra
{
class Illumination;
class RayScene;
}

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT vtkPenumbraIrradianceProvider : public vtkObject
{
public:
  vtkAbstractTypeMacro(vtkPenumbraIrradianceProvider, vtkObject);

  /** An answer: the value, its standard error as far as the source can tell, rays traced for it. */
  struct Estimate
  {
    double Value = 0.0;
    double Error = 0.0;
    long long Rays = 0;
  };

  /** How much an occluder at distance t < Radius counts; with an infinite Radius always 1. */
  enum Falloffs
  {
    NO_FALLOFF, ///< 1
    LINEAR,     ///< 1 - t / Radius
    QUADRATIC,  ///< 1 - (t / Radius)^2
    SQUARE_ROOT ///< 1 - sqrt(t / Radius)
  };

  /** Which occluders count, and how much: a radius in world units, may be infinite, and a fall-off. */
  struct Occluders
  {
    Occluders(double radius, int falloff = NO_FALLOFF)
      : Radius(radius),
        Falloff(falloff)
    {
    }
    double Radius;
    int Falloff;
  };

  /** Told the share of the work that is done; true asks to stop. */
  using Progress = std::function<bool(double)>;

  /**
   * Questions about `scene` follow: which `occluders` count (a number: all within that radius),
   * answers with a standard error of at most `tolerance`. No question follows once the scene is
   * gone. What was found for the same scene and the same arguments may be kept: every part of a
   * picture begins anew. False when `progress` stopped it; then no question follows.
   */
  virtual bool Begin(const penumbra::RayScene& scene, const Occluders& occluders, double tolerance,
    const Progress& progress = {}) = 0;

  /**
   * Occlusion at `point` (world coordinates) under the hemisphere about `normal` (unit). The
   * caller chooses the side: pictures ask about the geometric normal that faces the eye.
   */
  virtual Estimate Occlusion(const double point[3], const double normal[3]) const = 0;

  /**
   * The same with a standard error of at most `tolerance` instead, for one of several points whose
   * answers will be averaged: it must be no bias and independent from point to point. Default:
   * Occlusion().
   */
  virtual Estimate OcclusionWithin(
    const double point[3], const double normal[3], double vtkNotUsed(tolerance)) const
  {
    return this->Occlusion(point, normal);
  }

  /** Light that arrives: irradiance in red, green and blue, its standard error, rays traced for it. */
  struct Light
  {
    double Value[3] = { 0.0, 0.0, 0.0 };
    double Error = 0.0;
    long long Rays = 0;
  };

  /**
   * The same as Begin() for questions about `light`, `tolerance` in the unit of irradiance. What `light`
   * refers to must last as long as questions follow; it itself need not.
   */
  virtual bool BeginIrradiance(
    const penumbra::Illumination& light, double tolerance, const Progress& progress = {}) = 0;

  /** Irradiance at `point` (world) about `normal` (unit), with a standard error of at most `tolerance`. */
  virtual Light Irradiance(
    const double point[3], const double normal[3], double tolerance) const = 0;

  /** Adds counts since Begin() to `statistics`, one value an array. Default: none. */
  virtual void Report(vtkFieldData* vtkNotUsed(statistics)) const {}

protected:
  vtkPenumbraIrradianceProvider() = default;
  ~vtkPenumbraIrradianceProvider() override = default;

private:
  vtkPenumbraIrradianceProvider(const vtkPenumbraIrradianceProvider&) = delete;
  void operator=(const vtkPenumbraIrradianceProvider&) = delete;
};

#endif
