// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Baseline files: .png with 8 or 16 bits per channel, or .vti with floats. Private to this module.
#ifndef penumbra_BaselineFiles_h
#define penumbra_BaselineFiles_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkImageData;

namespace penumbra
{

/// Returns true if the extension of `path` is that of a supported image file.
bool IsBaselinePath(const std::string& path);

/// Returns the existing files among `path` and name_1.png, name_2.png, ... next to it.
std::vector<std::string> FindBaselines(const std::string& path);

/// Returns the path of the next baseline in this sequence.
std::string NextBaseline(const std::string& path);

/// Reads an image; returns nullptr if `path` cannot be read as one.
vtkSmartPointer<vtkImageData> ReadBaseline(const std::string& path);

/// Returns the colors of `image` as stored in the file `path`: for .png, floats become bytes, and
/// alpha is dropped if it is 1 everywhere.
vtkSmartPointer<vtkImageData> AsStored(vtkImageData* image, const std::string& path);

/// Writes the file atomically; returns false if it cannot be written.
bool WriteBaseline(vtkImageData* image, const std::string& path);

}
#endif
