// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Atomic file write: a temporary file in the same folder that is renamed when it is complete.
#ifndef penumbra_AtomicFile_h
#define penumbra_AtomicFile_h

#include <string>

namespace penumbra
{

/// Throws CommandError if `path`, the value of `option`, is an input file (InputFiles.h).
/// AtomicFile calls it in its constructor and again before renaming.
void RefuseInput(const std::string& path, const std::string& option);

/// Describes the first symbolic link on the path of a folder whose target does not exist; empty if there is none.
std::string DescribeBrokenLink(const std::string& folder);

class AtomicFile
{
public:
  /// Throws CommandError if `path` cannot be created. `option`: its option, for messages.
  AtomicFile(const std::string& path, const std::string& option);
  ~AtomicFile();

  AtomicFile(const AtomicFile&) = delete;
  void operator=(const AtomicFile&) = delete;

  /// Path to write to before Commit(); it has the extension of the final path.
  const std::string& TemporaryPath() const { return this->Temporary; }

  /// Writes `bytes` as the contents of the file.
  void Write(const std::string& bytes);

  /// Renames the file to its final name.
  void Commit();

  /// Throws CommandError with a reason why the file cannot be written.
  [[noreturn]] void Fail(const std::string& reason) const;

private:
  std::string Option;
  std::string Path;
  std::string Temporary;
};

}
#endif
