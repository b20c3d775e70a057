// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "InputFiles.h"

#include "FileExtension.h"
#include "Processes/CommandConstants.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <utility>

#include <fnmatch.h>
#include <sys/stat.h>

namespace penumbra
{

namespace
{

namespace fs = std::filesystem;

using FileId = std::pair<dev_t, ino_t>;

/// Size in bytes and time of the last change in nanoseconds.
struct FileState
{
  unsigned long long Bytes;
  long long Changed;
};

using Files = std::map<FileId, FileState>;

Files Inputs;

bool Add(const fs::path& path, Files& files)
{
  struct stat status = {};
  return stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) &&
    files
      .emplace(FileId(status.st_dev, status.st_ino),
        FileState{ static_cast<unsigned long long>(status.st_size),
          status.st_mtim.tv_sec * 1000000000ll + status.st_mtim.tv_nsec })
      .second;
}

// Returns whether the format refers to other files.
bool IsIndex(const fs::path& path)
{
  const std::string extension = LowerExtension(path);
  const char* known[] = { ".vtm", ".vtmb", ".vtpd", ".vtpc", ".pvtp", ".pvtu", ".pvti", ".pvts",
    ".pvtr", ".pvd", ".series", ".case", ".encas", ".xdmf", ".xmf", ".mhd", ".nhdr", ".gltf" };
  return std::find(std::begin(known), std::end(known), extension) != std::end(known);
}

void AddTree(const fs::path& path, Files& files);

// Returns whether a name is a pattern: "geo.***" for numbered EnSight steps, "s%03d.raw" for image slices.
bool IsPattern(const std::string& name)
{
  return name.find_first_of("*%") != std::string::npos;
}

void AddPattern(const fs::path& pattern, Files& files)
{
  std::string name = pattern.filename().string();
  std::replace(name.begin(), name.end(), '*', '?');
  const std::size_t percent = name.find('%');
  if (percent != std::string::npos)
  {
    const std::size_t end = std::min(name.find('d', percent), name.size() - 1);
    name.replace(percent, end - percent + 1, "*");
  }
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(pattern.parent_path(), ignored))
  {
    if (fnmatch(name.c_str(), entry.path().filename().c_str(), 0) == 0)
    {
      AddTree(entry.path(), files);
    }
  }
}

void AddIfNamed(const fs::path& folder, const std::string& word, Files& files)
{
  if (word.empty() || word.size() > 4096 || word.find('\0') != std::string::npos)
  {
    return;
  }
  const fs::path path = folder / word;
  if (IsPattern(path.filename().string()))
  {
    AddPattern(path, files);
  }
  else
  {
    AddTree(path, files);
  }
}

// Adds the files that a header refers to. Each word, each quoted text, and the rest of a line after a colon
// or an equals sign counts as a reference if a file of that name exists.
void AddReferences(const fs::path& path, Files& files)
{
  std::ifstream file(path, std::ios::binary);
  std::string text(MaximumHeaderSize, '\0');
  file.read(&text[0], MaximumHeaderSize);
  text.resize(static_cast<std::size_t>(file.gcount()));
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const auto addBetween = [&](const char* delimiters) {
    for (std::size_t begin = 0; begin < text.size();)
    {
      const std::size_t end = std::min(text.find_first_of(delimiters, begin), text.size());
      AddIfNamed(folder, text.substr(begin, end - begin), files);
      begin = end + 1;
    }
  };
  addBetween("\"'\n\r");
  addBetween(" \t\n\r\"'<>=");
  for (const char* sign : { ": ", "= " })
  {
    for (std::size_t at = 0; (at = text.find(sign, at)) != std::string::npos;)
    {
      at += 2;
      const std::size_t end = std::min(text.find_first_of("\n\r", at), text.size());
      AddIfNamed(folder, text.substr(at, end - at), files);
    }
  }
}

void AddFolder(const fs::path& folder, Files& files)
{
  std::error_code ignored;
  for (fs::recursive_directory_iterator entry(folder, ignored), end; entry != end;
       entry.increment(ignored))
  {
    Add(entry->path(), files);
  }
}

void AddTree(const fs::path& path, Files& files)
{
  if (!Add(path, files))
  {
    return;
  }
  if (IsIndex(path))
  {
    AddReferences(path, files);
  }
  else if (LowerExtension(path) == ".foam")
  {
    // The case is the folder: numbered time steps, constant, system and processor folders.
    std::error_code ignored;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    {
      const std::string name = entry.path().filename().string();
      if (entry.is_directory(ignored) &&
        (name == "constant" || name == "system" || name.rfind("processor", 0) == 0 ||
          std::isdigit(static_cast<unsigned char>(name[0]))))
      {
        AddFolder(entry.path(), files);
      }
    }
  }
  else if (LowerExtension(path) == ".cas")
  {
    fs::path data = path; // Fluent stores values next to the mesh.
    Add(data.replace_extension(".dat"), files);
  }
}

}

void RecordInput(const std::string& path)
{
  AddTree(path, Inputs);
}

bool IsInput(const std::string& path)
{
  struct stat status = {};
  return stat(path.c_str(), &status) == 0 && Inputs.count(FileId(status.st_dev, status.st_ino)) > 0;
}

unsigned long long InputBytes(const std::string& path)
{
  Files files;
  AddTree(path, files);
  unsigned long long bytes = 0;
  for (const auto& file : files)
  {
    bytes += file.second.Bytes;
  }
  return bytes;
}

std::string DescribeInput(const std::string& path)
{
  Files files;
  AddTree(path, files);
  unsigned long long bytes = 0;
  long long changed = 0;
  for (const auto& file : files)
  {
    bytes += file.second.Bytes;
    changed = std::max(changed, file.second.Changed);
  }
  return path + ' ' + std::to_string(bytes) + ' ' + std::to_string(changed);
}

}
