// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Pictures that the program wrote, read back.
#ifndef penumbra_testing_Pictures_h
#define penumbra_testing_Pictures_h

#include "vtkSmartPointer.h"

#include <array>
#include <string>

class vtkImageData;

namespace penumbra_testing
{

/// A picture of any format; an empty one when it cannot be read.
vtkSmartPointer<vtkImageData> ReadImage(const std::string& path);

using Pixel = std::array<double, 3>;

/// The colour of a pixel, counted from the left and the bottom, full intensity 1.
Pixel PixelAt(vtkImageData* image, int x, int y);

}
#endif
