// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RandomLight.h"

#include "Embree/RayScene.h"
#include "Scene.h"
#include "Shading/DistanceFalloff.h"
#include "Shading/HemisphereSampling.h"
#include "Shading/Illumination.h"
#include "Shading/TranslucentOcclusion.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPenumbraRayCasterConstants.h"

#include <glm/gtc/constants.hpp>

namespace penumbra
{
namespace
{

/// Number of steps of light shafts along a ray.
constexpr int ShaftSteps = 256;
/// Transmittance at which rays of occlusion end.
constexpr float OcclusionCut = 1e-4f;

struct RandomPoint
{
  glm::vec3 Position;
  SurfaceNormals Normals;
  std::uint32_t Random;

  RandomPoint(const RayScene& rays, const double point[3], const double normal[3],
    const double geometricNormal[3], std::uint32_t seed)
    : Position(rays.GetScene().FromWorld(point)),
      Normals(glm::vec3(normal[0], normal[1], normal[2]))
  {
    if (geometricNormal)
    {
      this->Normals.Geometric = { geometricNormal[0], geometricNormal[1], geometricNormal[2] };
    }
    this->Random = MixBits(HashPoint(this->Position, this->Normals.Shading) ^ MixBits(seed));
  }
};

}

vtkStandardNewMacro(RandomLight);
RandomLight::RandomLight() = default;
RandomLight::~RandomLight() = default;

bool RandomLight::Begin(const RayScene& scene, const Occluders& occluders, double, const Progress&)
{
  this->Rays = &scene;
  this->Settings = occluders;
  return true;
}

vtkPenumbraIrradianceProvider::Estimate RandomLight::Occlusion(
  const double point[3], const double normal[3], const double geometricNormal[3]) const
{
  RandomPoint at(*this->Rays, point, normal, geometricNormal, this->Seed);
  const glm::mat3 frame = FrameFromNormal(at.Normals.Shading);
  const DistanceFalloff falloff = DistanceFalloff::InScene(
    this->Settings.Radius, this->Settings.Falloff, this->Rays->GetScene().Scale);
  Estimate result;
  for (int i = 0; i < this->RaysPerPoint; ++i)
  {
    const float u = NextFloat(at.Random);
    const float v = NextFloat(at.Random);
    Ray ray = Illumination::SpawnRay(
      at.Position, at.Normals, frame * DiskToHemisphere(SampleUniformDiskConcentric(u, v)));
    ray.Far = falloff.Radius;
    const Hit hit = SkipLinesAndPoints(*this->Rays, ray, this->Rays->Intersect(ray));
    result.Value +=
      TraceTranslucentOcclusion(*this->Rays, ray, hit, falloff, OcclusionCut, result.Rays) /
      this->RaysPerPoint;
  }
  result.Rays += this->RaysPerPoint;
  return result;
}

bool RandomLight::BeginIrradiance(const Illumination& light, double, const Progress&)
{
  this->Lighting = std::make_unique<Illumination>(light);
  return true;
}

vtkPenumbraIrradianceProvider::Light RandomLight::Irradiance(
  const double point[3], const double normal[3], double, const double geometricNormal[3]) const
{
  RandomPoint at(this->Lighting->GetRays(), point, normal, geometricNormal, this->Seed);
  Light result;
  for (int i = 0; i < this->RaysPerPoint; ++i)
  {
    const glm::vec3 radiance = this->Lighting->TracePath(
      at.Position, at.Normals, this->Lighting->GetSettings().Bounces, at.Random, result.Rays);
    for (int c = 0; c < 3; ++c)
    {
      result.Value[c] += glm::pi<double>() * radiance[c] / this->RaysPerPoint;
    }
  }
  return result;
}

StratifiedReference DrawWithLight(vtkRenderer* renderer, int width, int height, int side,
  const std::function<void(vtkPenumbraRayCaster*)>& choose)
{
  Answer images[2];
  for (std::uint32_t i = 0; i < 2; ++i)
  {
    vtkNew<RandomLight> light;
    light->Seed = i + 1;
    images[i] = Cast(renderer, width, height, [&](vtkPenumbraRayCaster* caster) {
      choose(caster);
      caster->SetNumberOfThreads(0);
      caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Uniform;
      caster->GetConstants().UniformSamples = side - static_cast<int>(i);
      caster->GetConstants().LightShaftSteps = ShaftSteps;
      caster->SetIrradianceProvider(light);
    });
  }
  StratifiedReference reference;
  for (std::size_t i = 0; i < images[0].Colors.size(); ++i)
  {
    const glm::dvec3 a = images[0].Colors[i] * images[0].Alphas[i];
    const glm::dvec3 b = images[1].Colors[i] * images[1].Alphas[i];
    reference.Colors.push_back(0.5 * (a + b));
    reference.SquaredErrors.push_back(glm::dot(a - b, a - b) / 12.0);
  }
  return reference;
}

}
