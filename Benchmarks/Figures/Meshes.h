// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef penumbra_Meshes_h
#define penumbra_Meshes_h

#include "vtkSmartPointer.h"

#include <string>

class vtkPolyData;

namespace penumbra
{

/// Reads an .off file of triangles. Throws std::runtime_error.
vtkSmartPointer<vtkPolyData> ReadOff(const std::string& path);

/// With normals at the points, averaged over the triangles around.
vtkSmartPointer<vtkPolyData> Smooth(vtkPolyData* mesh);

/// Every triangle divided into 4^times.
vtkSmartPointer<vtkPolyData> Subdivide(vtkPolyData* mesh, int times);

/// A wavy sheet of 2 (side - 1)^2 triangles.
vtkSmartPointer<vtkPolyData> WavySheet(int side);

}
#endif
