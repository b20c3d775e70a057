// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Baked occlusion of one mesh, compared with many rays per point.
#ifndef penumbra_BakingCase_h
#define penumbra_BakingCase_h

#include "Baking/OcclusionBaking.h"
#include "Embree/RayScene.h"

#include "vtkSmartPointer.h"

#include <memory>
#include <string>
#include <vector>

class vtkPolyData;

namespace penumbra
{

/// A mesh as the input of baking; shared by the cases with different maximum distances.
struct BakingMesh
{
  BakingMesh(std::string name, vtkPolyData* data);

  std::string Name;
  BakeInput Input;
  RayScene Rays;
};

/// Error and cost of one bake.
struct BakingResult
{
  double Error = 0.0;        ///< RMSE over the reference points
  double Rays = 0.0;         ///< per point of the mesh
  double Interpolated = 0.0; ///< fraction of the points with values from records
  double Denoised = 0.0;     ///< fraction of the points with denoised estimates
  double Outliers = 0.0; ///< fraction of the reference points with more than 3 tolerances of error
  double Seconds = 0.0;  ///< CPU seconds, without normals, acceleration structure and contacts
};

/// A mesh and a maximum distance of occluders.
class BakingCase
{
public:
  /// Traces the reference rays.
  BakingCase(std::shared_ptr<const BakingMesh> mesh, bool unbounded);

  /// Name of the mesh and the maximum distance.
  std::string GetName() const;
  std::size_t GetNumberOfPoints() const { return this->Mesh->Input.Sites.size(); }

  BakingResult Bake(double tolerance, const OcclusionBakingConstants& constants) const;

  static constexpr int ReferenceRays = 4096; ///< per reference point
  static constexpr std::size_t ReferencePoints = 1000;

private:
  std::shared_ptr<const BakingMesh> Mesh;
  double Radius; ///< world units
  std::vector<std::size_t> Sites;
  std::vector<double> References;
};

}
#endif
