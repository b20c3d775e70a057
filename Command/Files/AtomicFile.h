// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A file that appears whole or not at all: written beside its place, then renamed.
#ifndef penumbra_AtomicFile_h
#define penumbra_AtomicFile_h

#include <string>

namespace penumbra
{

/// Throws Failure where `path`, which `option` asks to write, is one of the files that are read
/// (InputFiles.h). AtomicFile does so itself, when it is made and again before it is renamed.
void RefuseInput(const std::string& path, const std::string& option);

class AtomicFile
{
public:
  /// Throws Failure when a file cannot be made at `path`. `option` names who asked, for messages.
  AtomicFile(const std::string& path, const std::string& option);
  ~AtomicFile();

  AtomicFile(const AtomicFile&) = delete;
  void operator=(const AtomicFile&) = delete;

  /// Where to write until Commit(); it ends as the file's name does.
  const std::string& TemporaryPath() const { return this->Temporary; }

  /// Write `bytes` as the whole contents.
  void Write(const std::string& bytes);

  /// Give the file its name.
  void Commit();

  /// The Failure of a file that could not be written whole.
  [[noreturn]] void Fail(const std::string& reason) const;

private:
  std::string Option;
  std::string Path;
  std::string Temporary;
};

}
#endif
