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
/// Courier and Times; characters outside Windows code page 1252 become question marks and are
/// counted in `replaced`.
std::string EncodePdf(const VectorFigure& figure, int& replaced);

}
#endif
