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

// Names of files may be this long on Linux; of a longer one the temporary name takes the beginning.
constexpr std::size_t LongestName = 255;
constexpr std::size_t TemporaryPart = 200;
constexpr std::size_t LongestExtension = 16;

// A link stays, what it points to is written.
fs::path FollowLinks(fs::path path)
{
  std::error_code error;
  for (int depth = 0; depth < 40 && fs::is_symlink(path, error); ++depth)
  {
    path = path.parent_path() / fs::read_symlink(path, error);
  }
  return path;
}

// Of its own for every writer, those on other machines and in other containers included; some of
// VTK's writers insist on the extension.
std::string TemporaryName(const fs::path& target)
{
  const std::string name = target.filename().string();
  const std::string extension = target.extension().string();
  std::ostringstream temporary;
  temporary << '.' << name.substr(0, TemporaryPart) << '.' << getpid() << '-' << std::hex
            << std::random_device()();
  return temporary.str() + (extension.size() > LongestExtension ? "" : extension);
}

}

void RefuseInput(const std::string& path, const std::string& option)
{
  if (IsInput(path))
  {
    throw CommandError(
      BadInput, option + " " + path + ": this is one of the files to be read; name another");
  }
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
    this->Fail("the folder does not exist; make it first");
  }
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored))
  {
    this->Fail(fs::is_directory(target, ignored) ? "this is a folder; name a file in it"
                                                 : "this is not a regular file; name another");
  }
  const std::string name = target.filename().string();
  if (name.size() > LongestName)
  {
    this->Fail("the name is too long; shorten it to " + std::to_string(LongestName) + " bytes");
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0)
  {
    this->Fail("the folder cannot be written; choose another");
  }
  this->Temporary = (folder / TemporaryName(target)).string();
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
  bool whole = file && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  whole = file && std::fflush(file) == 0 && whole;
  const int error = errno;
  whole = file && std::fclose(file) == 0 && whole;
  if (!whole)
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
