// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Pixels of an image as bytes.
#ifndef penumbra_ImageMessage_h
#define penumbra_ImageMessage_h

#include "Messages/ByteStream.h"

class vtkImageData;

namespace penumbra
{

/// Adds the point arrays of `image` in `extent`, which its own contains, and its field data.
void AddPixels(vtkImageData* image, const int extent[6], ByteWriter& bytes);

/// Copies what AddPixels() has added into an image with a larger or the same extent. Adds arrays that the image
/// does not have.
void GetPixels(ByteReader& bytes, vtkImageData* image);

/// Reduces an image to the pixels in `extent`.
void CropImage(const int extent[6], vtkImageData* image);

}
#endif
