// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Reads the first image of a .tif (TIFF 6.0). vtkTIFFReader ignores or reverses the order of rows and columns, and the
// libtiff of VTK's package does not decode LZW.
#ifndef penumbra_TiffFile_h
#define penumbra_TiffFile_h

#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;

namespace penumbra
{

/// Returns the image with its orientation applied: 1 or 2 channels (gray, alpha), or 3 or 4 (RGB, alpha), of bytes,
/// 16-bit integers or floats. Throws std::runtime_error, whose text states what to do, if the file is damaged or of
/// another kind.
vtkSmartPointer<vtkImageData> ReadTiff(const std::string& path);

}
#endif
