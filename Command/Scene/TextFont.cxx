// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TextFont.h"

#include "Files/Report.h"
#include "FontFile.h"
#include "Processes/CommandError.h"

#include "vtkTextProperty.h"

#include <algorithm>
#include <cstdlib>

namespace penumbra
{

namespace
{

/// VTK's own font has the characters of Latin-1.
constexpr char32_t LastOfVtkFont = 0xff;

void Warn(const std::string& text, const std::string& font)
{
  PrintWarnings({ font + " lacks characters of '" + text +
    "'; set the environment variable PENUMBRA_FONT to the path of a font that has them" });
}

}

void SetFontFor(const std::string& text, vtkTextProperty* property, bool warns)
{
  const std::u32string characters = DecodeUtf8(text);
  const char* chosen = std::getenv("PENUMBRA_FONT");
  std::string path = chosen ? chosen : "";
  if (!path.empty())
  {
    if (!HasCharacters(path, U"0"))
    {
      throw CommandError(BadInput,
        path +
          ": the file that PENUMBRA_FONT names is not a TrueType or OpenType font; set it to "
          "another");
    }
    if (warns && !HasCharacters(path, characters))
    {
      Warn(text, path);
    }
  }
  else if (std::any_of(characters.begin(), characters.end(),
             [](char32_t character) { return character > LastOfVtkFont; }))
  {
    path = FindFontWith(characters);
    if (warns && path.empty())
    {
      Warn(text, "no installed font has all characters: VTK's font");
    }
  }
  if (!path.empty())
  {
    property->SetFontFamily(VTK_FONT_FILE);
    property->SetFontFile(path.c_str());
  }
}

}
