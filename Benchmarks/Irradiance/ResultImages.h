// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Images of the results of the irradiance cache benchmark, for visual inspection.
#ifndef penumbra_irradiance_ResultImages_h
#define penumbra_irradiance_ResultImages_h

#include <glm/glm.hpp>

#include <string>
#include <vector>

class vtkPolyData;

namespace penumbra
{

/// Writes colors in [0, 1], row by row from the bottom, to a PNG file.
void WriteImage(const std::string& path, int width, const std::vector<glm::dvec3>& colors);

/// Renders two bakings of one mesh (point array `AmbientOcclusion`) next to each other, and their
/// difference: red where the first is larger, blue where it is smaller; 0.05 and more is saturated.
void WriteBakings(const std::string& path, vtkPolyData* baked, vtkPolyData* other);

}
#endif
