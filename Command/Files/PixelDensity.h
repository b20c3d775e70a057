// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Sets the resolution in dots per inch in encoded images, which VTK's writers do not support.
#ifndef penumbra_PixelDensity_h
#define penumbra_PixelDensity_h

#include <string>

namespace penumbra
{

/// PNG: the chunk pHYs before the first IDAT (PNG specification, 11.3.5.3).
void SetDensityOfPng(std::string& bytes, int dotsPerInch);

/// JPEG: unit and densities of the JFIF header (JFIF 1.02).
void SetDensityOfJpeg(std::string& bytes, int dotsPerInch);

/// BMP: biXPelsPerMeter and biYPelsPerMeter of the header.
void SetDensityOfBmp(std::string& bytes, int dotsPerInch);

}
#endif
