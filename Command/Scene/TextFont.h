// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Fonts of texts in images.
#ifndef penumbra_TextFont_h
#define penumbra_TextFont_h

#include <string>

class vtkTextProperty;

namespace penumbra
{

/// Sets a font that has the characters of `text`: the file that the environment variable
/// PENUMBRA_FONT names, else VTK's font for Latin, else an installed font. If
/// `warns`, prints a warning if there is none. Throws CommandError if PENUMBRA_FONT names no font.
void SetFontFor(const std::string& text, vtkTextProperty* property, bool warns);

}
#endif
