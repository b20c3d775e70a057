// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BakingCase.h"

#include "Meshes.h"

#include "Execution/ParallelFor.h"

#include "vtkNew.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace penumbra
{
namespace
{

/// CPU seconds of all threads.
double Seconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}

BakingMesh::BakingMesh(std::string name, vtkPolyData* data)
  : Name(std::move(name)),
    Input(PrepareBakeInput(Smooth(data), BakeInputOptions())),
    Rays(this->Input.OccluderScene, 0)
{
}

BakingCase::BakingCase(std::shared_ptr<const BakingMesh> mesh, bool unbounded)
  : Mesh(std::move(mesh)),
    Radius(unbounded ? VTK_DOUBLE_MAX : DefaultRadiusFraction * this->Mesh->Input.Diagonal)
{
  const BakeInput& input = this->Mesh->Input;
  vtkNew<vtkPenumbraBruteForceIrradiance> provider;
  provider->SetMinimumRays(ReferenceRays);
  provider->SetMaximumRays(ReferenceRays);
  provider->Begin(this->Mesh->Rays, this->Radius, 1.0);
  for (std::size_t k = 0; k < ReferencePoints; ++k)
  {
    this->Sites.push_back(k * input.Sites.size() / ReferencePoints);
  }
  this->References.resize(ReferencePoints);
  ParallelFor(0, static_cast<int>(ReferencePoints), 0, [&](int k) {
    const RecordCandidate& site = input.Sites[this->Sites[k]];
    const glm::dvec3 world = input.OccluderScene.ToWorld(site.Position);
    const glm::dvec3 normal(site.Normal);
    this->References[k] = provider->Occlusion(&world.x, &normal.x).Value;
  });
}

std::string BakingCase::GetName() const
{
  return this->Mesh->Name + (this->Radius == VTK_DOUBLE_MAX ? ", no radius" : ", default radius");
}

BakingResult BakingCase::Bake(double tolerance, const OcclusionBakingConstants& constants) const
{
  const BakeInput& input = this->Mesh->Input;
  const OcclusionGatherer gatherer(this->Mesh->Rays,
    DistanceFalloff::InScene(
      this->Radius, vtkPenumbraIrradianceProvider::NO_FALLOFF, input.OccluderScene.Scale));
  RecordOctree tree;
  tree.Initialize(glm::vec3(0.f), .5f);
  BakedValues baked;
  const double start = Seconds();
  BakeOcclusion(input, this->Mesh->Rays, gatherer, { tolerance, { this->Radius }, true }, constants,
    tree, {}, baked);
  BakingResult result;
  result.Seconds = Seconds() - start;
  for (std::size_t k = 0; k < this->Sites.size(); ++k)
  {
    const double error = baked.Values[this->Sites[k]].Mean.x - this->References[k];
    result.Error += error * error;
    result.Outliers += std::abs(error) > 3.0 * tolerance ? 1.0 : 0.0;
  }
  result.Error = std::sqrt(result.Error / static_cast<double>(this->Sites.size()));
  result.Outliers /= static_cast<double>(this->Sites.size());
  const auto points = static_cast<double>(input.Sites.size());
  result.Rays = static_cast<double>(baked.BruteForceRays + baked.GatherRays) / points;
  const auto fraction = [&baked, points](BakingMethod method) {
    return static_cast<double>(std::count(baked.Methods.begin(), baked.Methods.end(), method)) /
      points;
  };
  result.Interpolated = fraction(BakingMethod::Interpolated);
  result.Denoised = fraction(BakingMethod::Denoised);
  return result;
}

}
