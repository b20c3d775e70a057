// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Baselines on disk: .png, 8 or 16 bits a channel, or .vti with floats as they are. Private to this
// module.
#ifndef penumbra_PictureFiles_h
#define penumbra_PictureFiles_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkImageData;

namespace penumbra
{

/// Ends `path` like a file of pictures?
bool IsPicturePath(const std::string& path);

/// `path`, and beside it as many as there are of name_1.png, name_2.png, ...; only what exists.
std::vector<std::string> FindBaselines(const std::string& path);

/// The path of the baseline that would be the next of these.
std::string NextBaseline(const std::string& path);

/// nullptr where `path` holds no picture.
vtkSmartPointer<vtkImageData> ReadPicture(const std::string& path);

/// The colours of `picture` as the file `path` would hold them: for .png floats become bytes, and
/// alpha is left out where it is 1 everywhere.
vtkSmartPointer<vtkImageData> AsStored(vtkImageData* picture, const std::string& path);

/// Appears whole or not at all; false where it cannot be written.
bool WritePicture(vtkImageData* picture, const std::string& path);

}
#endif
