// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Forward reader of a memory-mapped file, for the scanners of file formats.
#ifndef penumbra_FileCursor_h
#define penumbra_FileCursor_h

#include "Files/MappedFile.h"

#include <cstddef>
#include <string>

namespace penumbra
{

/// Thrown if a file ends too early.
struct TruncatedFile
{
  const char* Item; ///< what is missing, in the singular ("value")
};

/// Thrown if the structure of a file is unknown. Its reader reports the error.
struct UnknownStructure
{
};

class FileCursor
{
public:
  /// Throws UnknownStructure if the file cannot be mapped or is empty.
  explicit FileCursor(const std::string& path);

  /// Skips white space; returns whether the end of the file is reached.
  bool AtEnd();

  /// Returns the next word; empty at the end.
  std::string Word();

  /// Returns the next word in lower case without moving past it.
  std::string Peek();

  /// Gets the rest of the line; returns false at the end of the file.
  bool Line(std::string& line);

  // The following throw TruncatedFile with `item` if the file ends first.
  std::string RequireLine(const char* item);
  long long Count(const char* item); ///< also throws UnknownStructure if it is not a count
  void SkipWords(long long count, const char* item);
  void SkipLines(long long count, const char* item);
  void SkipBytes(long double count, const char* item);

  const char* Rest() const { return this->At; }
  std::size_t Left() const { return static_cast<std::size_t>(this->End - this->At); }

private:
  MappedFile Map;
  const char* At = nullptr;
  const char* End = nullptr;
};

/// Returns the number of words of a line.
int CountWords(const std::string& line);

}
#endif
