// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MappedFile.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace penumbra
{

MappedFile::MappedFile(const std::string& path)
{
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat status = {};
  if (file >= 0 && fstat(file, &status) == 0 && status.st_size > 0)
  {
    const auto size = static_cast<std::size_t>(status.st_size);
    void* map = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
    if (map != MAP_FAILED)
    {
      this->Bytes = static_cast<const char*>(map);
      this->NumberOfBytes = size;
    }
  }
  if (file >= 0)
  {
    close(file);
  }
}

MappedFile::~MappedFile()
{
  if (this->NumberOfBytes > 0)
  {
    munmap(const_cast<char*>(this->Bytes), this->NumberOfBytes);
  }
}

}
