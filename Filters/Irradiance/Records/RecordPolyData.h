// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Records as vtkPolyData in world coordinates and back: what is saved, inspected, reused and drawn.
// A vertex cell a record; point arrays `AmbientOcclusion` (1) or `Irradiance` (3), `Normals` (3),
// `Radius`, `TranslationGradient` and `RotationGradient` (3 or 9: a vector a channel), `Tangent`
// (3), `Clearance` (8), `Bend`, `StandardError`, `Serves` (0: brute force is to answer around it).
#ifndef penumbra_RecordPolyData_h
#define penumbra_RecordPolyData_h

#include "Record.h"

#include <string>
#include <vector>

class vtkPolyData;

namespace penumbra
{

struct Scene;

/// Which of the two means of the hemisphere a record holds.
enum class Quantities
{
  Occlusion, ///< its first channel, the blocked share
  Irradiance ///< pi times its mean, three channels
};

/// Has `data` the array of that quantity?
VTKPENUMBRAFILTERSIRRADIANCE_EXPORT bool HasRecords(vtkPolyData* data, Quantities quantity);

/// Replaces what `data` holds.
void ToPolyData(
  const std::vector<Record>& records, Quantities quantity, const Scene& scene, vtkPolyData* data);

/// Empty, with `problem` told, where arrays are missing or hold what no record can be.
VTKPENUMBRAFILTERSIRRADIANCE_EXPORT std::vector<Record> FromPolyData(
  vtkPolyData* data, Quantities quantity, const Scene& scene, std::string& problem);

}
#endif
