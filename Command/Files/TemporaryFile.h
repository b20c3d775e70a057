// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A temporary file, removed at the end of its lifetime and after a crash.
#ifndef penumbra_TemporaryFile_h
#define penumbra_TemporaryFile_h

#include "Processes/Worker.h"

#include <filesystem>
#include <string>
#include <system_error>

namespace penumbra
{

/// Creates an empty file in the folder of temporary files and registers it with RemoveOnCrash().
/// Returns its path; empty if it cannot be created.
std::string CreateTemporaryFile(const std::string& extension);

class TemporaryFile
{
public:
  /// `path`: of a file that CreateTemporaryFile() created; empty: no file.
  explicit TemporaryFile(const std::string& path)
    : Path(path)
  {
  }

  ~TemporaryFile()
  {
    if (!this->Path.empty())
    {
      std::error_code ignored;
      std::filesystem::remove(this->Path, ignored);
      KeepOnCrash(this->Path);
    }
  }

  TemporaryFile(const TemporaryFile&) = delete;
  void operator=(const TemporaryFile&) = delete;

  const std::string Path;
};

}
#endif
