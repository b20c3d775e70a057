// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A file in memory; UTF-16 text is converted.
#ifndef penumbra_TextFile_h
#define penumbra_TextFile_h

#include "Files/MappedFile.h"

#include <cstddef>
#include <string>

namespace penumbra
{

class TextFile
{
public:
  /// Maps the file at `path`. Of UTF-16 text with a byte order mark, ASCII characters are kept and
  /// all others become question marks.
  explicit TextFile(const std::string& path);

  const char* Begin() const { return this->IsConverted ? this->Text.data() : this->File.Begin(); }
  const char* End() const { return this->Begin() + this->Size(); }
  std::size_t Size() const { return this->IsConverted ? this->Text.size() : this->File.Size(); }

private:
  MappedFile File;
  std::string Text;
  bool IsConverted = false;
};

}
#endif
