// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Characters of TrueType and OpenType fonts, and the installed font that has given characters.
#ifndef penumbra_FontFile_h
#define penumbra_FontFile_h

#include <string>

namespace penumbra
{

/// Decodes UTF-8; bytes that are not UTF-8 are replaced by U+FFFD.
std::u32string DecodeUtf8(const std::string& text);

/// Returns whether the font, or the first of a collection, has a glyph for every character.
bool HasCharacters(const std::string& fontPath, const std::u32string& characters);

/// Returns the path of an installed font that has every character, upright and of regular weight if
/// there is one; empty if there is none.
std::string FindFontWith(const std::u32string& characters);

}
#endif
