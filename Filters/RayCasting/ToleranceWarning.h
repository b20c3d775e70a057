// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The warning of an image whose estimated error exceeds its tolerance.
#ifndef penumbra_ToleranceWarning_h
#define penumbra_ToleranceWarning_h

#include "Image/ImageRenderer.h"
#include "vtkPenumbraRayCasterConstants.h"

#include "vtkType.h"

#include <glm/vec2.hpp>

#include <string>

class vtkImageData;

namespace penumbra
{

/// How the errors of an image compare with its tolerance.
struct ToleranceReport
{
  vtkIdType TilesAboveTolerance = 0; ///< number of tiles of 16x16 pixels
  std::string Warning;               ///< with the property to increase; may be empty
};

/**
 * Compares the estimated errors of the tiles of `image` with the tolerance of a tile. There is a
 * warning if that of the image, of 4 tiles, or of 1 % of the tiles exceeds it. `image` has the arrays of
 * RenderImage() and may be a part of an image of `resolution` pixels: what it lacks of a tile counts as
 * exact, because the tolerance is that of whole tiles. `constants`: name and value of the tolerance in the warning.
 * `totals`: of `image`. `timeLimit`: seconds of the
 * limit that ended the work, which warns of a single tile; 0 if none did.
 */
ToleranceReport CheckTolerance(const IntegrationSettings& settings,
  const RayCasterConstants& constants, const ImageTotals& totals, double timeLimit,
  vtkImageData* image, const glm::ivec2& resolution);

}
#endif
