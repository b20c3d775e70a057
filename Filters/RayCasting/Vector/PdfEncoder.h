// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Writes a figure as PDF 1.4 [ISO 32000-1].
#ifndef penumbra_PdfEncoder_h
#define penumbra_PdfEncoder_h

#include "VectorFigure.h"

#include <string>

namespace penumbra
{

/// Returns the contents of a .pdf file of one page. Text is in one of the standard fonts Helvetica,
/// Courier and Times. Text with characters outside Windows code page 1252, or in a font from a file,
/// is outlines, under invisible text that can be selected; such texts are counted in
/// `outlinedTexts`. Throws std::runtime_error if VTK's font lacks a character, too.
std::string EncodePdf(const VectorFigure& figure, int& outlinedTexts);

}
#endif
