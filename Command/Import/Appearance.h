// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What a file describes besides surfaces: materials, lights, cameras.
#ifndef penumbra_Appearance_h
#define penumbra_Appearance_h

#include "vtkSmartPointer.h"

#include <memory>
#include <set>
#include <string>
#include <vector>

class vtkActor;
class vtkCamera;
class vtkDataObject;
class vtkDataSet;
class vtkImporter;
class vtkLight;
class vtkPolyData;
class vtkRenderer;

namespace penumbra
{

class TemporaryFile;

/// Name of the cell array with the cell ids in the file, if they differ from those of the surface.
constexpr const char* OriginalCellIds = "PenumbraOriginalCellIds";

struct Appearance
{
  /// Actors with the material of each data set of the file, in order; null: it has no material.
  /// Their mappers and transforms are ignored, except the colors of vertices.
  std::vector<vtkSmartPointer<vtkActor>> Actors;
  std::vector<vtkSmartPointer<vtkLight>> Lights;
  std::vector<vtkSmartPointer<vtkCamera>> Cameras;
  std::vector<std::string> Warnings;   ///< without the name of the file
  std::shared_ptr<TemporaryFile> Copy; ///< file to import instead; null: none
};

/// Returns the data sets of `data`, the leaves of composite data in order. Adds the classes of other
/// leaves with elements, such as tables, to `others` unless it is null.
std::vector<vtkDataSet*> FindDataSets(vtkDataObject* data, std::set<std::string>* others = nullptr);

/// Returns `mesh` without the points that no cell uses.
vtkSmartPointer<vtkPolyData> RemoveUnusedPoints(vtkPolyData* mesh);

/// Runs an importer of VTK without a graphics context, and returns the renderer that it fills and keeps alive.
vtkRenderer* RunImporter(vtkImporter* importer);

///@{
/// Read the appearance of a file whose surfaces are `data`, and return the data sets to which
/// Appearance::Actors belong.
vtkSmartPointer<vtkDataObject> ImportGltf(
  const std::string& path, vtkDataObject* data, Appearance& appearance);
vtkSmartPointer<vtkDataObject> ImportObj(
  const std::string& path, vtkDataObject* data, Appearance& appearance);
vtkSmartPointer<vtkDataObject> Import3ds(
  const std::string& path, vtkDataObject* data, Appearance& appearance);
vtkSmartPointer<vtkDataObject> ImportVrml(
  const std::string& path, vtkDataObject* data, Appearance& appearance);
///@}

///@{
/// Read the surfaces of a file. Throw CommandError, naming the file, if it cannot be read.
vtkSmartPointer<vtkDataObject> Read3ds(const std::string& path);
vtkSmartPointer<vtkDataObject> ReadVrml(const std::string& path);
///@}

}
#endif
