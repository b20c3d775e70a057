// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A file mapped into memory for reading.
#ifndef penumbra_MappedFile_h
#define penumbra_MappedFile_h

#include <cstddef>
#include <string>

namespace penumbra
{

class MappedFile
{
public:
  /// Maps the file at `path`; if it cannot be opened or is empty, Size() is 0.
  explicit MappedFile(const std::string& path);
  ~MappedFile();

  MappedFile(const MappedFile&) = delete;
  void operator=(const MappedFile&) = delete;

  const char* Begin() const { return this->Bytes; }
  const char* End() const { return this->Bytes + this->NumberOfBytes; }
  std::size_t Size() const { return this->NumberOfBytes; }

private:
  const char* Bytes = nullptr;
  std::size_t NumberOfBytes = 0;
};

}
#endif
