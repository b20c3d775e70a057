// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageRegion.h"

#include "Edges/EdgeConstants.h"
#include "Edges/SubpixelTriangles.h"
#include "Edges/UnsteadyNormals.h"
#include "RegionRenderer.h"
#include "Scene.h"
#include "Surface.h"

namespace penumbra
{

namespace
{

std::vector<MeshEdge> FindEdges(const Surface& surface, bool isDense, bool isUnsteady,
  const IntegrationSettings& integration, const Camera& camera)
{
  const double contrast = EdgeContrastFraction * integration.Tolerance;
  return surface.IsRound()          ? std::vector<MeshEdge>()
    : isDense && !surface.Instances ? FindEdgesOfDenseMesh(surface, contrast, camera)
                                    : FindMeshEdges(surface, contrast, isUnsteady);
}

}

SceneEdges FindSceneEdges(
  const Scene& scene, const RenderSettings& settings, const ProgressCallback& progress)
{
  const IntegrationSettings& integration = settings.Integration;
  SceneEdges edges;
  if (integration.Method != CoverageMethods::Silhouettes &&
    (integration.Method == CoverageMethods::Uniform || !integration.FindSmallObjects))
  {
    return edges;
  }
  for (const Surface& surface : scene.Surfaces)
  {
    ThrowIfStopped(progress, 0.0);
    edges.Flags.Dense.push_back(HasSubpixelTriangles(surface, scene.ViewCamera));
    edges.Flags.Unsteady.push_back(HasUnsteadyNormals(surface));
    edges.EdgesBySurface.push_back(FindEdges(surface, edges.Flags.Dense.back(),
      edges.Flags.Unsteady.back(), integration, scene.ViewCamera));
  }
  return edges;
}

void UpdateSceneEdges(const Scene& scene, const RenderSettings& settings,
  const std::vector<SurfaceChange>& changes, const ProgressCallback& progress, SceneEdges& edges)
{
  std::vector<char> isChanged(edges.EdgesBySurface.size(), 0);
  for (const SurfaceChange& change : changes)
  {
    if (change.Surface < isChanged.size()) // no edges are found without small objects
    {
      isChanged[change.Surface] = 1;
    }
  }
  for (std::size_t i = 0; i < edges.EdgesBySurface.size(); ++i)
  {
    ThrowIfStopped(progress, 0.0);
    const Surface& surface = scene.Surfaces[i];
    const char wasDense = edges.Flags.Dense[i];
    edges.Flags.Dense[i] = HasSubpixelTriangles(surface, scene.ViewCamera);
    if (isChanged[i])
    {
      edges.Flags.Unsteady[i] = HasUnsteadyNormals(surface);
    }
    if (isChanged[i] || ((edges.Flags.Dense[i] || wasDense) && !surface.Instances))
    {
      edges.EdgesBySurface[i] = FindEdges(surface, edges.Flags.Dense[i], edges.Flags.Unsteady[i],
        settings.Integration, scene.ViewCamera);
    }
  }
}

bool RenderRegion(const CameraRayTracer& tracer, const SceneEdges& sceneEdges,
  const RenderSettings& settings, const ProgressCallback& progress, ImageRegion& region)
{
  RegionRenderer renderer(tracer, sceneEdges, settings, region.Low, region.High);
  try
  {
    renderer.Run(progress);
  }
  catch (const Stopped&)
  {
    return false;
  }
  region = renderer.TakeResult();
  return true;
}

}
