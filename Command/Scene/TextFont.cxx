// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TextFont.h"

#include "Files/FileExtension.h"
#include "Files/MappedFile.h"
#include "Files/Report.h"
#include "Processes/CommandError.h"

#include "vtkTextProperty.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace penumbra
{

namespace
{

namespace fs = std::filesystem;

/// Reads big-endian numbers; 0 beyond the end.
class FontData
{
public:
  explicit FontData(const MappedFile& file)
    : Bytes(reinterpret_cast<const unsigned char*>(file.Begin())),
      Size(file.Size())
  {
  }

  std::uint32_t Short(std::size_t at) const
  {
    return at + 2 <= this->Size ? this->Bytes[at] << 8 | this->Bytes[at + 1] : 0u;
  }

  std::uint32_t Long(std::size_t at) const { return this->Short(at) << 16 | this->Short(at + 2); }

  bool HasTag(std::size_t at, const char* tag) const
  {
    return at + 4 <= this->Size && std::memcmp(this->Bytes + at, tag, 4) == 0;
  }

private:
  const unsigned char* Bytes;
  std::size_t Size;
};

/// Offset of the table `cmap`; 0 if there is none.
std::size_t FindCharacterMap(const FontData& font)
{
  const std::size_t start = font.HasTag(0, "ttcf") ? font.Long(12) : 0;
  const std::uint32_t tables = font.Short(start + 4);
  for (std::uint32_t i = 0; i < tables; ++i)
  {
    const std::size_t record = start + 12 + 16 * std::size_t(i);
    if (font.HasTag(record, "cmap"))
    {
      return font.Long(record + 8);
    }
  }
  return 0;
}

/// Segments of 16-bit characters.
bool IsInFormat4(const FontData& font, std::size_t table, char32_t character)
{
  const std::size_t segments = font.Short(table + 6) / 2;
  const std::size_t ends = table + 14;
  const std::size_t starts = ends + 2 * segments + 2;
  for (std::size_t i = 0; i < segments && character < 0xffff; ++i)
  {
    if (character <= font.Short(ends + 2 * i))
    {
      const std::uint32_t start = font.Short(starts + 2 * i);
      const std::uint32_t delta = font.Short(starts + 2 * (segments + i));
      const std::size_t rangeAt = starts + 4 * segments + 2 * i;
      const std::uint32_t range = font.Short(rangeAt);
      if (character < start)
      {
        return false;
      }
      const std::uint32_t glyph =
        range == 0 ? character : font.Short(rangeAt + range + 2 * (std::size_t(character) - start));
      return glyph != 0 && ((glyph + delta) & 0xffff) != 0;
    }
  }
  return false;
}

/// Groups of 32-bit characters.
bool IsInFormat12(const FontData& font, std::size_t table, char32_t character)
{
  const std::uint32_t groups = std::min<std::uint32_t>(font.Long(table + 12), 1u << 20);
  for (std::uint32_t i = 0; i < groups; ++i)
  {
    const std::size_t group = table + 16 + 12 * std::size_t(i);
    if (character >= font.Long(group) && character <= font.Long(group + 4))
    {
      return true;
    }
  }
  return false;
}

/// Bytes, whose characters above 127 depend on the platform.
bool IsInFormat0(const FontData& font, std::size_t table, char32_t character)
{
  return character < 0x80 && (font.Short(table + 6 + std::size_t(character)) >> 8) != 0;
}

/// One range of 16-bit characters.
bool IsInFormat6(const FontData& font, std::size_t table, char32_t character)
{
  const std::uint32_t first = font.Short(table + 6);
  const std::uint32_t count = font.Short(table + 8);
  return character < 0x80 && character >= first && character - first < count &&
    font.Short(table + 10 + 2 * (std::size_t(character) - first)) != 0;
}

/// VTK uses the first table that FreeType can read.
bool HasCharacter(const FontData& font, std::size_t map, char32_t character)
{
  const std::uint32_t tables = font.Short(map + 2);
  for (std::uint32_t i = 0; i < tables; ++i)
  {
    const std::size_t table = map + font.Long(map + 4 + 8 * std::size_t(i) + 4);
    switch (font.Short(table))
    {
      case 0:
        return IsInFormat0(font, table, character);
      case 4:
        return IsInFormat4(font, table, character);
      case 6:
        return IsInFormat6(font, table, character);
      case 12:
        return IsInFormat12(font, table, character);
      default:
        break;
    }
  }
  return false;
}

std::vector<fs::path> FontFolders()
{
  std::vector<fs::path> folders;
  if (const char* home = std::getenv("HOME"))
  {
    folders = { fs::path(home) / ".local/share/fonts", fs::path(home) / ".fonts" };
  }
  folders.insert(folders.end(), { "/usr/local/share/fonts", "/usr/share/fonts" });
  return folders;
}

/// 0 for an upright sans serif of regular weight; more for other styles.
int RateStyle(const fs::path& path)
{
  const std::string name = LowerCase(path.filename().string());
  int rating = 0;
  for (const char* style :
    { "bold", "italic", "oblique", "light", "black", "thin", "condensed", "mono", "serif" })
  {
    rating += name.find(style) != name.npos ? 2 : 0;
  }
  return rating + (name.find("sans") == name.npos ? 1 : 0);
}

/// Decodes UTF-8; bytes that are not UTF-8 are replaced by U+FFFD.
std::u32string DecodeUtf8(const std::string& text)
{
  std::u32string characters;
  for (std::size_t i = 0; i < text.size();)
  {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t length = byte < 0x80 ? 1
      : byte >> 5 == 6                     ? 2
      : byte >> 4 == 14                    ? 3
      : byte >> 3 == 30                    ? 4
                                           : 0;
    char32_t character = length > 1 ? byte & (0x7f >> length) : byte;
    bool valid = length > 0 && i + length <= text.size();
    for (std::size_t k = 1; valid && k < length; ++k)
    {
      const auto next = static_cast<unsigned char>(text[i + k]);
      valid = next >> 6 == 2;
      character = character << 6 | (next & 0x3f);
    }
    characters += valid ? character : U'\xfffd';
    i += valid ? length : 1;
  }
  return characters;
}

/// Returns whether the font, or the first of a collection, has a glyph for every character.
bool HasCharacters(const std::string& fontPath, const std::u32string& characters)
{
  const MappedFile file(fontPath);
  const FontData font(file);
  const std::size_t map = FindCharacterMap(font);
  return map != 0 && std::all_of(characters.begin(), characters.end(), [&](char32_t character) {
    return character <= U' ' || HasCharacter(font, map, character);
  });
}

/// Returns the path of an installed font that has every character, upright and of regular weight if
/// there is one; empty if there is none.
std::string FindFontWith(const std::u32string& characters)
{
  std::vector<std::pair<int, std::string>> fonts;
  for (const fs::path& folder : FontFolders())
  {
    std::error_code ignored;
    for (fs::recursive_directory_iterator entry(folder, ignored), end; entry != end;
         entry.increment(ignored))
    {
      const std::string extension = LowerExtension(entry->path());
      if (extension == ".ttf" || extension == ".otf" || extension == ".ttc")
      {
        fonts.emplace_back(RateStyle(entry->path()), entry->path().string());
      }
    }
  }
  std::sort(fonts.begin(), fonts.end());
  for (const auto& [rating, path] : fonts)
  {
    if (HasCharacters(path, characters))
    {
      return path;
    }
  }
  return {};
}

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
