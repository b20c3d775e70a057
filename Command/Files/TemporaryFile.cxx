// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TemporaryFile.h"

#include <cstdlib>

#include <unistd.h>

namespace penumbra
{

std::string CreateTemporaryFile(const std::string& extension)
{
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (error)
  {
    return {};
  }
  std::string name = (folder / "penumbra-XXXXXX").string();
  name += extension;
  const int descriptor = mkstemps(&name[0], static_cast<int>(extension.size()));
  if (descriptor < 0)
  {
    return {};
  }
  close(descriptor);
  RemoveOnCrash(name);
  return name;
}

}
