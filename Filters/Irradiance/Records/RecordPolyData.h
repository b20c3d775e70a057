// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Conversion of records to vtkPolyData in world coordinates and back. Each record is a vertex cell.
// Point arrays: `AmbientOcclusion` (1) or `Irradiance` (3), `Normals` (3), `Radius`, `Lean`
// (maximum distance from the tangent plane), `TranslationGradient` and `RotationGradient` (one
// vector per channel), `Tangent` (3), `Clearance` (8), `Bend` (Hessian norm), `StandardError`,
// `Serves` (1 if valid).
#ifndef penumbra_RecordPolyData_h
#define penumbra_RecordPolyData_h

#include "Record.h"

#include <string>
#include <vector>

class vtkPolyData;

namespace penumbra
{

struct SceneCoordinates;

/// Quantity that records store.
enum class Quantities
{
  Occlusion, ///< occluded fraction, the first channel of the mean
  Irradiance ///< pi times the mean, three channels
};

/// Returns true if `data` has the array of `quantity`.
VTKPENUMBRAFILTERSIRRADIANCE_EXPORT bool HasRecords(vtkPolyData* data, Quantities quantity);

/// Converts `records` and replaces the contents of `data`.
void ToPolyData(const std::vector<Record>& records, Quantities quantity,
  const SceneCoordinates& coordinates, vtkPolyData* data);

/// Converts `data` to records. If arrays are missing or contain invalid values, returns no records
/// and describes the problem in `problem`.
VTKPENUMBRAFILTERSIRRADIANCE_EXPORT std::vector<Record> FromPolyData(vtkPolyData* data,
  Quantities quantity, const SceneCoordinates& coordinates, std::string& problem);

}
#endif
