// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TextScanner.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstring>
#include <limits>

namespace penumbra
{

namespace
{

bool IsBlank(char c)
{
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

bool IsNewline(char c)
{
  return c == '\n' || c == '\r';
}

std::string_view WithoutPlus(std::string_view word)
{
  return !word.empty() && word.front() == '+' ? word.substr(1) : word;
}

}

bool ParseNumber(std::string_view word, double& value)
{
  const std::string_view number = WithoutPlus(word);
  const char* end = number.data() + number.size();
  const auto [rest, error] = std::from_chars(number.data(), end, value);
  if (error == std::errc::result_out_of_range)
  {
    const bool tiny = number.find("e-") != number.npos || number.find("E-") != number.npos;
    value = tiny ? 0.0 : std::numeric_limits<double>::infinity();
    return true;
  }
  if (error == std::errc() && rest != end && *rest == '#')
  {
    value = std::numeric_limits<double>::quiet_NaN(); // "1.#QNAN" of old C libraries
    return true;
  }
  return error == std::errc() && rest == end;
}

bool ParseInteger(std::string_view word, long long& value)
{
  const std::string_view number = WithoutPlus(word);
  const char* end = number.data() + number.size();
  const auto [rest, error] = std::from_chars(number.data(), end, value);
  return error == std::errc() && rest == end;
}

bool EqualsIgnoringCase(std::string_view a, std::string_view b)
{
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) ==
      std::tolower(static_cast<unsigned char>(y));
  });
}

TextScanner::TextScanner(const char* begin, const char* end, char comment)
  : At(begin),
    End(end),
    Comment(comment)
{
  if (end - begin >= 3 && std::memcmp(begin, "\xef\xbb\xbf", 3) == 0)
  {
    this->At += 3;
  }
}

bool TextScanner::IsContinuation() const
{
  return *this->At == '\\' && this->End - this->At > 1 && IsNewline(this->At[1]);
}

void TextScanner::SkipNewline()
{
  if (this->At != this->End)
  {
    const bool two = *this->At == '\r' && this->End - this->At > 1 && this->At[1] == '\n';
    this->At += two ? 2 : 1;
  }
}

void TextScanner::SkipBlanksInLine()
{
  while (this->At != this->End)
  {
    if (IsBlank(*this->At))
    {
      ++this->At;
    }
    else if (this->IsContinuation())
    {
      ++this->At;
      this->SkipNewline();
    }
    else if (this->Comment && *this->At == this->Comment)
    {
      this->At = std::find_if(this->At, this->End, IsNewline);
    }
    else
    {
      return;
    }
  }
}

std::string_view TextScanner::WordInLine()
{
  this->SkipBlanksInLine();
  const char* begin = this->At;
  while (this->At != this->End && !IsBlank(*this->At) && !IsNewline(*this->At) &&
    !this->IsContinuation() && (!this->Comment || *this->At != this->Comment))
  {
    ++this->At;
  }
  return { begin, static_cast<std::size_t>(this->At - begin) };
}

std::string TextScanner::WordsInLine()
{
  std::string words;
  for (std::string_view word = this->WordInLine(); !word.empty(); word = this->WordInLine())
  {
    words += (words.empty() ? "" : " ") + std::string(word);
  }
  return words;
}

std::string_view TextScanner::Word()
{
  for (;;)
  {
    const std::string_view word = this->WordInLine();
    if (!word.empty() || this->At == this->End)
    {
      return word;
    }
    this->SkipNewline();
  }
}

std::string_view TextScanner::Peek() const
{
  TextScanner copy = *this;
  return copy.Word();
}

int TextScanner::CountWordsInLine() const
{
  TextScanner copy = *this;
  int words = 0;
  while (!copy.WordInLine().empty())
  {
    ++words;
  }
  return words;
}

std::string_view TextScanner::Line()
{
  const char* begin = this->At;
  this->At = std::find_if(this->At, this->End, IsNewline);
  const std::string_view line(begin, static_cast<std::size_t>(this->At - begin));
  this->SkipNewline();
  return line;
}

}
