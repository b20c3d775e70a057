// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Random meshes of about unit size.
#ifndef penumbra_soak_RandomMeshes_h
#define penumbra_soak_RandomMeshes_h

#include "Random.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;
class vtkPolyData;

namespace penumbra_soak
{

struct RandomMesh
{
  vtkSmartPointer<vtkPolyData> Data;
  std::string Name;
  /// VTK's image of it is arbitrary: coplanar surfaces, invalid or degenerate cells, primitives
  /// below the size of a pixel.
  bool Arbitrary = false;
};

/// Makes a mesh; `difficult` admits degenerate and adversarial ones.
RandomMesh MakeRandomMesh(Random& random, bool difficult);

/// Adds scalars, direct colors or normals to a mesh, for points or cells.
void AddRandomArrays(Random& random, vtkPolyData* mesh);

/// Makes a colored image of 2 to 64 pixels per side.
vtkSmartPointer<vtkImageData> MakeRandomImage(Random& random);

}
#endif
