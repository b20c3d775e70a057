// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Extracts valid surfaces with finite points from a file, one for each data set.
#ifndef penumbra_Surfaces_h
#define penumbra_Surfaces_h

#include "Cuts.h"
#include "Import/Appearance.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <optional>
#include <string>
#include <vector>

class vtkPolyData;

namespace penumbra
{

/// Name of the cell array with the faces of curved cells, which are subdivided.
extern const char* const CurvedFaces;

struct Surfaces
{
  std::vector<std::string> Files; ///< that were read
  std::vector<vtkSmartPointer<vtkPolyData>> Meshes;
  std::vector<std::string> Names; ///< of the files of Meshes, and of the data sets in them
  /// With the materials of Meshes; null: of none. Empty unless materials were requested.
  std::vector<vtkSmartPointer<vtkActor>> Actors;
  std::vector<vtkSmartPointer<vtkLight>> Lights;
  std::vector<vtkSmartPointer<vtkCamera>> Cameras;
  std::vector<std::string> Warnings; ///< with the name of the file
  vtkIdType Points = 0;              ///< in the file
  vtkIdType DroppedPoints = 0;       ///< non-finite points, skipped with the cells that use them
  vtkIdType Polygons = 0;            ///< in Meshes
  vtkIdType ShortPolygons = 0; ///< those with fewer than three corners, of which nothing is drawn
  /// Distance of neighboring single-precision coordinates if it is visible in the bounds, else 0.
  double RoundingStep = 0.0;
  bool HasArea = false; ///< if off, all cells are polygons without area or lines without length

  /// Appends the surfaces, lights and cameras of another file. Counts are added.
  void Append(const Surfaces& other);
};

/// What to read from a file.
struct InputOptions
{
  std::optional<double> Time; ///< unset: the first time step
  bool Materials = false;     ///< read materials, lights and cameras, too
  bool AllowEmpty = false;    ///< a file without cells and points has no surfaces
  CutList Cuts;
};

/// Reads the surfaces of a file or of one step of a file series. Throws CommandError, naming the
/// file, if it cannot be read, contains no cells or points, or is inconsistent.
Surfaces ReadSurfaces(const std::string& path, const InputOptions& options = {});

}
#endif
