// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// From vtkPenumbraMedium to Medium and LightShafts: world to scene coordinates, and defaults from
// the scene's size.
#ifndef penumbra_MediumExtraction_h
#define penumbra_MediumExtraction_h

#include "LightShafts.h"

#include <optional>
#include <string>

class vtkPenumbraMedium;

namespace penumbra
{

/// `diagonal`: of the scene, in world units. Nothing where the numbers are not finite or no bounds.
std::optional<Medium> ConvertMedium(vtkPenumbraMedium* source, const Scene& scene, double diagonal);

/// The light shafts that `source` (null: none) makes of a scene; nothing where there are none, with
/// the reason in `warning`.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT std::optional<LightShafts> MakeLightShafts(
  vtkPenumbraMedium* source, const Shading& shading, double diagonal,
  LightShafts::MarchQuality effort, std::string& warning);

}
#endif
