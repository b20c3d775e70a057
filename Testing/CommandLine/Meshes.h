// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Small meshes in every format that VTK writes, made at test time.
#ifndef penumbra_testing_Meshes_h
#define penumbra_testing_Meshes_h

#include <string>
#include <vector>

namespace penumbra_testing
{

/// A square of side 2 centered at the origin, at z = 0, facing +z: ASCII STL.
std::string SquareStl();

/// A red square from 0 to 1 at z = 0 with a camera: 3DS.
std::string Make3ds();

/// A sphere of radius 0.5 in `folder`: .stl .ply .obj .vtp .vtk .vtu .vts .vti .vtr .vtm .off
/// .gltf, ... Returns the names of the files.
std::vector<std::string> WriteSpheres(const std::string& folder);

/// A sphere of radius 0.5 as .vtp with the point arrays Height (z) and Direction (the normal) and
/// the cell array Number.
void WriteSphereWithArrays(const std::string& path);

}
#endif
