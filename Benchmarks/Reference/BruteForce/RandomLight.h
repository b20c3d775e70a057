// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Reference images with light effects. Each of many regular samples of a pixel has a few random rays
// over the hemisphere, one ray to a random point of a light with a size, and finely marched light
// shafts. They share intersection and shading with the ray caster, but neither edges, coverage,
// sequences, records nor error estimates.
#ifndef penumbra_RandomLight_h
#define penumbra_RandomLight_h

#include "StratifiedReference.h"

#include "vtkPenumbraIrradianceProvider.h"

#include <cstdint>
#include <functional>
#include <memory>

namespace penumbra
{

/// Estimates occlusion and irradiance by independent random rays.
class RandomLight : public vtkPenumbraIrradianceProvider
{
public:
  static RandomLight* New();
  vtkTypeMacro(RandomLight, vtkPenumbraIrradianceProvider);

  bool Begin(const RayScene& scene, const Occluders& occluders, double tolerance,
    const Progress& progress) override;
  Estimate Occlusion(
    const double point[3], const double normal[3], const double geometricNormal[3]) const override;
  bool BeginIrradiance(
    const Illumination& light, double tolerance, const Progress& progress) override;
  Light Irradiance(const double point[3], const double normal[3], double tolerance,
    const double geometricNormal[3]) const override;

  std::uint32_t Seed = 0;
  int RaysPerPoint = 4;

protected:
  RandomLight();
  ~RandomLight() override;

private:
  const RayScene* Rays = nullptr;
  Occluders Settings = 0.0;
  std::unique_ptr<Illumination> Lighting;
};

/// Renders two independent images with `side` x `side` and (`side` - 1) x (`side` - 1) samples per
/// pixel. `choose` sets the light effects.
StratifiedReference DrawWithLight(vtkRenderer* renderer, int width, int height, int side,
  const std::function<void(vtkPenumbraRayCaster*)>& choose);

}
#endif
