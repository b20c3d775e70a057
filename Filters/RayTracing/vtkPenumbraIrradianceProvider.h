// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraIrradianceProvider
 * @brief   Interface for objects that compute ambient occlusion and irradiance at a surface point.
 *
 * The occlusion of a point is the fraction of the cosine-weighted hemisphere above it in which a
 * surface is hit nearer than a radius:
 *
 *   AO(p, n) = 1/pi * integral over directions w with w.n > 0 of D(t(p, w)) (w.n) dw.
 *
 * t is the distance of the first hit. D = 1 for t < Radius, or a falloff, and D = 0 beyond. Open
 * points have the value 0, fully occluded points 1. Surfaces occlude from both sides; spheres and
 * tubes occlude, flat lines and points do not. A translucent surface of opacity a occludes the
 * fraction a of what the surfaces in front of it let pass. The irradiance of a point is the
 * integral of the incident radiance times w.n: pi under a sky of radiance 1.
 *
 * The default provider, vtkPenumbraBruteForceIrradiance, traces rays for every point. Other
 * providers may cache results and interpolate between them.
 *
 * Call Begin() once per image, then Occlusion() from any number of threads; likewise
 * BeginIrradiance() and Irradiance(). The result for a point must not depend on the thread or on
 * earlier calls, so that images do not depend on the number of threads or on tiles.
 */
#ifndef vtkPenumbraIrradianceProvider_h
#define vtkPenumbraIrradianceProvider_h

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

  /** Estimated value, its estimated standard error, and the number of rays traced for it. */
  struct Estimate
  {
    double Value = 0.0;
    double Error = 0.0;
    long long Rays = 0;
  };

  /** Falloff D(t) of an occluder at distance t < Radius; always 1 with an infinite Radius. */
  enum Falloffs
  {
    NO_FALLOFF, ///< 1
    LINEAR,     ///< 1 - t / Radius
    QUADRATIC,  ///< 1 - (t / Radius)^2
    SQUARE_ROOT ///< 1 - sqrt(t / Radius)
  };

  /** Radius of occluders in world units, which may be infinite, and their falloff. */
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

  /** Called with the completed fraction of the work, in [0, 1]; returns true to stop. */
  using Progress = std::function<bool(double)>;

  /**
   * Prepares calls of Occlusion() for `scene`, which must exist until the last of them. `occluders`
   * is a radius or a radius and a falloff. `tolerance` is the accepted standard error of each
   * result. Begin() is called for each part of an image, so a provider may keep its results as long
   * as the scene and the arguments are the same. Returns false if `progress` stopped it;
   * Occlusion() must not be called then.
   */
  virtual bool Begin(const penumbra::RayScene& scene, const Occluders& occluders, double tolerance,
    const Progress& progress = {}) = 0;

  /**
   * Returns the occlusion at `point` (world coordinates) in the hemisphere about `normal` (unit).
   * The caller chooses the side: images use the interpolated normal, on the side that faces the
   * camera. `geometricNormal` (unit) is the normal of the polygon; null if it equals `normal`.
   * Directions below the polygon are reflected by its plane.
   */
  virtual Estimate Occlusion(const double point[3], const double normal[3],
    const double geometricNormal[3] = nullptr) const = 0;

  /**
   * Returns the occlusion with a standard error of at most `tolerance` instead, for one of several
   * points whose results are averaged. The errors must be unbiased and independent between points.
   * The default implementation calls Occlusion().
   */
  virtual Estimate OcclusionWithin(const double point[3], const double normal[3],
    double vtkNotUsed(tolerance), const double geometricNormal[3] = nullptr) const
  {
    return this->Occlusion(point, normal, geometricNormal);
  }

  /**
   * Returns true if an image may estimate its ambient occlusion, its irradiance, or both, for all pixels
   * together, and ask the provider only where that is not possible. Called after Begin() and
   * BeginIrradiance(). Default: false.
   */
  virtual bool JoinsPixels(bool vtkNotUsed(occlusion), bool vtkNotUsed(irradiance)) const
  {
    return false;
  }

  /**
   * Estimated irradiance (red, green, blue), its standard error, and the number of rays traced for
   * it.
   */
  struct Light
  {
    double Value[3] = { 0.0, 0.0, 0.0 };
    double Error = 0.0;
    long long Rays = 0;
  };

  /**
   * Prepares calls of Irradiance() for `light`, as Begin() does for Occlusion(). `tolerance` has
   * the unit of irradiance. The scene that `light` refers to must exist until the last call;
   * `light` need not.
   */
  virtual bool BeginIrradiance(
    const penumbra::Illumination& light, double tolerance, const Progress& progress = {}) = 0;

  /**
   * Returns the irradiance at `point` (world coordinates) in the hemisphere about `normal` (unit),
   * with a standard error of at most `tolerance`. `geometricNormal` as for Occlusion().
   */
  virtual Light Irradiance(const double point[3], const double normal[3], double tolerance,
    const double geometricNormal[3] = nullptr) const = 0;

  /** Adds counts since Begin() to `statistics`, as arrays of one value. The default adds none. */
  virtual void Report(vtkFieldData* vtkNotUsed(statistics)) const {}

protected:
  vtkPenumbraIrradianceProvider() = default;
  ~vtkPenumbraIrradianceProvider() override = default;

private:
  vtkPenumbraIrradianceProvider(const vtkPenumbraIrradianceProvider&) = delete;
  void operator=(const vtkPenumbraIrradianceProvider&) = delete;
};

#endif
