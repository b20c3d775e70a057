// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Pictures of what the benchmark of the irradiance cache measures, to be looked at.
#ifndef penumbra_irradiance_Pictures_h
#define penumbra_irradiance_Pictures_h

#include <glm/glm.hpp>

#include <string>
#include <vector>

class vtkPolyData;

namespace penumbra
{

/// Colours from 0 to 1, row after row from below, as a PNG file.
void WritePicture(const std::string& path, int width, const std::vector<glm::dvec3>& colors);

/// Two bakings of one mesh (point array `AmbientOcclusion`) beside each other, and what the first has
/// more (red) or less (blue): .05 and more is full colour.
void WriteBakings(const std::string& path, vtkPolyData* baked, vtkPolyData* other);

}
#endif
