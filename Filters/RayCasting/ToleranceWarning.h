// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The warning of an image whose estimated error exceeds its tolerance.
#ifndef penumbra_ToleranceWarning_h
#define penumbra_ToleranceWarning_h

#include "Image/ImageRenderer.h"

#include <string>

class vtkImageData;

namespace penumbra
{

/**
 * Returns a warning, with the property to increase, if the estimated error of the image, of 4 tiles
 * of 16x16 pixels, or of 1 % of the tiles exceeds the tolerance of a tile; else an empty string.
 * `totals`: of the whole `image`, which has the arrays of RenderImage().
 */
std::string DescribeMissedTolerance(
  const IntegrationSettings& settings, const ImageTotals& totals, vtkImageData* image);

}
#endif
