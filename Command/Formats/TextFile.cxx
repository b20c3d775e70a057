// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TextFile.h"

#include <cstring>

namespace penumbra
{

TextFile::TextFile(const std::string& path)
  : File(path)
{
  const bool isLittle =
    this->File.Size() >= 2 && std::memcmp(this->File.Begin(), "\xff\xfe", 2) == 0;
  const bool isBig = this->File.Size() >= 2 && std::memcmp(this->File.Begin(), "\xfe\xff", 2) == 0;
  this->IsConverted = isLittle || isBig;
  if (!this->IsConverted)
  {
    return;
  }
  this->Text.reserve(this->File.Size() / 2);
  for (const char* unit = this->File.Begin() + 2; this->File.End() - unit >= 2; unit += 2)
  {
    const char low = unit[isBig ? 1 : 0];
    const char high = unit[isBig ? 0 : 1];
    const bool isAscii = high == 0 && static_cast<unsigned char>(low) < 0x80;
    this->Text += isAscii ? low : '?';
  }
}

}
