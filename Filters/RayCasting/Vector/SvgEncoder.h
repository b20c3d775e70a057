// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Writes a figure as SVG 1.1.
#ifndef penumbra_SvgEncoder_h
#define penumbra_SvgEncoder_h

#include "VectorFigure.h"

#include <string>

namespace penumbra
{

/// Returns the contents of an .svg file. The image is embedded as PNG; text is in <text> elements.
std::string EncodeSvg(const VectorFigure& figure);

}
#endif
