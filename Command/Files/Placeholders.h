// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Placeholders in paths and texts.
#ifndef penumbra_Placeholders_h
#define penumbra_Placeholders_h

#include <string>

namespace penumbra
{

constexpr const char* FramePlaceholder = "{frame}";
constexpr const char* TimePlaceholder = "{time}";

inline bool Contains(const std::string& pattern, const std::string& placeholder)
{
  return pattern.find(placeholder) != std::string::npos;
}

/// Returns `pattern` with every `placeholder` replaced by `value`; `placeholder` may be any part of a text.
inline std::string ReplaceAll(
  std::string pattern, const std::string& placeholder, const std::string& value)
{
  for (std::size_t at = 0; (at = pattern.find(placeholder, at)) != std::string::npos;
       at += value.size())
  {
    pattern.replace(at, placeholder.size(), value);
  }
  return pattern;
}

}
#endif
