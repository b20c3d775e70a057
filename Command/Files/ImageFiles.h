// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Pictures to and from files: .png, .jpg, .tif, .bmp with 8 bits a channel, .vti with all arrays.
#ifndef penumbra_ImageFiles_h
#define penumbra_ImageFiles_h

#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;

namespace penumbra
{

class AtomicFile;

/// The formats of pictures, as ".png .jpg ..."; for messages and lists.
std::string PictureExtensions();

/// Throws Failure unless `path` ends like a picture. `option` names who asked.
void CheckPictureExtension(const std::string& path, const std::string& option);

/// Does the format that `path` names hold alpha?
bool SupportsAlpha(const std::string& path);

/// Is it .vti, with arrays of floats?
bool HoldsArrays(const std::string& path);

/// Write `image`, whose point array `Color` has 4 floats, in the format that `path` names.
/// Without `alpha` the 8-bit formats get three channels. `note` goes into the text of a .png.
void WritePicture(vtkImageData* image, AtomicFile& file, const std::string& path, bool alpha,
  int dotsPerInch, const std::string& note = std::string());

/// The note in a .png; empty where there is no such file, no note in it, or it is damaged.
std::string ReadNote(const std::string& path);

/// Throws Failure when `path` holds no picture.
vtkSmartPointer<vtkImageData> ReadPicture(const std::string& path);

}
#endif
