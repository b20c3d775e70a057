// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Conversion of vtkPenumbraMedium to Medium and LightShafts: world to scene coordinates, and
// defaults that depend on the size of the scene.
#ifndef penumbra_MediumExtraction_h
#define penumbra_MediumExtraction_h

#include "LightShafts.h"

#include <optional>
#include <string>

class vtkPenumbraMedium;

namespace penumbra
{

struct SceneCoordinates;

/// Converts `source` to scene coordinates. `diagonal` is the diagonal of the scene in world units.
/// Throws std::runtime_error, with a sentence without period, if a setting is invalid.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT SpectralMedium ConvertMedium(
  vtkPenumbraMedium* source, const SceneCoordinates& coordinates, double diagonal);

/// Creates the light shafts of a scene in the medium `source`. Returns nothing if `source` is null,
/// or if there are no light shafts; then `warning` gives the reason.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT std::optional<LightShafts> MakeLightShafts(
  vtkPenumbraMedium* source, const Shading& shading, double diagonal,
  LightShafts::MarchQuality quality, std::string& warning);

}
#endif
