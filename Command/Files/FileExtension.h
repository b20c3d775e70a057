// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Extensions of file names, whose case is ignored.
#ifndef penumbra_FileExtension_h
#define penumbra_FileExtension_h

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace penumbra
{

inline std::string LowerCase(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

/// Returns the extension of `path` with its dot, in lower case.
inline std::string LowerExtension(const std::filesystem::path& path)
{
  return LowerCase(path.extension().string());
}

}
#endif
