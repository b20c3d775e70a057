// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Readers of mesh formats. Each throws CommandError, naming the file, if it is damaged.
#ifndef penumbra_MeshReaders_h
#define penumbra_MeshReaders_h

#include "vtkSmartPointer.h"

#include <string>

class vtkDataObject;

namespace penumbra
{

/// Field data array of what a reader left out, such as bytes that the header of an STL file does not declare: one
/// warning per string.
constexpr const char* UnreadContent = "UnreadContent";

/// Returns whether a file starts as an input file of Abaqus.
bool IsAbaqus(const std::string& path);

/// Parts and their instances; solids, shells, membranes, trusses and beams, linear or quadratic.
vtkSmartPointer<vtkDataObject> ReadAbaqus(const std::string& path);

/// ASCII and binary of either byte order. Reads the elements vertex, face, tristrips and, in files
/// without faces, edge; properties of any type. Properties without a meaning become arrays of their
/// name.
vtkSmartPointer<vtkDataObject> ReadPly(const std::string& path);

///@{
/// Arrays of ReadObj(): the cell array of material ids, and the field data arrays with the names of
/// the materials, by id, and of their files, one string per line of the OBJ file.
constexpr const char* ObjMaterialIds = "MaterialIds";
constexpr const char* ObjMaterialNames = "MaterialNames";
constexpr const char* ObjLibraryNames = "MaterialLibraries";
///@}

/// Polygons, lines and points with groups, materials, normals, texture coordinates and colors.
vtkSmartPointer<vtkDataObject> ReadObj(const std::string& path);

/// Text, of vertices with or without normals, colors, texture coordinates and weights.
vtkSmartPointer<vtkDataObject> ReadOff(const std::string& path);

/// Points with intensities (array Intensities) and colors (Color).
vtkSmartPointer<vtkDataObject> ReadPts(const std::string& path);

/// Text in any case and indentation, and binary. Coincident points are merged.
vtkSmartPointer<vtkDataObject> ReadStl(const std::string& path);

}
#endif
