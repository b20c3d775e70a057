// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "XdmfCopy.h"

#include "Files/InputFiles.h"
#include "Files/MappedFile.h"
#include "Files/Placeholders.h"
#include "Files/TemporaryFile.h"
#include "Processes/CommandError.h"

#include <filesystem>
#include <fstream>
#include <set>
#include <string_view>
#include <vector>

namespace penumbra
{

namespace
{

namespace fs = std::filesystem;

const std::string SecureNamespace = "https://www.w3.org/2001/XInclude";
const std::string Namespace = "http://www.w3.org/2001/XInclude";

/// Returns where the next item of data begins; npos if there is none. Items in comments do not count.
std::size_t FindItem(std::string_view text, std::size_t from)
{
  while (from != text.npos)
  {
    const std::size_t item = text.find("<DataItem", from);
    const std::size_t comment = text.find("<!--", from);
    if (comment >= item)
    {
      return item;
    }
    from = text.find("-->", comment);
  }
  return from;
}

/// Returns the relative names of files with data in `text`, which are parts of it, in order.
std::vector<std::string_view> FindDataFiles(std::string_view text)
{
  std::vector<std::string_view> names;
  for (std::size_t at = FindItem(text, 0); at != text.npos; at = FindItem(text, at))
  {
    const std::size_t end = text.find('>', at);
    if (end == text.npos)
    {
      break;
    }
    const std::string_view tag = text.substr(at, end - at);
    at = end;
    const bool isHdf = tag.find("=\"HDF") != tag.npos;
    if (tag.back() == '/' || (!isHdf && tag.find("=\"Binary\"") == tag.npos))
    {
      continue;
    }
    constexpr const char* blanks = " \t\r\n";
    const std::size_t begin = text.find_first_not_of(blanks, end + 1);
    std::string_view name =
      begin == text.npos ? std::string_view() : text.substr(begin, text.find('<', begin) - begin);
    name = name.substr(0, isHdf ? name.find(':') : name.find_last_not_of(blanks) + 1);
    const bool isRelative = !name.empty() && name[0] != '/';
    if (isRelative && name.find('.') != name.npos) // Names without an extension may be drivers.
    {
      names.push_back(name);
    }
  }
  return names;
}

}

std::string CopyXdmf(const std::string& path, Appearance*, std::vector<std::string>&)
{
  const MappedFile file(path);
  const std::string_view text(file.Begin(), file.Size());
  const fs::path folder = fs::absolute(path).parent_path();
  const std::vector<std::string_view> names = FindDataFiles(text);
  for (const std::string_view name : std::set<std::string_view>(names.begin(), names.end()))
  {
    if (name.find('&') != name.npos)
    {
      continue; // an entity of XML
    }
    std::error_code ignored;
    if (!fs::exists(folder / name, ignored))
    {
      throw CommandError(BadInput,
        path + ": its data in '" + std::string(name) + "' are missing; copy them to their place");
    }
    RecordInput((folder / name).string());
  }
  if (text.find(SecureNamespace) == text.npos)
  {
    return {};
  }
  const std::string copy = CreateTemporaryFile(".xdmf");
  const std::string written =
    ReplaceAll(ReplaceAll((folder / "").string(), "&", "&amp;"), "<", "&lt;");
  std::ofstream stream(copy, std::ios::binary);
  std::string_view rest = text;
  const auto writeUntil = [&](std::string_view part) {
    const auto length = static_cast<std::size_t>(part.data() - rest.data());
    stream << ReplaceAll(std::string(rest.substr(0, length)), SecureNamespace, Namespace);
    rest.remove_prefix(length);
  };
  for (const std::string_view name : names)
  {
    writeUntil(name);
    stream << written; // The copy is in another folder.
  }
  writeUntil(text.substr(text.size()));
  stream.close();
  if (!stream)
  {
    throw CommandError(BadInput,
      path + ": its copy cannot be written to " +
        (copy.empty() ? "the folder of temporary files" : copy) + "; set TMPDIR to another folder");
  }
  return copy;
}

}
