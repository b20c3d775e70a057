// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A temporary folder for the files that are exchanged with peer programs.
#ifndef penumbra_TemporaryFolder_h
#define penumbra_TemporaryFolder_h

#include <unistd.h>

#include <filesystem>
#include <string>

namespace penumbra
{

/// A folder that is unique to this process; the destructor removes it.
struct TemporaryFolder
{
  TemporaryFolder() { std::filesystem::create_directories(this->Path); }
  ~TemporaryFolder()
  {
    std::error_code error;
    std::filesystem::remove_all(this->Path, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  void operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path Path =
    std::filesystem::temp_directory_path() / ("penumbra-chart-" + std::to_string(getpid()));
};

}
#endif
