// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// BVH over the opaque meshes of a renderer. It is rebuilt when the meshes change; camera motion
// reuses it.
#ifndef penumbra_Traced_OccluderGeometry_h
#define penumbra_Traced_OccluderGeometry_h

#include "Camera.h"
#include "Embree/RayScene.h"

#include "vtkType.h"

#include <memory>
#include <string>

class vtkRenderer;

namespace penumbra
{

struct Scene;

class OccluderGeometry
{
public:
  OccluderGeometry();
  ~OccluderGeometry();

  /// Updates the BVH for rays of length `radius` (world units). Returns whether it was rebuilt.
  /// Throws the exceptions of RayScene.
  bool Update(vtkRenderer* renderer, double radius);

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
  double CameraPosition[3] = { 0.0, 0.0, 0.0 }; ///< at the last build, world coordinates
  std::string Missing;
};

}
#endif
