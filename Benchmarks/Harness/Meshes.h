// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef penumbra_Meshes_h
#define penumbra_Meshes_h

#include "vtkSmartPointer.h"

#include <string>

class vtkPolyData;

namespace penumbra
{

/// Reads an .off file of triangles. Throws std::runtime_error if this fails.
vtkSmartPointer<vtkPolyData> ReadOff(const std::string& path);

/// Returns the mesh with point normals, averaged over the adjacent triangles.
vtkSmartPointer<vtkPolyData> Smooth(vtkPolyData* mesh);

/// Subdivides every triangle into 4^times triangles.
vtkSmartPointer<vtkPolyData> Subdivide(vtkPolyData* mesh, int times);

/// Builds a wavy height field of 2 (side - 1)^2 triangles.
vtkSmartPointer<vtkPolyData> WavySheet(int side);

}
#endif
