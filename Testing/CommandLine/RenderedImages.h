// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Reads images that the program wrote.
#ifndef penumbra_testing_RenderedImages_h
#define penumbra_testing_RenderedImages_h

#include "vtkSmartPointer.h"

#include <array>
#include <string>

class vtkImageData;

namespace penumbra_testing
{

/// Reads an image of any format; returns an empty image if it cannot be read.
vtkSmartPointer<vtkImageData> ReadImage(const std::string& path);

using Pixel = std::array<double, 3>;

/// Color of a pixel in [0, 1]; the indices start at the lower left corner.
Pixel PixelAt(vtkImageData* image, int x, int y);

}
#endif
