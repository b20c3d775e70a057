// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Bytes of image files: whether a file is whole, which VTK's readers do not check, and the resolution in dots per
// inch, which its writers do not support.
#ifndef penumbra_ImageBytes_h
#define penumbra_ImageBytes_h

#include <cstddef>
#include <string>

namespace penumbra
{

/// Returns whether a .png is complete, its critical chunks are undamaged, and its pixels can be
/// decompressed. vtkPNGReader may crash otherwise.
bool IsWholePng(const char* begin, std::size_t size);

/// Returns whether a .tif of the machine's byte order contains its directory and all strips.
bool IsWholeTiff(const std::string& path);

/// PNG: the chunk pHYs before the first IDAT (PNG specification, 11.3.5.3).
void SetDensityOfPng(std::string& bytes, int dotsPerInch);

/// JPEG: unit and densities of the JFIF header (JFIF 1.02).
void SetDensityOfJpeg(std::string& bytes, int dotsPerInch);

/// BMP: biXPelsPerMeter and biYPelsPerMeter of the header.
void SetDensityOfBmp(std::string& bytes, int dotsPerInch);

}
#endif
