// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FileCursor.h"

#include "Files/FileExtension.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <sstream>

namespace penumbra
{

namespace
{

bool IsSpace(char character)
{
  return std::isspace(static_cast<unsigned char>(character)) != 0;
}

}

FileCursor::FileCursor(const std::string& path)
  : Map(path)
{
  if (this->Map.Size() == 0)
  {
    throw UnknownStructure();
  }
  this->At = this->Map.Begin();
  this->End = this->Map.End();
}

bool FileCursor::AtEnd()
{
  this->At = std::find_if_not(this->At, this->End, IsSpace);
  return this->At == this->End;
}

std::string FileCursor::Word()
{
  this->AtEnd();
  const char* begin = this->At;
  this->At = std::find_if(begin, this->End, IsSpace);
  return std::string(begin, this->At);
}

std::string FileCursor::Peek()
{
  const char* before = this->At;
  const std::string word = LowerCase(this->Word());
  this->At = before;
  return word;
}

bool FileCursor::Line(std::string& line)
{
  if (this->At == this->End)
  {
    return false;
  }
  const char* end = std::find(this->At, this->End, '\n');
  line.assign(this->At, end);
  this->At = end == this->End ? end : end + 1;
  line.erase(line.find_last_not_of(" \t\r") + 1);
  return true;
}

std::string FileCursor::RequireLine(const char* item)
{
  std::string line;
  if (!this->Line(line))
  {
    throw TruncatedFile{ item };
  }
  return line;
}

long long FileCursor::Count(const char* item)
{
  const std::string word = this->Word();
  if (word.empty())
  {
    throw TruncatedFile{ item };
  }
  char* end = nullptr;
  const long long count = std::strtoll(word.c_str(), &end, 10);
  if (*end || count < 0)
  {
    throw UnknownStructure();
  }
  return count;
}

void FileCursor::SkipWords(long long count, const char* item)
{
  for (; count > 0; --count)
  {
    if (this->AtEnd())
    {
      throw TruncatedFile{ item };
    }
    this->At = std::find_if(this->At, this->End, IsSpace);
  }
}

void FileCursor::SkipLines(long long count, const char* item)
{
  for (; count > 0; --count)
  {
    if (this->At == this->End)
    {
      throw TruncatedFile{ item };
    }
    this->At = std::find(this->At, this->End, '\n');
    this->At += this->At != this->End;
  }
}

void FileCursor::SkipBytes(long double count, const char* item)
{
  if (count > static_cast<long double>(this->End - this->At))
  {
    throw TruncatedFile{ item };
  }
  this->At += static_cast<std::ptrdiff_t>(count);
}

int CountWords(const std::string& line)
{
  std::istringstream words(line);
  int count = 0;
  for (std::string word; words >> word;)
  {
    ++count;
  }
  return count;
}

}
