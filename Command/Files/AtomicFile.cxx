// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "AtomicFile.h"

#include "InputFiles.h"
#include "Processes/CommandError.h"
#include "Processes/Worker.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>
#include <sstream>

#include <unistd.h>

namespace penumbra
{

namespace fs = std::filesystem;

namespace
{

// Lengths in bytes: the longest file name on Linux, the part of it that the temporary name repeats, and
// the longest extension that the temporary name keeps.
constexpr std::size_t MaximumNameLength = 255;
constexpr std::size_t TemporaryPrefixLength = 200;
constexpr std::size_t MaximumExtensionLength = 16;

// Resolves symbolic links, so that the target is replaced and the link is kept.
fs::path FollowLinks(fs::path path)
{
  std::error_code error;
  for (int depth = 0; depth < 40 && fs::is_symlink(path, error); ++depth)
  {
    path = path.parent_path() / fs::read_symlink(path, error);
  }
  return path;
}

// Returns a name that is unique among all writers, including those on other machines and in containers.
// It keeps the extension, which some of VTK's writers require.
std::string MakeTemporaryName(const fs::path& target)
{
  const std::string name = target.filename().string();
  const std::string extension = target.extension().string();
  std::ostringstream temporary;
  temporary << '.' << name.substr(0, TemporaryPrefixLength) << '.' << getpid() << '-' << std::hex
            << std::random_device()();
  return temporary.str() + (extension.size() > MaximumExtensionLength ? "" : extension);
}

}

void RefuseInput(const std::string& path, const std::string& option)
{
  if (IsInput(path))
  {
    throw CommandError(
      BadInput, option + " " + path + ": the path is an input file; choose another");
  }
}

std::string DescribeBrokenLink(const std::string& folder)
{
  fs::path link;
  std::error_code ignored;
  for (const fs::path& part : fs::path(folder))
  {
    link /= part;
    if (fs::is_symlink(link, ignored) &&
      fs::status(link, ignored).type() == fs::file_type::not_found)
    {
      return link.string() + " is a symbolic link to " + fs::read_symlink(link, ignored).string() +
        ", which does not exist; create that folder or remove the link";
    }
  }
  return std::string();
}

AtomicFile::AtomicFile(const std::string& path, const std::string& option)
  : Option(option),
    Path(path)
{
  RefuseInput(path, option);
  std::error_code ignored;
  const fs::path target = FollowLinks(path);
  this->Path = target.string();
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored))
  {
    const std::string broken = DescribeBrokenLink(folder.string());
    this->Fail(broken.empty() ? "the folder does not exist; create it first" : broken);
  }
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored))
  {
    this->Fail(fs::is_directory(target, ignored)
        ? "the path is a folder; name a file in it"
        : "the path is not a regular file; choose another");
  }
  const std::string name = target.filename().string();
  if (name.size() > MaximumNameLength)
  {
    this->Fail(
      "the name is too long; shorten it to " + std::to_string(MaximumNameLength) + " bytes");
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0)
  {
    this->Fail("the folder is not writable; choose another");
  }
  this->Temporary = (folder / MakeTemporaryName(target)).string();
  RemoveOnCrash(this->Temporary);
}

AtomicFile::~AtomicFile()
{
  if (!this->Temporary.empty())
  {
    unlink(this->Temporary.c_str());
    KeepOnCrash(this->Temporary);
  }
}

void AtomicFile::Fail(const std::string& reason) const
{
  throw CommandError(BadInput, this->Option + " " + this->Path + ": cannot be written: " + reason);
}

void AtomicFile::Write(const std::string& bytes)
{
  std::FILE* file = std::fopen(this->Temporary.c_str(), "wb");
  bool complete = file && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  complete = file && std::fflush(file) == 0 && complete;
  const int error = errno;
  complete = file && std::fclose(file) == 0 && complete;
  if (!complete)
  {
    this->Fail(strerror(error));
  }
}

void AtomicFile::Commit()
{
  RefuseInput(this->Path, this->Option);
  if (std::rename(this->Temporary.c_str(), this->Path.c_str()) != 0)
  {
    this->Fail(strerror(errno));
  }
  KeepOnCrash(this->Temporary);
  this->Temporary.clear();
}

}
