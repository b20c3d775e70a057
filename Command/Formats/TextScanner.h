// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Forward scanner of words and numbers in a text that is in memory.
#ifndef penumbra_TextScanner_h
#define penumbra_TextScanner_h

#include <cstddef>
#include <string>
#include <string_view>

namespace penumbra
{

/// Parses a whole word as a number, independent of the locale. Returns false if it is none.
bool ParseNumber(std::string_view word, double& value);
bool ParseInteger(std::string_view word, long long& value);

/// Returns whether two ASCII words are equal except for the case of letters.
bool EqualsIgnoringCase(std::string_view a, std::string_view b);

class TextScanner
{
public:
  /// `comment`: the character that starts a comment up to the end of the line; 0: none.
  /// A byte order mark at the beginning is skipped.
  TextScanner(const char* begin, const char* end, char comment = 0);

  /// Returns the next word of the line; empty at its end. A backslash at the end continues a line.
  std::string_view WordInLine();

  /// Returns the words left in the line with single blanks between them: a name that may contain blanks.
  std::string WordsInLine();

  /// Returns the next word of the text; empty at its end.
  std::string_view Word();

  /// Returns the next word of the text without moving past it.
  std::string_view Peek() const;

  /// Returns the number of words left in the line.
  int CountWordsInLine() const;

  /// Returns the rest of the line and moves to the next.
  std::string_view Line();

  bool AtEnd() const { return this->At == this->End; }
  std::size_t Left() const { return static_cast<std::size_t>(this->End - this->At); }
  const char* Rest() const { return this->At; }

private:
  bool IsContinuation() const;
  void SkipNewline();
  void SkipBlanksInLine();

  const char* At;
  const char* End;
  char Comment;
};

}
#endif
