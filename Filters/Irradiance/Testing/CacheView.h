// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Occlusion of the cache at the visible points of a scene, and its error against a reference.
#ifndef penumbra_CacheView_h
#define penumbra_CacheView_h

#include "vtkPenumbraIrradianceCache.h"

#include "Records/PixelCandidates.h"
#include "Scenes/Solids.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace penumbra_testing
{

using namespace penumbra;

inline constexpr double Infinity = std::numeric_limits<double>::infinity();
inline constexpr int Size = 256;

/// Returns the visible points of all levels of candidates.
inline std::vector<RecordCandidate> FindVisiblePoints(const RayScene& rays)
{
  std::vector<RecordCandidate> all;
  for (int level = 0; level < ImageLevels; ++level)
  {
    const std::vector<RecordCandidate> sites = CandidatesInImage(rays, level);
    all.insert(all.end(), sites.begin(), sites.end());
  }
  return all;
}

/// Visible points and their scene.
struct CacheView
{
  const Scene& SceneData;
  std::vector<RecordCandidate> Sites;

  glm::dvec3 World(const RecordCandidate& site) const
  {
    return glm::dvec3(site.Position) / this->SceneData.Scale + this->SceneData.Origin;
  }
};

inline double QueryOcclusion(const vtkPenumbraIrradianceCache* cache, glm::dvec3 position,
  glm::dvec3 normal = { 0.0, 0.0, 1.0 })
{
  return cache->Occlusion(&position.x, &normal.x).Value;
}

using Reference = std::function<double(glm::dvec3 position, glm::dvec3 normal)>;

inline double ComputeRmse(
  const vtkPenumbraIrradianceCache* cache, const CacheView& view, const Reference& reference)
{
  double square = 0.0;
  for (const RecordCandidate& site : view.Sites)
  {
    const glm::dvec3 world = view.World(site);
    square +=
      std::pow(QueryOcclusion(cache, world, site.Normal) - reference(world, site.Normal), 2.0);
  }
  return std::sqrt(square / static_cast<double>(view.Sites.size()));
}

inline double GetStatistic(const vtkPenumbraIrradianceCache* cache, const char* name)
{
  vtkNew<vtkFieldData> statistics;
  cache->Report(statistics);
  return statistics->GetArray(name)->GetComponent(0, 0);
}

/// Makes a unit sphere with its center at height h above a floor, seen as in the benchmark.
inline void MakeSphereScene(Scene& scene, double h)
{
  AddFloor(scene, 1000.f);
  AddSphere(scene, { 0.0, 0.0, h }, 1.0, 400);
  LookAt(scene, { 0.0, -7.0, 4.0 }, { 0.0, 0.0, .6 }, 45.0, Size, Size);
}

inline Reference SphereReference(double h)
{
  return [h](glm::dvec3 position, glm::dvec3 normal) {
    const double square = position.x * position.x + position.y * position.y;
    return normal.z > .999999 && position.z < 1e-3 ? h / std::pow(h * h + square, 1.5)
                                                   : .5 * (1.0 - normal.z);
  };
}

}
#endif
