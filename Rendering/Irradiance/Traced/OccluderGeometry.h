// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A renderer's opaque meshes as a tree for rays, kept until they change: the eye may move on without
// them.
#ifndef penumbra_OccluderGeometry_h
#define penumbra_OccluderGeometry_h

#include "Embree/RayScene.h"

#include "vtkType.h"

#include <memory>
#include <string>

class vtkRenderer;

namespace penumbra
{

class OccluderGeometry
{
public:
  /// Brings the tree up to date for occluders within `radius` (world units). True when it was built
  /// anew. Throws what RayScene throws.
  bool Update(vtkRenderer* renderer, double radius);

  /// From where the scene is seen; rays that exist already do not change.
  void SetEye(const Camera& eye) { this->Meshes->ViewCamera = eye; }

  const RayScene& GetRays() const { return *this->Rays; }
  const Scene& GetScene() const { return *this->Meshes; }

  /// Whether rays can hit all props that are rendered with depth.
  bool HasAllOccluders() const { return this->Missing.empty(); }

  /// The first prop that rays cannot hit, and why; empty if there is none.
  const std::string& GetMissing() const { return this->Missing; }

private:
  std::unique_ptr<Scene> Meshes;
  std::unique_ptr<RayScene> Rays;
  vtkMTimeType Time = 0;
  double Eye[3] = { 0.0, 0.0, 0.0 };
  std::string Missing;
};

}
#endif
