// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Image I/O: .png, .jpg, .tif, .bmp with 8 bits per channel, .vti with all arrays.
#ifndef penumbra_ImageFiles_h
#define penumbra_ImageFiles_h

#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;

namespace penumbra
{

class AtomicFile;

/// Extensions of the image formats, as ".png .jpg ...".
std::string ImageExtensions();

/// Throws CommandError unless `path` has the extension of an image format. `option`: its option,
/// for messages.
void CheckImageExtension(const std::string& path, const std::string& option);

/// Returns whether `path` has the extension of a format of vector graphics: .svg or .pdf.
bool IsVectorGraphic(const std::string& path);

/// Throws CommandError unless `path` has the extension of an image format or of vector graphics.
/// `option`: its option, for messages.
void CheckOutputExtension(const std::string& path, const std::string& option);

/// Returns whether the format of `path` has an alpha channel.
bool SupportsAlpha(const std::string& path);

/// Returns whether the format of `path` is .vti, which stores arrays of floats.
bool HoldsArrays(const std::string& path);

/// Writes `image`, whose point array `Color` has 4 floats, in the format of `path`. Without `alpha`
/// the 8-bit formats have three channels. `note` is stored in a text chunk of a .png.
void WriteImage(vtkImageData* image, AtomicFile& file, const std::string& path, bool alpha,
  int dotsPerInch, const std::string& note = std::string());

/// Returns the note of a .png; empty if the file is missing or damaged, or has no note.
std::string ReadNote(const std::string& path);

/// Reads an image. Throws CommandError if `path` is not a valid image.
vtkSmartPointer<vtkImageData> ReadImage(const std::string& path);

}
#endif
